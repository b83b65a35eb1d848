"""The command and its subcommands."""

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from ridelab import __version__
from ridelab.cli import jobs
from ridelab.cli.compare import compare
from ridelab.cli.controller import controller, hil
from ridelab.cli.export import export
from ridelab.cli.paper import paper
from ridelab.cli.parsing import Command
from ridelab.cli.reporting import BROKEN_PIPE, InputError, ReportingGroup, abandon_output
from ridelab.cli.robustness import robustness
from ridelab.cli.run import run as run_
from ridelab.cli.server import backup, open_, serve
from ridelab.cli.service import with_services
from ridelab.cli.sweep import sweep
from ridelab.cli.tune import tune
from ridelab.client import TOKEN_VARIABLE

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
JOBS = typer.Typer(help="Batches and tunings: list, show, follow, label, cancel, resume, delete.", no_args_is_help=True)
app.add_typer(JOBS, name="jobs")
for name, command in COMMANDS.items():
    app.command(name, cls=Command)(command if command in (serve, backup) else with_services(command))
for name, command in jobs.COMMANDS.items():
    JOBS.command(name, cls=Command)(with_services(command))


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"Ridelab {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
    token_file: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="File with the token that --server asks for; RIDELAB_TOKEN holds one itself.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Options of the command itself."""
    if token_file is not None:
        token = token_file.read_text(encoding="utf-8").strip()
        if not token:
            raise InputError(f"--token-file: {token_file} is empty")
        os.environ[TOKEN_VARIABLE] = token  # where the client looks for it


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
