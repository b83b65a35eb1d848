"""Links outlive the process that made them, the database's schema and the core that computed what they open."""

import json
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

from backend import pins
from backend.links.models import Link
from backend.store import Store
from sim_core import __version__
from sim_core.scenario import Scenario
from sim_core.signals import SIGNALS
from sim_core.simulation import simulate
from tests.data.links import dump
from tests.faults.conftest import Process, Start, starter

FIXTURES = sorted(Path(dump.__file__).parent.glob("schema-*.json"))
PAGE = '<!doctype html><html><head><meta charset="utf-8"><title>Ridelab</title></head><body></body></html>'
SCENARIO = {"road": {"length": 60, "bump": {"start": 30}}}


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A built frontend, as far as the service cares."""
    folder = tmp_path_factory.mktemp("dist")
    (folder / "index.html").write_text(PAGE)
    return str(folder)


def link_to(service: Process, run_id: str, **view: Any) -> str:
    answer = service.client.post("/api/v1/links", json={"run_id": run_id, "view": view})
    assert answer.status_code == 201, answer.text
    slug: str = answer.json()["slug"]
    return slug


def test_a_link_survives_a_kill_right_after_its_answer(start: Start, built: str, tmp_path: Path) -> None:
    service = start(RIDELAB_WORKERS="1", RIDELAB_FRONTEND_DIR=built)
    run = service.client.post("/api/v1/runs", json={"scenario": SCENARIO, "strategies": ["lv", "passive"]}).json()
    query = f"/api/v1/runs/{run['id']}/series?strategy=lv,passive&encoding=base64"
    series = service.client.get(query).content
    slug = link_to(service, run["id"], zoom=[1, 2], baseline="passive")
    service.kill()
    with sqlite3.connect(tmp_path / "data" / "ridelab.sqlite") as connection:
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    connection.close()
    again = start(RIDELAB_WORKERS="1", RIDELAB_FRONTEND_DIR=built)
    link = again.client.get(f"/api/v1/links/{slug}").json()
    assert link["series_pinned"] is True
    assert link["view"] == {"zoom": [1, 2], "baseline": "passive"}
    assert link["run"]["strategies"]["lv"]["metrics"] == run["strategies"]["lv"]["metrics"]
    assert again.client.get(query).content == series
    assert "LV control against passive" in again.client.get(f"/s/{slug}").text


@pytest.fixture(scope="module", params=FIXTURES, ids=lambda path: path.stem)
def old(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a database held when that schema version was today's, put into a database of its time."""
    content: dict[str, Any] = json.loads(request.param.read_text())
    content["folder"] = tmp_path_factory.mktemp(request.param.stem)
    (content["folder"] / "data").mkdir()
    store = Store(f"sqlite:///{content['folder']}/data/ridelab.sqlite")
    store.migrate(content["revision"])
    dump.load(store, content)
    store.close()
    return content


@pytest.fixture(scope="module")
def client(old: dict[str, Any], built: str) -> Iterator[httpx.Client]:
    """Today's service on that database."""
    for start_one in starter(old["folder"]):
        yield start_one(RIDELAB_WORKERS="1", RIDELAB_FRONTEND_DIR=built).client


def test_a_link_of_an_older_version_opens_with_its_numbers(client: httpx.Client, old: dict[str, Any]) -> None:
    for stored in old["links"]:
        answer = client.get(f"/api/v1/links/{stored['slug']}")
        assert answer.status_code == 200, answer.text
        Link.model_validate_json(answer.content)
        link = answer.json()
        assert link["view"] == json.loads(stored["view"])
        assert link["schema_version"] == old["runs"][0]["schema_version"]
        assert (link["core_version"], link["current_core_version"]) == (dump.CORE_VERSION, __version__)
        assert link["created_at"].startswith("2026-11-21T12:00:00")
        assert link["series_pinned"] is True
        for result in old["results"]:
            found = dict(link["run"]["strategies"][result["strategy"]])
            assert (found.pop("status"), found.pop("compute_ms")) == (result["status"], result["compute_ms"])
            assert found == json.loads(result["summary"])
        assert Scenario.model_validate(link["scenario"]).model_dump(mode="json") == link["scenario"]
        assert link["run"]["scenario"] == link["scenario"]


def test_its_time_histories_are_those_that_were_pinned(client: httpx.Client, old: dict[str, Any]) -> None:
    (run,) = old["runs"]
    kept = {row["result_key"]: row["content"] for row in old["pinned_series"]}
    for result in old["results"]:
        query = f"/api/v1/runs/{run['id']}/series?strategy={result['strategy']}"
        series = client.get(query).json()["series"]
        pinned = pins.read(dump.bytes_of(kept[result["key"]]))
        for signal in pinned:
            np.testing.assert_array_equal(np.array(series[signal], dtype=np.float32), pinned[signal])
        fewer = client.get(f"{query}&points=100").json()["series"]
        assert set(fewer["body_acceleration"]) < set(series["body_acceleration"])
        today = simulate(
            Scenario.model_validate(client.get(f"/api/v1/runs/{run['id']}").json()["scenario"]), result["strategy"]
        )
        assert not np.allclose(today.series["body_acceleration"], series["body_acceleration"], rtol=1e-3), (
            "today's core computes otherwise, or this shows nothing"
        )
    header = client.get(f"/api/v1/runs/{run['id']}/series?strategy=lv&format=csv").text.splitlines()[0]
    assert header.startswith(f"time [{SIGNALS['time'].unit}]")
    assert client.get(f"/api/v1/runs/{run['id']}/figures/speed").json()["data"]


def test_it_can_be_run_again_on_todays_core(client: httpx.Client, old: dict[str, Any]) -> None:
    link = client.get(f"/api/v1/links/{old['links'][0]['slug']}").json()
    again = client.post("/api/v1/runs", json={"scenario": link["scenario"], "strategies": ["lv"]}).json()
    assert again["core_version"] == __version__
    assert again["id"] != link["run"]["id"]
    assert again["strategies"]["lv"]["metrics"] != link["run"]["strategies"]["lv"]["metrics"]


def test_its_page_tells_what_it_opens(client: httpx.Client, old: dict[str, Any]) -> None:
    page = client.get(f"/s/{old['links'][0]['slug']}")
    assert page.status_code == 200
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert page.headers["cache-control"] == "no-cache"
    assert page.headers["x-robots-tag"] == "noindex"
    assert "script-src 'self'" in page.headers["content-security-policy"]
    assert f"Ridelab core {dump.CORE_VERSION}, 2026-11-21" in page.text
    assert 'property="og:title" content="LV control against passive: ' in page.text


@pytest.mark.parametrize("slug", ["AAAAAAAAAAAAAAAAAAAAAA", "short", "%00", "%3Cscript%3E", "a" * 500, "..%2f..%2fetc"])
def test_a_slug_that_opens_nothing_is_a_page_too(client: httpx.Client, slug: str) -> None:
    page = client.get(f"/s/{slug}")
    assert page.status_code == 404
    if "%2f" not in slug:
        assert page.headers["content-type"] == "text/html; charset=utf-8"
        assert "<title>There is no such link · Ridelab</title>" in page.text
    assert "script>" not in page.text


def test_batches_have_a_page(client: httpx.Client) -> None:
    page = client.get("/b/AAAAAAAAAAAAAAAAAAAAAA")
    assert (page.status_code, page.text) == (200, PAGE)
    assert client.get("/b").status_code == 404
