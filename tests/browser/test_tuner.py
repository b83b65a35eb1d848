"""Tunings: put together, estimated, started, followed, cancelled, resumed, looked at, loaded into the lab."""

import re
from typing import Any

import pytest
from playwright.sync_api import Page

from tests.browser.dashboard import Dashboard, expect
from tests.browser.server import Server

SHORT = {"road": {"length": 95, "bump": {"start": 70}}, "speed": {"detection_distance": 50}}


def submit(server: Server, **wish: Any) -> str:
    """A tuning of the LQR on a short road, which is quick, as a script begins it; its id."""
    body = {"scenario": SHORT, "strategy": "lqr", "seeds": [1], "fresh_seeds": [101, 102], "population": 4, **wish}
    return str(server.post("/tunings", body)["id"])


def stored(server: Server, tuning: str) -> Any:
    return server.get(f"/tunings/{tuning}")


def expect_state(page: Page, text: str) -> None:
    expect(page.get_by_test_id("tuning-state")).to_have_text(text)


def test_a_tuning_from_the_lab_and_back(dashboard: Dashboard, server: Server) -> None:
    dashboard.open()
    page = dashboard.page
    dashboard.edit("Width", "3")
    run = dashboard.run_id
    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Tuner").click()
    expect(page).to_have_url(re.compile(rf"/tuner\?run={run}$"))
    expect(page.get_by_text("Other than the paper: Bump width 3\u00a0m.")).to_be_visible()

    page.get_by_role("radiogroup", name="Strategy").get_by_text("LQR").click()
    page.get_by_role("textbox", name="Training roads").fill("1")
    page.get_by_role("textbox", name="Validation roads").fill("101-102")
    page.get_by_role("textbox", name="Trials").fill("12")
    page.get_by_role("textbox", name="Population size").fill("6")
    pages = page.get_by_role("navigation", name="Pages")
    pages.get_by_role("link", name="Lab").click()
    pages.get_by_role("link", name="Tuner").click()
    expect(page.get_by_role("textbox", name="Trials")).to_have_value("12")
    expect(page.get_by_test_id("estimate")).to_contain_text("runs in 2 generations")
    page.get_by_role("button", name="Start").click()

    expect(page).to_have_url(re.compile(r"/tuner/[\w-]{22}$"))
    expect_state(page, "Done")
    expect(page.get_by_test_id("tuning-counts")).to_have_text("12 of 12 trials")
    tuning = stored(server, page.url.split("/")[-1])
    assert tuning["scenario"]["road"]["bump"]["width"] == 3
    assert tuning["trials"]["total"] == 12
    best, paper = tuning["best"][0], tuning["paper"]
    expect(page.get_by_role("region", name="History").locator(".scatterlayer .point").first).to_be_visible()
    shown = page.get_by_role("region", name="Best points", exact=True).locator("td[data-cell='objectives.0']")
    values = shown.evaluate_all("cells => cells.map(cell => Number(cell.dataset.value))")
    assert values == [paper["values"][0], best["values"][0]]
    assert values[1] <= values[0]  # the paper's weights are a trial themselves

    fresh = page.get_by_role("region", name="Validation roads", exact=True).locator("tr[data-figure='objectives.0'] td")
    compared = tuning["comparison"]["points"]
    expected = [point[roads]["objectives.0"]["mean"] for point in compared for roads in ("training", "fresh")]
    assert fresh.evaluate_all("cells => cells.map(cell => Number(cell.dataset.value))") == expected

    page.get_by_role("button", name=re.compile("^Load in lab: .*Best")).click()
    dashboard.expect_curves()
    scenario = dashboard.stored_run()["scenario"]
    assert scenario["lqr"]["weights"] == best["weights"]["lqr.weights"]
    assert scenario["road"]["bump"]["width"] == 3


@pytest.mark.thorough
def test_a_front_is_looked_at_point_by_point(dashboard: Dashboard, server: Server) -> None:
    page = dashboard.page
    objectives = [{"kind": "paper"}, {"kind": "peaks"}]
    limits = [{"figure": "events.travel_exceeded_mm", "at_most": 1000}]
    tuning = submit(server, scenario={}, objectives=objectives, limits=limits, trials=16, population=8)
    page.goto(f"/tuner/{tuning}")
    expect_state(page, "Done")
    points = stored(server, tuning)["front"]
    plot = page.get_by_role("region", name="Pareto front")
    expect(plot).to_have_attribute("data-front", str(len(points)))
    selected = page.get_by_role("region", name="Selected point")
    selected.get_by_label("Weights of trial").select_option(str(points[0]["number"]))
    weights = selected.locator("td[data-weights='lqr.weights']").evaluate("cell => cell.firstChild.textContent")
    assert [float(weight) for weight in weights.split(" · ")] == pytest.approx(points[0]["weights"]["lqr.weights"])
    place, other = max(enumerate(sorted(points, key=lambda trial: trial["values"][0])))
    drawn = plot.locator(".scatterlayer .trace").filter(has=page.locator(".point"))
    front = drawn.nth(drawn.count() - 3).locator(".point")  # then the named points, and the ring
    expect(front).to_have_count(len(points))
    front.nth(place).click(force=True)
    expect(selected).to_have_attribute("data-trial", str(other["number"]))
    dashboard.expect_accessible()
    dashboard.expect_no_wider(400)
