"""Options that several commands have."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli.names import remembered
from ridelab.cli.reporting import InputError


def folder(text: str) -> Path:
    """A folder's name, which is not empty."""
    if not text:
        raise typer.BadParameter("it is empty; leave it out for the default")
    return Path(text)


def option(metavar: str, help: str, *names: str, **more: Any) -> Any:  # noqa: A002  # typer's name for it
    """An option without a default to show; `completes` says what the shell completes."""
    if kind := more.pop("completes", None):
        more["autocompletion"] = completes(*kind.split())
    return typer.Option(*names, metavar=metavar, help=help, show_default=False, **more)


def flag(help: str, *names: str) -> Any:  # noqa: A002  # typer's name for it
    """An option without a value."""
    return typer.Option(*names, help=help)


_WORD = re.compile(r"(?:(--[a-z-]+)=)?(?:([\w.]+)=)?(.*)", re.DOTALL)  # option, field, and what is typed of its value
completed_field = ""  # bash hands over only what follows the =


def split_as_bash() -> None:
    """Take the words of `FIELD=VALUE` together but for the last one's, of which bash completes what follows the `=`."""
    global completed_field
    if os.environ.get("_RIDELAB_COMPLETE") != "complete_bash":
        return
    before = os.environ["COMP_WORDS"].split("\n")[: int(os.environ["COMP_CWORD"]) + 1]
    *words, last = re.sub("\n=(\n|$)", "=", "\n".join(before)).split("\n")
    if match := _WORD.fullmatch(last):
        option_before, field, typed = match.groups(default="")
        completed_field = field
        words += [option_before] * bool(option_before) + [typed]
    os.environ |= {"COMP_WORDS": "\n".join(words), "COMP_CWORD": str(len(words) - 1)}


def completes(kind: str, end: str = "") -> Callable[[str], list[str]]:
    """Completion by a service's names, for the last of several values with commas between them."""

    def complete(incomplete: str) -> list[str]:
        field, sign, vehicle = incomplete.rpartition("=")
        if sign or completed_field:  # of --set, which takes a vehicle by its name
            vehicles = remembered()["vehicles"] if (field or completed_field) == "vehicle" else []
            return [f"{field}{sign}{name}" for name in vehicles if name.startswith(vehicle)]
        before, comma, last = incomplete.rpartition(",")
        names = [f"{before}{comma}{name}{end}" for name in remembered().get(kind, []) if name.startswith(last)]
        # Of two with one beginning the shell completes that alone; after a single one it would leave a space.
        return [*names, f"{names[0]}VALUE"] if end and len(names) == 1 else names

    return complete


_SERVER = "Service to work with; without one a private one is started for as long as the command runs."
DATA_FOLDER = "./data where there is one, else the system's folder for data"
_DATA = f"Where the private service keeps its database [default: {DATA_FOLDER}]."
_CONTROLLER = (
    "Python file or FMU with controllers of your own, which are strategies then. It is run: name only what you trust. "
    "May be repeated; not with --server."
)
_TARGET = "File, - for standard input, preset, run id, or address of a result."
_CHANGE = "Change one field, such as road.bump.height=0.12, or vehicle=NAME|FILE; may be repeated."
_IDS = "Strategies to run, with commas or repeated."

Server = Annotated[str | None, option("URL", _SERVER, envvar="RIDELAB_SERVER")]
Controllers = Annotated[list[Path] | None, option("FILE", _CONTROLLER, "--controller", exists=True, resolve_path=True)]
DataDir = Annotated[Path | None, option("DIR", _DATA, envvar="RIDELAB_DATA_DIR", parser=folder)]
Scenario = Annotated[str, typer.Argument(metavar="SCENARIO", help=_TARGET, autocompletion=completes("presets"))]
Changes = Annotated[list[str] | None, option("FIELD=VALUE", _CHANGE, "--set", completes="fields =")]
Strategies = Annotated[list[str] | None, option("ID", _IDS, "--strategy", "-s", completes="strategies")]
Baseline = Annotated[str | None, option("ID", "Strategy that changes refer to.", completes="strategies")]
Format = Annotated[str | None, option("csv|parquet|json", "Instead of the file name's end.", "--format")]
Detach = Annotated[bool, flag("Submit it and end; needs --server.", "--detach")]
Label = Annotated[str | None, option("TEXT", "Call the job so; lists find it by that.")]
DryRun = Annotated[bool, flag("Only say how many runs and how long.", "--dry-run")]
AsJson = Annotated[bool, flag("All of it, as JSON.", "--json")]
Seed = Annotated[int, typer.Option(metavar="N", min=0, help="Of what is drawn: same seed, same points.")]


def one_strategy(name: str) -> str:
    """Return the strategy that `--strategy` names, for a command that takes one.

    Raises:
        InputError: It names several.
    """
    if "," in name:
        raise InputError(f"--strategy: this command takes one strategy, and {name} are several")
    return name


def listed(names: list[str] | None, option: str = "--strategy") -> list[str]:
    """The names of an option that may be repeated and may hold commas, each once; none where it is left out.

    Raises:
        InputError: It was given and names nothing: an empty variable in a script is a mistake.
    """
    split = (name.strip() for text in names or () for name in text.split(","))
    unique = list(dict.fromkeys(name for name in split if name))
    if names and not unique:
        raise InputError(f"{option}: it names nothing; leave it out for the default")
    return unique
