"""The command and its subcommands."""

import sys
from collections.abc import Callable
from typing import Annotated

import typer

from backend.cli.backup import backup
from backend.cli.browse import open_
from backend.cli.compare import compare
from backend.cli.controller import controller, hil
from backend.cli.export import export
from backend.cli.paper import paper
from backend.cli.parsing import Command
from backend.cli.reporting import BROKEN_PIPE, ReportingGroup, abandon_output
from backend.cli.robustness import robustness
from backend.cli.run import run as run_
from backend.cli.serve import serve
from backend.cli.sweep import sweep
from backend.cli.tune import tune
from sim_core import __version__

HELP = """Ridelab: what-ifs of active suspension over bumps.

SCENARIO is a JSON file, - for standard input, a preset such as "paper", the id of a stored run, or the address of a run
or shared link. What it leaves out takes the paper's value. Commands work with the service at
--server; without one they start their own for as long as they run.
"""
EPILOG = "Exit codes: 0 well; 1 failed runs, or different (compare); 2 bad input; 3 no service, or it failed."

app = typer.Typer(
    name="ridelab",
    cls=ReportingGroup,
    help=HELP,
    epilog=EPILOG,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)
COMMANDS: dict[str, Callable[..., None]] = {
    "serve": serve,
    "run": run_,
    "sweep": sweep,
    "robustness": robustness,
    "tune": tune,
    "paper": paper,
    "controller": controller,
    "hil": hil,
    "compare": compare,
    "open": open_,
    "export": export,
    "backup": backup,
}
for name, command in COMMANDS.items():
    app.command(name, cls=Command)(command)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"Ridelab {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Options of the command itself."""


def run(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    try:
        app(arguments, prog_name="ridelab")
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        abandon_output()
        return BROKEN_PIPE
    return code
