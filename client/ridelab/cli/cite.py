"""`ridelab cite`: how to name Ridelab, and the paper whose system it rebuilds, in a text."""

from typing import Annotated

import typer

from ridelab import __version__
from ridelab.cli.options import flag

TITLE = "Ridelab: a what-if laboratory for active suspension over bumps"
AUTHOR = "The Ridelab maintainers"
PAPER_AUTHORS = ["Meng", "Kong", "Ding", "Liu", "Wang"]
PAPER: dict[str, str | list[str]] = {
    "title": "Research on Active Suspension Control Based on Vehicle Speed Control Under Transient Pavement Excitation",
    "author": PAPER_AUTHORS,
    "journal": "World Electric Vehicle Journal",
    "volume": "16",
    "number": "4",
    "pages": "232",
    "year": "2025",
    "doi": "10.3390/wevj16040232",
}


def cite(
    bibtex: Annotated[bool, flag("As entries for BibTeX.", "--bibtex")] = False,
) -> None:
    """Say how to cite Ridelab and the paper whose system it rebuilds."""
    if bibtex:
        typer.echo(_entry("software", "ridelab", {"title": TITLE, "author": [f"{{{AUTHOR}}}"], "version": __version__}))
        typer.echo(_entry("article", "meng2025", PAPER))
        return
    *first, last = PAPER_AUTHORS
    authors = f"{', '.join(first)} and {last}"
    typer.echo(f"{AUTHOR}. {TITLE}. Version {__version__}.")
    typer.echo(
        f"{authors}. {PAPER['title']}. {PAPER['journal']} {PAPER['volume']}({PAPER['number']}), {PAPER['pages']}, "
        f"{PAPER['year']}. doi:{PAPER['doi']}"
    )


def _entry(kind: str, key: str, fields: dict[str, str | list[str]]) -> str:
    lines = [
        f"  {name} = {{{' and '.join(value) if isinstance(value, list) else value}}}," for name, value in fields.items()
    ]
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])
