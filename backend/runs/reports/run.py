"""The report of a run; its words and tables are in templates/run.html."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from backend.json_types import JsonObject
from backend.outcome import Outcome
from backend.runs import figures
from backend.runs.reports import inputs
from backend.runs.reports.caveats import caveats
from backend.runs.reports.drawings import caption, framed
from backend.runs.reports.keys import key_of
from backend.runs.reports.page import Report, render
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import (
    COMFORT,
    EVENTS,
    METRIC_SIGNALS,
    METRICS,
    PAPER_SIGNALS,
    PAPER_VIEWS,
    RUN_FIGURES,
    SIGNALS,
)
from sim_core.comparison.numbers import (
    NO_VALUE,
    ZERO_TOLERANCE,
    exact,
    in_words,
    percent,
    plus_minus,
    pretty_unit,
    significant,
    with_unit,
)
from sim_core.comparison.requirements import RequirementResult
from sim_core.comparison.vehicle_cautions import PAPER_SAG
from sim_core.strategies import label_of

WHOLE_RUN = (
    *((f"comfort.{key}", quantity) for key, quantity in COMFORT.items()),
    *RUN_FIGURES.items(),
    *((f"events.{key}", quantity) for key, quantity in EVENTS.items()),
)
TABLES = {
    "RMS on the rough road and peak on the bump": PAPER_SIGNALS,
    "Suspension travel and forces": METRIC_SIGNALS[len(PAPER_SIGNALS) :],
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFacts:
    """The contents of a report.

    Attributes:
        answer: The run as it is answered.
        created_at: When it was stored, UTC.
        baseline: Whose figures the changes refer to.
        against: The id of the run to whose figures, strategy by strategy, they refer instead; None where to the
            baseline's.
        changes: Strategy -> metric, by its flat name -> its change, as the answer's `comparison` has them.
        outcomes: By strategy, with the time histories there are.
        axis: `position` or `time`, for x of the figures.
        gone: Why time histories there were cannot be had any more; None where they can.
    """

    answer: JsonObject
    created_at: datetime
    baseline: str
    against: str | None
    changes: Mapping[str, Mapping[str, JsonObject]]
    outcomes: Mapping[str, Outcome]
    axis: str
    gone: str | None


def report(facts: RunFacts, *, compressed: bool) -> Report:
    """The run's report.

    Args:
        facts: What it is made of.
        compressed: Whether whoever asked takes gzip.
    """
    answer, entries = facts.answer, facts.answer["strategies"]
    ran = {name: entry for name, entry in entries.items() if entry["status"] == "ok"}
    drawn = {name: framed(figures.filled(name, facts.outcomes, facts.axis)) for name in figures.PANELS}
    with_data = {name: figure for name, figure in drawn.items() if figure["data"]}
    roads = answer.get("roads", 1)
    numbers = Numbers(ran=ran, changes=facts.changes)
    values = {
        "run_id": answer["id"],
        "core_version": answer["core_version"],
        "current_version": CORE_VERSION,
        "sources": [(label_of(name), source) for name, entry in ran.items() if (source := entry["source"])],
        "stored": f"{facts.created_at:%Y-%m-%d %H:%M} UTC",
        "strategies": [key_of(name) for name in entries],
        "baseline": None if facts.against else key_of(facts.baseline),
        "against": f"run {facts.against}, strategy by strategy" if facts.against else label_of(facts.baseline),
        "drive": drive(answer["scenario"]),
        "roads": roads,
        "seed": answer["scenario"]["road"]["seed"],
        "parts": inputs.parts(answer["scenario"]),
        "command": inputs.command(answer["scenario"], list(entries), roads, facts.baseline),
        "caveats": [
            (label_of(name), sentences)
            for name, entry in entries.items()
            if (sentences := caveats(entry, answer["scenario"]["vehicle"]))
        ],
        "cautions": [each["text"] for each in answer["comparison"]["cautions"] if each["kind"] != PAPER_SAG],
        "ran": [key_of(name) for name in ran],
        "requirements": [_required(each) for each in answer.get("requirement_results", [])],
        "tables": {
            title: [(signal, SIGNALS[signal].label, *_shown_unit(signal)) for signal in signals]
            for title, signals in TABLES.items()
        },
        "views": PAPER_VIEWS,
        "whole_run": WHOLE_RUN,
        "cell": numbers.cell,
        "gone": facts.gone,
        "figures": [caption(name, figure) for name, figure in with_data.items()],
        "without_history": [label_of(name) for name in ran if with_data and name not in facts.outcomes],
    }
    return render("run.html", values, with_data, compressed=compressed)


def _required(answered: JsonObject) -> JsonObject:
    """Return a requirement and its result in words."""
    result = RequirementResult(**answered)
    return {
        "metric": METRICS[result.metric].label,
        "limit": result.limit_text,
        "strategy": label_of(result.strategy),
        "held": result.value_text,
        "result": result.result,
        "reason": result.reason,
    }


def drive(scenario: JsonObject) -> list[str]:
    """The road and the speed of the scenario, in a few words."""
    road, speed = scenario["road"], scenario["speed"]
    bump = road["bump"]
    obstacle = "no bump"
    if bump["height"]:
        shape = bump["shape"].replace("_", " ")
        kind = shape if shape == "kerb" else f"{shape} {'bump' if bump['height'] > 0 else 'pothole'}"
        height, width = exact(round(1000 * abs(bump["height"]), 6)), exact(bump["width"])
        obstacle = f"{kind}, {with_unit(height, 'mm')} over {with_unit(width, 'm')}"
        if bump["count"] > 1:
            obstacle = f"{bump['count']} × {obstacle}, every {with_unit(exact(bump['spacing']), 'm')}"
    rough = f"roughness {with_unit(exact(road['roughness']), 'm^3')}, seed {road['seed']}"
    return [
        obstacle,
        f"measured road {road['profile']}" if road["profile"] else rough if road["roughness"] else "smooth road",
        f"{exact(speed['initial_speed_kmh'])} → {with_unit(exact(speed['target_speed_kmh']), 'km/h')}",
    ]


@dataclass(frozen=True, slots=True, kw_only=True)
class Numbers:
    """The strategies' metrics and their changes.

    Attributes:
        ran: By strategy its entry.
        changes: Strategy -> metric -> its change; metrics that are not compared have none.
    """

    ran: JsonObject
    changes: Mapping[str, Mapping[str, JsonObject]]

    def cell(self, key: str, strategy: str, scale: float | None = None) -> JsonObject:
        """One value, and its change where it is compared.

        Args:
            key: Of the metric.
            strategy: Whose.
            scale: From SI to the unit shown; None for a value that may be a count, true or false.
        """
        metric = METRICS[key]
        value, half = _estimate(metric.of(self.ran[strategy]))
        number = isinstance(value, int | float) and not isinstance(value, bool)
        shown = in_words(value) if scale is None else significant(value * scale) if number else NO_VALUE
        change = self.changes.get(strategy, {}).get(key)
        percentage = None if change is None else change["change"]
        verdict = ""
        if change is not None and percentage is not None and change["beyond_variation"]:
            verdict = "better" if percentage < 0 else "worse"
        return {
            "raw": value,
            "shown": plus_minus(shown, half * (scale or 1)) if half > ZERO_TOLERANCE else shown,
            "change": None if percentage is None or change is None else percent(percentage, _half(change)),
            "verdict": verdict,
        }


def _half(change: JsonObject) -> float:
    """Return half the width of a change's interval [%]; 0 where it has none."""
    return 0.0 if change["low"] is None else (change["high"] - change["low"]) / 2


def _estimate(value: Any) -> tuple[Any, float]:
    """A value and half the width of its interval; a plain value has none."""
    return (value["mean"], value["high"] - value["mean"]) if isinstance(value, Mapping) else (value, 0.0)


def _shown_unit(signal: str) -> tuple[str, float]:
    """The unit a signal is shown in, in figures and tables alike, and the factor to it."""
    panels = (panel.shown for panel in figures.PANELS.values() if panel.signal == signal)
    return next(panels, (pretty_unit(SIGNALS[signal].unit), 1.0))
