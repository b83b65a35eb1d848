"""What can be tuned: the weights of a strategy, where the paper puts them, how far they are searched."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache

from backend.json_types import JsonObject
from sim_core.scenario import Scenario, dotted

SMALLEST, LARGEST = 0.05, 1000.0  # of a searched range where none is named; the scenario's hard limit
DEFAULT_RANGE = (SMALLEST, 50.0)
DIGITS = 3  # of a weight that is tried: the sums of Eq. 16 change by less than 0.1 % with the fourth

# strategy -> its triples of weights (q1, q2, q3), and the weight on the suspension's travel (q4).
STRATEGIES: dict[str, tuple[tuple[str, ...], str]] = {
    "lv": (
        ("mpc.stage_weights.cruise", "mpc.stage_weights.brake", "mpc.stage_weights.bump"),
        "mpc.deflection_weight",
    ),
    "suspension_only": (("mpc.road_weights.rough", "mpc.road_weights.bump"), "mpc.deflection_weight"),
    "lqr": (("lqr.weights",), "lqr.deflection_weight"),
}

Ranges = Mapping[str, Sequence[float]]  # field -> lowest and highest value that is searched
Weights = JsonObject  # dotted name -> three weights, or one


def searchable(strategy: str) -> list[str]:
    """Each single weight of the strategy by its dotted name; the travel weight last."""
    triples, travel = STRATEGIES[strategy]
    return [*(f"{name}.{index}" for name in triples for index in range(3)), travel]


def default_search(strategy: str) -> dict[str, tuple[float, float]]:
    """Every weight but the travel's.

    None of a triple is held: q4 and R stay, so that a triple's scale is a choice as well as its ratios.
    """
    return dict.fromkeys(searchable(strategy)[:-1], DEFAULT_RANGE)


def weights_at(scenario: JsonObject, strategy: str, searched: Iterable[str]) -> Weights:
    """The strategy's weights in a plain scenario; the travel weight only where it is searched."""
    triples, travel = STRATEGIES[strategy]
    names = [*triples, *([travel] if travel in searched else [])]
    return {name: dotted.value(scenario, name) for name in names}


def paper_weights(strategy: str, searched: Iterable[str]) -> Weights:
    """The paper's own (Tables 3 and 6, section 4.2.2); the travel weight, which it has not, at its default."""
    return weights_at(_paper(), strategy, searched)


def first_weights(scenario: JsonObject, strategy: str, searched: Iterable[str]) -> list[Weights]:
    """What every search begins with: the paper's weights, and the scenario's own where they are others."""
    papers, own = paper_weights(strategy, searched), weights_at(scenario, strategy, searched)
    return [papers] if own == papers else [papers, own]


def point_of(weights: Weights, search: Ranges, scenario: JsonObject) -> dict[str, float] | None:
    """Those weights as a point of the searched space; None where they do not lie in it."""
    flat = _flat(weights)
    for name, value in flat.items():
        low, high = search.get(name, (0, 0))
        held = name not in search and value == dotted.value(scenario, name)
        if not held and not low <= value <= high:
            return None
    return {name: flat[name] for name in search}


def weights_of(point: Mapping[str, float], search: Ranges, own: Weights) -> Weights:
    """The strategy's weights at a point of the searched space, rounded; what is not searched is the scenario's own."""
    weights: Weights = {name: list(value) if isinstance(value, list) else value for name, value in own.items()}
    for name, value in point.items():
        low, high = search[name]
        rounded = min(max(float(f"{value:.{DIGITS}g}"), low), high)
        triple, _, index = name.rpartition(".")
        if triple in weights:
            weights[triple][int(index)] = rounded
        else:
            weights[name] = rounded
    return weights


def _flat(weights: Weights) -> dict[str, float]:
    flat: dict[str, float] = {}
    for name, value in weights.items():
        flat |= {f"{name}.{index}": item for index, item in enumerate(value)} if isinstance(value, list) else {}
        if not isinstance(value, list):
            flat[name] = value
    return flat


@cache
def _paper() -> JsonObject:
    return Scenario().model_dump(mode="json")
