//! Many instances, one after the other, at once, and each on a thread of its own.

use crate::client::Client;

#[test]
fn a_thousand_instances_live_side_by_side() {
    let clients: Vec<_> = (0..1000).map(|_| Client::three().ready(&[])).collect();
    let expected = clients[0].run((0, 3), 0.01);
    assert!(clients[1..].iter().all(|client| client.run((0, 3), 0.01) == expected));
}

#[test]
fn ten_threads_give_the_bits_of_one_run_alone() {
    let alone = Client::three().ready(&[]).run((0, 200), 0.01);
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..10)
            .map(|index| {
                scope.spawn(move || {
                    let client = if index % 2 == 0 { Client::two() } else { Client::three() };
                    client.ready(&[]).run((0, 200), 0.01)
                })
            })
            .collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), alone);
        }
    });
}

#[test]
fn two_thousand_lives_in_one_process() {
    for _ in 0..2000 {
        let client = Client::three().ready(&[]);
        client.save(); // freed with its instance
        client.run((0, 1), 0.01);
    }
}
