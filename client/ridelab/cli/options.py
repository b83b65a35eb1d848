"""Options that several commands have."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from ridelab.cli.names import remembered


def folder(text: str) -> Path:
    """A folder's name.

    Raises:
        BadParameter: There is none.
    """
    if not text:
        raise typer.BadParameter("it is empty; leave it out for the default")
    return Path(text)


def completes(kind: str, end: str = "") -> Callable[[str], list[str]]:
    """Completion of what a service knows by name, the last of several with commas between them."""

    def complete(incomplete: str) -> list[str]:
        before, comma, last = incomplete.rpartition(",")
        return [f"{before}{comma}{name}{end}" for name in remembered().get(kind, []) if name.startswith(last)]

    return complete


Server = Annotated[
    str | None,
    typer.Option(
        envvar="RIDELAB_SERVER",
        metavar="URL",
        help="Service to work with; without one a private one is started for as long as the command runs.",
        show_default=False,
    ),
]
DataDir = Annotated[
    Path | None,
    typer.Option(
        envvar="RIDELAB_DATA_DIR",
        metavar="DIR",
        parser=folder,
        help="Where the private service keeps its database [default: data].",
        show_default=False,
    ),
]
Scenario = Annotated[
    str,
    typer.Argument(
        metavar="SCENARIO",
        help="File, - for standard input, preset, run id, or address of a result.",
        autocompletion=completes("presets"),
    ),
]
Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="FIELD=VALUE",
        help="Change one field, such as road.bump.height=0.12; may be repeated.",
        show_default=False,
        autocompletion=completes("fields", "="),
    ),
]
Strategies = Annotated[
    list[str] | None,
    typer.Option(
        "--strategy",
        "-s",
        metavar="ID",
        help="Strategies to run, with commas or repeated.",
        show_default=False,
        autocompletion=completes("strategies"),
    ),
]
Baseline = Annotated[
    str | None,
    typer.Option(
        metavar="ID",
        help="Strategy that changes refer to.",
        show_default=False,
        autocompletion=completes("strategies"),
    ),
]
Format = Annotated[
    str | None,
    typer.Option("--format", metavar="csv|parquet|json", help="Instead of the file name's end.", show_default=False),
]
Detach = Annotated[bool, typer.Option("--detach", help="Hand it in and leave; needs --server.")]
Label = Annotated[
    str | None, typer.Option(metavar="TEXT", help="Call the job so; lists find it by that.", show_default=False)
]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Only say how many runs and how long.")]


def listed(names: list[str] | None) -> list[str]:
    """The names of an option that may be repeated and may hold commas, each once."""
    split = (name.strip() for text in names or () for name in text.split(","))
    return list(dict.fromkeys(name for name in split if name))
