"""Links outlive the database's schema and the core that computed what they open."""

import json
from typing import Any

import httpx
import numpy as np
import pytest

from backend import pins
from backend.links.models import Link
from sim_core import __version__
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario
from sim_core.simulate import simulate
from tests.data.links import dump
from tests.faults.conftest import OLD, PAGE, Process


@pytest.fixture(scope="module", params=OLD, ids=lambda content: f"schema-{content['runs'][0]['schema_version']}")
def old(request: pytest.FixtureRequest) -> dict[str, Any]:
    """What the database held when that schema version was today's."""
    content: dict[str, Any] = request.param
    return content


@pytest.fixture(scope="module")
def client(service: Process) -> httpx.Client:
    return service.client


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
        scenario = Scenario.model_validate(client.get(f"/api/v1/runs/{run['id']}").json()["scenario"])
        now, then = (each["body_acceleration"] for each in (simulate(scenario, result["strategy"]).series, series))
        differ = len(now) != len(then) or not np.allclose(now, then, rtol=1e-3)
        assert differ, "today's core computes otherwise, or this shows nothing"
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
