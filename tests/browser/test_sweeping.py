"""Sweeps: put together in the dialog, estimated, started, followed, looked at, exported, shared, opened run by run."""

import csv
import re

import pytest
from playwright.sync_api import Locator, Page, Route

from tests.browser.dashboard import Dashboard, expect, expect_new_address
from tests.browser.server import Server
from tests.browser.test_sharing import share


def open_dialog(page: Page) -> Locator:
    page.get_by_role("button", name="Sweep…").click()
    dialog = page.get_by_role("dialog", name="Sweep")
    expect(dialog).to_be_visible()
    return dialog


def add_field(dialog: Locator, search: str, title: str) -> None:
    """Finds a field by what somebody would type, and takes it."""
    dialog.get_by_role("combobox", name="Add a field").fill(search)
    dialog.page.get_by_role("listbox").get_by_role("option", name=title).click()


def expect_done(page: Page) -> None:
    expect(page.get_by_test_id("batch-state")).to_have_text("Done")


def test_a_sweep_from_the_dialog_to_its_file(dashboard: Dashboard) -> None:
    dashboard.open()
    page, first = dashboard.page, dashboard.page.url
    dashboard.type_into("Width", "3")
    expect_new_address(page, first)
    dialog = open_dialog(page)
    dialog.get_by_label("Height, from", exact=True).fill("5")
    dialog.get_by_label("Height, to", exact=True).fill("150 mm")
    dialog.get_by_label("Height, number of values").fill("3")
    add_field(dialog, "target_speed", "Target speed")
    dialog.get_by_role("radiogroup", name="Target speed: values by").get_by_text("List").click()
    dialog.get_by_label("Target speed, values", exact=True).fill("15, 25")
    dialog.get_by_role("checkbox", name="LQR").uncheck()
    expect(dialog.get_by_text("Passive does not use target speed: its 6 runs give 3 results.")).to_be_visible()
    expect(dialog.get_by_test_id("estimate")).to_contain_text(
        re.compile(r"^12 runs \(6 points × 2 strategies\), about ")
    )
    dialog.get_by_role("button", name="Start").click()

    expect(page).to_have_url(re.compile("/b/"))
    expect(page).to_have_title("Sweep of Height × Target speed · Ridelab")
    expect_done(page)
    expect(page.get_by_test_id("batch-counts")).to_have_text("12 of 12 runs finished")
    expect(page.get_by_text("Other than the paper: Bump width 3\u00a0m.")).to_be_visible()
    expect(page.get_by_role("progressbar", name="Finished runs")).to_have_attribute("aria-valuenow", "100")
    expect(page.get_by_text("Passive does not use target speed: its 6 runs give 3 results.")).to_be_visible()
    expect(page.locator("tbody tr[data-status=ok]")).to_have_count(12)

    note = page.get_by_test_id("map-note")
    expect(note).to_contain_text("LV control is at or below Passive at 6 of 6 points.")
    page.get_by_label("Line at").fill("−80 %")
    expect(note).to_contain_text(re.compile(r"At or below −80\s%? at [1-5] of 6 points"))
    expect(page.locator(".contourlayer .contourlevel, .contourlayer .contourlines path").first).to_be_attached()
    page.get_by_label("Change against", exact=True).select_option("none")
    page.get_by_label("Line at").fill("0.9")
    expect(note).to_contain_text("At or below 0.9\u00a0m/s²")
    expect(page).to_have_url(re.compile(r"\?against=none&at=0\.9$"))
    page.reload()
    expect(page.get_by_label("Line at")).to_have_value("0.9")

    page.get_by_role("button", name="New sweep").click()
    expect(dialog.get_by_text(re.compile("variants of this sweep.s scenario"))).to_be_visible()
    expect(dialog.get_by_role("checkbox", name="LQR")).not_to_be_checked()
    dialog.get_by_role("button", name="Cancel").click()

    kinds = page.get_by_role("radiogroup", name="Plot")
    kinds.get_by_text("Trade-off").click()
    expect(page.get_by_text(re.compile(r"Pareto front: \d+ runs? that no other betters"))).to_be_visible()
    kinds.get_by_text("Curves").click()
    expect(page.locator(".infolayer .annotation").first).to_have_text(re.compile(r"^(15|25)\skm/h$"))
    expect(page.locator(".scatterlayer .point")).to_have_count(13)  # each run, and a ring around the lowest
    expect(page.get_by_role("region", name="Plot")).to_contain_text(
        re.compile(r"Lowest: [\d.]+\s?m/s², LV control at Height 5")
    )

    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="CSV").click()
    assert download.value.suggested_filename.endswith(".csv")
    table = list(csv.DictReader(download.value.path().read_text().splitlines()))
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
    expect(start).to_be_enabled()
    dialog.get_by_label("Height, to", exact=True).fill("3 m")
    row = dialog.get_by_role("group", name="Height")
    expect(row.get_by_role("alert")).to_have_text("To: must be from −100 to 100\u00a0cm")
    dashboard.expect_accessible(dialog)
    expect(start).to_be_disabled()
    dialog.get_by_role("button", name="Remove Height").click()
    expect(estimate).to_have_text("It cannot start: Add a field to sweep")

    add_field(dialog, "mpc.prediction_horizon", "Prediction horizon")  # below the control horizon: contradictory
    dialog.get_by_label("Prediction horizon, from", exact=True).fill("10")
    dialog.get_by_label("Prediction horizon, to", exact=True).fill("30")
    dialog.get_by_label("Prediction horizon, number of values").fill("2")
    expect(estimate).to_contain_text("values contradict each other")

    dialog.get_by_text("Latin hypercube").click()
    dialog.get_by_label("Samples").fill("900000")  # allowed by the field, not by the server
    expect(dialog.get_by_role("alert")).to_contain_text("over the limit")
    expect(start).to_be_disabled()

    dialog.get_by_label("Prediction horizon, from", exact=True).fill("20")
    dialog.get_by_label("Samples").fill("7")
    dialog.get_by_role("textbox", name="Seed").fill("3")
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
    expect(page).to_have_url(re.compile("/b/"))
    assert keys[0] is not None
    assert keys == [keys[0], keys[0]]
    expect_done(page)
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
    expect(page.locator("tr[data-status=failed]").first).to_contain_text(re.compile(r"failed: .*road"))
    rows = page.get_by_role("region", name="Rows")
    rows.get_by_label("Failed only").check()
    expect(rows).to_contain_text("2 failed runs")
    expect(rows.locator("tbody tr")).to_have_count(2)
    expect(rows.locator("tr[data-status=failed]")).to_have_count(2)
    rows.get_by_label("Failed only").uncheck()
    shown = page.locator("tr[data-run='3'][data-status=ok] td").last.inner_text()
    page.get_by_role("button", name="Open run 3 in the dashboard").click()
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.08
    assert set(dashboard.stored_run()["strategies"]) == {"lv", "passive"}
    expect(dashboard.row("passive").locator("td").last).to_contain_text(str(round(float(shown), 2)))

    opened = dashboard.address()
    dashboard.type_into("Width", "3")
    expect_new_address(page, opened)  # it is still of that sweep
    page.get_by_role("link", name="From sweep “Height").click()
    expect(page).to_have_url(re.compile(f"{sweep}$"))
    page.go_back()
    page.go_back()
    page.go_back()
    expect(page).to_have_url(re.compile(f"{sweep}$"))
    expect(page.get_by_role("button", name="Open run 3 in the dashboard")).to_be_enabled()


@pytest.mark.thorough
def test_a_sweep_is_cancelled_resumed_named_and_deleted_with_another_one(dashboard: Dashboard, server: Server) -> None:
    """It is far longer than any click takes: nothing here waits for its end."""
    page = dashboard.page
    other = server.submit({"grid": {"road.bump.height": [0.03]}}, ["passive"])
    shown = server.submit({"grid": {"road.seed": list(range(1, 601))}}, ["lv_hil"])
    page.goto(shown)
    state = page.get_by_test_id("batch-state")
    page.get_by_role("button", name="Cancel").click()
    expect(state).to_have_text("Cancelled; finished runs are kept")
    page.get_by_role("button", name="Resume").click()
    expect(page.get_by_test_id("batch-counts")).to_have_text(re.compile(r"^[1-9]\d* of 600 runs finished"))
    page.get_by_role("button", name="Cancel").click()
    expect(state).to_have_text("Cancelled; finished runs are kept")

    sweeps = page.get_by_role("region", name="Sweeps")
    entry = sweeps.locator("li").filter(has=page.locator(f"a[href='{shown}']"))
    expect(entry).to_have_attribute("aria-current", "true")
    expect(entry).to_contain_text("cancelled")
    entry.get_by_role("button", name="Rename or delete").click()
    page.get_by_role("menuitem", name="Rename").click()
    entry.get_by_role("textbox", name="Name").fill("Low bump")
    entry.get_by_role("button", name="Save").click()
    expect(page.get_by_role("heading", name="Low bump")).to_be_visible()
    assert server.get(f"/batches/{shown.split('/')[-1]}")["label"] == "Low bump"

    neighbour = sweeps.locator("li").filter(has=page.locator(f"a[href='{other}']"))
    neighbour.get_by_role("button", name="Rename or delete").click()
    page.get_by_role("menuitem", name="Delete").click()
    neighbour.get_by_role("button", name="Delete", exact=True).click()
    expect(neighbour).to_have_count(0)
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
    grid = {"grid": {"road.bump.height": [0.05, 0.1], "road.bump.width": [3, 4]}}
    path = server.submit(grid, ["lv", "passive"])
    page.goto(f"{path}?plot=points")
    expect_done(page)
    expect(page.locator(".scatterlayer .point")).to_have_count(9)  # each run, and the ring
    expect(page.locator(".scatterlayer .js-line")).to_have_count(4)  # a width and a strategy each
    rows = server.get(f"/batches/{path.split('/')[-1]}/results?format=json")["rows"]
    airborne = [str(row["run"]) for row in rows if row["events"]["airborne_ms"] > 0]
    assert airborne
    marked = page.locator("tr[data-run]:has([data-caveat~=airborne_ms])")
    assert marked.evaluate_all("rows => rows.map(row => row.dataset.run)") == airborne
    expect(page.get_by_test_id("airborne-note")).to_contain_text(f"{len(airborne)} of the 8 runs shown")
    chips = page.get_by_role("group", name="Strategies")
    expect(chips.get_by_role("button", name="Passive").locator("svg[data-marker=x]")).to_be_visible()
    dashboard.expect_accessible()

    page.locator(".scatterlayer .trace").nth(3).locator(".point").last.hover(force=True)
    expect(page.locator(".hoverlayer")).to_contain_text(re.compile(r"Passive.*Height 10\scm.*Width [34]\sm.*airborne"))

    page.get_by_label("Over", exact=True).select_option("road.bump.width")
    page.get_by_role("combobox", name="Metric").fill("travel time")
    page.get_by_role("listbox").get_by_role("option", name="Travel time").click()
    page.get_by_role("group", name="Strategies").get_by_role("button", name="Passive").click()
    expect(page).to_have_url(re.compile(r"plot=points&x=road.bump.width&y=travel_time&hide=passive"))
    link = share(page)

    page.goto(link)
    expect(page.get_by_role("region", name="Shared result")).to_contain_text("Shared sweep, computed on")
    expect(page.get_by_label("Over", exact=True)).to_have_value("road.bump.width")
    expect(page.get_by_role("combobox", name="Metric")).to_have_value("Travel time")
    passive = page.get_by_role("group", name="Strategies").get_by_role("button", name="Passive")
    expect(passive).to_have_attribute("aria-pressed", "false")
    expect(page.locator("tbody tr[data-status=ok]")).to_have_count(8)
    assert page.url == link
