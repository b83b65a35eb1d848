"""A batch's summary over HTTP: against the exported rows, and what is refused."""

import statistics
from typing import Any

import httpx
import pytest

from backend.batches.models import BatchSummary
from backend.batches.robustness import FIGURES, UNCERTAINTIES
from backend.batches.summary_models import RobustnessDefaults
from sim_core.scenario import dotted
from tests.servers.batches import computed

# Nobody else's, so that nothing is stored yet; short, so that it is quick.
BASE: dict[str, Any] = {"road": {"length": 92, "bump": {"start": 70}}, "speed": {"detection_distance": 50}}
PEAK = "bump.body_acceleration.peak"
TRAVEL = "events.travel_exceeded_mm"
# Every third point contradicts itself: its bump would lie behind the road's end.
POINTS = [
    {
        "mismatch.body_mass": 0.8 + 0.02 * index,
        "mismatch.damping": 1.3 - 0.05 * (index * 7 % 20),
        "road.bump.start": 91 if index % 3 == 2 else 70,
    }
    for index in range(12)
]


@pytest.fixture(scope="module")
def batch(client: httpx.Client) -> str:
    sweep = {"list": POINTS}
    ended = computed(client, scenario=BASE, strategies=["passive", "lqr", "lv"], sweep=sweep)
    assert (ended["state"], ended["failed"]) == ("done", 12)
    return str(ended["id"])


@pytest.fixture(scope="module")
def rows(client: httpx.Client, batch: str) -> Any:
    return client.get(f"/api/v1/batches/{batch}/results").json()["rows"]


def read(client: httpx.Client, batch: str, **params: str) -> Any:
    answer = client.get(f"/api/v1/batches/{batch}/summary", params=params)
    assert answer.status_code == 200, answer.text
    BatchSummary.model_validate(answer.json())
    return answer.json()


def peaks(rows: list[dict[str, Any]], strategy: str) -> dict[int, tuple[int, float]]:
    """Point -> the run and its peak on the bump, of those that ran."""
    of = [row for row in rows if row["strategy"] == strategy]
    return {
        point: (row["run"], row["metrics"]["bump"]["body_acceleration"]["peak"])
        for point, row in enumerate(of)
        if row["status"] == "ok"
    }


def test_it_says_what_the_exported_rows_say(client: httpx.Client, batch: str, rows: list[dict[str, Any]]) -> None:
    summary = read(client, batch, figures=f"{PEAK},{TRAVEL}")
    assert (summary["points"], summary["baseline"], summary["state"]) == (12, "lv", "done")
    assert summary["units"] == {PEAK: "m/s^2", TRAVEL: "mm"}
    for strategy in ("lv", "lqr", "passive"):
        runs = peaks(rows, strategy)
        values = [value for _, value in runs.values()]
        of_strategy = summary["strategies"][strategy]
        assert (of_strategy["ok"], of_strategy["failed"], of_strategy["unfinished"]) == (8, 4, 0)
        assert list(of_strategy["reasons"].values()) == [4]
        assert "road" in next(iter(of_strategy["reasons"]))
        peak = of_strategy["figures"][PEAK]
        cut = statistics.quantiles(values, n=20, method="inclusive")
        expected = [min(values), cut[0], cut[4], cut[9], cut[14], cut[18], max(values)]
        assert peak["quantiles"] == pytest.approx(expected, rel=1e-12)
        worst = max(runs, key=lambda point: runs[point][1])
        assert peak["highest"] == {"run": runs[worst][0], "value": runs[worst][1], "at": POINTS[worst]}
        assert {item["field"] for item in peak["sensitivity"]} <= {"mismatch.body_mass", "mismatch.damping"}


def test_the_nominal_values_are_those_of_the_batchs_own_scenario(client: httpx.Client, batch: str) -> None:
    run = client.post("/api/v1/runs", json={"scenario": BASE, "strategies": ["lv", "passive"]}).json()
    strategies = read(client, batch)["strategies"]
    assert list(strategies["lv"]["figures"]) == list(FIGURES)
    for name in ("lv", "passive"):
        for key, figure in strategies[name]["figures"].items():
            value: Any = run["strategies"][name] if key.startswith("events") else run["strategies"][name]["metrics"]
            for step in key.split("."):
                value = value[step]
            # Another process: the blocks a law is computed in may differ in their last bits.
            assert figure["nominal"] == pytest.approx(value, rel=1e-9, abs=1e-9), key


def test_the_defaults_are_ranges_that_a_batch_takes(client: httpx.Client) -> None:
    usual = client.get("/api/v1/robustness").json()
    RobustnessDefaults.model_validate(usual)
    assert len(usual["ranges"]) == len(UNCERTAINTIES)
    for each in usual["ranges"]:
        field = dotted.field(each["field"])
        assert field.unit == each["unit"]
        for end in (each["low"], each["high"]):
            field.checked(int(end) if field.kind == "integer" else end)
    ranges = {each["field"]: [each["low"], each["high"]] for each in usual["ranges"]}
    sweep = {"latin_hypercube": {"ranges": ranges, "samples": usual["samples"]}}
    body = {"scenario": BASE, "strategies": usual["strategies"], "sweep": sweep, "dry_run": True}
    estimate = client.post("/api/v1/batches", json=body).json()
    assert (estimate["points"], estimate["contradictory"]) == (usual["samples"], 0)
