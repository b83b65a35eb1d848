"""Tunings on the command line: what is typed, and what a tuning's answer comes to as text."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import typer

from ridelab.cli.names import Names
from ridelab.cli.reporting import InputError
from ridelab.cli.tables import show_table, shown, with_unit
from ridelab.jobs import Tuning

_NORMALISED = re.compile(r"(paper|peaks)(?:@(\w+))?(?::(.*))?")
_SPAN = re.compile(r"(\d+)-(\d+)")
_MOST_SEEDS = 1000


def objective(text: str) -> dict[str, Any]:
    """`paper`, `peaks@bump:1,1,2`, or a figure's name.

    Raises:
        InputError: Its q are not three numbers.
    """
    match = _NORMALISED.fullmatch(text)
    if match is None:
        return {"kind": "figure", "figure": text}
    kind, window, q = match.groups()
    objective: dict[str, Any] = {"kind": kind} | ({"window": window} if window else {})
    if q is not None:
        try:
            objective["q"] = [float(each) for each in q.split(",")]
        except ValueError:
            raise InputError(f"--objective {kind}:Q1,Q2,Q3 takes three numbers") from None
    return objective


def limit(text: str) -> dict[str, Any]:
    """`events.travel_exceeded_mm=1`.

    Raises:
        InputError: It has not that form.
    """
    figure, _, most = text.partition("=")
    try:
        return {"figure": figure.strip(), "at_most": float(most)}
    except ValueError:
        raise InputError("--limit takes FIGURE=MOST, such as events.travel_exceeded_mm=1") from None


def seeds(text: str | None, option: str) -> list[int] | None:
    """`1-4,7`.

    Raises:
        InputError: These are not whole numbers.
    """
    if text is None:
        return None
    numbers: list[int] = []
    for item in text.split(","):
        span = _SPAN.fullmatch(item.strip())
        low, high = (span[1], span[2]) if span else (item.strip(), item.strip())
        if not (low.isdecimal() and high.isdecimal()) or not 0 <= int(high) - int(low) < _MOST_SEEDS:
            raise InputError(f"{option} takes whole numbers and spans of them, such as 1-4,7")
        numbers += range(int(low), int(high) + 1)
    return numbers


def show(tuning: Tuning, names: Names) -> None:
    """Print the best trials, then what it is worth on fresh roads."""
    answer, comparison = tuning.answer, tuning.comparison
    typer.echo(f"Ridelab core {answer['core_version']}, weights of {names.label(answer['strategy'])}")
    within = f", {tuning.feasible} within the limits" if answer["limits"] else ""
    typer.echo(f"{tuning.done} trials on roads {_spans(answer['seeds'])}{within}\n")
    _show_points(answer)
    best = [trial["number"] for trial in tuning.best if trial is not None]
    if best and tuning.paper is not None and set(best) == {tuning.paper["number"]}:
        typer.echo("\nNo weights that were tried are better than the paper's; --resume with more --trials tries more.")
    for point in comparison["points"] if comparison is not None else []:
        if comparison is not None and point["verdict"] is not None:
            _show_compared(answer, comparison["figures"], comparison["points"][0], point)


def _show_points(answer: Mapping[str, Any]) -> None:
    """A row for each point of interest: its values and its weights."""
    named: dict[int, tuple[list[str], Mapping[str, Any]]] = {}
    several = len(answer["objectives"]) > 1
    roles = [("the paper's", answer["paper"]), ("the scenario's", answer["own"])]
    roles += [(f"best {index + 1}" if several else "best", trial) for index, trial in enumerate(answer["best"])]
    for role, trial in [*roles, ("knee", answer["knee"])]:
        if trial is not None:
            named.setdefault(trial["number"], ([], trial))[0].append(role)
    aims = [*answer["objectives"], *answer["limits"]]
    weights = list(next(iter(named.values()))[1]["weights"]) if named else []
    heads = ["weights", "trial", *(with_unit(each["label"], each["unit"]) for each in aims), *map(_short, weights)]
    rows = [
        [
            ", ".join(names),
            str(trial["number"]),
            *(shown(value, 4) for value in _values(trial, len(aims))),
            *(shown(trial["weights"][name], 3) for name in weights),
        ]
        for names, trial in named.values()
    ]
    show_table(heads, rows)


def _show_compared(
    answer: Mapping[str, Any], figures: Sequence[Mapping[str, Any]], paper: Mapping[str, Any], point: Mapping[str, Any]
) -> None:
    """One point against the paper's weights, the training roads beside the fresh ones."""
    roads = f"trained on {_spans(answer['seeds'])}, fresh {_spans(answer['fresh_seeds'])}"
    typer.echo(f"\nTrial {point['trial']} against the paper's weights; {roads}")
    heads = ["mean of", "paper", "tuned", "change", "paper, fresh", "tuned, fresh", "change, fresh (95 %)", ""]
    rows = []
    for figure in figures:
        kind, _, index = figure["key"].partition(".")
        of_limit = kind == "limits"  # not its mean counts but its worst road
        cells = [with_unit(figure["label"] + (", worst" if of_limit else ""), figure["unit"])]
        for where in ("training", "fresh"):
            both = [each[where].get(figure["key"], {}) for each in (paper, point)]
            cells += [shown(each.get("worst" if of_limit else "mean"), 4) for each in both]
            cells.append("" if of_limit else _change(both[1].get("change"), interval=where == "fresh"))
        rows.append([*cells, point["verdict"][int(index)] if kind == "objectives" else ""])
    show_table(heads, rows, left={0, 7})
    for failure in point["failures"]:
        typer.echo(failure)


def _change(change: Mapping[str, Any] | None, *, interval: bool) -> str:
    if change is None:
        return "-"
    text = f"{change['value']:+.1f} %"
    return f"{text} ({change['low']:+.1f} .. {change['high']:+.1f})" if interval and change["low"] is not None else text


def _values(trial: Mapping[str, Any], count: int) -> list[Any]:
    return [*trial["values"], *trial["limits"]] if trial["status"] == "ok" else [None] * count


def _short(name: str) -> str:
    return name.rpartition("mpc.")[2]


def _spans(numbers: Sequence[int]) -> str:
    """`1-4, 7`."""
    spans: list[list[int]] = []
    for number in numbers:
        if spans and number == spans[-1][1] + 1:
            spans[-1][1] = number
        else:
            spans.append([number, number])
    return ", ".join(str(low) if low == high else f"{low}-{high}" for low, high in spans)
