"""What a run is worth: objectives and limits from the figures of runs, road by road.

An objective as it is stored is `{"kind", "q", "window", "figure"}`, a limit `{"figure", "at_most"}`.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from sim_core.catalogue import METRICS, SIGNALS, WINDOWS

Summary = Mapping[str, Any]  # of one run, as it is stored

_STATISTIC = {"paper": "rms", "peaks": "peak"}
# The terms of Eq. 16 with the signals that make each: its one F is the load of both tyres.
_TERMS = (("body_acceleration",), ("pitch_acceleration",), ("front_tyre_load", "rear_tyre_load"))


class UndefinedObjectiveError(Exception):
    """An objective cannot be told; the message says why."""


def objective_value(objective: Mapping[str, Any], run: Summary, passive: Summary) -> float:
    """The objective on one road.

    Args:
        objective: As it is stored.
        run: The run on that road.
        passive: The passive car's; not read where nothing is normalised by it.

    Raises:
        UndefinedObjectiveError: The passive car's figure is zero.
    """
    if objective["kind"] == "figure":
        return float(METRICS[objective["figure"]].of(run))
    return _normalised(objective["q"], run, passive, objective["window"], _STATISTIC[objective["kind"]])


def needs_passive(objectives: Sequence[Mapping[str, Any]]) -> bool:
    """Whether one of them is a share of the passive car's figures."""
    return any(objective["kind"] in _STATISTIC for objective in objectives)


def objective_label(objective: Mapping[str, Any]) -> str:
    """What to call it."""
    if objective["kind"] == "figure":
        return METRICS[objective["figure"]].label
    name = {"paper": "Eq. 16", "peaks": "Eq. 16 with peaks"}[objective["kind"]]
    q = "" if tuple(objective["q"]) == (1, 1, 1) else f", q = {', '.join(f'{each:g}' for each in objective['q'])}"
    return f"{name}, {WINDOWS[objective['window']].label.lower()}{q}"


def objective_unit(objective: Mapping[str, Any]) -> str:
    """Its unit; `1` for none."""
    return METRICS[objective["figure"]].unit if objective["kind"] == "figure" else "1"


def _normalised(q: Sequence[float], run: Summary, passive: Summary, window: str, statistic: str) -> float:
    """Eq. 16 on one road: Σ q_i (X_i / X_i,passive)², X_i the RMS (or peak) of the term's signals together."""
    total = 0.0
    for coefficient, signals in zip(q, _TERMS, strict=True):
        if not coefficient:
            continue
        ours, theirs = (
            sum(float(each["metrics"][window][signal][statistic]) ** 2 for signal in signals) for each in (run, passive)
        )
        if theirs == 0:
            raise UndefinedObjectiveError(
                f"The passive car's {SIGNALS[signals[0]].label.lower()} is zero ({WINDOWS[window].label.lower()}): "
                "nothing can be a share of it"
            )
        total += coefficient * ours / theirs
    return total
