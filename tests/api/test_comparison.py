"""What results mean beside each other, over HTTP: the core's comparison in answers about runs."""

import json
from dataclasses import asdict
from typing import Any

import httpx
import pytest

from sim_core import Comparison, Requirement, Scenario, compare, simulate
from sim_core.catalogue import PAPER_METRICS
from tests.api.conftest import Service

NAMES = ["lv", "lqr", "passive"]
PEAK = "bump.body_acceleration.peak"


def get(client: httpx.Client, run: dict[str, Any], **parameters: str) -> httpx.Response:
    return client.get(f"/api/v1/runs/{run['id']}", params=parameters)


def compared(client: httpx.Client, run: dict[str, Any], **parameters: str) -> Any:
    return get(client, run, **parameters).raise_for_status().json()["comparison"]


def plain(comparison: Comparison) -> Any:
    return json.loads(json.dumps(asdict(comparison)))


def test_it_is_the_cores_and_against_the_baseline_that_is_asked_for(
    client: httpx.Client, service: Service, run: dict[str, Any]
) -> None:
    scenario = Scenario.model_validate(run["scenario"])
    results = {name: simulate(scenario, name) for name in NAMES}
    assert run["comparison"] == compared(client, run) == plain(compare(results))
    assert compared(client, run, baseline="lqr") == plain(compare(results, "lqr"))
    posted = service.run(NAMES, run["scenario"], baseline="lqr").json()
    assert posted["id"] == run["id"], "what numbers are compared with makes no other run"
    assert posted["comparison"] == compared(client, run, baseline="lqr")


def test_a_strategy_that_is_not_shown_can_be_left_out_and_stay_the_baseline(
    client: httpx.Client, run: dict[str, Any]
) -> None:
    every, shown = run["comparison"], compared(client, run, compare="lqr")
    assert shown["baseline"] == "passive"
    assert shown["changes"] == {"lqr": every["changes"]["lqr"]}
    assert "LV" not in shown["verdict"]["text"]
    assert "than with Passive" in shown["verdict"]["text"]


def test_live_has_the_papers_eight_metrics(service: Service, run: dict[str, Any]) -> None:
    live = service.live(NAMES, run["scenario"], baseline="lqr").raise_for_status().json()["comparison"]
    exact = compared(service, run, baseline="lqr")
    assert (live["baseline"], live["verdict"]) == ("lqr", exact["verdict"])
    for name in ("lv", "passive"):
        assert live["changes"][name] == {key: exact["changes"][name][key] for key in PAPER_METRICS}


def test_over_several_roads_changes_have_the_intervals_that_changes_has(service: Service, road: dict[str, Any]) -> None:
    run = service.run(["lqr", "passive"], {"road": {**road, "length": 119}}, roads=3).json()
    assert run["comparison"]["baseline"] == run["baseline"] == "passive"
    change, interval = (
        run["comparison"]["changes"]["lqr"][PEAK],
        run["changes"]["lqr"]["bump"]["body_acceleration"]["peak"],
    )
    assert [change["change"], change["low"], change["high"]] == [interval[key] for key in ("mean", "low", "high")]
    assert change["beyond_variation"] is (interval["high"] < 0 or interval["low"] > 0)
    view = {"run_id": run["id"], "view": {"baseline": "lqr"}}
    slug = service.post("/api/v1/links", json=view).raise_for_status().json()["slug"]
    answer = get(service, run, baseline="lqr").json()
    assert service.get(f"/api/v1/links/{slug}").json()["run"]["changes"] == answer["changes"]
    paired = answer["changes"]["passive"]["bump"]["body_acceleration"]["peak"]
    assert answer["comparison"]["changes"]["passive"][PEAK]["low"] == paired["low"]


def test_a_baseline_that_failed_stays_the_baseline(service: Service, lqr_fails: int) -> None:
    scenario = {"road": {"length": 131.7, "seed": lqr_fails}}
    comparison = service.run(["lqr", "lv", "passive"], scenario, baseline="lqr").json()["comparison"]
    assert (comparison["baseline"], comparison["changes"]) == ("lqr", {})
    assert set(comparison["verdict"]["best"].values()) == {"lv"}
    alone = service.run(["lqr"], {"road": {"length": 131.6, "seed": lqr_fails}}).json()["comparison"]
    assert alone["verdict"] == {"text": "There is no result to compare.", "best": {}, "mixed": False}


def test_runs_and_live_are_compared_with_another_run_and_held_to_requirements(
    service: Service, run: dict[str, Any]
) -> None:
    """Word for word the core's; a baseline and a strategy that are hidden change no number."""
    edited = {**run["scenario"], "road": {**run["scenario"]["road"], "bump": {"height": 0.08}}}
    scenario, before = Scenario.model_validate(edited), Scenario.model_validate(run["scenario"])
    limits: list[dict[str, Any]] = [{"metric": PEAK, "max": 1.2}, {"metric": PEAK, "max_change": -80}]
    asked = {"against": run["id"], "requirements": limits}
    expected = plain(
        compare(
            {name: simulate(scenario, name) for name in NAMES},
            requirements=[Requirement(**each) for each in limits],
            against={name: simulate(before, name) for name in NAMES},
        )
    )
    posted = service.run(NAMES, edited, **asked).raise_for_status().json()
    assert posted["comparison"] == expected
    assert {each["result"] for each in expected["requirements"]} == {"pass", "fail"}
    parameters = {"against": run["id"], "requirements": json.dumps(limits)}
    got = get(service, posted, **parameters).raise_for_status().json()
    assert (got["comparison"], got["requirement_results"]) == (expected, expected["requirements"])
    assert compared(service, posted)["changes_against"] == {}, "nothing of it is kept"
    fewer = compared(service, posted, **parameters, compare="lqr")
    assert fewer["changes_against"]["lqr"] == expected["changes_against"]["lqr"]
    assert (list(fewer["changes_against"]), fewer["requirements"]) == (["lqr", "passive"], expected["requirements"])
    live = service.live(NAMES, edited, **asked).raise_for_status().json()["comparison"]
    assert live["requirements"] == expected["requirements"]
    for name, changes in live["changes_against"].items():
        assert changes == {key: expected["changes_against"][name][key] for key in PAPER_METRICS}


def test_over_several_roads_changes_against_are_those_of_changes(service: Service, road: dict[str, Any]) -> None:
    runs = [
        service.run(["lqr", "passive"], {"road": {**road, "length": length}}, roads=2).json() for length in (119, 120)
    ]
    paired = service.get(f"/api/v1/runs/{runs[1]['id']}/changes", params={"against": runs[0]["id"]}).json()["changes"]
    interval = paired["lqr"]["rough_road"]["body_acceleration"]["rms"]
    change = compared(service, runs[1], against=runs[0]["id"])["changes_against"]["lqr"][
        "rough_road.body_acceleration.rms"
    ]
    assert [change["change"], change["low"], change["high"]] == [interval[key] for key in ("mean", "low", "high")]


@pytest.mark.parametrize("roads", [1, 2])
def test_a_run_that_nothing_can_refer_to_is_refused_at_its_field(
    service: Service, run: dict[str, Any], road: dict[str, Any], roads: int
) -> None:
    other = service.run(["lqr"], {"road": {**road, "seed": 77}}, roads=3).json()["id"]
    for against in ("no-such-run", other):
        posted = service.run(["lqr"], {"road": road}, roads=roads, against=against)
        live = service.live(["lqr"], {"road": road}, against=against)
        for answer in (posted, live):
            assert (answer.status_code, answer.json()["errors"][0]["pointer"]) == (422, "/against")
        answer = get(service, run, against=against)
        assert (answer.status_code, answer.json()["errors"][0]["parameter"]) == (422, "against")
