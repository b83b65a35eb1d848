"""`ridelab new` and `ridelab check`: files with a controller of one's own."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Annotated

import typer

from ridelab.cli import options
from ridelab.cli.reporting import DIFFERENT, InputError, say
from ridelab.cli.service import check_core, server_environment

LIMIT = 60.0  # a check drives some short roads, which takes seconds [s]
_NAME = re.compile("[a-z][a-z0-9_]*")
_TEMPLATE = Path(__file__).with_name("new_controller.txt")
NEW = typer.Typer(help="Write a file to begin with.", no_args_is_help=True)


@NEW.callback()
def new() -> None:
    """Write a file to begin with."""


@NEW.command("controller")
def new_controller(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Its id, and the file's name before .py.")],
    as_json: options.AsJson = False,
) -> None:
    """Write NAME.py here: a controller that runs, for a law of your own in its place."""
    if not _NAME.fullmatch(name):
        raise InputError("NAME begins with a small letter and has small letters, digits and underscores only")
    words = name.split("_")
    text = _TEMPLATE.read_text(encoding="utf-8").format(
        name=name, kind="".join(map(str.capitalize, words)), label=" ".join(words).strip().capitalize()
    )
    file = Path(f"{name}.py")
    try:
        with file.open("x", encoding="utf-8") as new_file:
            new_file.write(text)
    except FileExistsError:
        raise InputError(f"{file} is there already") from None
    say(f"{file}: ridelab check {file} tries it", {"file": str(file), "id": name}, as_json=as_json)


def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A Python file with controllers.", exists=True)],
    as_json: options.AsJson = False,
) -> None:
    """Say in words what is wrong with a file's controllers.

    The file is run, with all that you may do. Exit code 1 where something is wrong, 2 where it cannot be loaded.
    """
    check_core()
    command = [sys.executable, "-P", "-m", "sim_core.check_file", str(file), *["--json"] * as_json]
    try:
        run = subprocess.run(  # noqa: S603  # no shell
            command, env=server_environment(), stdout=subprocess.PIPE, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        raise InputError(f"{file}: it was ended after {LIMIT:.0f} s; has it a loop without an end?") from None
    text = run.stdout.decode(errors="replace")
    if not text:  # the check's own answer always has a line
        raise InputError(f"{file}: it ended Python with the code {run.returncode}")
    if run.returncode not in (0, DIFFERENT):
        raise InputError(*text.splitlines())
    typer.echo(text, nl=False)
    raise typer.Exit(run.returncode)
