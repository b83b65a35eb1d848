"""Requirements over HTTP: limits of metrics, judged from the numbers that are answered beside them."""

import json
from typing import Any

import httpx
import pytest

from tests.api.conftest import ROAD, Service
from tests.servers.batches import computed

PEAK = "bump.body_acceleration.peak"
SCENARIO = {"road": ROAD}


def judged(client: httpx.Client, requirements: list[Any], **more: Any) -> Any:
    body = {"scenario": SCENARIO, "strategies": ["lqr", "lv", "passive"], "requirements": requirements, **more}
    return client.post("/api/v1/runs", json=body).raise_for_status().json()


def peak(run: Any, strategy: str) -> Any:
    return run["strategies"][strategy]["metrics"]["bump"]["body_acceleration"]["peak"]


def test_a_run_is_held_to_requirements_which_are_no_part_of_its_id(service: Service, run: dict[str, Any]) -> None:
    most = (peak(run, "lqr") + peak(run, "lv")) / 2
    change = 100 * (peak(run, "lv") / peak(run, "passive") - 1)
    requirements = [
        {"metric": PEAK, "max": most},
        {"metric": PEAK, "min": peak(run, "passive"), "strategies": ["passive"]},
        {"metric": PEAK, "max_change": change + 0.1, "strategies": ["lv"]},
        {"metric": PEAK, "max_change": change - 0.1, "strategies": ["lv"]},
        {"metric": "events.ecu_most_iterations", "max": 9, "strategies": ["lv"]},
    ]
    answer = judged(service, requirements)
    results = answer.pop("requirement_results")
    assert [(each["strategy"], each["result"]) for each in results] == [
        *(("lv", "pass"), ("lqr", "fail"), ("passive", "pass")),
        *(("lv", "pass"), ("lv", "fail"), ("lv", "fail")),
    ]
    assert (results[1]["value"], results[1]["max"]) == (peak(run, "lqr"), most)
    assert (results[3]["baseline"], results[3]["value"]) == ("passive", pytest.approx(change, rel=1e-12))
    assert (results[5]["value"], results[5]["reason"]) == (None, "It has no such metric")
    assert answer["id"] == run["id"]
    stored = service.get(f"/api/v1/runs/{run['id']}")
    assert "requirement_results" not in stored.json()
    held = service.get(f"/api/v1/runs/{run['id']}", params={"requirements": json.dumps(requirements)})
    assert held.json()["requirement_results"] == results


def test_over_several_roads_a_limit_within_the_interval_is_uncertain(client: httpx.Client) -> None:
    run = judged(client, [{"metric": PEAK, "max": 1}], roads=3)
    mean = peak(run, "lv")
    limits = {"pass": mean["high"], "uncertain": mean["mean"], "fail": mean["low"] - 1e-6}
    change = run["changes"]["lv"]["bump"]["body_acceleration"]["peak"]
    requirements = [{"metric": PEAK, "max": limit, "strategies": ["lv"]} for limit in limits.values()]
    requirements += [{"metric": PEAK, "min": limit, "strategies": ["lv"]} for limit in limits.values()]
    requirements += [{"metric": PEAK, "max_change": change[key], "strategies": ["lv"]} for key in ("high", "mean")]
    results = judged(client, requirements, roads=3)["requirement_results"]
    of_min = ["uncertain" if mean["low"] < mean["high"] else "pass"] * 2 + ["pass"]
    assert [each["result"] for each in results] == [*limits, *of_min, "pass", "uncertain"]
    assert (results[0]["value"], results[0]["low"], results[0]["high"]) == (mean["mean"], mean["low"], mean["high"])


def test_a_link_keeps_its_requirements_and_says_how_they_are_kept(client: httpx.Client, run: dict[str, Any]) -> None:
    requirements = [{"metric": PEAK, "max_change": -10, "strategies": ["lqr"]}]
    body = {"run_id": run["id"], "view": {"baseline": "lv", "axis": "time"}, "requirements": requirements}
    link = client.get(f"/api/v1/links/{client.post('/api/v1/links', json=body).json()['slug']}").json()
    assert (link["requirements"], link["view"]) == (requirements, body["view"])
    (result,) = link["run"]["requirement_results"]
    change = 100 * (peak(run, "lqr") / peak(run, "lv") - 1)
    assert (result["baseline"], result["value"]) == ("lv", pytest.approx(change))


def test_the_largest_value_at_which_all_pass_is_that_of_the_strictest(client: httpx.Client) -> None:
    """On a smooth road the passive car is linear in the bump's height: the least of both limits' heights."""
    smooth = {"road": {"roughness": 0, "length": 118}}
    question = {"scenario": smooth, "strategy": "passive", "field": "road.bump.height", "range": [0.01, 0.2]}
    limits = {PEAK: 4.0, "bump.front_deflection.peak": 0.05, "comfort.weighted_rms": 99.0}
    single = [{**question, "metric": metric, "limit": limit} for metric, limit in list(limits.items())[:2]]
    least = min(client.post("/api/v1/solve", json=each).json()["value"] for each in single)
    requirements = [{"metric": metric, "max": limit} for metric, limit in limits.items()]
    solution = client.post("/api/v1/solve", json={**question, "requirements": requirements}).json()
    assert solution["value"] == least
    assert 0.99 < solution["metric_value"] <= 1
    assert {each["result"] for each in solution["requirement_results"]} == {"pass"}
    changed = [{"metric": PEAK, "max_change": -5}, *requirements]
    answer = client.post("/api/v1/solve", json={**question, "strategy": "skyhook", "requirements": changed}).json()
    assert [each["result"] for each in answer["requirement_results"]] == ["pass"] * 4
    none = client.post("/api/v1/solve", json={**question, "requirements": [{"metric": PEAK, "max": 1e-3}]})
    assert none.json()["detail"].endswith(f"keeps every requirement; nearest is 0.01 m: {PEAK} does not pass.")


def test_the_runs_of_a_batch_are_held_point_by_point(client: httpx.Client, run: dict[str, Any]) -> None:
    heights = [0.02, 0.1, 0.15]
    change = 100 * (peak(run, "lqr") / peak(run, "passive") - 1)
    limits = [{"metric": PEAK, "max": peak(run, "lqr") * 0.99}, {"metric": PEAK, "max_change": change - 0.1}]
    requirements = [{**limit, "strategies": ["lqr"]} for limit in limits]
    sweep = {"grid": {"road.bump.height": heights}}
    body = {"scenario": SCENARIO, "strategies": ["lqr", "passive"], "sweep": sweep, "requirements": requirements}
    batch = computed(client, **body)
    assert batch["requirements"] == [
        {"max": None, "min": None, "max_change": None, "strategies": None} | each for each in requirements
    ]
    path = f"/api/v1/batches/{batch['id']}"
    answer = client.get(f"{path}/requirements").json()
    rows = client.get(f"{path}/results").json()["rows"]
    own, base = ([row["metrics"]["bump"]["body_acceleration"]["peak"] for row in rows[first::2]] for first in (0, 1))
    changes = [100 * (a / b - 1) for a, b in zip(own, base, strict=True)]
    for result, held, limit in zip(
        answer["requirement_results"], (own, changes), (limits[0]["max"], limits[1]["max_change"]), strict=True
    ):
        fails = [value > limit for value in held]
        assert any(fails), "the test needs a stricter limit"
        counts = {"pass": 3 - sum(fails), "fail": sum(fails), "not_computed": 0, "unfinished": 0}
        assert (result["result"], result["counts"], result["reason"]) == ("fail", counts, None)
        first = fails.index(True)
        assert result["first_failure"]["at"] == {"road.bump.height": heights[first]}
        assert result["first_failure"]["value"] == pytest.approx(held[first])
        assert result["worst_failure"]["value"] == pytest.approx(max(held))
    assert answer["runs"][1::2] == [None] * 3, "nothing is required of the baseline"
    again = client.post("/api/v1/batches", json={**body, "requirements": []}).json()
    assert client.get(f"/api/v1/batches/{again['id']}/requirements").json()["requirement_results"] == []


def test_a_run_of_a_batch_that_could_not_be_computed_is_no_failure_of_its_limit(
    client: httpx.Client, lqr_fails: int
) -> None:
    """Nor is the change of one whose baseline could not: both say why, and neither passes. Of a run it is."""
    scenario = {"road": {**ROAD, "seed": lqr_fails}}
    alone = judged(client, [{"metric": PEAK, "max": 99, "strategies": ["lqr"]}], scenario=scenario)
    assert [(each["result"], each["reason"]) for each in alone["requirement_results"]] == [("fail", "no controller")]
    sweep = {"grid": {"road.seed": [lqr_fails, lqr_fails + 1]}}
    body = {"scenario": SCENARIO, "strategies": ["lqr", "passive"], "baseline": "lqr", "sweep": sweep}
    own = {"metric": PEAK, "max": 99, "strategies": ["lqr"]}
    change = {"metric": PEAK, "max_change": 999, "strategies": ["passive"]}
    path = f"/api/v1/batches/{computed(client, **body, requirements=[own, change])['id']}"
    answer = client.get(f"{path}/requirements").json()
    for result, reason in zip(
        answer["requirement_results"], ["no controller", "The baseline: no controller"], strict=True
    ):
        assert result["counts"] == {"pass": 1, "fail": 0, "not_computed": 1, "unfinished": 0}
        assert (result["result"], result["first_failure"], result["reason"]) == ("fail", None, reason)
    assert answer["runs"] == ["fail", "fail", "pass", "pass"]


def test_a_report_says_how_the_requirements_are_kept(client: httpx.Client, run: dict[str, Any]) -> None:
    requirements = [{"metric": PEAK, "max": peak(run, "lqr") / 2, "strategies": ["lqr"]}]
    path = f"/api/v1/runs/{run['id']}/report.html"
    report = client.get(path, params={"requirements": json.dumps(requirements)}).text
    section = report[report.index('id="requirements"') :].partition("</section>")[0]
    assert "<td>fail</td>" in section
    assert "Body acceleration, peak, bump" in section
    assert 'id="requirements"' not in client.get(path).text
    refused = client.get(path, params={"requirements": '[{"metric": "peak", "max": 1}]'})
    assert (refused.status_code, refused.json()["errors"][0]["parameter"]) == (422, "requirements")
