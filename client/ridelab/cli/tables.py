"""Results as tables, each figure with its unit: columns as wide as they need, in a terminal as wide as it is."""

import re
import sys
from collections.abc import Sequence
from typing import Any

import typer
from rich.console import Console
from rich.table import Table

_UNLIMITED = 1000  # columns of a file or a pipe
_FIGURE = re.compile(r"|-|none| *[-+(]?[\d.].*|- : .*|\(misprint .*|[-+]?inf")


def show_table(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """Print a table: columns of figures end at their right edge, those of words begin at their left."""
    looked_at = sys.stdout.isatty()
    console = Console(width=None if looked_at else _UNLIMITED, markup=False, highlight=False, emoji=False)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    texts = [[shown(cell) for cell in row] for row in rows]
    for column, head in enumerate(heads):
        figures = all(_FIGURE.fullmatch(row[column]) for row in texts)
        table.add_column(head, justify="right" if figures else "left", overflow="fold")
    for row in texts:
        table.add_row(*row)
    with console.capture() as printed:
        console.print(table)
    typer.echo("\n".join(line.rstrip() for line in printed.get().splitlines()))


def with_unit(name: str, unit: str) -> str:
    """A column's head: `bump.body_acceleration.peak [m/s^2]`; numbers without a unit stand alone."""
    return name if unit in ("", "1") else f"{name} [{unit}]"


def shown(value: Any, digits: int = 6) -> str:
    """One value, short."""
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "-"}[value]
    if isinstance(value, float | int):
        return f"{value:.{digits}g}"
    if isinstance(value, list):
        return ",".join(shown(item, digits) for item in value)
    return str(value)
