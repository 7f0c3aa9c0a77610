"""Command line of the laboratory: `jostle-lab`, or `python -m jostle_lab`. Thin: argument in, library call out."""

import ast
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import typer

from jostle_lab.demos.packing.command import demo, draw, exchanges, held_loop, step_control
from jostle_lab.demos.ratchet.command import ratchet_demo
from jostle_lab.demos.torque.command import torque_demo
from jostle_lab.errors import LabError, describe_os_error
from jostle_lab.film.command import film
from jostle_lab.loudspeaker.command import loudspeaker
from jostle_lab.runs.command import sweep
from jostle_lab.stopping import stoppable

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
    # With a callback a single command, too, is called by its name.
    app.callback()(lambda: None)
    for command in commands:
        app.command()(command)
    return app


def lazily(place: str) -> Callable[..., None]:
    """The function `module:name`, imported only if its command is called; else what the list of commands needs."""
    module, _, name = place.partition(":")
    if sys.argv[1:2] == [name.replace("_", "-")]:
        found: Callable[..., None] = getattr(import_module(module), name)
        return found

    def listed() -> None:
        pass

    listed.__name__, listed.__doc__ = name, _docstring(module, name)
    return listed


def _docstring(module: str, name: str) -> str:
    """That of a function, read from its source."""
    spec = find_spec(module)
    if spec is None or spec.origin is None:
        raise ImportError(f"There is no module {module}.")
    functions = [node for node in ast.parse(Path(spec.origin).read_text()).body if isinstance(node, ast.FunctionDef)]
    return next(ast.get_docstring(node) or "" for node in functions if node.name == name)


def call(app: typer.Typer) -> None:
    """Run it: what the user can put right is reported without a traceback. A file or folder that fails ends with 1."""
    try:
        with stoppable():
            app()
    except LabError as error:
        typer.echo(f"error: {error}", err=True)
        raise SystemExit(2) from None
    except OSError as error:
        typer.echo(f"error: {describe_os_error(error)}", err=True)
        raise SystemExit(1) from None
    except Exception as error:
        # Polars is not imported to ask for its errors.
        if not type(error).__module__.startswith("polars"):
            raise
        typer.echo(f"error: a table is not as it should be: {error}. Make the results again.", err=True)
        raise SystemExit(2) from None


def main() -> None:
    """Entry point."""
    commands: list[Callable[..., None]] = [
        demo,
        draw,
        exchanges,
        held_loop,
        step_control,
        sweep,
        ratchet_demo,
        torque_demo,
        loudspeaker,
        film,
    ]
    # A wheel holds the laboratory alone; the studies, whose records are in the source tree, are beside it there.
    if find_spec("studies"):
        commands.append(lazily("studies.claims.command:claims"))
    call(application(HELP, *commands))
