"""A batch's summary against what can be counted by hand."""

import statistics
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from backend.batches import summary
from backend.batches.summary import QUANTILES, Study

FIGURE = "bump.body_acceleration.peak"


def study(values: Sequence[Sequence[float | None]], fields: dict[str, list[Any]] | None = None, **more: Any) -> Study:
    """Two strategies `a` and `b`; None is a run that failed."""
    table = np.array(values, dtype=np.float64)
    fields = fields or {}
    columns: dict[str, Any] = {
        "strategies": ["a", "b"],
        "status": np.where(np.isnan(table), "failed", "ok"),
        "reasons": {},
        "figures": {FIGURE: table},
        "fields": fields,
        "read": {"a": list(fields), "b": list(fields)},
        "damping": np.full(table.shape, np.nan),
        "nominal": {},
        "nominal_damping": {},
    }
    return Study(**(columns | more))


def summarise(rows: Study, baseline: str) -> dict[str, Any]:
    """The summary in the form of an answer."""
    return {name: each.model_dump() for name, each in summary.summarise(rows, baseline).items()}


def figure(summaries: dict[str, Any], strategy: str) -> Any:
    return summaries[strategy]["figures"][FIGURE]


def test_quantiles_extremes_and_mean_are_those_of_the_values() -> None:
    values = [3.0, 1.0, 4.0, 1.5, 9.0, 2.6, 5.3, 5.8, 9.7]
    summary = figure(summarise(study([[value, 1.0] for value in values], {"x": list(range(9))}), "b"), "a")
    hundredths = statistics.quantiles(values, n=100, method="inclusive")  # the same definition, another author
    expected = [min(values), *(hundredths[at - 1] for at in QUANTILES[1:-1]), max(values)]
    assert summary["quantiles"] == pytest.approx(expected, rel=1e-12)
    assert summary["mean"] == pytest.approx(statistics.fmean(values))
    assert summary["highest"] == {"run": 16, "value": 9.7, "at": {"x": 8}}
    assert summary["lowest"] == {"run": 2, "value": 1.0, "at": {"x": 1}}


def test_margins_pair_the_points_where_both_ran() -> None:
    summary = summarise(study([[2, 1], [None, 1], [1, 2], [3, None], [4, 4], [0.5, 1]]), "b")
    assert (summary["a"]["ok"], summary["a"]["failed"], summary["b"]["ok"]) == (5, 1, 5)
    assert figure(summary, "a")["n"] == 5  # its own distribution has its run without a partner
    margin = figure(summary, "a")["margin"]
    assert (margin["pairs"], margin["n"]) == (4, 4)
    assert margin["mean"] == pytest.approx((100 - 50 + 0 - 50) / 4)
    assert (margin["better"], margin["worse"]) == (0.5, 0.25)
    assert (margin["highest"]["run"], margin["highest"]["value"]) == (0, 100)
    assert figure(summary, "b")["margin"] is None


def test_a_change_against_zero_does_not_exist_and_better_still_does() -> None:
    margin = figure(summarise(study([[1, 0], [0, 0], [1, 2]]), "b"), "a")["margin"]
    assert (margin["pairs"], margin["n"], margin["mean"]) == (3, 1, -50)
    assert (margin["better"], margin["worse"]) == (pytest.approx(1 / 3), pytest.approx(1 / 3))


def test_nothing_finished_is_nothing_and_not_an_error() -> None:
    summary = figure(summarise(study([[None, None], [None, None]]), "b"), "a")
    assert (summary["n"], summary["quantiles"], summary["highest"], summary["above_zero"]) == (0, None, None, 0)
    assert summary["margin"]["pairs"] == 0
    assert summary["margin"]["better"] is None


def test_a_valley_is_seen_though_it_has_no_direction() -> None:
    x = np.linspace(-1, 1, 101)
    y = x**2 + 0.01 * np.random.default_rng(1).random(101)
    other = np.random.default_rng(2).random(101)
    summary = figure(summarise(study([[v, 1.0] for v in y], {"x": x.tolist(), "other": other.tolist()}), "b"), "a")
    first, second = summary["sensitivity"]
    assert first["field"] == "x"
    assert abs(first["spearman"]) < 0.2
    assert first["effect"] > 0.9
    assert second["effect"] < 0.2


def test_seeds_choices_constants_and_fields_that_are_not_read_explain_nothing() -> None:
    n = 30
    fields: dict[str, list[Any]] = {
        "road.seed": list(range(n)),
        "mpc.preview": ["none"] * n,
        "constant": [1.0] * n,
        "unread": list(range(n)),
    }
    values = [[float(i), 1.0] for i in range(n)]
    read = {"a": ["road.seed", "mpc.preview", "constant"], "b": []}
    summary = figure(summarise(study(values, fields, read=read), "b"), "a")
    assert summary["sensitivity"] == []
    assert summary["margin"]["sensitivity"] == []


def test_unstable_loops_are_counted() -> None:
    damping = np.array([[0.2, 0.1], [-0.1, 0.1], [np.nan, 0.3]])
    stability = summarise(study([[1, 1], [1, 1], [1, 1]], damping=damping), "b")["a"]["stability"]
    assert (stability["known"], stability["unstable"], stability["lowest"]["value"]) == (2, 1, -0.1)
