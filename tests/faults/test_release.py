"""A database of core 0.2.0 opens with all it has, and jobs that its service was killed in are finished."""

import io
import json
from typing import Any

import httpx
import numpy as np
import pytest
from pyarrow import parquet

from backend.runs.links.models import Link
from sim_core import __version__
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from tests.api.streams import events_of, read_events
from tests.data import release
from tests.faults.conftest import Process

TABLES: dict[str, list[dict[str, Any]]] = release.content()["tables"]
ANSWERS: dict[str, Any] = release.content()["answers"]
RECOMPUTED = {"current_core_version", "nominal", "stability"}  # a summary's are computed when it is asked for


@pytest.fixture(scope="module")
def client(service: Process) -> httpx.Client:
    return service.client


def unfinished(table: str) -> dict[str, Any]:
    """The user's job that the service was killed in."""
    (job,) = (row for row in TABLES[table] if row["state"] == "running" and " " not in (row["idempotency_key"] or ""))
    return job


def differences(before: Any, now: Any, path: str = "") -> list[str]:
    """Where `now` has another value than `before`, members of today's core apart; it may have new ones."""
    if isinstance(before, dict) and isinstance(now, dict):
        each = [(name, before[name], now.get(name)) for name in before.keys() - RECOMPUTED]
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        each = [(str(index), *pair) for index, pair in enumerate(zip(before, now, strict=True))]
    else:
        return [] if before == now else [f"{path}: {before!r} is {now!r}"]
    return [difference for name, *pair in each for difference in differences(*pair, f"{path}/{name}")]


@pytest.mark.parametrize("path", ANSWERS)
def test_everything_is_answered_as_before(client: httpx.Client, path: str) -> None:
    if path.endswith("/events"):
        before, now = events_of(ANSWERS[path]), read_events(client, f"/api/v1{path}")
    else:
        before, now = ANSWERS[path], client.get(f"/api/v1{path}").raise_for_status().json()
    assert not differences(before, now)


def test_a_summary_says_which_core_computes_its_nominal_values(client: httpx.Client) -> None:
    (path,) = (path for path in ANSWERS if path.partition("?")[0].endswith("/summary"))
    assert client.get(f"/api/v1{path}").json()["core_version"] == __version__
    assert client.get(f"/api/v1{path.rpartition('/')[0]}").json()["core_version"] == "0.2.0"


def test_time_histories_are_those_that_were_pinned(client: httpx.Client) -> None:
    pinned = {row["result_key"]: row["content"] for row in TABLES["pinned_series"]}
    strategies = {row["key"]: row["strategy"] for row in TABLES["results"] if row["key"] in pinned}
    first = {row["result_key"]: row["run_id"] for row in reversed(TABLES["run_results"])}
    assert sorted(strategies.values()) == ["lqr", "lv", "passive"]
    for key, strategy in strategies.items():
        path = f"/api/v1/runs/{first[key]}/series?strategy={strategy}"
        series = client.get(path).raise_for_status().json()["series"]
        then = parquet.read_table(io.BytesIO(release.bytes_of(pinned[key]))).to_pydict()
        for signal, values in then.items():
            np.testing.assert_array_equal(np.array(series[signal], dtype=np.float32), np.array(values, np.float32))
        fewer = client.get(f"{path}&points=100").json()["series"]
        assert set(fewer["body_acceleration"]) < set(series["body_acceleration"])
        now = simulate(Scenario.model_validate(release.SCENARIO), strategy).series["body_acceleration"]
        differ = len(now) != len(then["time"]) or not np.allclose(now, then["body_acceleration"], rtol=1e-5)
        assert differ, "today's core computes otherwise, or this shows nothing"
        header = client.get(f"{path}&format=csv").text.splitlines()[0]
        assert header.startswith(f"time [{SIGNALS['time'].unit}]")
        assert client.get(f"/api/v1/runs/{first[key]}/figures/speed").json()["data"]


def test_a_run_can_be_run_again_on_the_current_core(client: httpx.Client) -> None:
    old = client.get(f"/api/v1/runs/{TABLES['runs'][0]['id']}").json()
    again = client.post("/api/v1/runs", json={"scenario": old["scenario"], "strategies": ["lv"]}).json()
    assert again["core_version"] == __version__
    assert again["id"] != old["id"]
    assert again["strategies"]["lv"]["metrics"] != old["strategies"]["lv"]["metrics"]


def test_a_link_has_the_scenario_in_the_current_schema(client: httpx.Client) -> None:
    for stored in TABLES["links"]:
        answer = client.get(f"/api/v1/links/{stored['slug']}")
        Link.model_validate_json(answer.content)
        link = answer.json()
        assert (link["schema_version"], link["current_core_version"]) == (1, __version__)
        assert Scenario.model_validate(link["scenario"]).model_dump(mode="json") == link["scenario"]
        assert (link["run"] or link["batch"])["scenario"] == link["scenario"]


def test_a_links_page_tells_what_it_opens(client: httpx.Client) -> None:
    page = client.get(f"/s/{TABLES['links'][0]['slug']}")
    assert page.status_code == 200
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert page.headers["cache-control"] == "no-cache"
    assert page.headers["x-robots-tag"] == "noindex"
    assert "script-src 'self'" in page.headers["content-security-policy"]
    assert "Ridelab core 0.2.0, 2026-11-22" in page.text
    assert 'property="og:title" content="LV control against passive: ' in page.text


def test_an_unfinished_batch_is_finished(client: httpx.Client) -> None:
    job = unfinished("batches")
    events = read_events(client, f"/api/v1/batches/{job['id']}/events")
    assert [event["id"] for event in events] == list(range(1, len(events) + 1))
    assert (events[-1]["state"], events[-1]["done"], events[-1]["failed"]) == ("done", job["total"], 0)
    rows = client.get(f"/api/v1/batches/{job['id']}/results").json()["rows"]
    done = {
        row["position"]: row["result_key"]
        for row in TABLES["batch_runs"]
        if row["batch_id"] == job["id"] and row["status"] == "ok"
    }
    summaries = {row["key"]: json.loads(row["summary"]) for row in TABLES["results"]}
    assert 0 < len(done) < job["total"] == len(rows)
    for row in rows:
        assert (row["status"], row["road.seed"]) == ("ok", 100 + row["run"])
        assert row["core_version"] == ("0.2.0" if row["run"] in done else __version__)
        if row["run"] in done:
            assert row["metrics"] == summaries[done[row["run"]]]["metrics"]


def test_an_unfinished_tuning_goes_on_to_its_end(client: httpx.Client) -> None:
    """Its numbers are not mixed with those of today's core: it begins again."""
    job = unfinished("tunings")
    events = read_events(client, f"/api/v1/tunings/{job['id']}/events")
    before = [row for row in TABLES["tuning_events"] if row["tuning_id"] == job["id"]]
    assert [event["event"] for event in events[: len(before) + 1]] == [*(row["kind"] for row in before), "restart"]
    tuning = client.get(f"/api/v1/tunings/{job['id']}").json()
    assert (tuning["state"], tuning["core_version"], tuning["trials"]["done"]) == ("done", __version__, job["total"])
    assert [each["trials"] for each in tuning["history"]] == [10, 20, 24]
    assert tuning["comparison"]["points"]


def test_what_tunings_submitted_is_not_listed(client: httpx.Client) -> None:
    keys = {row["id"]: row["idempotency_key"] or "" for row in TABLES["batches"]}
    listed = {each["id"] for each in client.get("/api/v1/batches?limit=500").json()["batches"]}
    assert listed & keys.keys() == {job_id for job_id, key in keys.items() if " " not in key}
    tunings = {each["id"] for each in client.get("/api/v1/tunings?limit=500").json()["tunings"]}
    assert tunings >= {row["id"] for row in TABLES["tunings"]}
