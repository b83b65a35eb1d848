"""The page where a browser is slow, brings a page back as it was left, or has no server for a while."""

import re

import pytest
from playwright.sync_api import Playwright, expect

from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, Dashboard
from tests.browser.server import Server

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
            box = dashboard.slider("Height").bounding_box()
            assert box is not None
            x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
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


def test_back_from_another_document_goes_on_where_it_was(playwright: Playwright, server: Server) -> None:
    """With the back/forward cache, which brings a page back as it was left, with what it had pressed and asked."""
    browser = launch(playwright, back_forward_cache=True)
    try:
        page = browser.new_page(base_url=server.url, viewport=LAPTOP, reduced_motion="reduce")
        page.add_init_script("addEventListener('pageshow', event => window.cached = event.persisted)")
        dashboard = Dashboard(page, server.url)
        dashboard.open()
        dashboard.type_into("Height", "12")
        expect(dashboard.results.get_by_test_id("differences")).to_be_visible()
        page.get_by_role("button", name="Sweep…").click()
        page.get_by_role("dialog", name="Sweep").get_by_role("button", name="Start").click()
        expect(page.get_by_test_id("batch-state")).to_have_text("Done")
        page.get_by_role("button", name=re.compile("Open run 1 in the dashboard")).click()
        dashboard.expect_curves()
        for step in (None, -1, -1):  # what was opened; its sweep; the lab that started it
            if step:
                page.evaluate(f"history.go({step})")
            expect(page.get_by_role("navigation", name="Pages")).to_be_visible()
            page.evaluate("window.cached = false; location.href = '/docs'")
            page.wait_for_function("() => document.title.includes('Ridelab') && document.querySelector('#swagger-ui')")
            page.evaluate("history.back()")
            page.wait_for_function("() => window.cached")
            expect(page.locator("[data-loading]")).to_have_count(0)
        expect(dashboard.entry("Height")).to_have_value("12")
        page.get_by_role("button", name="Sweep…").click()
        expect(page.get_by_role("dialog", name="Sweep").get_by_role("button", name="Start")).to_be_enabled()
        assert dashboard.failures == []
    finally:
        browser.close()


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
