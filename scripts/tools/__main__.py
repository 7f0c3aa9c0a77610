"""`python -m tools`."""

from jostle_lab.cli import application, call
from tools.import_circles import import_circles
from tools.instruction_counts import instruction_counts
from tools.notices import notices
from tools.peers import peers
from tools.real_time_page import real_time
from tools.release.command import binaries, verify
from tools.stability_page import stability
from tools.work_precision.work_precision_cli import work_precision

if __name__ == "__main__":
    commands = (
        work_precision,
        stability,
        real_time,
        instruction_counts,
        import_circles,
        peers,
        binaries,
        verify,
        notices,
    )
    call(application("Tools of the project itself.", *commands))
