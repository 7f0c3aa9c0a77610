"""Cases for other programs."""

from tools.peers import side_by_side


def test_copies_stand_side_by_side() -> None:
    state = "2 1.5 2.0\n0.1 0.25 0.5 1 2 3\n0.2 1.0 0.5 4 5 6\n"
    assert side_by_side(state, 1) == state
    header, *rows = side_by_side(state, 3).splitlines()
    assert header == "6 4.5 2.0"
    assert [row.split()[1] for row in rows] == ["0.25", "1.0", "1.75", "2.5", "3.25", "4.0"]
    assert [row.split()[2:] for row in rows] == 3 * [row.split()[2:] for row in state.splitlines()[1:]]
