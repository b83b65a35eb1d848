"""`ridelab paper`: the paper's printed changes and ours, cell by cell, with a verdict on each."""

from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError, deliver, note, print_json, terminal
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table

_HEADS = ("table", "figure", "strategy", "against", "printed", "change", "ours", "change", "95 %", "verdict")
_BLIND = ("without preview", "95 %", "verdict")
_SETS = ("interpretation", "reached", "simulated", "ECU, ±8 %", "within ±10 points", "printed in our interval")
_LEFT = {1, 2, 3, 9, 12}


def paper(
    services: Services,
    reading: Annotated[
        list[str] | None,
        options.option("READING=CHOICE", "Read the paper otherwise, such as preview=none; may be repeated."),
    ] = None,
    interpretation: Annotated[
        str,
        typer.Option(metavar="NAME", help="A named set of readings, default or favourable; --reading overrides it."),
    ] = "default",
    seeds: Annotated[
        str, typer.Option(metavar="N|A-B", help="Roads that every strategy drives, 20 to 100: seeds 1 to N, or A to B.")
    ] = "20",
    report: Annotated[str | None, options.option("FILE", "Write all of it as one HTML file, figures too.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole answer, as JSON.")] = False,
) -> None:
    """Hold the paper's Tables 4, 5 and 7 to 10 against ours: each printed change, ours, and a verdict by rule.

    The first time it takes up to a minute; then it is stored.
    """
    asked: dict[str, Any] = _roads(seeds)
    asked |= {"interpretation": interpretation, "readings": _choices(reading or [])}
    if report is not None and report != "-" and not Path(report).parent.is_dir():
        raise InputError(f"--report: there is no folder {Path(report).parent}")
    ridelab = services.at()
    with _waiting(f"Driving {asked['seeds']} roads"):
        answer = ridelab.paper(**asked)
    if report is not None:
        with _waiting("Making the report"):
            deliver(ridelab.paper_report(**asked), report)
    if report != "-":
        print_json(answer) if as_json else _show(answer, services.names)
    if report not in (None, "-"):
        note(f"The report is {report}")


def _show(answer: Mapping[str, Any], names: Names) -> None:
    """A `PaperAnswer` as a table and its counts."""
    cells: Sequence[Mapping[str, Any]] = answer["cells"]
    rows = [_row(cell, names.signals[cell["signal"]][1]) for cell in cells]
    show_table([*_HEADS, *_BLIND], rows, left=_LEFT)
    typer.echo()
    if any("?" in part for row in rows for part in row):
        typer.echo("? the interval reaches into another verdict")
    for item in answer["readings"]:
        choices = {choice["id"]: choice for choice in item["choices"]}
        if not choices[item["chosen"]]["default"]:
            typer.echo(f"{item['title']}: {choices[item['chosen']]['label']}")
    if (missing := answer["unavailable"]) is not None:
        typer.echo(f"{missing['cells']} cells not available here. {missing['reason']}")
    typer.echo()
    show_table(_SETS, [_set(item) for item in answer["interpretations"]])
    blind, total = answer["without_preview"], answer["total"]
    typer.echo(f"\nwithout preview: {_counted(blind['reached'], total, blind['counts'])}")
    typer.echo(
        f"{_counted(answer['reached'], total, answer['counts'])} (Ridelab core {answer['core_version']}, "
        f"seeds {answer['first_seed']}-{answer['first_seed'] + answer['seeds'] - 1})"
    )


def _set(item: Mapping[str, Any]) -> list[str]:
    """A named set and what the cells come to under it."""
    simulated, in_ecu, near = item["simulated"], item["ecu"], item["agreement"]
    return [
        item["id"],
        f"{item['reached']} of {item['total']}",
        f"{simulated['reached']} of {simulated['total']}",
        f"{in_ecu['reached']} of {in_ecu['total']}" if in_ecu["total"] else "not available",
        f"{near['within']} of {near['cells']}",
        f"{near['in_interval']} of {near['cells']}",
    ]


def _roads(text: str) -> dict[str, int]:
    """How many roads from which seed on, of `N` or `A-B`.

    Raises:
        InputError: It is neither, or not 20 to 100 roads.
    """
    first, _, last = text.rpartition("-")
    try:
        begin, end = int(first or 1), int(last)
    except ValueError:
        raise InputError("--seeds takes N or A-B, such as 20 or 21-60") from None
    if begin < 1 or not 20 <= end + 1 - begin <= 100:
        raise InputError("--seeds takes 20 to 100 roads, of seeds from 1 on")
    return {"seeds": end + 1 - begin, "first_seed": begin}


def _choices(readings: Sequence[str]) -> dict[str, str]:
    """Reading -> choice.

    Raises:
        InputError: It has not that form, or one is given twice.
    """
    choices: dict[str, str] = {}
    for text in readings:
        name, _, choice = (part.strip() for part in text.partition("="))
        if not choice:
            raise InputError("--reading takes READING=CHOICE")
        if name in choices:
            raise InputError(f"--reading {name}: given twice")
        choices[name] = choice
    return choices


def _row(cell: Mapping[str, Any], unit: str) -> list[str]:
    blind = cell["without_preview"]
    return [
        str(cell["table"]),
        f"{cell['window']}.{cell['signal']}.{cell['statistic']} [{unit}]",
        cell["strategy"],
        cell["against"],
        f"{cell['paper_value']:g} : {cell['paper_base']:g}",
        _claimed(cell),
        f"{'-' if cell['our_value'] is None else format(cell['our_value'], '.4g')} : {cell['our_base']:.4g}",
        *_judged(cell),
        *(["-", "-", "-"] if blind is None else _judged(blind)),
    ]


def _claimed(cell: Mapping[str, Any]) -> str:
    """The paper's change; where it is a misprint, what follows from its absolutes, and what is printed."""
    misprint = cell["misprint"]
    if misprint is None:
        return f"{cell['paper_change']:+g} %"
    return f"(misprint {misprint['printed']:+g} %) {misprint['follows']:+g} %"


def _judged(item: Mapping[str, Any]) -> list[str]:
    if item["verdict"] == "unavailable":
        return ["-", "-", "not available"]
    low, high = item["ci"]
    sure = "" if item["certain"] else "?"
    return [f"{item['our_change']:+.1f} %", f"{low:+.1f} to {high:+.1f}", f"{item['verdict']}{sure}"]


def _counted(reached: int, total: int, counts: Mapping[str, int]) -> str:
    return f"{reached} of {total} cells reached, {counts['smaller']} smaller, {counts['contradicts']} contradict"


def _waiting(what: str) -> Any:
    console = terminal()
    return console.status(what) if console.is_terminal else nullcontext()
