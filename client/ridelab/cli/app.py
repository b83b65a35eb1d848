"""The command and its subcommands."""

import os
import re
import sys
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from ridelab import __version__
from ridelab.cli import jobs, links
from ridelab.cli.cars_and_roads import road, vehicle
from ridelab.cli.cite import cite
from ridelab.cli.compare import compare
from ridelab.cli.controller import controller
from ridelab.cli.export import export
from ridelab.cli.fmu import fmu
from ridelab.cli.frequency import frequency
from ridelab.cli.instant import instant
from ridelab.cli.lists import LISTS, fields, strategies
from ridelab.cli.options import option, split_as_bash
from ridelab.cli.own import NEW, check
from ridelab.cli.paper import paper
from ridelab.cli.reporting import BROKEN_PIPE, InputError, ReportingGroup, abandon_output
from ridelab.cli.robustness import robustness
from ridelab.cli.run import run as run_
from ridelab.cli.server import backup, demo, open_, serve
from ridelab.cli.service import with_services
from ridelab.cli.solve import solve
from ridelab.cli.sweep import sweep
from ridelab.cli.tune import tune
from ridelab.connection import TOKEN_VARIABLE

HELP = """Ridelab: what-ifs of active suspension over bumps.

SCENARIO is a JSON file, - for standard input, a preset such as "paper", the id of a stored run, or the address of a run
or shared link. What it leaves out takes the paper's value. Commands work with the service at
--server; without one they start their own for as long as they run.
"""
EPILOG = "Exit codes: 0 well; 1 failed runs, or different (compare); 2 bad input; 3 no service, or it failed."

_ID = re.compile(r"-[A-Za-z0-9_-]{21}")
_LONG_OPTION = re.compile(r"--[a-z-]+")


class Command(TyperCommand):
    """A command with arguments that may be ids: of earlier versions' ids one in 64 begins with `-`."""

    def make_parser(self, ctx: Any) -> Any:
        """The parser of the command's options, which takes ids as arguments."""
        parser: Any = super().make_parser(ctx)
        read_option = parser._process_opts  # raises "No such option"

        def read(word: str, state: Any) -> None:
            if _ID.fullmatch(word) and not _LONG_OPTION.fullmatch(word):
                state.largs.append(word)
            else:
                read_option(word, state)

        parser._process_opts = read
        return parser


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
COMMANDS = (
    serve,
    demo,
    run_,
    solve,
    frequency,
    instant,
    sweep,
    robustness,
    tune,
    paper,
    vehicle,
    road,
    controller,
    fmu,
    compare,
    open_,
    export,
    backup,
    check,
    cite,
    *LISTS,
)
DRIVING = (run_, compare, sweep, robustness, solve, tune, frequency, instant, fmu, fields, strategies)
JOBS = typer.Typer(help="Batches and tunings: list, show, follow, label, cancel, resume, delete.", no_args_is_help=True)
LINKS = typer.Typer(help="Links that were shared: list, revoke.", no_args_is_help=True)
app.add_typer(JOBS, name="jobs")
app.add_typer(LINKS, name="links")
app.add_typer(NEW, name="new")
for group, commands in ((app, COMMANDS), (JOBS, jobs.COMMANDS), (LINKS, links.COMMANDS)):
    for command in commands:
        alone = command in (serve, demo, backup, check, cite)
        own = command if alone else with_services(command, drives=command in DRIVING)
        group.command(command.__name__.partition("_")[0], cls=Command)(own)


_VERSION = "Show the version and exit."
_FILE = "File with the token that --server asks for; RIDELAB_TOKEN holds one itself."


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"Ridelab {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help=_VERSION)] = False,
    token_file: Annotated[Path | None, option("FILE", _FILE)] = None,
) -> None:
    """Options of the command itself."""
    if token_file is not None:
        token = token_file.read_text(encoding="utf-8").strip()
        if not token:
            raise InputError(f"--token-file: {token_file} is empty")
        os.environ[TOKEN_VARIABLE] = token  # where the client looks for it


def run(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    split_as_bash()
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
