"""The report of a run."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.runs import figures
from backend.runs.reports import inputs
from backend.runs.reports.doubts import doubts
from backend.runs.reports.drawings import caption, framed
from backend.runs.reports.keys import key_of, label
from backend.runs.reports.numbers import (
    NO_VALUE,
    NOTHING,
    SAME,
    exact,
    percent,
    plus_minus,
    pretty_unit,
    significant,
    told,
    with_unit,
)
from backend.runs.reports.page import Report, render
from backend.runs.work import Outcome
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import (
    COMFORT,
    EVENTS,
    METRIC_SIGNALS,
    PAPER_SIGNALS,
    PAPER_VIEWS,
    RUN_FIGURES,
    SIGNALS,
    STATISTICS,
    WINDOWS,
    Quantity,
)

JUDGED = (*COMFORT, "travel_time")  # of the figures of a whole run, those of which less is better


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFacts:
    """What a report is made of.

    Attributes:
        answer: The run as `Run`, or as `RoadsRun` with changes against `baseline`.
        created_at: When it was stored, UTC.
        baseline: Whose figures the changes refer to.
        outcomes: By strategy, with the time histories there are.
        axis: `position` or `time`, for x of the figures.
        gone: Whether time histories there were cannot be had any more.
    """

    answer: Mapping[str, Any]
    created_at: datetime
    baseline: str
    outcomes: Mapping[str, Outcome]
    axis: str
    gone: bool


def report(facts: RunFacts, *, compressed: bool) -> Report:
    """The run's report.

    Args:
        facts: What it is made of.
        compressed: Whether whoever asked takes gzip.
    """
    entries: Mapping[str, Any] = facts.answer["strategies"]
    ran = {name: entry for name, entry in entries.items() if entry["status"] == "ok"}
    drawn = {name: framed(figures.filled(name, facts.outcomes, facts.axis)) for name in figures.PANELS}
    with_data = {name: figure for name, figure in drawn.items() if figure["data"]}
    roads, changes = facts.answer.get("roads", 1), facts.answer.get("changes", {})
    values = {
        "run_id": facts.answer["id"],
        "core_version": facts.answer["core_version"],
        "current_version": CORE_VERSION,
        "stored": f"{facts.created_at:%Y-%m-%d %H:%M} UTC",
        "strategies": [key_of(name) for name in entries],
        "baseline": label(facts.baseline),
        "drive": drive(facts.answer["scenario"]),
        "roads": roads,
        "seed": facts.answer["scenario"]["road"]["seed"],
        "parts": inputs.parts(facts.answer["scenario"]),
        "command": inputs.command(facts.answer["scenario"], list(entries), roads, facts.baseline),
        "doubts": [(label(name), found) for name, entry in entries.items() if (found := doubts(entry))],
        "comparisons": [
            comparison(ran, changes, facts.baseline, signals, caption_text)
            for signals, caption_text in (
                (PAPER_SIGNALS, "RMS on the rough road and peak on the bump"),
                (METRIC_SIGNALS[len(PAPER_SIGNALS) :], "Suspension travel and forces"),
            )
        ],
        "whole": whole(ran, changes, facts.baseline),
        "gone": facts.gone,
        "figures": [caption(name, figure) for name, figure in with_data.items()],
        "without_history": [label(name) for name in ran if with_data and name not in facts.outcomes],
    }
    return render("run.html", values, with_data, compressed=compressed)


def drive(scenario: Mapping[str, Any]) -> list[str]:
    """What is driven over, and how fast, in a few words."""
    road, speed = scenario["road"], scenario["speed"]
    bump = road["bump"]
    obstacle = "no bump"
    if bump["height"]:
        kind = f"{bump['shape'].replace('_', ' ')} {'bump' if bump['height'] > 0 else 'pothole'}"
        height, width = exact(round(1000 * abs(bump["height"]), 6)), exact(bump["width"])
        obstacle = f"{kind}, {with_unit(height, 'mm')} over {with_unit(width, 'm')}"
    rough = f"roughness {with_unit(exact(road['roughness']), 'm^3')}, seed {road['seed']}"
    return [
        obstacle,
        rough if road["roughness"] else "smooth road",
        f"{exact(speed['initial_speed_kmh'])} → {with_unit(exact(speed['target_speed_kmh']), 'km/h')}",
    ]


def comparison(
    ran: Mapping[str, Any], changes: Mapping[str, Any], baseline: str, signals: Sequence[str], caption_text: str
) -> dict[str, Any]:
    """RMS on the rough road and peak on the bump side by side: a row for each strategy.

    Args:
        ran: By strategy its entry.
        changes: By strategy its paired changes over several roads [%]; empty for a run of one.
        baseline: Whose figures the changes refer to.
        signals: Which.
        caption_text: The table's title.
    """
    shown = {signal: _shown_unit(signal) for signal in signals}
    return {
        "caption": caption_text,
        "groups": [
            f"{STATISTICS[statistic].label}, {WINDOWS[window].label.lower()}" for window, statistic in PAPER_VIEWS
        ],
        "heads": [{"label": SIGNALS[signal].label, "unit": unit} for signal, (unit, _) in shown.items()],
        "rows": [
            {
                "key": key_of(name),
                "baseline": name == baseline,
                "cells": [
                    _cell(
                        f"{window}.{signal}.{statistic}",
                        _metric(entry["metrics"], window, signal, statistic),
                        _change(
                            _metric(entry["metrics"], window, signal, statistic),
                            _metric(ran[baseline]["metrics"], window, signal, statistic),
                            _metric(changes.get(name, {}), window, signal, statistic),
                        )
                        if name != baseline and baseline in ran
                        else None,
                        scale,
                    )
                    for window, statistic in PAPER_VIEWS
                    for signal, (_, scale) in shown.items()
                ],
            }
            for name, entry in ran.items()
        ],
    }


def whole(ran: Mapping[str, Any], changes: Mapping[str, Any], baseline: str) -> dict[str, Any]:
    """Comfort, time and events: a row for each figure, a column for each strategy; arguments as for `comparison`."""
    listed = [*_listed("comfort", COMFORT.values()), *_listed(None, RUN_FIGURES.values())]
    listed += _listed("events", EVENTS.values())
    rows = []
    for place, quantity in listed:
        values = {name: _whole_figure(entry, place, quantity.key) for name, entry in ran.items()}
        judged = quantity.key in JUDGED and baseline in ran
        rows.append(
            {
                "quantity": quantity,
                "cells": [
                    _cell(
                        quantity.key,
                        value,
                        _change(value, values[baseline], changes.get(name, {}).get(place, {}).get(quantity.key))
                        if judged and name != baseline
                        else None,
                        None,
                    )
                    for name, value in values.items()
                ],
            }
        )
    return {"columns": [key_of(name) for name in ran], "rows": rows}


def _cell(name: str, value: Any, change: tuple[float, float] | None, scale: float | None) -> dict[str, Any]:
    """One value, and its change where there is something to compare it with.

    Args:
        name: What it is.
        value: In SI; of several roads the mean and its interval.
        change: See `_change`.
        scale: From SI to the unit shown; None for a value that may be a count, true or false.
    """
    value, half = _estimate(value)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    shown = told(value) if scale is None else significant(value * scale) if number else NO_VALUE
    percentage, uncertainty = change or (0.0, 0.0)
    return {
        "name": name,
        "raw": value,
        "shown": plus_minus(shown, half * (scale or 1)) if half > NOTHING else shown,
        "change": None if change is None else percent(percentage, uncertainty),
        "verdict": "" if abs(percentage) < max(SAME, uncertainty) else "better" if percentage < 0 else "worse",
    }


def _change(value: Any, base: Any, paired: Any) -> tuple[float, float] | None:
    """Change [%] and half the width of its interval: as paired over several roads, or from two plain values."""
    if isinstance(paired, Mapping):
        return _estimate(paired)
    plain = all(isinstance(each, int | float) and not isinstance(each, bool) for each in (value, base))
    return (100 * (value - base) / abs(base), 0.0) if plain and abs(base) > NOTHING else None


def _estimate(value: Any) -> tuple[Any, float]:
    """A value and half the width of its interval; a plain value has none."""
    return (value["mean"], value["high"] - value["mean"]) if isinstance(value, Mapping) else (value, 0.0)


def _shown_unit(signal: str) -> tuple[str, float]:
    """The unit a signal is shown in and the factor to it: the figures say it, the tables follow."""
    panels = (panel.shown for panel in figures.PANELS.values() if panel.signal == signal)
    return next(panels, (pretty_unit(SIGNALS[signal].unit), 1.0))


def _metric(by_window: Mapping[str, Any], window: str, signal: str, statistic: str) -> Any:
    """From a summary that an older core may have written with other names; None where it has it not."""
    return by_window.get(window, {}).get(signal, {}).get(statistic)


def _listed(place: str | None, quantities: Iterable[Quantity]) -> list[tuple[str | None, Quantity]]:
    return [(place, quantity) for quantity in quantities]


def _whole_figure(entry: Mapping[str, Any], place: str | None, key: str) -> Any:
    return (entry if place is None else entry[place]).get(key)
