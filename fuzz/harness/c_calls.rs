//! Random calls of all functions of the C library, on a few simulations of small scenes at once.

use std::ffi::{CStr, CString, c_char};
use std::ptr::null_mut;
use std::sync::LazyLock;

use jostle::scene::catalogue::names;
use jostle_c::*;

use super::hand::*;

/// Longest step: what takes little time with every engine. Longer ones are for `tests/abuse`.
const LONGEST_STEP: f64 = 0.05;

/// Work of one call, so that the boundary is tried and not the patience.
const MOST_WORK: u64 = 2000;

/// Names of scenes and variables, numbers, and texts that are neither.
static TEXTS: LazyLock<Vec<CString>> = LazyLock::new(|| {
    const TEXTS: [&str; 46] = [
        "1e-3",
        "7",
        "nan",
        "-1",
        "1e300",
        "0",
        "1e-9",
        "0.3",
        "random_phase",
        "walls",
        "packing",
        "wedge",
        "ratchet",
        "three_disk",
        "molecular-dynamics",
        "molecular-dynamics-located",
        "event-driven",
        "map",
        "input",
        "sine",
        "harmonic-torque",
        "",
        "sandpile",
        "base.displacement",
        "base.velocity",
        "base.model",
        "torque",
        "torque.rate",
        "torque.amplitude",
        "support.shape",
        "support.amplitude",
        "disk.angle[1]",
        "disk.drop_height",
        "seed",
        "gravity",
        "tolerance",
        "collisions",
        "drive.amplitude",
        "drive.frequency",
        "contact.friction",
        "contact.normal_stiffness",
        "time_step",
        "scene = 'wedge'\nengine = 'map'",
        "scene = 'packing'\ndisks = 3\n[parameters]\nbase.model = 'random_phase'",
        "scene = [",
        "box.width",
    ];
    let texts = TEXTS.iter().map(|text| CString::new(*text));
    texts.collect::<Result<_, _>>().expect("no zero byte")
});

/// Scene, engine and drive of everything in the catalogue, and whether it may have more than one disk.
static SCENES: LazyLock<Vec<([CString; 3], bool)>> = LazyLock::new(|| {
    let name = |text: &str| CString::new(text).expect("no zero byte");
    let scenes = names().into_iter();
    let scenes = scenes.map(|names| {
        let many = ["packing", "ratchet"].contains(&names.scene);
        ([names.scene, names.engine, names.drive].map(name), many)
    });
    scenes.collect()
});

struct Caller<'a> {
    hand: Hand<'a>,
    simulations: [*mut JostleSimulation; 3],
    saved: Vec<u8>,
    error: [c_char; 256],
}

impl Caller<'_> {
    fn simulation(&mut self) -> *mut JostleSimulation {
        static NOTHING: [u64; 64] = [0; 64];
        match self.hand.below(24) {
            0 => null_mut(),
            1 => NOTHING.as_ptr().cast_mut().cast(),
            index => self.simulations[index % 3],
        }
    }

    fn error_size(&mut self) -> usize {
        [0, 1, 7, 256][self.hand.below(4)]
    }
}

fn draw<D: Draw>(caller: &mut Caller) -> D::Argument {
    D::draw(&mut caller.hand)
}

type Call = fn(&mut Caller);

const CALLS: &[Call] = &[
    create,
    create,
    |caller| {
        let index = caller.hand.below(3);
        // SAFETY: null or alive.
        unsafe { jostle_free(std::mem::replace(&mut caller.simulations[index], null_mut())) }
    },
    step,
    step,
    step,
    // SAFETY, here and below: simulations are null, alive or memory that is none; pointers are as `Hand` promises.
    |caller| check(unsafe { jostle_advance_to(caller.simulation(), draw::<Real>(caller).min(LONGEST_STEP)) }),
    |caller| check(unsafe { jostle_time(caller.simulation(), draw::<Reals>(caller)) }),
    |caller| check(unsafe { jostle_find(caller.simulation(), draw::<Text>(caller), draw::<References>(caller)) }),
    |caller| {
        let (simulation, references) = (caller.simulation(), draw::<References>(caller));
        check(unsafe { jostle_set(simulation, references, draw::<Reals>(caller), draw::<Length>(caller)) })
    },
    |caller| check(unsafe { jostle_set_by_name(caller.simulation(), draw::<Text>(caller), draw::<Real>(caller)) }),
    |caller| {
        let (simulation, references) = (caller.simulation(), draw::<References>(caller));
        check(unsafe { jostle_get(simulation, references, draw::<Reals>(caller), draw::<Length>(caller)) })
    },
    |caller| {
        let (simulation, references) = (caller.simulation(), draw::<References>(caller));
        check(unsafe { jostle_get_integers(simulation, references, draw::<Longs>(caller), draw::<Length>(caller)) })
    },
    |caller| check(unsafe { jostle_get_by_name(caller.simulation(), draw::<Text>(caller), draw::<Reals>(caller)) }),
    |caller| {
        check(unsafe { jostle_get_integer_by_name(caller.simulation(), draw::<Text>(caller), draw::<Longs>(caller)) })
    },
    carry,
    carry,
    |caller| {
        check(unsafe {
            jostle_limit_work(
                caller.simulation(),
                [0, 1, 100, MOST_WORK, 10_000][caller.hand.below(5)],
            )
        })
    },
    |caller| {
        let (simulation, bytes) = (caller.simulation(), draw::<Bytes>(caller));
        check(unsafe { jostle_save(simulation, bytes, draw::<Length>(caller), draw::<Sizes>(caller)) })
    },
    |caller| check(unsafe { jostle_restore(caller.simulation(), draw::<Bytes>(caller), draw::<Length>(caller)) }),
    |caller| {
        let size = caller.error_size();
        count();
        let needed = unsafe { jostle_error_text(caller.simulation(), caller.error.as_mut_ptr(), size) };
        if needed > 0 && size > 0 {
            let text = unsafe { CStr::from_ptr(caller.error.as_ptr()) };
            assert!(text.to_str().is_ok_and(|text| text.len() < needed && text.len() < size));
        }
    },
    |caller| {
        count();
        let variables = unsafe { jostle_variable_count(caller.simulation()) };
        assert!(variables < 1000);
    },
    |caller| {
        let mut variable = std::mem::MaybeUninit::<JostleVariable>::uninit();
        let pointer = caller.hand.spoil(variable.as_mut_ptr());
        let status = unsafe { jostle_variable(caller.simulation(), draw::<Reference>(caller), pointer) };
        check(status);
        if status == JostleStatus::Ok {
            let texts = unsafe { variable.assume_init() };
            for text in [texts.name, texts.unit, texts.description, texts.options] {
                assert!(unsafe { CStr::from_ptr(text) }.to_str().is_ok());
            }
        }
    },
    |caller| {
        count();
        let size = caller.error_size();
        assert!(unsafe { jostle_scenes(caller.error.as_mut_ptr(), size) } > 100);
        assert!(unsafe { CStr::from_ptr(jostle_version()) }.count_bytes() > 4);
    },
];

pub fn run(bytes: &[u8]) {
    report_defects();
    let mut caller = Caller {
        hand: Hand::new(bytes, 60, &TEXTS),
        simulations: [null_mut(); 3],
        saved: Vec::new(),
        error: [0; 256],
    };
    create(&mut caller);
    while !caller.hand.is_empty() {
        let index = usize::from(caller.hand.byte());
        CALLS[index % CALLS.len()](&mut caller);
    }
    for simulation in caller.simulations {
        // SAFETY: null or alive.
        unsafe { jostle_free(simulation) };
    }
}

fn check(status: JostleStatus) {
    count();
    assert_ne!(status, JostleStatus::Failed);
}

/// Makes a simulation where there is none, of a scene that exists for the most part.
fn create(caller: &mut Caller) {
    count();
    let (index, scene) = (caller.hand.below(3), caller.hand.below(SCENES.len() + 1));
    if !caller.simulations[index].is_null() {
        return;
    }
    let settings = [(); 2].map(|()| JostleSetting {
        name: caller.hand.text(),
        value: caller.hand.text(),
    });
    let settings_count = if caller.hand.rarely(4) {
        draw::<Length>(caller).min(2)
    } else {
        0
    };
    let (size, error) = (caller.error_size(), caller.error.as_mut_ptr());
    let disks = 1 + caller.hand.below(4) as u32;
    let ([scene, engine, drive], disks) = match SCENES.get(scene) {
        Some((names, many)) => (
            names.each_ref().map(|name| name.as_ptr()),
            if *many { disks } else { 1 },
        ),
        None => ([(); 3].map(|()| caller.hand.text()), disks),
    };
    // SAFETY: texts are null or end with a zero byte; lengths are those of the arrays; what is made is alive.
    unsafe {
        let made = if caller.hand.rarely(16) {
            jostle_new_from_toml(caller.hand.text(), error, size)
        } else {
            let (settings, count) = (settings.as_ptr(), settings_count);
            jostle_new(scene, engine, drive, disks, settings, count, error, size)
        };
        caller.simulations[index] = made;
        if !made.is_null() {
            check(jostle_limit_work(made, MOST_WORK));
        }
    }
}

/// Steps on from where a simulation is.
fn step(caller: &mut Caller) {
    let (simulation, step, mut now) = (caller.simulation(), caller.hand.duration(LONGEST_STEP), 0.0);
    // SAFETY: null, alive or memory that is none.
    unsafe {
        check(jostle_time(simulation, &mut now));
        let status = jostle_advance_to(simulation, now + step);
        check(status);
        count_step(status == JostleStatus::Ok && step > 0.0);
    }
}

/// Saves a simulation, damages the bytes, brings them to another.
fn carry(caller: &mut Caller) {
    let (from, to, mut size) = (caller.simulation(), caller.simulation(), 0);
    // SAFETY: null, alive or memory that is none; the bytes are as many as said.
    unsafe {
        check(jostle_save(from, null_mut(), 0, &mut size));
        if size > 0 {
            caller.saved = vec![0; size];
            check(jostle_save(from, caller.saved.as_mut_ptr(), size, &mut size));
        }
        let mut bytes = caller.saved.clone();
        caller.hand.damage(&mut bytes);
        check(jostle_restore(to, bytes.as_ptr(), bytes.len()));
    }
}
