"""`ridelab paper`: the paper's printed changes and ours, cell by cell, with a verdict on each."""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer

from backend.cli import options, output
from backend.cli.reporting import InputError, note, terminal
from backend.cli.services import Services
from backend.cli.tables import aligned
from sim_core.catalogue import SIGNALS

_HEADS = ("table", "figure", "strategy", "against", "printed", "change", "ours", "change", "95 %", "verdict")
_BLIND = ("without preview", "95 %", "verdict")
_SETS = ("interpretation", "reached", "simulated", "ECU, ±8 %", "within ±10 points", "printed in our interval")
_LEFT = {1, 2, 3, 9, 12}


def paper(
    reading: Annotated[
        list[str] | None,
        typer.Option(
            metavar="READING=CHOICE",
            help="Read the paper otherwise, such as preview=none; may be repeated.",
            show_default=False,
        ),
    ] = None,
    interpretation: Annotated[
        str,
        typer.Option(metavar="NAME", help="A named set of readings, default or favourable; --reading overrides it."),
    ] = "default",
    seeds: Annotated[
        str, typer.Option(metavar="N|A-B", help="Roads that every strategy drives, 20 to 100: seeds 1 to N, or A to B.")
    ] = "20",
    report: Annotated[
        str | None,
        typer.Option(metavar="FILE", help="Write all of it as one HTML file, figures too.", show_default=False),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole answer, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Hold the paper's Tables 4, 5 and 7 to 10 against ours: each printed change, ours, and a verdict by rule.

    The first time it takes up to a minute; then it is stored.
    """
    asked: dict[str, Any] = _roads(seeds)
    asked |= {"interpretation": _named(interpretation), "readings": _chosen(reading or [])}
    if report is not None and report != "-" and not Path(report).parent.is_dir():
        raise InputError(f"--report: there is no folder {Path(report).parent}")
    with Services(server, data_dir) as services:
        ridelab = services.at()
        with _waiting(f"Driving {asked['seeds']} roads"):
            found = ridelab.paper(**asked)
        if report is not None:
            with _waiting("Making the report"):
                output.deliver(ridelab.paper_report(**asked), report)
    if report == "-":
        return
    if as_json:
        typer.echo(json.dumps(found, indent=1, ensure_ascii=False))
    else:
        for line in lines(found):
            typer.echo(line)
    if report is not None:
        note(f"The report is {report}")


def lines(answer: Mapping[str, Any]) -> Iterator[str]:
    """A `PaperAnswer` as a table and its counts."""
    cells: Sequence[Mapping[str, Any]] = answer["cells"]
    yield from aligned([*_HEADS, *_BLIND], [_row(cell) for cell in cells], left=_LEFT)
    yield ""
    if any("?" in part for cell in cells for part in _row(cell)):
        yield "? the interval reaches into another verdict"
    for item in answer["readings"]:
        labels = {choice["id"]: choice for choice in item["choices"]}
        if not labels[item["chosen"]]["default"]:
            yield f"{item['title']}: {labels[item['chosen']]['label']}"
    if (missing := answer["unavailable"]) is not None:
        yield f"{missing['cells']} cells not available here. {missing['reason']}"
    yield ""
    yield from aligned(_SETS, [_set(item) for item in answer["interpretations"]], left={0})
    yield ""
    blind = answer["without_preview"]
    yield f"without preview: {_counted(blind['reached'], answer['total'], blind['counts'])}"
    yield (
        f"{_counted(answer['reached'], answer['total'], answer['counts'])} (Ridelab core {answer['core_version']}, "
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


def _named(interpretation: str) -> str:
    from sim_core.study.interpretations import INTERPRETATIONS

    if interpretation not in INTERPRETATIONS:
        raise InputError(f"--interpretation: Unknown; there are {', '.join(INTERPRETATIONS)}")
    return interpretation


def _chosen(readings: Sequence[str]) -> dict[str, str]:
    """Reading -> choice.

    Raises:
        InputError: There is no such reading or choice, or one is given twice.
    """
    from sim_core.errors import RidelabError
    from sim_core.study.readings import reading

    chosen: dict[str, str] = {}
    for text in readings:
        name, sign, choice = (part.strip() for part in text.partition("="))
        if not sign or not choice:
            raise InputError("--reading takes READING=CHOICE")
        try:
            reading(name).choice(choice)
        except RidelabError as error:
            raise InputError(f"--reading {name}: {error.message}") from None
        if name in chosen:
            raise InputError(f"--reading {name}: given twice")
        chosen[name] = choice
    return chosen


def _row(cell: Mapping[str, Any]) -> list[str]:
    blind = cell["without_preview"]
    return [
        str(cell["table"]),
        f"{cell['window']}.{cell['signal']}.{cell['statistic']} [{SIGNALS[cell['signal']].unit}]",
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
