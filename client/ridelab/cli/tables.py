"""Results as tables, each figure with its unit: columns as wide as they need, in a terminal as wide as it is."""

import sys
from collections.abc import Collection, Sequence
from typing import Any

import typer
from rich.console import Console
from rich.table import Table

from ridelab.cli.names import Names
from ridelab.results import Interval, Outcome, RunResult

_VIEWS = (("rough_road", "rms", "RMS on the rough road"), ("bump", "peak", "peak on the bump"))
_UNLIMITED = 1000  # columns of a file or a pipe


def show_table(heads: Sequence[str], rows: Sequence[Sequence[str]], left: Collection[int] = (0,)) -> None:
    """Print a table; the columns in `left` begin at their left edge."""
    looked_at = sys.stdout.isatty()
    console = Console(width=None if looked_at else _UNLIMITED, markup=False, highlight=False, emoji=False)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for column, head in enumerate(heads):
        table.add_column(head, justify="left" if column in left else "right", overflow="fold")
    for row in rows:
        table.add_row(*row)
    with console.capture() as printed:
        console.print(table)
    typer.echo("\n".join(line.rstrip() for line in printed.get().splitlines()))


def show_run(run: RunResult, baseline: str, names: Names) -> None:
    """The paper's signals of each strategy that ran and how its drive went; then why others did not run."""
    ran = [outcome for outcome in run if outcome.status == "ok"]
    base = run[baseline] if run[baseline].status == "ok" else None
    for window, statistic, title in _VIEWS:
        typer.echo()
        show_table(
            [title, *map(names.signal, names.paper_signals)],
            [
                [
                    names.label(outcome.strategy),
                    *(_cell(run, outcome, base, (window, key, statistic)) for key in names.paper_signals),
                ]
                for outcome in ran
            ],
        )
    typer.echo()
    show_table(
        [
            f"road seed {run.scenario['road']['seed']} alone" if run.roads > 1 else "",
            *("travel time", "at the bump", "airborne", "over travel", "QPs", "run"),
        ],
        [
            [
                names.label(outcome.strategy),
                f"{outcome.travel_time:.2f} s",
                f"{outcome.arrival_speed_kmh:.1f} km/h",
                f"{outcome.events['airborne_ms']:.0f} ms",
                f"{outcome.events['travel_exceeded_mm']:.1f} mm",
                str(outcome.events["qp_solves"]),
                f"{outcome.compute_ms:8.1f} ms",  # a width that how busy the machine is does not change
            ]
            for outcome in ran
        ],
    )
    for outcome in run:
        if outcome.status != "ok":
            typer.echo(f"{names.label(outcome.strategy)}  failed: {outcome.reason}")


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


def _cell(run: RunResult, outcome: Outcome, base: Outcome | None, place: tuple[str, str, str]) -> str:
    """A metric and its change; over several roads both with half their interval's width."""
    window, signal, statistic = place
    value: Any = outcome.metrics[window][signal][statistic]  # type: ignore[literal-required]  # one of both
    if isinstance(value, Interval):
        change = run.changes.get(outcome.strategy, {}).get(window, {}).get(signal, {}).get(statistic)
        return f"{value}{f' ({change.mean:+.1f} ± {change.half:.1f} %)' if isinstance(change, Interval) else ''}"
    reference: Any = base.figures()[".".join(place)] if base is not None and base is not outcome else None
    return f"{value:.4g}{f' ({100 * (value - reference) / reference:+.1f} %)' if reference else ''}"
