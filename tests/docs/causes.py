"""Why printed changes do not come out here: each cause with the fields that show it, and what they make of the cells.

tests/api/test_paper_docs.py drives all of it and, with UPDATE_DOCS=1, prints the tables into docs/explanation/paper.md.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import sqrt
from statistics import fmean
from typing import Any

from backend.paper.interpretations import Intervals
from backend.paper.tables import PaperCell, cells
from sim_core.catalogue import PAPER_SIGNALS, SIGNALS
from sim_core.comparison.intervals import change_with_interval
from sim_core.metrics.evaluate import rms_between
from sim_core.scenario import Scenario, dotted
from sim_core.simulate import simulate
from sim_core.speed.profile import make_speed_profile
from sim_core.strategies import STRATEGIES, strategy_named

_TYRES = ("front_tyre_load", "rear_tyre_load")


@dataclass(frozen=True, slots=True, kw_only=True)
class Variation:
    """Fields set otherwise than in the paper's scenario, by dotted name; where RMS are taken, if not up to the bump."""

    changes: Mapping[str, Any] = field(default_factory=dict)
    stretches: Intervals | None = None

    @property
    def label(self) -> str:
        """What it changes, in Markdown."""
        fields = [f"`{name}={_written(value)}`" for name, value in self.changes.items()]
        where = [f"RMS over {first:g}-{last:g} m" for first, last in self.stretches or ()]
        return ", ".join([*where, *fields]) or "nothing"

    def __or__(self, other: "Variation") -> "Variation":
        """Return both at once."""
        return Variation(changes={**self.changes, **other.changes}, stretches=self.stretches or other.stretches)


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """Cells of one comparison, and the variations that show what moves them; the first variation changes nothing."""

    table: int
    strategy: str
    against: str
    signals: tuple[str, ...]
    variations: tuple[Variation, ...]

    @property
    def cells(self) -> list[PaperCell]:
        """The paper's changes, in the order of `signals`."""
        of_table = {
            cell.signal: cell
            for cell in cells()
            if (cell.table, cell.strategy, cell.against) == (self.table, self.strategy, self.against)
        }
        return [of_table[signal] for signal in self.signals]


def _cause(table: int, compared: str, signals: tuple[str, ...], *variations: Variation) -> Cause:
    strategy, against = compared.split(" against ")
    return Cause(
        table=table, strategy=strategy, against=against, signals=signals, variations=(Variation(), *variations)
    )


def _changed(name: str, value: object) -> Variation:
    return Variation(changes={name: value})


_FORCE, _TIME = _changed("mpc.force_limit", 10_000), _changed("mpc.sample_time", 0.005)
_TRAVEL = _changed("mpc.deflection_limit", 0.1)
_NO_MOMENT = _changed("vehicle.cg_height", 0)
_FROM_20, _HARD_BRAKES = Variation(stretches=((20, 100),)), _changed("brake.maximum_deceleration", 8)
_BRAKE_STAGE = _changed("mpc.stage_weights.brake", [1, 1, 6])
_CRUISE_STAGE = _changed("mpc.stage_weights.cruise", [1, 1, 6])
_BUMP_STAGE = _changed("mpc.stage_weights.bump", [1, 6, 1])
_SEEN_LATE, _ROUGHER = _changed("speed.detection_distance", 40), _changed("road.roughness", 16e-6)
_NO_PREVIEW, _FASTER = _changed("mpc.preview", "none"), _changed("speed.target_speed_kmh", 50)
_LIMITS = (_FORCE, _TIME, _TRAVEL, _FORCE | _TIME, _FORCE | _TRAVEL, _TIME | _TRAVEL, _FORCE | _TIME | _TRAVEL)
_STAGE_AND_MOMENT = (_BRAKE_STAGE, _NO_MOMENT, _BRAKE_STAGE | _NO_MOMENT)

CAUSES = (
    _cause(4, "speed_only against passive", _TYRES[:1], _NO_MOMENT, _SEEN_LATE, _ROUGHER),
    _cause(4, "speed_only against passive", ("body_acceleration",), _FROM_20, _HARD_BRAKES, _FROM_20 | _HARD_BRAKES),
    _cause(5, "suspension_only against passive", PAPER_SIGNALS, *_LIMITS),
    _cause(7, "lv against speed_only", _TYRES, _CRUISE_STAGE, *_STAGE_AND_MOMENT),
    _cause(7, "lv against suspension_only", _TYRES, *_STAGE_AND_MOMENT),
    _cause(7, "lv against suspension_only", ("pitch_acceleration",), _NO_MOMENT, _NO_PREVIEW, _FASTER, _BRAKE_STAGE),
    _cause(8, "lv against speed_only", PAPER_SIGNALS, _CRUISE_STAGE, _BUMP_STAGE),
)


def page(seeds: Iterable[int]) -> Iterator[str]:
    """The tables of docs/explanation/paper.md, line by line, from runs over these roads."""
    roads = tuple(seeds)
    yield "| table | compared | figure | paper | changed | ours |"
    yield "|---|---|---|---|---|---|"
    for cause in CAUSES:
        names = ", ".join(SIGNALS[signal].label.lower().removesuffix(" dynamic load") for signal in cause.signals)
        compared = f"{STRATEGIES[cause.strategy].label} against {STRATEGIES[cause.against].label}"
        printed = _percents([cell.claim for cell in cause.cells], 2)
        about = f"| {cause.table} | {compared} | {names} | {printed} |"
        for variation in cause.variations:
            yield f"{about} {variation.label} | {_percents(changes(cause, variation, roads), 1)} |"
            about = "| | | | |"
    yield ""
    yield from _pulling(roads)
    yield ""
    yield from _bound(roads)


def changes(cause: Cause, variation: Variation, seeds: Sequence[int]) -> list[float]:
    """Change of the means over these roads in each of the cause's figures [%]."""
    figures = [(cell.window, cell.statistic, cell.signal) for cell in cause.cells]
    ours, base = (
        [_figures(_key(variation.changes), variation.stretches, name, seed) for seed in seeds]
        for name in (cause.strategy, cause.against)
    )
    return [
        change_with_interval([run[figure] for run in ours], [run[figure] for run in base]).value for figure in figures
    ]


@cache
def _figures(
    changes: tuple[tuple[str, Any], ...], stretches: Intervals | None, strategy: str, seed: int
) -> dict[tuple[str, str, str], float]:
    """Every figure of the paper, and the lowest rear tyre load [N], which is none."""
    scenario = _scenario(dict(changes), seed)
    result = simulate(scenario, strategy)
    rough = {signal: result.metrics["rough_road"][signal]["rms"] for signal in PAPER_SIGNALS}
    if stretches is not None:
        rough = rms_between(result.series, make_speed_profile(scenario, strategy_named(strategy).speed_plan), stretches)
    return {
        **{("rough_road", "rms", signal): rough[signal] for signal in PAPER_SIGNALS},
        **{("bump", "peak", signal): result.metrics["bump"][signal]["peak"] for signal in PAPER_SIGNALS},
        _LOWEST: float(result.series["rear_tyre_load"].min()),
    }


_LOWEST = ("whole", "lowest", "rear_tyre_load")


def _scenario(changes: Mapping[str, Any], seed: int) -> Scenario:
    return Scenario.model_validate(
        dotted.with_changes(Scenario().model_dump(mode="json"), {**changes, "road.seed": seed})
    )


def _key(changes: Mapping[str, Any]) -> tuple[tuple[str, Any], ...]:
    return tuple((name, tuple(value) if isinstance(value, list) else value) for name, value in changes.items())


def _pulling(seeds: Sequence[int]) -> Iterator[str]:
    lowest = fmean(_figures((), None, "passive", seed)[_LOWEST] for seed in seeds)
    static = Scenario().vehicle.static_loads[1]
    yield (
        f"Table 5's passive car: its rear tyre's dynamic load falls to {lowest:.0f} N, the mean over the roads; its "
        f"static load is {static:.0f} N. So the linear tyre pulls on the road with {-lowest - static:.0f} N, which a "
        "real one cannot, and every change of Table 5 is against that."
    )


def least_change(speed_only: float, road: float) -> float:
    """The lowest change that LV can have against speed control in a front tyre's RMS [%].

    Braking shifts the load m a h/L to the front axle whatever the suspension does: with the body at rest in pitch the
    tyres must balance that moment. So under speed control S² = R² + T², with R of the road and T of the load transfer,
    and under LV at least T. With S and R against the passive car P at constant speed, T/S = sqrt(1 - (R/S)²).

    Args:
        speed_only: Change of speed control against the passive car, S/P - 1 [%].
        road: The same without the load transfer, R/P - 1 [%].

    Raises:
        ValueError: The road's part is larger than the whole.
    """
    share = (1 + road / 100) / (1 + speed_only / 100)
    if share > 1:
        raise ValueError("The road's part is at most the whole")
    return 100 * (sqrt(1 - share * share) - 1)


def _bound(seeds: Sequence[int]) -> Iterator[str]:
    rise, fall = (
        next(cell.claim for cell in cells() if (cell.table, cell.strategy, cell.against, cell.signal) == change)
        for change in ((4, "speed_only", "passive", _TYRES[0]), (7, "lv", "speed_only", _TYRES[0]))
    )
    road = changes(CAUSES[0], _NO_MOMENT, seeds)[0]
    transfer = 1 + fall / 100
    needed = 100 * ((1 + rise / 100) * sqrt(1 - transfer * transfer) - 1)
    yield (
        f"Front tyre on the rough road: without the braking moment speed control changes it by {road:+.1f} %, which is "
        f"the road's part. If the moment makes that Table 4's {rise:+g} %, LV cannot get below "
        f"{least_change(rise, road):+.1f} % of speed control; Table 7 prints {fall:+g} %. Both could hold only if the "
        f"lower speed changed the road's part by {needed:+.1f} % or less."
    )


def _percents(values: Iterable[float], decimals: int) -> str:
    return ", ".join(f"{round(value, decimals):+g}" if decimals > 1 else f"{value:+.1f}" for value in values) + " %"


def _written(value: Any) -> str:
    return (
        ",".join(map(str, value))
        if isinstance(value, list)
        else f"{value:g}"
        if isinstance(value, float)
        else str(value)
    )
