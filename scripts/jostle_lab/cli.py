"""Command line of the laboratory: `jostle-lab`, or `python -m jostle_lab`. Thin: argument in, library call out."""

from collections.abc import Callable

import typer

from jostle_lab.demos.packing.command import demo, draw, exchanges, held_loop, step_control
from jostle_lab.demos.ratchet.command import ratchet_demo
from jostle_lab.demos.torque.command import torque_demo
from jostle_lab.errors import LabError
from jostle_lab.loudspeaker.command import loudspeaker
from jostle_lab.runs.command import sweep

HELP = (
    "The laboratory of vibrated granular disks on a computer: a loudspeaker shakes a packing FMU, two accelerometers "
    "and a camera watch. FMUs are looked for in the folder JOSTLE_FMUS, the program jostle at JOSTLE_PROGRAM."
)


def application(help_text: str, *commands: Callable[..., None]) -> typer.Typer:
    """A command line of these commands."""
    app = typer.Typer(
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        help=help_text,
    )
    for command in commands:
        app.command()(command)
    return app


def call(app: typer.Typer) -> None:
    """Run it: what the user can put right is reported in one line, without a traceback."""
    try:
        app()
    except LabError as error:
        typer.echo(f"error: {error}", err=True)
        raise SystemExit(2) from None


def main() -> None:
    """Entry point."""
    call(
        application(HELP, demo, draw, exchanges, held_loop, step_control, sweep, ratchet_demo, torque_demo, loudspeaker)
    )
