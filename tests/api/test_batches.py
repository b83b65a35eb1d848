"""Batches over HTTP: what is accepted, refused, followed, cancelled and read."""

import csv
import io
import itertools
import json
from typing import Any

import httpx
import pytest

from backend.jobs import dispatch
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from tests.api.streams import read_events
from tests.servers.batches import rows, wait_for
from tests.servers.process import wait_until

BASE = {"road": {"length": 125, "bump": {"start": 88}}}  # nobody else's, so that nothing is stored yet
HEIGHTS = [0.04, 0.06, 0.08]
# A tenth of a second of one core each, so that a batch of them is still running when it is looked at.
LONG = {
    "road": {"length": 10.7, "bump": {"start": 4}},
    "mpc": {"solver": "osqp", "force_limit": 500, "prediction_horizon": 15, "control_horizon": 10},
}


def submit(client: httpx.Client, sweep: dict[str, Any], *, key: str | None = None, **more: Any) -> httpx.Response:
    body = {"scenario": BASE, "strategies": ["lv", "passive"], "sweep": sweep, **more}
    return client.post("/api/v1/batches", json=body, headers={"Idempotency-Key": key} if key else {})


def listed(client: httpx.Client) -> list[str]:
    return [batch["id"] for batch in client.get("/api/v1/batches", params={"limit": 500}).json()["batches"]]


@pytest.fixture(scope="module")
def batch(client: httpx.Client) -> dict[str, Any]:
    """A finished grid of three heights and two previews under two strategies."""
    answer = submit(client, {"grid": {"road.bump.height": HEIGHTS, "mpc.preview": ["lookahead", "none"]}})
    assert answer.status_code == 202, answer.text
    assert answer.headers["location"] == f"/api/v1/batches/{answer.json()['id']}"
    unplanned = {"state": "planning", "total": None, "fields": None, "estimated_cost": None}
    assert {name: answer.json()[name] for name in unplanned} == unplanned
    finished: dict[str, Any] = wait_for(client, answer.json()["id"])
    return finished


def test_every_combination_runs_once_in_order(client: httpx.Client, batch: dict[str, Any]) -> None:
    assert (batch["state"], batch["done"], batch["failed"], batch["total"]) == ("done", 12, 0, 12)
    assert batch["created_at"] <= batch["started_at"] <= batch["finished_at"]
    runs = rows(client, batch["id"])
    combinations = itertools.product(HEIGHTS, ["lookahead", "none"], ["lv", "passive"])
    assert [(row["road.bump.height"], row["mpc.preview"], row["strategy"]) for row in runs] == list(combinations)
    assert [row["run"] for row in runs] == list(range(12))


def test_a_row_is_what_the_core_computes(client: httpx.Client, batch: dict[str, Any]) -> None:
    row = rows(client, batch["id"])[6]
    scenario = Scenario.model_validate(
        {**BASE, "road": {**BASE["road"], "bump": {"start": 88, "height": 0.06}}, "mpc": {"preview": "none"}}
    )
    expected = json.loads(json.dumps(simulate(scenario, "lv").summary(), default=dict))
    assert (row["road.bump.height"], row["mpc.preview"], row["strategy"]) == (0.06, "none", "lv")
    for name in ("metrics", "comfort", "travel_time", "arrival_speed_kmh"):
        # Another process, the same arithmetic: only the blocks a law is computed in may differ in their last bits.
        assert _flat(row[name]) == pytest.approx(_flat(expected[name]), rel=1e-9), name


def _flat(value: Any, name: str = "") -> dict[str, float]:
    if isinstance(value, dict):
        return {key: item for inner, part in value.items() for key, item in _flat(part, f"{name}.{inner}").items()}
    return {name: value}


def test_files_hold_the_same_rows_with_units(client: httpx.Client, batch: dict[str, Any]) -> None:
    path = f"/api/v1/batches/{batch['id']}/results"
    plain = client.get(path).json()
    text = client.get(path, params={"format": "csv"})
    assert text.headers["content-type"] == "text/csv; charset=utf-8; header=present"
    assert f'filename="ridelab-batch-{batch["id"]}.csv"' in text.headers["content-disposition"]
    lines = list(csv.DictReader(io.StringIO(text.text)))
    assert len(lines) == len(plain["rows"]) == 12
    peak = "bump.body_acceleration.peak [m/s^2]"
    for row, line in zip(plain["rows"], lines, strict=True):
        expected = row["metrics"]["bump"]["body_acceleration"]["peak"]
        assert float(line[peak]) == expected
        assert float(line["road.bump.height [m]"]) == row["road.bump.height"]
        assert line["mpc.preview [1]"] == row["mpc.preview"]
        assert line["status"] == "ok"
        assert line["core_version"] == row["core_version"]
        assert line["batch"] == batch["id"]
    assert plain["units"]["bump.body_acceleration.peak"] == "m/s^2"
    assert plain["sweep"] == client.get(f"/api/v1/batches/{batch['id']}/sweep").json()
    assert plain["scenario"] == batch["scenario"]


def test_rows_come_page_by_page_and_as_csv_by_accept(client: httpx.Client, batch: dict[str, Any]) -> None:
    path = f"/api/v1/batches/{batch['id']}/results"
    lengths, found = list[int](), list[Any]()
    cursor: int | None = 0
    while cursor is not None:
        page = client.get(path, params={"limit": 5, "cursor": cursor}).json()
        lengths.append(len(page["rows"]))
        found += page["rows"]
        cursor = page["next"]
    assert lengths == [5, 5, 2]
    assert found == client.get(path).json()["rows"]
    asked = client.get(path, headers={"Accept": "text/csv"}, params={"limit": 2, "cursor": 10})
    whole = _csv(client, batch["id"]).splitlines()
    assert asked.text.splitlines() == [whole[0], *whole[11:]]


def test_columns_are_the_same_numbers(client: httpx.Client, batch: dict[str, Any]) -> None:
    path = f"/api/v1/batches/{batch['id']}/table"
    answer = client.get(path, params={"figures": "bump.body_acceleration.peak,travel_time"}).json()
    runs = rows(client, batch["id"])
    assert answer["columns"]["road.bump.height"] == [row["road.bump.height"] for row in runs]
    assert answer["columns"]["travel_time"] == [row["travel_time"] for row in runs]
    peaks = [row["metrics"]["bump"]["body_acceleration"]["peak"] for row in runs]
    assert answer["columns"]["bump.body_acceleration.peak"] == peaks
    assert answer["units"] == {
        "road.bump.height": "m",
        "mpc.preview": "1",
        "bump.body_acceleration.peak": "m/s^2",
        "travel_time": "s",
    }
    assert client.get(path, params={"figures": "no.such"}).status_code == 422


def events(client: httpx.Client, batch_id: str, **options: Any) -> list[dict[str, Any]]:
    return read_events(client, f"/api/v1/batches/{batch_id}/events", **options)


def test_points_that_contradict_themselves_are_failed_rows_with_a_reason(client: httpx.Client) -> None:
    sweep = {"grid": {"mpc.prediction_horizon": [10, 30], "mpc.control_horizon": [5, 20]}}
    before = listed(client)
    estimate = submit(client, sweep, strategies=["lv"], dry_run=True).json()
    assert (estimate["points"], estimate["total"], estimate["contradictory"]) == (4, 4, 1)
    assert min(estimate["estimated_seconds"], estimate["estimated_cost"]) > 0
    assert listed(client) == before, "nothing is stored"
    batch = wait_for(client, submit(client, sweep, strategies=["lv"]).json()["id"])
    assert (batch["state"], batch["done"], batch["failed"], batch["total"]) == ("done", 3, 1, 4)
    runs = rows(client, batch["id"])
    assert [row["status"] for row in runs] == ["ok", "failed", "ok", "ok"]
    assert runs[1]["reason"].startswith("mpc.control_horizon: ")
    assert "metrics" not in runs[1]
    lines = list(csv.DictReader(io.StringIO(_csv(client, batch["id"]))))
    assert lines[1]["reason"] == runs[1]["reason"]
    assert lines[1]["travel_time [s]"] == ""


def _csv(client: httpx.Client, batch_id: str) -> str:
    return client.get(f"/api/v1/batches/{batch_id}/results", params={"format": "csv"}).text


def hypercube(name: str, low: float, high: float, **more: int) -> dict[str, Any]:
    return {"latin_hypercube": {"ranges": {name: [low, high]}, "samples": 3, **more}}


@pytest.mark.parametrize(
    ("sweep", "pointers"),
    [
        ({"grid": {"road.bmp": [1]}}, ["grid/road.bmp"]),
        ({"grid": {"road.seed": [1, "1", True, -1, None]}}, [f"grid/road.seed/{i}" for i in (1, 2, 3, 4)]),
        ({"grid": {"lqr.weights": [[0, 0, 0], [1, 2]]}}, ["grid/lqr.weights/0", "grid/lqr.weights/1"]),
        ({"grid": {"lqr.weights": [[1, 1, 1]], "lqr.weights.0": [2]}}, [""]),
        ({"list": [{"=HYPERLINK(1)": 1}]}, ["list/0"]),
        (hypercube("mpc.preview", 0, 1), ["latin_hypercube/ranges/mpc.preview"]),
        (hypercube("road.bump.height", 0, 7), ["latin_hypercube/ranges/road.bump.height/1"]),
        ({"grid": {"road.seed": [1]}, "linked": {"road.length": ["road.bump.start"]}}, ["linked/road.length"]),
        ({"grid": {"road.length": [150]}, "linked": {"road.length": ["road.seed"]}}, ["linked/road.length/0"]),
        ({"grid": {"road.length": [2000]}, "linked": {"road.length": ["road.bump.width"]}}, ["linked/road.length/0"]),
        ({"grid": {}}, ["grid"]),
        ({}, [""]),
        ({"grid": {"road.seed": [1]}, "list": [{}]}, [""]),
    ],
)
def test_what_a_sweep_cannot_use_is_named(client: httpx.Client, sweep: dict[str, Any], pointers: list[str]) -> None:
    answer = submit(client, sweep)
    assert answer.status_code == 422, answer.text
    assert sorted({error["pointer"] for error in answer.json()["errors"]}) == sorted(
        f"/sweep/{place}".rstrip("/") for place in pointers
    )
    assert "HYPERLINK" not in answer.text


def test_what_planning_finds_ends_the_batch_with_the_problem_of_a_dry_run(client: httpx.Client) -> None:
    """Also of a list too long to be looked at when it is sent."""
    before = listed(client)
    sweep = {"list": [{"road.bump.height": 7 if index == 1500 else 0.1} for index in range(2000)]}
    refused = submit(client, sweep, dry_run=True)
    assert [error["pointer"] for error in refused.json()["errors"]] == ["/sweep/list/1500/road.bump.height"]
    assert listed(client) == before
    accepted = submit(client, sweep)
    assert accepted.status_code == 202
    batch = wait_for(client, accepted.json()["id"])
    assert (batch["state"], batch["reason"]) == ("failed", refused.json()["detail"])
    assert batch["problem"] | {"request_id": ""} == refused.json() | {"request_id": ""}
    assert (batch["total"], batch["fields"], batch["resumable"]) == (None, None, True)
    assert rows(client, batch["id"]) == []
    client.post(f"/api/v1/batches/{batch['id']}/resume").raise_for_status()
    assert wait_for(client, batch["id"])["problem"] == batch["problem"], "it was planned again"
    assert [event["state"] for event in events(client, batch["id"])] == ["planning", "failed"] * 2


EXPENSIVE: dict[str, Any] = {
    "road": {"length": 3000},
    "speed": {"initial_speed_kmh": 20},
    "mpc": {"solver": "osqp", "prediction_horizon": 200, "control_horizon": 100},
}


@pytest.mark.parametrize(
    ("scenario", "sweep", "limit"),
    [
        (EXPENSIVE, {"grid": {"mpc.sample_time": [0.01, 0.002]}}, "30 s"),
        (
            BASE,
            {"grid": {"road.seed": list(range(1000)), "road.bump.height": [i / 1000 for i in range(200)]}},
            "100000",
        ),
    ],
    ids=["cost", "runs"],
)
def test_too_large_a_batch_is_refused_with_its_limit(
    client: httpx.Client, scenario: dict[str, Any], sweep: dict[str, Any], limit: str
) -> None:
    answer = submit(client, sweep, scenario=scenario, dry_run=True)
    assert answer.status_code == 422
    assert f"over the limit of {limit}" in answer.json()["detail"]


def test_the_largest_batch_is_accepted_before_it_is_planned_and_cancelled_meanwhile(
    client: httpx.Client, worker_calls: list[tuple[Any, ...]]
) -> None:
    ranges = {"road.bump.height": [0.05, 0.1], "vehicle.body_mass": [1000, 1500]}
    cube = {"latin_hypercube": {"ranges": ranges, "samples": 100_000}}
    accepted = submit(client, cube, strategies=["passive"])
    assert (accepted.status_code, accepted.json()["state"]) == (202, "planning")
    assert worker_calls == []
    path = f"/api/v1/batches/{accepted.json()['id']}"
    assert client.get(f"{path}/sweep").json() == {"latin_hypercube": {**cube["latin_hypercube"], "seed": 0}}
    assert client.post(f"{path}/cancel").json()["state"] == "cancelled"
    assert client.get(path).json()["total"] is None
    assert client.delete(path).status_code == 204


def test_fields_that_are_linked_take_the_same_value_at_each_point(client: httpx.Client) -> None:
    initial, target = "speed.initial_speed_kmh", "speed.target_speed_kmh"
    answer = submit(client, {"grid": {initial: [20, 30.5]}, "linked": {initial: [target]}})
    batch = wait_for(client, answer.json()["id"])
    assert [(field["name"], field["linked_to"]) for field in batch["fields"]] == [(initial, None), (target, initial)]
    runs = rows(client, batch["id"])
    assert [(row[initial], row[target], row["strategy"]) for row in runs] == [
        (speed, speed, strategy) for speed in (20, 30.5) for strategy in ("lv", "passive")
    ]
    assert runs[0]["arrival_speed_kmh"] == pytest.approx(20, abs=0.5)


def test_a_small_batch_does_not_wait_for_a_large_one_which_is_cancelled_and_goes_on(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`position` counts the runs before it; cancelling keeps what is finished."""
    monkeypatch.setattr(dispatch, "CHUNK_BUDGET", 0.5)
    sweep = {"grid": {"road.seed": list(range(1, 41))}}
    large = submit(client, sweep, scenario=LONG, strategies=["passive", "lv"]).json()
    path = f"/api/v1/batches/{large['id']}"
    wait_until(lambda: client.get(path).json()["done"], "the first runs are done")
    small = submit(client, {"grid": {"road.bump.height": [0.0311]}}).json()
    assert 0 < small["position"] < 80
    assert wait_for(client, small["id"])["done"] == 2
    running = client.get(path).json()
    assert (running["state"], running["position"]) == ("running", 0)
    assert running["done"] < 60, "it was far from its end"
    answer = client.post(f"{path}/cancel")
    assert (answer.status_code, answer.json()["state"]) == (200, "cancelled")
    runs = rows(client, large["id"])
    statuses = [row["status"] for row in runs]
    assert statuses.count("ok") == answer.json()["done"] >= 1
    assert statuses.count("cancelled") == 80 - statuses.count("ok")
    assert client.post(f"{path}/resume").json()["state"] in ("queued", "running")
    wait_until(lambda: client.get(path).json()["done"] > answer.json()["done"], "it goes on")
    client.post(f"{path}/cancel").raise_for_status()
