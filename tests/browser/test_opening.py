"""How the page opens: without a jump, where nothing is, and where the server starts, goes, or asks for a token."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from tests.browser.dashboard import Dashboard, expect
from tests.browser.server import Server
from tests.servers.process import Api

UNKNOWN = "A" * 22
TOKEN = "ann-0123456789abcdef"  # noqa: S105  # nobody's
MOVED = """() => new Promise(done => {
  const told = new PerformanceObserver(list =>
    done(list.getEntriesByType('layout-shift').reduce((sum, {value}) => sum + value, 0)));
  // There always is a paint to tell of.
  for (const type of ['paint', 'layout-shift']) told.observe({type, buffered: true});
})"""


@pytest.mark.parametrize(
    ("width", "height"), [(390, 844), *(pytest.param(*size, marks=pytest.mark.thorough) for size in [(1440, 900)])]
)
def test_nothing_jumps_while_loading_or_is_wider_than_the_window(dashboard: Dashboard, width: int, height: int) -> None:
    """Cumulative layout shift is good up to 0.1; a table or a plot without its place kept is over that."""
    page = dashboard.page
    page.set_viewport_size({"width": width, "height": height})
    dashboard.open()
    expect(page.get_by_test_id("verdict")).to_be_visible()
    assert page.evaluate(MOVED) < 0.05
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_what_is_not_there_is_said_beside_the_navigation(dashboard: Dashboard) -> None:
    """The statuses are the API's tests'."""
    page = dashboard.page
    for path, said in (
        ("/manual/nothing-here/", "There is no page at this address"),
        (f"/r/{UNKNOWN}", "There is no run at this address"),
        (f"/s/{UNKNOWN}", "There is no shared result at this address"),
        (f"/b/{UNKNOWN}", "There is no sweep at this address"),
        (f"/tuner/{UNKNOWN}", "There is no tuning at this address"),
        ("/paper?preview=sideways", "does not know"),
    ):
        page.goto(path)
        expect(page.get_by_text(said)).to_be_visible()
        expect(page.get_by_role("navigation", name="Pages").get_by_role("link", name="Lab")).to_be_visible()


def finished(sweep: Page) -> int:
    return int(sweep.get_by_test_id("batch-counts").inner_text().split(" ")[0])


@pytest.mark.thorough
def test_the_server_goes_and_comes_back(dashboard: Dashboard, server: Server) -> None:
    """Under an edit in the lab, and under a sweep that is being computed and goes on by itself."""
    dashboard.open()
    page, address = dashboard.page, dashboard.address()
    ranges = {"road.bump.height": [0.01, 0.2], "mpc.deflection_weight": [1, 5]}
    with page.context.new_page() as sweep:
        sweep.goto(server.submit({"latin_hypercube": {"ranges": ranges, "samples": 4000}}, ["lv"]))
        interrupted = sweep.get_by_text("The connection is interrupted")
        expect(sweep.get_by_test_id("batch-counts")).to_contain_text(re.compile(r"^[1-9]\d* of 4000 runs finished"))
        server.stop()
        try:
            dashboard.type_into("Height", "0.11 m")
            expect(page.get_by_test_id("connection")).to_contain_text("The server does not answer")
            expect(dashboard.results).to_have_attribute("data-stale", "true")
            assert dashboard.address() == address
            expect(interrupted).to_be_visible()
            done = finished(sweep)
        finally:
            server.start()
        expect(page).not_to_have_url(address)
        dashboard.expect_table_to_be_the_stored_run()
        assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.11
        expect(interrupted).to_have_count(0)
        while finished(sweep) == done:
            sweep.wait_for_timeout(100)
        sweep.get_by_role("button", name="Cancel").click()
        expect(sweep.get_by_test_id("batch-state")).to_have_text("Cancelled; finished runs are kept")


@pytest.mark.thorough
def test_a_service_with_tokens_asks_for_one_once(browser: Browser, tmp_path: Path) -> None:
    """Then all works, event streams included, until somebody logs out."""
    tokens = tmp_path / "tokens"
    tokens.write_text(f"ann {TOKEN}\n")
    limits = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1", "RIDELAB_TOKENS_FILE": str(tokens)}
    with Api(tmp_path, **limits) as api, browser.new_context(base_url=api.url, reduced_motion="reduce") as context:
        api.wait_until_ready()
        dashboard = Dashboard(context.new_page(), api.url)
        page, asked = dashboard.page, dashboard.page.get_by_role("heading", name="Ridelab asks for a token")
        page.goto("/")
        expect(asked).to_be_visible()
        for text in ("not the one", TOKEN):
            page.get_by_label("Token").fill(text)
            page.get_by_role("button", name="Log in").click()
            if text != TOKEN:
                expect(page.get_by_text("This is none of the service's tokens.")).to_be_visible()
        dashboard.expect_curves()
        assert page.evaluate("document.cookie") == "", "no script reads it"
        page.get_by_role("button", name="Sweep…").click()
        page.get_by_role("dialog", name="Sweep").get_by_role("button", name="Start").click()
        expect(page.get_by_test_id("batch-state")).to_have_text("Done")
        page.get_by_role("button", name="Log out ann").click()
        expect(asked).to_be_visible()
        page.reload()
        expect(asked).to_be_visible()
        assert dashboard.failures == []
        assert not any(secret in api.log for secret in (TOKEN, "not the one", "not%20the%20one"))
