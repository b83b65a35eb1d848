"""The page where a browser is slow, brings a page back as it was left, or has no server for a while."""

import re

import pytest
from playwright.sync_api import Route

from tests.browser.dashboard import Dashboard, expect, expect_new_address, thumb
from tests.browser.server import Server
from tests.browser.test_opening import expect_steady
from tests.browser.test_sweeping import expect_done

SLOWER = 4  # times


def test_the_last_value_of_a_drag_is_the_exact_runs_on_a_slow_processor(dashboard: Dashboard) -> None:
    """However far the curves are behind the pointer, on release they are those of the value it was left at."""
    dashboard.open()
    page = dashboard.page
    session = page.context.new_cdp_session(page)
    session.send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    try:
        for stride in (1, -1):  # up and down again
            address = dashboard.address()
            x, y = thumb(dashboard.slider("Height"))
            page.mouse.move(x, y)
            page.mouse.down()
            for step in range(1, 41):  # nothing is waited for
                page.mouse.move(x + stride * step, y)
            page.mouse.up()
            expect(dashboard.results).to_have_attribute("data-source", "exact")
            expect(page).not_to_have_url(address)
            expect(dashboard.results).not_to_have_attribute("data-stale", "true")
            height = float(dashboard.entry("Height").input_value()) / 100
            assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == pytest.approx(height)
            dashboard.expect_table_to_be_the_stored_run()
    finally:
        session.send("Emulation.setCPUThrottlingRate", {"rate": 1})


def test_the_server_goes_and_comes_back(dashboard: Dashboard, server: Server) -> None:
    """Under an edit in the lab, and under a sweep that is being computed and goes on by itself."""
    dashboard.open()
    page, address = dashboard.page, dashboard.address()
    ranges = {"road.bump.height": [0.01, 0.2], "mpc.deflection_weight": [1, 5]}
    with page.context.new_page() as sweep:
        sweep.goto(server.submit({"latin_hypercube": {"ranges": ranges, "samples": 4000}}, ["lv"]))
        counts, interrupted = sweep.get_by_test_id("batch-counts"), sweep.get_by_text("The connection is interrupted")
        expect(counts).to_contain_text(re.compile(r"^[1-9]\d* of 4000 runs finished"))
        server.stop()
        try:
            dashboard.type_into("Height", "0.11 m")
            notice = page.get_by_test_id("connection")
            expect(notice).to_contain_text("The server does not answer")
            expect(dashboard.entry("Height")).to_have_value("11")
            expect(dashboard.results).to_have_attribute("data-stale", "true")
            assert dashboard.address() == address
            expect(interrupted).to_be_visible()
            done = int(counts.inner_text().split(" ")[0])
        finally:
            server.start()
        expect(notice).to_have_count(0)
        expect(page).not_to_have_url(address)
        dashboard.expect_table_to_be_the_stored_run()
        assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.11

        expect(interrupted).to_have_count(0)
        sweep.wait_for_function(
            "done => Number(document.querySelector('[data-testid=batch-counts]').textContent.split(' ')[0]) > done",
            arg=done,
        )
        sweep.get_by_role("button", name="Cancel").click()
        expect(sweep.get_by_test_id("batch-state")).to_have_text("Cancelled; finished runs are kept")
        expect(sweep.get_by_role("button", name="Cancel")).to_have_count(0)
        expect(sweep.locator("tbody tr[data-status=ok]").first).to_be_visible()


def test_ten_thousand_runs_are_plotted_and_opened(dashboard: Dashboard, server: Server) -> None:
    """More points than a page can hold as elements; the rows are made up, the run opened is not."""
    page, size = dashboard.page, 10_000
    path = server.submit({"grid": {"road.bump.height": [0.05, 0.1]}}, ["lv"])

    def many(route: Route) -> None:
        answer = route.fetch().json()
        columns = answer["columns"]
        answer["columns"] = {name: [values[0]] * size for name, values in columns.items()} | {
            "run": list(range(size)),
            "road.bump.height": [0.05 + 0.1 * index / size for index in range(size)],
            "bump.body_acceleration.peak": [1 + (index % 100) / 100 for index in range(size)],
        }
        route.fulfill(json=answer)

    page.route("**/table?*", many)
    page.goto(path)
    expect_done(page)
    plot = page.locator("[data-points='10000']")
    expect(plot).to_be_visible()
    expect(page.locator(".scatterlayer .point")).to_have_count(5)  # the corners plotly needs, and the ring
    expect(page.get_by_role("region", name="Rows")).to_contain_text("10\u202f000 runs")
    page.get_by_role("button", name="Page 200", exact=True).click()
    expect(page.locator("tr[data-run='9999']")).to_be_visible()

    box = plot.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 4)
    tip = page.get_by_test_id("tip")
    expect(tip).to_contain_text(re.compile(r"LV control.*Height \d+(\.\d+)?\scm"))
    page.mouse.down()
    page.mouse.up()
    dashboard.expect_curves()
    assert 0.09 < dashboard.stored_run()["scenario"]["road"]["bump"]["height"] < 0.11


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (820, 1180)])
def test_nothing_jumps_while_loading_or_is_wider_than_the_window(dashboard: Dashboard, width: int, height: int) -> None:
    expect_steady(dashboard, width, height)


def test_address_table_and_curves_change_together(dashboard: Dashboard) -> None:
    """Whatever is slow: a run's address stands there when its curves do, and not before."""
    dashboard.open()
    page, series = dashboard.page, "**/series?*"

    def shown() -> tuple[dict[str, float], list[str]]:
        return dashboard.shown_values(), dashboard.curves()

    first, paper = dashboard.address(), shown()
    with dashboard.held(series):
        with page.expect_request(series):
            dashboard.type_into("Height", "0.06 m")
        expect(dashboard.results).to_have_attribute("data-stale", "true")
        assert (dashboard.address(), shown()) == (first, paper)
    expect_new_address(page, first)
    second, low = dashboard.address(), shown()
    assert low[0] != paper[0]
    assert low[1] != paper[1]
    dashboard.expect_table_to_be_the_stored_run()

    with dashboard.held(series):
        with page.expect_request(series) as curves:
            dashboard.drag(dashboard.slider("Height"), (10,))
        expect(dashboard.results).to_have_attribute("data-source", "live")
        assert dashboard.address() == second
        with page.expect_event("requestfailed", lambda request: request == curves.value):
            page.get_by_role("button", name="Undo").click()  # nobody waits for it any more
        expect(dashboard.results).to_have_attribute("data-source", "exact")
    assert (dashboard.address(), shown()) == (second, low)


def test_back_to_a_run_that_has_to_be_fetched(dashboard: Dashboard) -> None:
    """The browser changes the address before it is there: until then what is shown is one run, form and view included,
    and says that it is not the address's. The run before the last edit the page has at hand, the one before that not.
    """
    dashboard.open()
    page, first, paper = dashboard.page, dashboard.address(), dashboard.shown_values()
    for height in ("0.08 m", "0.06 m"):
        before = dashboard.address()
        dashboard.type_into("Height", height)
        expect_new_address(page, before)
    low = dashboard.shown_values()
    page.get_by_text("Time", exact=True).click()
    expect(page).to_have_url(re.compile("axis=time"))
    dashboard.open(dashboard.address())
    assert dashboard.shown_values() == low
    expect(dashboard.status).to_contain_text("Stored result")
    with dashboard.held("**/series?*"):
        with page.expect_request("**/series?*"):
            page.evaluate("history.go(-2)")
        expect(page).to_have_url(first)
        expect(dashboard.results).to_have_attribute("data-stale", "true")
        assert (dashboard.entry("Height").input_value(), dashboard.shown_values()) == ("6", low)
        expect(page.get_by_role("radio", name="Time")).to_be_checked()
    expect(page.get_by_role("radio", name="Distance")).to_be_checked()
    assert (dashboard.entry("Height").input_value(), dashboard.shown_values()) == ("10", paper)
