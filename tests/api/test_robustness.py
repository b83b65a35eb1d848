"""A batch's summary over HTTP: against the exported rows, and what is refused."""

from typing import Any

import httpx
import pytest

from backend.batches.models import BatchSummary
from backend.batches.robustness import FIGURES
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


def test_it_says_what_the_exported_rows_say(client: httpx.Client, batch: str, rows: list[dict[str, Any]]) -> None:
    """How quantiles and sensitivities are computed is in tests/unit/test_summary.py."""
    summary = read(client, batch, figures=f"{PEAK},{TRAVEL}")
    assert (summary["points"], summary["baseline"], summary["state"]) == (12, "lv", "done")
    assert summary["units"] == {PEAK: "m/s^2", TRAVEL: "mm"}
    for strategy, of_strategy in summary["strategies"].items():
        own = [row for row in rows if row["strategy"] == strategy]
        peaks = {
            row["metrics"]["bump"]["body_acceleration"]["peak"]: (row["run"], POINTS[point])
            for point, row in enumerate(own)
            if row["status"] == "ok"
        }
        assert (of_strategy["ok"], of_strategy["failed"], of_strategy["unfinished"]) == (8, 4, 0)
        ((reason, count),) = of_strategy["reasons"].items()
        assert (count, "road" in reason) == (4, True)
        peak, worst = of_strategy["figures"][PEAK], max(peaks)
        assert (peak["quantiles"][0], peak["quantiles"][-1]) == (min(peaks), worst)
        assert peak["highest"] == {"run": peaks[worst][0], "value": worst, "at": peaks[worst][1]}
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
