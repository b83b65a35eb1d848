"""Runs over several roads: means, intervals and paired changes; everything else of a run works on them."""

import itertools
from concurrent.futures import ThreadPoolExecutor
from statistics import fmean
from typing import Any

import numpy as np
import pytest

from backend.means_over_roads import with_seeds
from backend.runs import bands, histories
from backend.runs.models import Bands, CreatedRoadsRun, CreatedRun, PairedChanges, RoadsRun
from sim_core import Scenario, simulate
from sim_core.catalogue import COMFORT, METRIC_SIGNALS, SIGNALS, STATISTICS, WINDOWS
from sim_core.comparison.intervals import change_with_interval, mean_with_interval
from tests import wording
from tests.api.conftest import Service
from tests.api.refusals import check_refused
from tests.html import check, read

SEED = 41


@pytest.fixture(scope="module")
def scenario(road: dict[str, Any]) -> dict[str, Any]:
    return {"road": {**road, "seed": SEED}}


def post(service: Any, **body: Any) -> Any:
    return service.post("/api/v1/runs", json=body)


@pytest.fixture(scope="module")
def three(service: Any, scenario: dict[str, Any]) -> Any:
    """Three roads of two strategies."""
    response = post(service, scenario=scenario, strategies=["passive", "lqr"], roads=3)
    assert response.status_code == 200, response.text
    return response.json()


def triple(interval: Any) -> dict[str, float]:
    return {"mean": interval.value, "low": interval.low, "high": interval.high}


def test_its_figures_are_those_of_the_three_single_runs(
    service: Any, three: dict[str, Any], scenario: dict[str, Any]
) -> None:
    singles = [
        post(service, scenario={"road": {**scenario["road"], "seed": SEED + i}}, strategies=["lqr", "passive"]).json()
        for i in range(3)
    ]
    for single in singles:
        CreatedRun.model_validate(single)
        assert all(entry["cached"] for entry in single["strategies"].values()), "the same results, by content"
    for name in ("lqr", "passive"):
        entry, alone = three["strategies"][name], [single["strategies"][name] for single in singles]
        for window, signal, statistic in itertools.product(WINDOWS, METRIC_SIGNALS, STATISTICS):
            values = [each["metrics"][window][signal][statistic] for each in alone]
            base = [single["strategies"]["passive"]["metrics"][window][signal][statistic] for single in singles]
            interval = entry["metrics"][window][signal][statistic]
            assert interval == pytest.approx(triple(mean_with_interval(values)), rel=1e-12)
            assert interval["mean"] == pytest.approx(fmean(values), rel=1e-12)
            if name == "lqr":
                change = three["changes"]["lqr"][window][signal][statistic]
                expected = triple(change_with_interval(values, base)) if any(base) else None
                assert change == (None if expected is None else pytest.approx(expected, rel=1e-9))
        for key in COMFORT:
            values = [each["comfort"][key] for each in alone]
            assert entry["comfort"][key] == pytest.approx(triple(mean_with_interval(values)), rel=1e-12)
        for key in ("events", "reference", "stages", "travel_time", "arrival_speed_kmh"):
            assert entry[key] == alone[0][key], "the first road's"
        assert len({each["travel_time"] for each in alone}) == 1, "which is that of every road"
        assert entry["compute_ms"] == pytest.approx(sum(each["compute_ms"] for each in alone))


def test_it_is_stored_by_its_roads_and_baseline(service: Any, three: dict[str, Any], scenario: dict[str, Any]) -> None:
    body = {"scenario": scenario, "strategies": ["lqr", "passive"], "roads": 3}
    again, other = (post(service, **body, baseline=name).json() for name in ("passive", "lqr"))
    assert (again["id"], again["changes"]) == (three["id"], three["changes"])
    assert (other["id"] == three["id"], other["baseline"], set(other["changes"])) == (False, "lqr", {"passive"})
    for run in (again, other):
        assert all(entry["cached"] for entry in run["strategies"].values()), "the same results"
    asked = service.get(f"/api/v1/runs/{three['id']}/changes", params={"baseline": "lqr"}).json()
    assert asked["changes"] == other["changes"]
    stored = service.get(f"/api/v1/runs/{three['id']}").json()
    RoadsRun.model_validate(stored)
    assert {**stored, "strategies": None} == {**three, "strategies": None}


@pytest.fixture(scope="module")
def higher(service: Any, scenario: dict[str, Any]) -> Any:
    """The same roads with a higher bump, one strategy more."""
    bump = {**scenario["road"]["bump"], "height": 0.11}
    body = {"scenario": {"road": {**scenario["road"], "bump": bump}}, "strategies": ["passive", "lqr", "skyhook"]}
    return post(service, **body, roads=3).json()


def changes(service: Any, run: str, against: str) -> Any:
    return service.get(f"/api/v1/runs/{run}/changes", params={"against": against})


def test_changes_against_another_run_are_paired_by_road(
    service: Any, three: dict[str, Any], higher: dict[str, Any], scenario: dict[str, Any]
) -> None:
    answer = changes(service, higher["id"], three["id"]).json()
    PairedChanges.model_validate(answer)
    assert (answer["against"], answer["roads"], list(answer["changes"])) == (three["id"], 3, ["lqr", "passive"])

    def peaks(of: dict[str, Any]) -> list[float]:
        singles = [{**of, "road": {**of["road"], "seed": SEED + i}} for i in range(3)]
        answers = [post(service, scenario=single, strategies=["passive"]).json() for single in singles]
        return [each["strategies"]["passive"]["metrics"]["bump"]["body_acceleration"]["peak"] for each in answers]

    expected = change_with_interval(peaks(higher["scenario"]), peaks(scenario))
    change = answer["changes"]["passive"]["bump"]["body_acceleration"]["peak"]
    assert change == pytest.approx(triple(expected), rel=1e-9)
    assert answer["changes"]["passive"]["rough_road"]["body_acceleration"]["rms"] == {"mean": 0, "low": 0, "high": 0}
    report = service.get(f"/api/v1/runs/{higher['id']}/report.html", params={"against": three["id"]}).text
    check(read(report))
    assert f"run {three['id']}, strategy by strategy" in report
    assert f"+{change['mean']:.0f} ± {change['high'] - change['mean']:.0f}\u2009%" in report


@pytest.mark.parametrize("asked", wording.asked_in("roads_refusals"), ids=lambda asked: asked["query"])
def test_changes_are_refused_against_other_roads(
    service: Service, three: dict[str, Any], scenario: dict[str, Any], asked: Any
) -> None:
    one = service.run(["passive"], scenario).json()["id"]
    other = service.run(["passive"], {"road": {**scenario["road"], "seed": SEED - 9}}, roads=3).json()["id"]
    check_refused(service, "roads_refusals", asked, THREE=three["id"], ONE=one, OTHER=other)


def test_a_failure_on_one_road_is_the_strategys_and_names_the_seed(service: Service, lqr_fails: int) -> None:
    scenario = {"road": {"length": 131.7, "seed": lqr_fails - 1}}
    answer = post(service, scenario=scenario, strategies=["lqr", "passive"], roads=3, baseline="lqr").json()
    CreatedRoadsRun.model_validate(answer)
    assert answer["strategies"]["lqr"]["reason"] == "Road seed 72: no controller"
    assert answer["strategies"]["passive"]["status"] == "ok"
    assert answer["changes"] == {}, "the baseline failed"
    drawn = service.get(f"/api/v1/runs/{answer['id']}/figures/speed").json()
    assert [trace["meta"]["strategy"] for trace in drawn["data"]] == ["passive"]
    report = service.get(f"/api/v1/runs/{answer['id']}/report.html")
    assert "Road seed 72: no controller" in report.text


def test_a_link_and_its_preview_open(service: Any, three: dict[str, Any]) -> None:
    created = service.post("/api/v1/links", json={"run_id": three["id"]}).json()
    link = service.get(f"/api/v1/links/{created['slug']}").json()
    assert created["series_pinned"] is True
    assert link["run"]["changes"] == three["changes"]
    change = three["changes"]["lqr"]["bump"]["body_acceleration"]["peak"]["mean"]
    head = service.get(f"/s/{created['slug']}").text
    assert f"{abs(round(change))} % {'less' if change < 0 else 'more'} peak body acceleration" in head
    assert "mean of 3 roads" in head


def test_bands_are_mean_and_extremes_of_the_single_runs(
    service: Service, three: dict[str, Any], scenario: dict[str, Any]
) -> None:
    """At each sample, which every road shares; fewer points are some of them, with every extreme."""
    path = f"/api/v1/runs/{three['id']}/bands"
    whole, few = (
        service.get(path, params={"strategy": "lqr", **points}).json()["strategies"]["lqr"]
        for points in ({}, {"points": 300})
    )
    singles = [simulate(road, "lqr").series for road in with_seeds(Scenario.model_validate(scenario), 3)]
    assert list(whole["mean"]) == list(SIGNALS)
    common = {"time", "position", "speed", "brake_pressure", "brake_deceleration"}
    assert set(whole["mean"]) - set(whole["minimum"]) == common
    kept = np.isin(whole["mean"]["time"], few["mean"]["time"])
    assert kept.sum() == len(few["mean"]["time"]) < len(kept) / 4
    for part, over in (("mean", np.mean), ("minimum", np.min), ("maximum", np.max)):
        for key, values in whole[part].items():
            drives = np.array([each[key] for each in singles], dtype=np.float32).astype(np.float64)
            single = np.array(values, dtype=np.float32)
            np.testing.assert_allclose(single, over(drives, axis=0), rtol=1e-7)  # float32's half digit
            np.testing.assert_array_equal(np.array(few[part][key], dtype=np.float32), single[kept])
            assert (min(few[part][key]), max(few[part][key])) == (min(values), max(values))
            assert key not in common or np.ptp(drives, axis=0).max() == 0
    one = post(service, scenario=scenario, strategies=["lqr"]).json()["id"]
    assert "one road" in service.get(f"/api/v1/runs/{one}/bands").json()["detail"]


def test_bands_are_driven_once_within_limits_and_refused_of_another_core(
    service: Any, road: dict[str, Any], monkeypatch: pytest.MonkeyPatch, worker_calls: list[tuple[Any, ...]]
) -> None:
    """Two equal requests at once drive each strategy once; a third, for fewer points, none."""
    scenario = {"road": {**road, "seed": 600}}
    run = service.run(["lqr", "passive"], scenario, roads=6).json()["id"]

    def asked(points: int, more: str = "") -> Any:
        return service.get(f"/api/v1/runs/{run}/bands?points={points}{more}")

    with monkeypatch.context() as limited:  # counted before anything is driven
        sizes = [bands.Band.most_nbytes(Scenario.model_validate(scenario), name) for name in ("lqr", "passive")]
        limited.setattr(bands, "MAX_BYTES", sum(sizes) - 1)
        refused = asked(60)
        assert (refused.status_code, "fewer strategies" in refused.json()["detail"]) == (422, True)
        assert asked(60, "&strategy=lqr").status_code == 200
    with ThreadPoolExecutor(2) as threads:
        answers = [each.json() for each in threads.map(asked, [500, 500])]
    fewer = asked(60).json()
    assert sum(call[0] is bands.drive for call in worker_calls) == 2, "one task a strategy"
    assert answers[0] == answers[1]
    Bands.model_validate(answers[0])
    assert (answers[0]["roads"], list(answers[0]["strategies"])) == (6, ["lqr", "passive"])
    assert len(fewer["strategies"]["lqr"]["mean"]["time"]) < len(answers[0]["strategies"]["lqr"]["mean"]["time"])
    monkeypatch.setattr(histories, "CORE_VERSION", "9.0.0")
    gone = asked(60)
    assert (gone.status_code, gone.json()["type"].rpartition(":")[2]) == (410, "other-core-version")
