"""A batch's statistics: distributions, margins against a baseline, sensitivity to each field, stability.

Runs in a worker: no web here. Everything is read from the batch's own rows; nothing is fitted, nothing random.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray
from pydantic import ValidationError

from backend.batches import summary_models as models
from backend.cost.affordable import simulate
from backend.custom_controllers.registry import run_in_sandbox_process
from backend.json_types import JsonObject, Summary
from backend.scenario_at import NO_ROADS, scenario_at
from sim_core import FloatArray, RidelabError, Scenario
from sim_core.controller_files import ControllerFileError
from sim_core.errors import RefusedError
from sim_core.frequency.stability import least_damping
from sim_core.scenario.measured import MeasuredRoad

QUANTILES = (0, 5, 25, 50, 75, 95, 100)  # percentiles, numpy's "linear" method: between two values by distance
MOST_GROUPS = 10  # of a field's values, for the share of a figure's variance it explains
LEAST_POINTS = 20  # fewer say nothing of which field matters
MOST_REASONS = 5
# What no loop's modes depend on: preview, the road, and limits that do not bind near rest.
NOT_FED_BACK = ("mismatch.preview_", "road.", "actuator.saturation", "actuator.rate_limit", "mpc.force_limit")

Numbers = dict[str, FloatArray]  # swept field -> its value at each point


@dataclass(slots=True, eq=False, kw_only=True)
class Study:
    """A batch's rows by point and strategy; what follows the damping is added once every row is there.

    Attributes:
        strategies: Their ids, in the order of the columns below.
        status: (points, strategies) of each run.
        reasons: Why runs failed, with how many.
        figures: Key -> values (points, strategies); NaN where a run has none.
        damping: Least damping ratio of each loop (points, strategies); NaN where there is none.
        fields: Swept field -> its value at each point.
        read: Strategy -> the swept fields that can change its result.
        nominal: Strategy -> figure -> value of the batch's own scenario.
        nominal_damping: Strategy -> least damping of the batch's own scenario.
    """

    strategies: Sequence[str]
    status: NDArray[np.str_]
    reasons: dict[str, Counter[str]]
    figures: dict[str, FloatArray]
    damping: FloatArray
    fields: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    read: Mapping[str, Sequence[str]] = field(default_factory=dict)
    nominal: Mapping[str, Mapping[str, float | None]] = field(default_factory=dict)
    nominal_damping: Mapping[str, float | None] = field(default_factory=dict)


def dampings(base: JsonObject, schema_version: int, changes: Sequence[str], strategies: Sequence[str]) -> FloatArray:
    """Least damping of each strategy's loop at these points (`changes` is JSON text); NaN where there is none."""
    points: dict[int, Scenario] = {}
    for point, text in enumerate(changes):
        with suppress(ValidationError, RidelabError):  # another version ran it
            points[point] = scenario_at(base, orjson.loads(text), schema_version)
    ratios = np.full((len(changes), len(strategies)), np.nan)
    for index, name in enumerate(strategies):
        ratios[list(points), index] = [np.nan if each is None else each for each in _dampings([*points.values()], name)]
    return ratios


def nominal(
    base: JsonObject, schema_version: int, strategies: Sequence[str], roads: Mapping[str, MeasuredRoad] = NO_ROADS
) -> tuple[dict[str, Summary], dict[str, float | None], bool]:
    """Drive the batch's own scenario, nothing swept.

    Returns:
        Each strategy's summary ({} where it fails), its least damping, and whether one failed for a reason that may
        pass.
    """
    scenario = scenario_at(base, {}, schema_version, roads)
    summaries, may_pass = dict[str, Summary](), False
    for name in strategies:
        try:
            summaries[name] = simulate(scenario, name).summary()
        except RidelabError as error:
            summaries[name] = {}
            may_pass |= not isinstance(error, RefusedError)
    return summaries, {name: _dampings([scenario], name)[0] for name in strategies}, may_pass


def summarise(study: Study, baseline: str) -> dict[str, models.StrategySummary]:
    """Return by strategy how many runs, stability, and each figure's distribution and margin."""
    against = study.strategies.index(baseline)
    numbers = _numbers(study.fields)
    return {name: _strategy(study, index, against, numbers) for index, name in enumerate(study.strategies)}


def _strategy(study: Study, index: int, against: int, every: Numbers) -> models.StrategySummary:
    name = study.strategies[index]
    numbers = {field: values for field, values in every.items() if field in study.read[name]}
    both = {**numbers, **{field: every[field] for field in study.read[study.strategies[against]] if field in every}}
    status = Counter(study.status[:, index].tolist())
    damping = study.damping[:, index]
    fed_back = {key: numbers[key] for key in numbers if not key.startswith(NOT_FED_BACK)}
    return models.StrategySummary(
        ok=status["ok"],
        failed=status["failed"],
        unfinished=len(study.status) - status["ok"] - status["failed"],
        reasons=dict(Counter(study.reasons.get(name, {})).most_common(MOST_REASONS)),
        stability=models.StabilitySummary(
            known=int(np.isfinite(damping).sum()),
            unstable=int((damping < 0).sum()),
            nominal=study.nominal_damping.get(name),
            **_distribution(study, index, damping, fed_back),
        ),
        figures={
            key: models.FigureSummary(
                nominal=study.nominal.get(name, {}).get(key),
                above_zero=int((values[:, index] > 0).sum()),
                margin=None if index == against else _margin(study, key, index, against, both),
                **_distribution(study, index, values[:, index], numbers),
            )
            for key, values in study.figures.items()
        },
    )


def _margin(study: Study, key: str, index: int, against: int, numbers: Numbers) -> models.MarginSummary:
    """Compare a strategy with the baseline at the points where both have the figure."""
    own, base = study.figures[key][:, index], study.figures[key][:, against]
    nominal = [study.nominal.get(study.strategies[each], {}).get(key) for each in (index, against)]
    paired = np.isfinite(own) & np.isfinite(base)
    pairs = int(paired.sum())
    comparable = paired & (base != 0)
    change = np.full(len(own), np.nan)
    change[comparable] = 100 * (own[comparable] / base[comparable] - 1)
    return models.MarginSummary(
        nominal=_change(*nominal),
        pairs=pairs,
        better=_share(paired & (own < base), pairs),
        worse=_share(paired & (own > base), pairs),
        **_distribution(study, index, change, numbers),
    )


def _distribution(study: Study, index: int, values: FloatArray, numbers: Numbers) -> dict[str, Any]:
    """The fields of `SensitiveDistribution`, over the finite values."""
    defined = np.flatnonzero(np.isfinite(values))
    if not len(defined):
        return {"n": 0, "mean": None, "quantiles": None, "lowest": None, "highest": None, "sensitivity": []}
    finite = values[defined]
    return {
        "n": len(defined),
        "mean": float(finite.mean()),
        "quantiles": np.percentile(finite, QUANTILES, method="linear").tolist(),
        "lowest": _extreme(study, index, values, int(defined[finite.argmin()])),
        "highest": _extreme(study, index, values, int(defined[finite.argmax()])),
        "sensitivity": _sensitivity(values, numbers),
    }


def _extreme(study: Study, index: int, values: FloatArray, point: int) -> models.Place:
    return models.Place(
        run=point * len(study.strategies) + index,
        value=float(values[point]),
        at={name: column[point] for name, column in study.fields.items()},
    )


def _share(of_pairs: NDArray[np.bool_], pairs: int) -> float | None:
    return float(of_pairs.sum() / pairs) if pairs else None


def _change(value: float | None, base: float | None) -> float | None:
    return None if value is None or not base else 100 * (value / base - 1)


def _numbers(fields: Mapping[str, Sequence[Any]]) -> Numbers:
    """The swept fields that have an order: numbers (none is NaN), but no seeds."""
    numbers: Numbers = {}
    for name, column in fields.items():
        plain = all(value is None or (isinstance(value, float | int)) for value in column)
        if plain and not name.endswith("seed"):
            numbers[name] = np.array([np.nan if value is None else value for value in column], dtype=np.float64)
    return numbers


def _sensitivity(values: FloatArray, numbers: Numbers) -> list[models.Sensitivity]:
    """Return which fields a metric follows, the most important first; empty where it is constant or has few points.

    `spearman` is the rank correlation (direction, monotone effects; scipy.stats.spearmanr). `effect` is the share of
    the ranks' variance that the field alone explains, of any shape: Kruskal-Wallis' H over up to ten groups of the
    field's values, (H - k + 1)/(n - k), Tomczak and Tomczak 2014. `p_value` is the smaller of both tests', doubled.
    """
    from scipy.stats import spearmanr  # takes half a second to import: a service starts without it

    rows = []
    for name, column in numbers.items():
        defined = np.isfinite(values) & np.isfinite(column)
        x, y = column[defined], values[defined]
        if len(x) < LEAST_POINTS or np.ptp(x) == 0 or np.ptp(y) == 0:
            continue
        rho, (effect, chance) = spearmanr(x, y), _effect(x, y)
        p_value = min(1.0, 2 * min(float(rho.pvalue), chance))
        rows.append(models.Sensitivity(field=name, spearman=float(rho.statistic), p_value=p_value, effect=effect))
    return sorted(rows, key=lambda row: (-row.effect, -abs(row.spearman)))


def _effect(x: FloatArray, y: FloatArray) -> tuple[float, float]:
    """The share of the variance explained, and the probability of such a share without any effect."""
    from scipy.stats import kruskal

    values = np.unique(x)
    if len(values) <= MOST_GROUPS:
        groups = [y[x == value] for value in values]
    else:
        groups = np.array_split(y[np.argsort(x, kind="stable")], min(MOST_GROUPS, len(x) // 10))
    n, k = len(y), len(groups)
    if n == k:  # every group is one value: nothing to compare within
        return 0.0, 1.0
    test = kruskal(*groups)
    return max(0.0, float((test.statistic - k + 1) / (n - k))), float(test.pvalue)


def _dampings(scenarios: Sequence[Scenario], name: str) -> Sequence[float | None]:
    try:
        return run_in_sandbox_process(name, _each_damping, scenarios, name)
    except ControllerFileError:
        return [None] * len(scenarios)


def _each_damping(scenarios: Sequence[Scenario], name: str) -> list[float | None]:
    ratios: list[float | None] = []
    for scenario in scenarios:
        try:
            ratios.append(least_damping(scenario, name))
        except RidelabError:
            ratios.append(None)
    return ratios
