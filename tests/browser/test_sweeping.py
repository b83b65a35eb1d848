"""Sweeps: put together in the dialog, estimated, started, followed, looked at, exported, shared, opened run by run."""

import csv
import re

import pytest
from playwright.sync_api import Locator, Page, Route

from tests.browser.dashboard import Dashboard, expect
from tests.browser.server import Server
from tests.browser.test_sharing import share


def open_dialog(page: Page) -> Locator:
    page.get_by_role("button", name="Sweep…").click()
    return page.get_by_role("dialog", name="Sweep")


def add_field(dialog: Locator, search: str, title: str) -> None:
    """Finds a field by what somebody would type, and takes it."""
    dialog.get_by_role("combobox", name="Add a field").fill(search)
    dialog.page.get_by_role("listbox").get_by_role("option", name=title).click()


def fill(dialog: Locator, **texts: str) -> None:
    for label, text in texts.items():
        dialog.get_by_label(label.replace("__", ", ").replace("_", " "), exact=True).fill(text)


def expect_done(page: Page) -> None:
    expect(page.get_by_test_id("batch-state")).to_have_text("Done")


def test_a_sweep_from_the_dialog_to_its_file(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    dashboard.edit("Width", "3")
    dialog = open_dialog(page)
    fill(dialog, Height__from="5", Height__to="150 mm", Height__number_of_values="3")
    add_field(dialog, "target_speed", "Target speed")
    dialog.get_by_role("radiogroup", name="Target speed: values by").get_by_text("List").click()
    fill(dialog, Target_speed__values="15, 25")
    dialog.get_by_role("checkbox", name="LQR").uncheck()
    expect(dialog.get_by_test_id("estimate")).to_contain_text("12 runs (6 points × 2 strategies), about ")
    dialog.get_by_role("button", name="Start").click()

    expect(page).to_have_title("Sweep of Height × Target speed · Ridelab")
    expect_done(page)
    expect(page.get_by_test_id("batch-counts")).to_have_text("12 of 12 runs finished")
    expect(page.get_by_text("Other than the paper: Bump width 3\u00a0m.")).to_be_visible()
    expect(page.locator("tbody tr[data-status=ok]")).to_have_count(12)
    note = page.get_by_test_id("map-note")
    expect(note).to_contain_text("LV control is at or below Passive at 6 of 6 points.")
    fill(page.locator("main"), Line_at="−80 %")
    expect(note).to_contain_text(re.compile(r"At or below −80\s%? at [1-5] of 6 points"))
    expect(page.locator(".contourlayer .contourlevel, .contourlayer .contourlines path").first).to_be_attached()
    page.get_by_label("Change against", exact=True).select_option("none")
    fill(page.locator("main"), Line_at="0.9")
    expect(page).to_have_url(re.compile(r"\?against=none&at=0\.9$"))
    page.reload()
    expect(page.get_by_label("Line at")).to_have_value("0.9")

    page.get_by_role("button", name="New sweep").click()
    expect(dialog.get_by_role("checkbox", name="LQR")).not_to_be_checked()
    dialog.get_by_role("button", name="Cancel").click()
    page.get_by_role("radiogroup", name="Plot").get_by_text("Trade-off").click()
    expect(page.get_by_text(re.compile(r"Pareto front: \d+ runs? that no other betters"))).to_be_visible()

    table = list(csv.DictReader(dashboard.exported("CSV").path().read_text().splitlines()))
    assert {(row["road.bump.height [m]"], row["speed.target_speed_kmh [km/h]"], row["strategy"]) for row in table} == {
        (height, speed, strategy)
        for height in ("0.05", "0.1", "0.15")
        for speed in ("15", "25")
        for strategy in ("lv", "passive")
    }


@pytest.mark.thorough
def test_the_dialog_says_what_cannot_be_run_and_starts_what_can_once(dashboard: Dashboard) -> None:
    """An answer that is lost and asked for again is not a second batch."""
    dashboard.open()
    page = dashboard.page
    dialog = open_dialog(page)
    start, estimate = dialog.get_by_role("button", name="Start"), dialog.get_by_test_id("estimate")
    fill(dialog, Height__to="3 m")
    expect(dialog.get_by_role("group", name="Height").get_by_role("alert")).to_contain_text("from −100 to 100\u00a0cm")
    dashboard.expect_accessible(dialog)
    expect(start).to_be_disabled()
    dialog.get_by_role("button", name="Remove Height").click()
    expect(estimate).to_contain_text("Add a field to sweep")
    add_field(dialog, "mpc.prediction_horizon", "Prediction horizon")
    # Below the control horizon, which is contradictory.
    fill(dialog, Prediction_horizon__from="10", Prediction_horizon__to="30", Prediction_horizon__number_of_values="2")
    expect(estimate).to_contain_text("values contradict each other")
    dialog.get_by_text("Latin hypercube").click()
    fill(dialog, Samples="900000")  # allowed by the field, not by the server
    expect(dialog.get_by_role("alert")).to_contain_text("over the limit")
    expect(start).to_be_disabled()
    fill(dialog, Prediction_horizon__from="20", Samples="7")
    expect(estimate).to_contain_text("21 runs")
    keys: list[str | None] = []

    def lose_the_first(route: Route) -> None:
        if "dry_run" in (route.request.post_data or ""):
            route.continue_()
            return
        keys.append(route.request.headers.get("idempotency-key"))
        answer = route.fetch()
        if len(keys) == 1:
            route.abort()
        else:
            route.fulfill(response=answer)

    page.route("**/api/v1/batches", lose_the_first)
    start.click()
    expect(dialog.get_by_role("alert")).to_contain_text("does not answer")
    start.click()
    expect_done(page)
    assert keys[0] is not None
    assert keys == [keys[0], keys[0]]
    expect(page.get_by_test_id("batch-results")).to_have_attribute("data-rows", "21")


@pytest.mark.thorough
def test_a_row_opens_its_run_which_leads_back(dashboard: Dashboard, server: Server) -> None:
    """By a link of its own and by the browser's back; and the sweep's link to the lab leads to where the lab was."""
    dashboard.open()
    page, lab = dashboard.page, dashboard.address()
    points = [{"road.bump.height": 0.04}, {"road.bump.height": 0.08}, {"road.bump.start": 149.9}]
    sweep = server.submit({"list": points}, ["lv", "passive"])
    page.get_by_role("link", name="Sweeps").click()
    page.get_by_role("region", name="Sweeps").locator(f"a[href='{sweep}']").click()
    page.get_by_role("link", name="Lab", exact=True).click()
    expect(page).to_have_url(lab)
    page.go_back()
    expect_done(page)
    expect(page.get_by_test_id("batch-counts")).to_have_text("4 ok, 2 failed of 6 runs")
    rows = page.get_by_role("region", name="Rows")
    rows.get_by_label("Failed only").check()
    expect(rows.locator("tbody tr")).to_have_count(2)
    expect(rows.locator("tr[data-status=failed]").first).to_contain_text(re.compile(r"failed: .*road"))
    rows.get_by_label("Failed only").uncheck()
    page.get_by_role("button", name="Open run 3 in the dashboard").click()
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.08
    assert set(dashboard.stored_run()["strategies"]) == {"lv", "passive"}
    dashboard.edit("Width", "3")  # it is still of that sweep
    page.get_by_role("link", name="From sweep “Height").click()
    expect(page).to_have_url(re.compile(f"{sweep}$"))


@pytest.mark.thorough
def test_a_sweep_is_cancelled_resumed_named_and_deleted(dashboard: Dashboard, server: Server) -> None:
    """It is far longer than any click takes: nothing here waits for its end."""
    page = dashboard.page
    shown = server.submit({"grid": {"road.seed": list(range(1, 601))}}, ["lv_hil"])
    page.goto(shown)
    state = page.get_by_test_id("batch-state")
    page.get_by_role("button", name="Cancel").click()
    expect(state).to_have_text("Cancelled; finished runs are kept")
    page.get_by_role("button", name="Resume").click()
    expect(page.get_by_test_id("batch-counts")).to_have_text(re.compile(r"^[1-9]\d* of 600 runs finished"))
    page.get_by_role("button", name="Cancel").click()
    expect(state).to_have_text("Cancelled; finished runs are kept")
    entry = page.get_by_role("region", name="Sweeps").locator("li").filter(has=page.locator(f"a[href='{shown}']"))
    entry.get_by_role("button", name="Rename or delete").click()
    page.get_by_role("menuitem", name="Rename").click()
    entry.get_by_role("textbox", name="Name").fill("Low bump")
    entry.get_by_role("button", name="Save").click()
    expect(page.get_by_role("heading", name="Low bump")).to_be_visible()
    assert server.get(f"/batches/{shown.split('/')[-1]}")["label"] == "Low bump"
    dashboard.expect_no_wider(400)
    entry.get_by_role("button", name="Rename or delete").click()
    page.get_by_role("menuitem", name="Delete").click()
    entry.get_by_role("button", name="Delete", exact=True).click()
    expect(page.get_by_role("heading", name="There is no sweep at this address")).to_be_visible()


@pytest.mark.thorough
def test_a_point_says_where_it_is_and_whether_to_believe_it_and_a_shared_sweep_opens_with_its_plot(
    dashboard: Dashboard, server: Server
) -> None:
    page = dashboard.page
    path = server.submit({"grid": {"road.bump.height": [0.05, 0.1]}}, ["lv", "passive"])
    page.goto(path)
    expect_done(page)
    expect(page.locator(".scatterlayer .point")).to_have_count(5)  # each run, and the ring
    expect(page.locator(".scatterlayer .js-line")).to_have_count(2)  # a strategy each
    rows = server.get(f"/batches/{path.split('/')[-1]}/results?format=json")["rows"]
    airborne = [str(row["run"]) for row in rows if row["events"]["airborne_ms"] > 0]
    assert airborne
    marked = page.locator("tr[data-run]:has([data-caveat~=airborne_ms])")
    assert marked.evaluate_all("rows => rows.map(row => row.dataset.run)") == airborne
    dashboard.expect_accessible()
    page.locator(".scatterlayer .trace").nth(3).locator(".point").last.hover(force=True)
    expect(page.locator(".hoverlayer")).to_contain_text(re.compile(r"Passive.*Height 10\scm.*airborne"))

    page.get_by_role("combobox", name="Metric").fill("travel time")
    page.get_by_role("listbox").get_by_role("option", name="Travel time").click()
    passive = page.get_by_role("group", name="Strategies").get_by_role("button", name="Passive")
    passive.click()
    expect(page).to_have_url(re.compile(r"y=travel_time&hide=passive"))
    page.goto(share(page))
    expect(page.get_by_role("region", name="Shared result")).to_contain_text("Shared sweep, computed on")
    expect(page.get_by_role("combobox", name="Metric")).to_have_value("Travel time")
    expect(passive).to_have_attribute("aria-pressed", "false")
    expect(page.locator("tbody tr[data-status=ok]")).to_have_count(4)
