"""What each part of LV control contributes: combinations the paper does not compare, all else equal.

The paper changes speed, preview and weights together. Here each is varied alone: preview × weights × speed for the MPC,
beside LQR with and without preview and the passive car, everything over the same roads.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import log
from typing import Any, Literal

from backend.paper.claims import FIGURES, scenario_for
from backend.paper.interpretations import DATA
from backend.paper.models import Share
from sim_core import SpeedPlan
from sim_core.comparison.intervals import Interval, change_with_interval
from sim_core.scenario import Preview, Scenario, StageWeights, dotted

ControllerName = Literal["passive", "lqr", "mpc"]
Weighting = Literal["equal", "comfort", "switched"]
FACTORS = ("speed", "preview", "switching")
COMFORT_FIGURES = ("weighted_rms", "vibration_dose")

_SWITCHED = StageWeights()
WEIGHTS: dict[Weighting, StageWeights] = {
    "equal": StageWeights(cruise=(1, 1, 1), brake=(1, 1, 1), bump=(1, 1, 1)),
    "comfort": StageWeights(cruise=_SWITCHED.cruise, brake=_SWITCHED.cruise, bump=_SWITCHED.cruise),
    "switched": _SWITCHED,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Variant:
    """One combination; `preview` and `weights` are None where there is nothing to choose."""

    controller: ControllerName
    speed: SpeedPlan
    preview: Preview | None = None
    weights: Weighting | None = None

    @property
    def id(self) -> str:
        """Return the parts, joined."""
        return "-".join(str(part) for part in (self.controller, self.speed, self.preview, self.weights) if part)

    @property
    def label(self) -> str:
        """Return the parts in words."""
        parts = (self.controller, self.weights, self.preview, self.speed)
        return ", ".join(DATA["attribution"]["words"][part] for part in parts if part)

    @property
    def known_as(self) -> str | None:
        """Return the strategy of the paper it is, if it is one."""
        return _KNOWN.get(self)

    def scenario(self, seed: int) -> Scenario:
        """Return the paper's scenario with this variant's speed, preview and weights."""
        changes: dict[str, Any] = {"speed.policy": self.speed}
        if self.preview is not None:
            changes[f"{self.controller}.preview"] = self.preview
        if self.weights is not None:
            changes["mpc.stage_weights"] = WEIGHTS[self.weights].model_dump(mode="json")
        plain = scenario_for({}, seed).model_dump(mode="json")
        return Scenario.model_validate(dotted.with_changes(plain, changes))

    @property
    def strategy(self) -> str:
        """Return the id of the strategy that has its controller; the scenario says how fast it goes."""
        return {"passive": "passive", "lqr": "lqr", "mpc": "lv"}[self.controller]


_PREVIEWS: tuple[Preview, ...] = ("none", "wheelbase", "lookahead")
_KNOWN = {
    Variant(controller="passive", speed="constant"): "passive",
    Variant(controller="passive", speed="planned"): "speed_only",
    Variant(controller="lqr", speed="planned", preview="none"): "lqr",
    Variant(controller="mpc", speed="planned", preview="lookahead", weights="switched"): "lv",
}
_SPEEDS: tuple[SpeedPlan, ...] = "constant", "planned"
VARIANTS: tuple[Variant, ...] = tuple(
    variant
    for speed in _SPEEDS
    for variant in (
        Variant(controller="passive", speed=speed),
        *(Variant(controller="lqr", speed=speed, preview=preview) for preview in _PREVIEWS),
        *(
            Variant(controller="mpc", speed=speed, preview=preview, weights=weights)
            for preview in _PREVIEWS
            for weights in WEIGHTS
        ),
    )
)
LV = "mpc-planned-lookahead-switched"

EQUAL_SPEED: list[tuple[str, str, str]] = DATA["attribution"]["equal_speed"]

# variant id -> figure (as in claims.FIGURES, or a comfort key) -> a value for each seed
Values = Mapping[str, Mapping[Any, Sequence[float]]]


def shares(values: Values) -> list[Share]:
    """Return how much of LV's gain is speed, preview and switching, metric by metric.

    From the MPC with equal weights, without preview, at constant speed to LV: Shapley values (Shapley 1953) of the log
    of the mean, that is the average over the six orders in which the three can be added.
    """
    return [_shares(figure, values) for figure in FIGURES]


def _shares(figure: tuple[str, str, str], values: Values) -> Share:
    logs = {
        added: log(_mean(values[_corner(added)][figure]))
        for added in (frozenset(order[:size]) for order in permutations(FACTORS) for size in range(len(FACTORS) + 1))
    }
    whole = logs[frozenset(FACTORS)] - logs[frozenset()]
    parts = dict.fromkeys(FACTORS, 0.0)
    orders = list(permutations(FACTORS))
    for order in orders:
        for size, factor in enumerate(order):
            parts[factor] += (logs[frozenset(order[: size + 1])] - logs[frozenset(order[:size])]) / len(orders)
    total = change_with_interval(values[LV][figure], values[_corner(frozenset())][figure]).value
    shown = {name: 100 * part / whole for name, part in parts.items()}
    return Share(**dict(zip(("window", "statistic", "signal"), figure, strict=True)), **shown, total_change=total)


def _corner(added: frozenset[str]) -> str:
    return Variant(
        controller="mpc",
        speed="planned" if "speed" in added else "constant",
        preview="lookahead" if "preview" in added else "none",
        weights="switched" if "switching" in added else "equal",
    ).id


def compared(first: str, second: str, values: Values) -> list[Interval]:
    """Return the change of one variant against another in each of claims.FIGURES."""
    return [change_with_interval(values[first][figure], values[second][figure]) for figure in FIGURES]


def sentences(values: Values) -> list[str]:
    """Say in words what contributes how much; every number is computed from `values`."""
    by_figure, lines = shares(values), []
    for window, statistic, title in (
        ("bump", "peak", "peaks on the bump"),
        ("rough_road", "rms", "RMS on the rough road"),
    ):
        of_window = [item for item in by_figure if (item.window, item.statistic) == (window, statistic)]
        changes = ", ".join(f"{item.total_change:+z.0f} %" for item in of_window)
        speed, preview, switching = (
            _mean([getattr(item, factor) * log(1 + item.total_change / 100) for item in of_window])
            for factor in FACTORS
        )
        whole = speed + preview + switching
        lines.append(
            f"Of the change in the {title} from an MPC with equal weights, without preview and at constant speed to LV "
            f"(body, pitch, front and rear tyre: {changes}), {100 * speed / whole:.0f} % is the lower speed, "
            f"{100 * preview / whole:.0f} % the preview and {100 * switching / whole:.0f} % the switching of weights."
        )
    lines += [_against(label, first, second, values) for label, first, second in EQUAL_SPEED[:4]]
    slow, fast = values[LV]["travel_time"], values["passive-constant"]["travel_time"]
    lines.append(
        f"The lower speed costs {_mean(slow) - _mean(fast):.1f} s over the road "
        f"({_mean(slow):.1f} against {_mean(fast):.1f} s)."
    )
    return lines


def _against(label: str, first: str, second: str, values: Values) -> str:
    changes = compared(first, second, values)
    better = sum(change.high < 0 for change in changes)
    worse = sum(change.low > 0 for change in changes)
    return (
        f"{label}, at the same speed: better in {better} of {len(changes)} figures, worse in {worse} "
        f"(bump peaks {', '.join(f'{change.value:+z.0f} %' for change in changes[4:])})."
    )


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
