"""The standalone report of a run, as it is served."""

import base64
import hashlib
import json
import re
from dataclasses import replace
from typing import Any

import httpx
import plotly.graph_objects as go
import pytest

from backend.runs.figures import PANELS
from sim_core.catalogue import METRIC_SIGNALS
from tests.api.test_series import unpack
from tests.html import Element, check, read

CELL = "bump.body_acceleration.peak"
WINDOWS = {"rough_road": "rms", "bump": "peak"}
SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)


@pytest.fixture(scope="module")
def answer(client: httpx.Client, run: dict[str, Any]) -> httpx.Response:
    response = client.get(f"/api/v1/runs/{run['id']}/report.html")
    assert response.status_code == 200, response.text[:300]
    return response


@pytest.fixture(scope="module")
def page(answer: httpx.Response) -> Element:
    return read(answer.text)


def test_it_is_one_sound_page_that_loads_nothing(answer: httpx.Response, page: Element, run: dict[str, Any]) -> None:
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    assert answer.headers["content-disposition"] == f'inline; filename="ridelab-{run["id"]}.html"'
    check(page)
    assert all(word in next(page.all("header")).text for word in (run["id"], run["core_version"], " UTC"))
    own = SCRIPT.sub("", answer.text)
    assert str(answer.url.host) not in own, "where it was made stays there"
    assert not list(page.all("link"))
    assert len(answer.content) <= 1.5e6


def directives(policy: str) -> dict[str, str]:
    return dict(part.partition(" ")[::2] for part in policy.split("; "))


def test_its_policy_names_its_scripts_and_nothing_else(answer: httpx.Response, page: Element) -> None:
    policy = directives(answer.headers["content-security-policy"])
    hashes = {
        f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"
        for script in SCRIPT.findall(answer.text)
    }
    assert len(hashes) == 2
    assert set(policy["script-src"].split()) == hashes
    assert policy["default-src"] == policy["base-uri"] == policy["form-action"] == policy["frame-ancestors"] == "'none'"
    saved = directives(str(next(page.all("meta", http_equiv="Content-Security-Policy")).attributes["content"]))
    assert saved == {name: value for name, value in policy.items() if name != "frame-ancestors"}
    assert answer.headers["x-frame-options"] == "DENY"
    assert answer.headers["x-content-type-options"] == "nosniff"


def test_its_numbers_are_the_runs(client: httpx.Client, page: Element, run: dict[str, Any]) -> None:
    stored = client.get(f"/api/v1/runs/{run['id']}").json()["strategies"]
    shown = {
        (row.attributes["data-strategy"], cell.attributes["data-cell"]): float(str(cell.attributes["data-value"]))
        for row in page.all("tr")
        if "data-strategy" in row.attributes
        for cell in row.all("td")
    }
    assert shown == {
        (name, f"{window}.{signal}.{statistic}"): entry["metrics"][window][signal][statistic]
        for name, entry in stored.items()
        for window, statistic in WINDOWS.items()
        for signal in METRIC_SIGNALS
    }
    for name, entry in stored.items():
        for key, value in {**entry["comfort"], **entry["events"], "travel_time": entry["travel_time"]}.items():
            [cell] = page.all("td", data_cell=key, data_strategy=name)
            assert cell.attributes["data-value"] == ("" if value is None else str(value)), (name, key)


def changes(page: Element) -> dict[str | None, str]:
    """What stands in the cell of one metric, by strategy."""
    return {
        row.attributes["data-strategy"]: cell.text for row in page.all("tr") for cell in row.all("td", data_cell=CELL)
    }


def test_changes_refer_to_the_baseline_asked_for(client: httpx.Client, page: Element, run: dict[str, Any]) -> None:
    other = read(client.get(f"/api/v1/runs/{run['id']}/report.html", params={"baseline": "lv"}).text)
    against_passive, against_lv = changes(page), changes(other)
    peaks = {name: entry["metrics"]["bump"]["body_acceleration"]["peak"] for name, entry in run["strategies"].items()}
    against = f"{100 * (peaks['lv'] / peaks['passive'] - 1):.1f}".replace("-", "−")
    assert f"{against}\u2009%" in against_passive["lv"]
    assert "%" not in against_passive["passive"]
    assert f"+{100 * (peaks['passive'] / peaks['lv'] - 1):.0f}\u2009%" in against_lv["passive"]
    assert ("better" in against_passive["lv"], "worse" in against_lv["passive"]) == (True, True)


def test_changes_of_one_road_refer_to_another_run_strategy_by_strategy(
    client: httpx.Client, run: dict[str, Any]
) -> None:
    """A bump higher by 8 %: so do passive peaks grow, beyond what is random; LV's grow by less."""
    road = run["scenario"]["road"]
    higher = {**run["scenario"], "road": {**road, "bump": {**road["bump"], "height": 1.08 * road["bump"]["height"]}}}
    other = client.post("/api/v1/runs", json={"scenario": higher, "strategies": ["lv", "passive"]}).json()
    page = read(client.get(f"/api/v1/runs/{other['id']}/report.html", params={"against": run["id"]}).text)
    check(page)
    cells = changes(page)
    assert "worse" in cells["passive"]
    assert not {"worse", "better"} & set(cells["lv"].split())


def test_its_figures_are_the_runs(client: httpx.Client, page: Element, run: dict[str, Any]) -> None:
    figures = json.loads(next(page.all("script", id="figures")).text)
    assert list(figures) == list(PANELS) == [each.attributes["data-figure"] for each in page.all("div", role="img")]
    served = client.get(f"/api/v1/runs/{run['id']}/figures").json()["figures"]
    for name, figure in figures.items():
        go.Figure(figure)
        low, high = figure["layout"]["yaxis"]["range"]
        for trace, whole in zip(figure["data"], served[name]["data"], strict=True):
            few, values = points(trace), points(whole)
            assert set(few) <= set(values)
            assert len(few) <= 900
            heights = [y for _, y in few]
            assert (min(heights), max(heights)) == (min(y for _, y in values), max(y for _, y in values))
            assert low <= min(heights) <= max(heights) <= high


def points(trace: dict[str, Any]) -> list[tuple[float, float]]:
    x, y = (unpack(trace[letter]).tolist() for letter in "xy")
    return list(zip(x, y, strict=True))


def test_a_run_without_histories_keeps_its_tables(service: Any, run: dict[str, Any]) -> None:
    store = service.services.store
    stored = store.runs.load(run["id"])
    older = {item.strategy: [replace(item, key=f"older-{item.key}"[:43])] for item in stored.results}
    store.runs.save(replace(stored, id="report-of-an-older-one", core_version="0.0.2", by_strategy=older))
    answer = service.get("/api/v1/runs/report-of-an-older-one/report.html")
    assert answer.status_code == 200
    assert "script-src 'none'" in answer.headers["content-security-policy"]
    root = read(answer.text)
    assert "Core version 0.0.2" in root.text
    assert not list(root.all("script"))
    peak = run["strategies"]["lv"]["metrics"]["bump"]["body_acceleration"]["peak"]
    assert next(root.all("td", data_cell=CELL)).attributes["data-value"] == str(peak)
