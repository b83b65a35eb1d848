"""What can be tuned: a strategy's weights or options, preview, horizon and sample time; with their ranges."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from backend.batches import robustness
from backend.json_types import JsonObject
from backend.store.trials import StoredTrial
from sim_core.control.controller import Controller, option_fields
from sim_core.scenario import Scenario, dotted
from sim_core.strategies import STRATEGIES, reads, strategies

DEFAULT_RANGE = (0.05, 50.0)  # of a weight
DIGITS = 3  # of a value that is tried: the sums of Eq. 16 change by less than 0.1 % with the fourth
TIMING = ("mpc.expected_offset", "mpc.expected_noise", "mpc.sample_time")  # every controller's
SAMPLE_TIME = TIMING[-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Tunable:
    """Dotted names of what can be tuned in a strategy beside its options.

    Attributes:
        triples: Its triples of weights (q1, q2, q3).
        travel: The weight on the suspension's travel (q4).
        preview: Its kind of preview.
        horizon: How far ahead, in steps.
    """

    triples: tuple[str, ...] = ()
    travel: str = "mpc.deflection_weight"
    preview: str = "mpc.preview"
    horizon: str = "mpc.prediction_horizon"


OURS = {
    "lv": Tunable(triples=("mpc.stage_weights.cruise", "mpc.stage_weights.brake", "mpc.stage_weights.bump")),
    "suspension_only": Tunable(triples=("mpc.road_weights.rough", "mpc.road_weights.bump")),
    "lqr": Tunable(
        triples=("lqr.weights",),
        travel="lqr.deflection_weight",
        preview="lqr.preview",
        horizon="lqr.preview_horizon",
    ),
}

Ranges = Mapping[str, Sequence[float] | Sequence[str]]  # field -> lowest and highest value searched, or the choices
Weights = JsonObject  # dotted name -> three weights, or one value
Point = dict[str, Any]  # of the searched space: field -> value


def weights_in(strategy: str) -> list[str]:
    """Return each single weight of the strategy by its dotted name, without the travel weight."""
    return [f"{name}.{index}" for name in _tunable(strategy).triples for index in range(3)]


def tunable_strategies() -> list[str]:
    """Return our strategies that have weights, and the custom controllers."""
    return [*OURS, *(name for name in strategies() if name not in STRATEGIES)]


def searchable(strategy: str) -> list[str]:
    """Return each number that can be searched by its dotted name, the weights or options first."""
    tunable = _tunable(strategy)
    if strategy in OURS:
        return [*weights_in(strategy), tunable.travel, tunable.horizon, *TIMING]
    controller = strategies()[strategy]
    options = [each.name for each in option_fields(controller).values() if each.kind in ("number", "integer")]
    return [*options, *(name for name in (tunable.horizon, *TIMING) if _is_read(name, controller))]


def takes_previews(strategy: str) -> bool:
    """Check whether its kind of preview is the scenario's."""
    return _is_read(_tunable(strategy).preview, strategies()[strategy])


def _is_read(name: str, controller: type[Controller]) -> bool:
    return any(dotted.is_within(name, each) for each in reads(controller))


def default_search(strategy: str) -> dict[str, tuple[float, float]]:
    """Return every weight but the travel weight; of a custom controller every option that has both bounds.

    None of a triple is held: q4 and R stay, so that a triple's scale is a choice as well as its ratios.
    """
    if strategy in OURS:
        return dict.fromkeys(weights_in(strategy), DEFAULT_RANGE)
    options = strategies()[strategy].options()
    return {
        name: (each.ge, each.le)
        for name in searchable(strategy)
        if dotted.is_option(name) and (each := options[name.rpartition(".")[2]]).ge is not None and each.le is not None
    }


def ranges_of(request: JsonObject) -> Ranges:
    """Return the ranges that a tuning's stored request searches, and its kinds of preview."""
    previews = request.get("previews")
    return {**request["search"], **({_tunable(request["strategy"]).preview: previews} if previews else {})}


def _tunable(strategy: str) -> Tunable:
    return OURS.get(strategy, Tunable())


def road(request: JsonObject, seed: int) -> JsonObject:
    """Return the changes for one road of a tuning's request: its seed, and of an uncertain car its values."""
    return {"road.seed": seed} | (robustness.drawn(seed) if request.get("uncertain") else {})


def longest_run(request: JsonObject) -> JsonObject:
    """Return the changes that give the request's longest run: the longest horizon and the shortest sample time."""
    search, horizon = request["search"], _tunable(request["strategy"]).horizon
    longest = {horizon: int(search[horizon][1])} if horizon in search else {}
    shortest = {SAMPLE_TIME: search[SAMPLE_TIME][0]} if SAMPLE_TIME in search else {}
    return longest | shortest


def weights_at(scenario: JsonObject, strategy: str, searched: Iterable[str]) -> Weights:
    """Return the strategy's weights in a plain scenario; travel weight, options and other values where searched."""
    triples = _tunable(strategy).triples
    others = [name for name in searched if name.rpartition(".")[0] not in triples]
    return {name: dotted.value(scenario, name) for name in [*triples, *others]}


def paper_weights(strategy: str, searched: Iterable[str]) -> Weights:
    """Return the paper's weights (Tables 3 and 6, section 4.2.2); what it lacks (the travel weight) at its default."""
    return weights_at(_paper(), strategy, searched)


def first_weights(scenario: JsonObject, strategy: str, searched: Iterable[str]) -> list[Weights]:
    """Return the first points of every search: the paper's weights, and the scenario's where they differ."""
    papers, own = paper_weights(strategy, searched), weights_at(scenario, strategy, searched)
    return [papers] if own == papers else [papers, own]


def has_own_weights(request: JsonObject, trials: Sequence[StoredTrial]) -> bool:
    """Check whether the second trial is the scenario's own weights, because they are others than the first's."""
    own = weights_at(request["scenario"], request["strategy"], ranges_of(request))
    return len(trials) > 1 and trials[0].weights != own


def point_of(weights: Weights, search: Ranges, scenario: JsonObject) -> Point | None:
    """Return those weights as a point of the searched space; None where they lie outside it."""
    flat = _flat(weights)
    for name, value in flat.items():
        if name not in search:
            inside = value == dotted.value(scenario, name)
        elif isinstance(value, str):
            inside = value in search[name]
        else:
            inside = search[name][0] <= value <= search[name][1]
        if not inside:
            return None
    return {name: flat[name] for name in search}


def weights_of(point: Point, search: Ranges, own: Weights) -> Weights:
    """Return the strategy's weights at a point of the searched space, rounded; others are the scenario's."""
    weights: Weights = {name: list(value) if isinstance(value, list) else value for name, value in own.items()}
    for name, value in point.items():
        rounded = value if isinstance(value, str | int) else _rounded(value, search[name])
        triple, _, index = name.rpartition(".")
        if triple in weights:
            weights[triple][int(index)] = rounded
        else:
            weights[name] = rounded
    return weights


def _rounded(value: float, ends: Sequence[Any]) -> float:
    return float(min(max(float(f"{value:.{DIGITS}g}"), ends[0]), ends[1]))


def _flat(weights: Weights) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in weights.items():
        flat |= {f"{name}.{index}": item for index, item in enumerate(value)} if isinstance(value, list) else {}
        if not isinstance(value, list):
            flat[name] = value
    return flat


@cache
def _paper() -> JsonObject:
    return Scenario().model_dump(mode="json")
