"""`ridelab paper`: the paper's printed changes and ours, cell by cell, with a verdict on each."""

from collections.abc import Mapping
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError, deliver, folder_of, note, print_json, show_table
from ridelab.cli.service import Services
from ridelab.errors import RidelabAPIError

_HEADS = ("table", "figure", "strategy", "against", "printed", "change", "ours", "change", "95 %", "verdict")
_BLIND = ("without preview", "95 %", "verdict")
_SETS = ("interpretation", "reached", "simulated", "ECU, ±8 %", "within ±10 points", "printed in our interval")
_ABSOLUTES = ("figure", "strategy", "printed", "default", "one road", "nearest", "one road")
_READING = "Read the paper otherwise, such as preview=none; may be repeated."
_SET = "A named set of readings: default, favourable or nearest; --reading overrides it."
_ROADS = "Roads that every strategy drives, 20 to 100: seeds 1 to N, or A to B."
_REPORT = "Write all of it as one HTML file, figures too."


def paper(
    services: Services,
    reading: Annotated[list[str] | None, options.option("READING=CHOICE", _READING)] = None,
    interpretation: Annotated[str, typer.Option(metavar="NAME", help=_SET)] = "default",
    seeds: Annotated[str, typer.Option(metavar="N|A-B", help=_ROADS)] = "20",
    report: Annotated[str | None, options.option("FILE", _REPORT)] = None,
    as_json: options.AsJson = False,
) -> None:
    """Hold the paper's Tables 4, 5 and 7 to 10 against ours: each printed change, ours, and a verdict by rule.

    The first time it takes up to a minute; then it is stored.
    """
    asked: dict[str, Any] = _roads(seeds)
    asked |= {"interpretation": interpretation, "readings": dict(map(_choice, reading or []))}
    if len(asked["readings"]) < len(reading or []):
        raise InputError("--reading: one is given twice")
    if report not in (None, "-"):
        folder_of(str(report), "--report")
    ridelab = services.at()
    services.doing = f"Driving {asked['seeds']} roads"
    try:
        answer = ridelab.paper(**asked)
    except RidelabAPIError as error:
        wrong = [place.message for place in error.errors if place.parameter == "seeds"]
        if wrong:  # there it is their number
            raise InputError(f"--seeds: {seeds} are {asked['seeds']} roads. {wrong[0]}") from None
        raise
    if report is not None:
        services.doing = "Making the report"
        deliver(ridelab.paper_report(**asked), report)
    if report != "-":
        print_json(answer) if as_json else _show(answer, services.names)
    if report not in (None, "-"):
        note(f"The report is {report}")


def _show(answer: Mapping[str, Any], names: Names) -> None:
    """A `PaperAnswer` as a table and its counts."""
    rows = [_row(cell, names.signals[cell["signal"]][1]) for cell in answer["cells"]]
    show_table([*_HEADS, *_BLIND], rows)
    typer.echo()
    if any("?" in part for row in rows for part in row):
        typer.echo("? the interval reaches into another verdict")
    for item in answer["readings"]:
        choice = next(choice for choice in item["choices"] if choice["id"] == item["chosen"])
        if not choice["default"]:
            typer.echo(f"{item['title']}: {choice['label']}")
    if (missing := answer["unavailable"]) is not None:
        typer.echo(f"{missing['cells']} cells not available here. {missing['reason']}")
    typer.echo()
    show_table(_ABSOLUTES, [_absolute(row, names.signals[row["signal"]][1]) for row in answer["absolutes"]["rows"]])
    typer.echo("×2: tyre loads are doubled there, which has no explanation\n")
    for item in answer["absolutes"]["distances"]:
        typer.echo(_distances(item))
    typer.echo()
    show_table(_SETS, [_set(item) for item in answer["interpretations"]])
    seeds = f"{answer['first_seed']}-{answer['first_seed'] + answer['seeds'] - 1}"
    typer.echo(f"\nwithout preview: {_counted(answer['without_preview'], answer['total'])}")
    typer.echo(f"{_counted(answer, answer['total'])} (Ridelab core {answer['core_version']}, seeds {seeds})")


def _set(item: Mapping[str, Any]) -> list[str]:
    """A named set and what the cells come to under it."""
    reached = [f"{part['reached']} of {part['total']}" for part in (item, item["simulated"], item["ecu"])]
    if not item["ecu"]["total"]:
        reached[2] = "not available"
    near = item["agreement"]
    return [item["id"], *reached, *(f"{near[key]} of {near['cells']}" for key in ("within", "in_interval"))]


def _absolute(row: Mapping[str, Any], unit: str) -> list[str]:
    """Return a printed absolute and ours, each with the spread of one road."""
    figure = f"{row['window']}.{row['signal']}.{row['statistic']} [{unit}]"
    return [figure, row["strategy"], f"{row['printed']:g}", *_ours(row["default"]), *_ours(row["nearest"])]


def _ours(item: Mapping[str, Any] | None) -> list[str]:
    if item is None:
        return ["-", "-"]
    doubled = "" if item["factor"] == 1 else f" ×{item['factor']:g}"
    return [f"{item['value']:.4g}{doubled}", f"± {100 * item['spread'] / item['value']:.0f} %"]


def _distances(item: Mapping[str, Any]) -> str:
    """Return in words how far an interpretation's absolutes are from the printed ones."""
    uncontrolled, simulated = item["uncontrolled"], item["simulated"]
    return (
        f"{item['interpretation']}: the {uncontrolled['values']} printed values without control are a factor of "
        f"{uncontrolled['median']:.2f} (median) or {uncontrolled['mean']:.2f} (mean) away, all {simulated['values']} "
        f"that are simulated {simulated['median']:.2f} or {simulated['mean']:.2f}"
    )


def _roads(text: str) -> dict[str, int]:
    """Return the number of roads and the first seed of `N` or `A-B`; the service says how many there may be."""
    first, _, last = text.rpartition("-")
    try:
        begin, end = int(first or 1), int(last)
    except ValueError:
        raise InputError("--seeds takes N or A-B, such as 20 or 21-60") from None
    if end < begin:
        raise InputError(f"--seeds: {text} has no road; A-B takes the smaller seed first, such as 21-60")
    return {"seeds": end + 1 - begin, "first_seed": begin}


def _choice(text: str) -> tuple[str, str]:
    name, _, choice = (part.strip() for part in text.partition("="))
    if not choice:
        raise InputError("--reading takes READING=CHOICE")
    return name, choice


def _row(cell: Mapping[str, Any], unit: str) -> list[str]:
    """A cell; where the paper's change is a misprint, what is printed and what follows from its absolutes."""
    blind, misprint, ours = cell["without_preview"], cell["misprint"], cell["our_value"]
    claimed = f"{cell['paper_change']:+g} %"
    if misprint is not None:
        claimed = f"(misprint {misprint['printed']:+g} %) {misprint['follows']:+g} %"
    return [
        str(cell["table"]),
        f"{cell['window']}.{cell['signal']}.{cell['statistic']} [{unit}]",
        cell["strategy"],
        cell["against"],
        f"{cell['paper_value']:g} : {cell['paper_base']:g}",
        claimed,
        f"{'-' if ours is None else format(ours, '.4g')} : {cell['our_base']:.4g}",
        *_judged(cell),
        *(["-", "-", "-"] if blind is None else _judged(blind)),
    ]


def _judged(item: Mapping[str, Any]) -> list[str]:
    if item["verdict"] == "unavailable":
        return ["-", "-", "not available"]
    low, high = item["ci"]
    sure = "" if item["certain"] else "?"
    return [f"{item['our_change']:+z.1f} %", f"{low:+z.1f} to {high:+z.1f}", f"{item['verdict']}{sure}"]


def _counted(part: Mapping[str, Any], total: int) -> str:
    smaller, contradicting = part["counts"]["smaller"], part["counts"]["contradicts"]
    return f"{part['reached']} of {total} cells reached, {smaller} smaller, {contradicting} contradict"
