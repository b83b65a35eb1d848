"""Batches over HTTP: what is accepted, planned, computed and read; what every kind of job does is in test_job_kinds."""

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
from tests.servers.batches import rows, wait_for
from tests.servers.process import wait_until

BASE = {"road": {"length": 125, "bump": {"start": 88}}}  # nobody else's, so that nothing is stored yet
HEIGHTS = [0.04, 0.06, 0.08]
PEAK = "bump.body_acceleration.peak"
# A tenth of a second of one core each, so that a batch of them is still running when it is looked at.
LONG = {
    "road": {"length": 10.7, "bump": {"start": 4}},
    "mpc": {"solver": "osqp", "force_limit": 500, "prediction_horizon": 15, "control_horizon": 10},
}


def submit(client: httpx.Client, sweep: dict[str, Any], **more: Any) -> httpx.Response:
    body = {"scenario": BASE, "strategies": ["lv", "passive"], "sweep": sweep, **more}
    return client.post("/api/v1/batches", json=body)


def listed(client: httpx.Client) -> list[str]:
    return [batch["id"] for batch in client.get("/api/v1/batches", params={"limit": 500}).json()["batches"]]


@pytest.fixture(scope="module")
def batch(client: httpx.Client) -> dict[str, Any]:
    """A finished grid of three heights and two previews under two strategies."""
    answer = submit(client, {"grid": {"road.bump.height": HEIGHTS, "mpc.preview": ["lookahead", "none"]}})
    assert answer.status_code == 202, answer.text
    unplanned = {"state": "planning", "total": None, "fields": None, "estimated_cost": None}
    assert {name: answer.json()[name] for name in unplanned} == unplanned
    finished: dict[str, Any] = wait_for(client, answer.json()["id"])
    return finished


def test_every_combination_runs_once_in_order_and_is_what_the_core_computes(
    client: httpx.Client, batch: dict[str, Any]
) -> None:
    assert (batch["state"], batch["done"], batch["failed"], batch["total"]) == ("done", 12, 0, 12)
    runs = rows(client, batch["id"])
    combinations = itertools.product(HEIGHTS, ["lookahead", "none"], ["lv", "passive"])
    assert [(row["road.bump.height"], row["mpc.preview"], row["strategy"]) for row in runs] == list(combinations)
    assert [row["run"] for row in runs] == list(range(12))
    road = {**BASE["road"], "bump": {"start": 88, "height": 0.06}}
    scenario = Scenario.model_validate({"road": road, "mpc": {"preview": "none"}})
    expected = json.loads(json.dumps(simulate(scenario, "lv").summary(), default=dict))
    for name in ("metrics", "comfort", "travel_time", "arrival_speed_kmh"):
        # Another process, the same arithmetic: only the blocks a law is computed in may differ in their last bits.
        assert _flat(runs[6][name]) == pytest.approx(_flat(expected[name]), rel=1e-9), name


def _flat(value: Any, name: str = "") -> dict[str, float]:
    if isinstance(value, dict):
        return {key: item for inner, part in value.items() for key, item in _flat(part, f"{name}.{inner}").items()}
    return {name: value}


def test_json_its_pages_csv_and_columns_hold_the_same_numbers_with_units(
    client: httpx.Client, batch: dict[str, Any]
) -> None:
    path = f"/api/v1/batches/{batch['id']}"
    plain = client.get(f"{path}/results").json()
    assert plain["units"][PEAK] == "m/s^2"
    assert plain["sweep"] == client.get(f"{path}/sweep").json()
    assert plain["scenario"] == batch["scenario"]
    pages = list[list[Any]]()
    cursor: int | None = 0
    while cursor is not None:
        page = client.get(f"{path}/results", params={"limit": 5, "cursor": cursor}).json()
        pages.append(page["rows"])
        cursor = page["next"]
    assert [len(page) for page in pages] == [5, 5, 2]
    assert list(itertools.chain(*pages)) == plain["rows"]

    text = client.get(f"{path}/results", params={"format": "csv"})
    assert text.headers["content-type"] == "text/csv; charset=utf-8; header=present"
    assert f'filename="ridelab-batch-{batch["id"]}.csv"' in text.headers["content-disposition"]
    part = client.get(f"{path}/results", headers={"Accept": "text/csv"}, params={"limit": 2, "cursor": 10})
    whole = text.text.splitlines()
    assert part.text.splitlines() == [whole[0], *whole[11:]]
    columns = client.get(f"{path}/table", params={"figures": f"{PEAK},travel_time"}).json()
    assert columns["units"] == {"road.bump.height": "m", "mpc.preview": "1", PEAK: "m/s^2", "travel_time": "s"}
    for number, (row, line) in enumerate(zip(plain["rows"], csv.DictReader(io.StringIO(text.text)), strict=True)):
        peak = row["metrics"]["bump"]["body_acceleration"]["peak"]
        assert float(line[f"{PEAK} [m/s^2]"]) == columns["columns"][PEAK][number] == peak
        assert float(line["road.bump.height [m]"]) == row["road.bump.height"]
        assert columns["columns"]["travel_time"][number] == row["travel_time"]
        kept = ("mpc.preview [1]", "status", "core_version", "batch")
        assert [line[name] for name in kept] == [row["mpc.preview"], "ok", row["core_version"], batch["id"]]
    assert client.get(f"{path}/table", params={"figures": "no.such"}).status_code == 422


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
    text = client.get(f"/api/v1/batches/{batch['id']}/results", params={"format": "csv"}).text
    lines = list(csv.DictReader(io.StringIO(text)))
    assert (lines[1]["reason"], lines[1]["travel_time [s]"]) == (runs[1]["reason"], "")


def test_what_planning_finds_ends_the_batch_with_the_problem_of_a_dry_run(client: httpx.Client) -> None:
    """Also of a list too long to be looked at when it is sent."""
    sweep = {"list": [{"road.bump.height": 7 if index == 1500 else 0.1} for index in range(2000)]}
    refused = submit(client, sweep, dry_run=True)
    assert [error["pointer"] for error in refused.json()["errors"]] == ["/sweep/list/1500/road.bump.height"]
    batch = wait_for(client, submit(client, sweep).json()["id"])
    assert (batch["state"], batch["reason"]) == ("failed", refused.json()["detail"])
    assert batch["problem"] | {"request_id": ""} == refused.json() | {"request_id": ""}
    assert (batch["total"], batch["fields"], batch["resumable"]) == (None, None, True)
    assert rows(client, batch["id"]) == []
    client.post(f"/api/v1/batches/{batch['id']}/resume").raise_for_status()
    assert wait_for(client, batch["id"])["problem"] == batch["problem"], "it was planned again"


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
    assert [(row[initial], row[target]) for row in runs] == [(20, 20), (20, 20), (30.5, 30.5), (30.5, 30.5)]
    assert runs[0]["arrival_speed_kmh"] == pytest.approx(20, abs=0.5)


def test_a_small_batch_does_not_wait_for_a_large_one_whose_rows_stay_when_it_is_cancelled(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`position` counts the runs before it."""
    monkeypatch.setattr(dispatch, "CHUNK_BUDGET", 0.5)
    large = submit(client, {"grid": {"road.seed": list(range(1, 41))}}, scenario=LONG, strategies=["passive", "lv"])
    path = f"/api/v1/batches/{large.json()['id']}"
    wait_until(lambda: client.get(path).json()["done"], "the first runs are done")
    small = submit(client, {"grid": {"road.bump.height": [0.0311]}}).json()
    assert 0 < small["position"] < 80
    assert wait_for(client, small["id"])["done"] == 2
    running = client.get(path).json()
    assert (running["state"], running["position"]) == ("running", 0)
    assert running["done"] < 60, "it was far from its end"
    head = client.head(f"{path}/events")
    assert (head.status_code, head.headers["content-type"]) == (200, "text/event-stream; charset=utf-8")
    done = client.post(f"{path}/cancel").json()["done"]
    statuses = [row["status"] for row in rows(client, large.json()["id"])]
    assert statuses.count("ok") == done >= 1
    assert statuses.count("cancelled") == 80 - done
