"""Options that several commands have."""

from pathlib import Path
from typing import Annotated

import typer

SERVER_VARIABLE = "RIDELAB_SERVER"


def _folder(text: str) -> Path:
    if not text:
        raise typer.BadParameter("it is empty; leave it out for the default")
    return Path(text)


Server = Annotated[
    str | None,
    typer.Option(
        envvar=SERVER_VARIABLE,
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
        parser=_folder,
        help="Where the private service keeps its database [default: data].",
        show_default=False,
    ),
]
DatabaseDir = Annotated[
    Path | None,
    typer.Option(
        envvar="RIDELAB_DATA_DIR",
        metavar="DIR",
        parser=_folder,
        help="Where the database is [default: data].",
        show_default=False,
    ),
]
Scenario = Annotated[
    str, typer.Argument(metavar="SCENARIO", help="File, - for standard input, preset, run id, or address of a result.")
]
Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="FIELD=VALUE",
        help="Change one field, such as road.bump.height=0.12; may be repeated.",
        show_default=False,
    ),
]
Strategies = Annotated[
    list[str] | None,
    typer.Option(
        "--strategy", "-s", metavar="ID", help="Strategies to run, with commas or repeated.", show_default=False
    ),
]
Format = Annotated[
    str | None,
    typer.Option("--format", metavar="csv|parquet|json", help="Instead of the file name's end.", show_default=False),
]


def listed(names: list[str] | None) -> list[str]:
    """The names of an option that may be repeated and may hold commas, each once."""
    split = (name.strip() for text in names or () for name in text.split(","))
    return list(dict.fromkeys(name for name in split if name))
