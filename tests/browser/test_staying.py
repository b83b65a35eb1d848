"""What stays where something else goes: on a reload, in another tab, behind Back and Forward, without a file."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, Playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, TOUR_SEEN, Dashboard, expect
from tests.browser.server import Server


def go(page: Page, name: str) -> None:
    page.get_by_role("navigation", name="Pages").get_by_role("link", name=name).click()


@pytest.mark.thorough
def test_edits_outlive_other_pages(dashboard: Dashboard) -> None:
    """Undo, redo, what changes are against; from page to page nothing is loaded. Chosen colours outlive a reload."""
    page, scheme = dashboard.page, "data-mantine-color-scheme"
    page.emulate_media(color_scheme="dark")
    dashboard.open()
    page.get_by_role("button", name="Use light colours").click()
    page.evaluate("window.unloaded = false")
    dashboard.edit("Height", "6")
    low = dashboard.address()
    dashboard.edit("Width", "3")
    entries = page.evaluate("history.length")
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(low)
    assert page.evaluate("history.length") == entries, "undos do not fill the browser's history"
    dashboard.expect_curves()
    page.get_by_label("Change against").select_option("Before the undo")
    expect(page).to_have_url(re.compile("against=before"))
    address = dashboard.address()
    go(page, "Sweeps")
    expect(page.get_by_role("region", name="Sweeps")).to_be_visible()
    go(page, "Lab")
    expect(page).to_have_url(address)
    dashboard.expect_curves()
    assert page.evaluate("window.unloaded") is False
    expect(page.get_by_test_id("differences")).to_contain_text("Bump width 3 → 4\u00a0m")
    page.get_by_role("button", name="Undo").click()
    expect(dashboard.entry("Height")).to_have_value("10")
    for height, width in (("6", "4"), ("6", "3")):
        page.get_by_role("button", name="Redo").click()
        expect(dashboard.entry("Height")).to_have_value(height)
        expect(dashboard.entry("Width")).to_have_value(width)
    page.reload()
    expect(page.locator("html")).to_have_attribute(scheme, "light")


def test_a_closed_tab_comes_back_and_the_paper_is_a_click_away(dashboard: Dashboard) -> None:
    """Whichever page it comes back on; what is computed meanwhile is there then, and Back and Forward go by runs."""
    dashboard.open()
    page, paper, first = dashboard.page, dashboard.address(), dashboard.shown_values()
    dashboard.edit("Height", "6")
    low, values = dashboard.address(), dashboard.shown_values()
    page.go_back()
    expect(page).to_have_url(paper)
    assert (dashboard.entry("Height").input_value(), dashboard.shown_values()) == ("10", first)
    page.go_forward()
    expect(page).to_have_url(low)
    page.goto("/tuner")
    go(page, "Lab")
    dashboard.expect_curves()
    expect(page.get_by_text("Your last scenario.")).to_be_visible()
    assert (dashboard.address(), dashboard.shown_values()) == (low, values)
    with page.expect_response("**/series?*"), dashboard.held("**/series?*"):
        with page.expect_request("**/series?*"):
            dashboard.type_into("Height", "7")
        go(page, "Tuner")
        expect(page).to_have_url(re.compile(r"/tuner\?run="))
    page.go_back()
    dashboard.expect_curves()
    assert dashboard.entry("Height").input_value() == "7"
    dashboard.expect_table_to_be_the_stored_run()
    dashboard.chip("LQR").click()
    expect(dashboard.row("lqr")).to_have_count(0)
    dashboard.open("/")
    assert dashboard.entry("Height").input_value() == "7"
    expect(dashboard.row("lqr")).to_have_count(0)
    page.get_by_role("button", name="Open the paper’s scenario").click()
    expect(dashboard.row("lqr")).to_be_visible()
    assert dashboard.address().split("?")[0] == paper
    expect(page.get_by_text("Your last scenario.")).to_have_count(0)


@pytest.mark.thorough
def test_back_to_a_run_that_has_to_be_fetched(dashboard: Dashboard) -> None:
    """The browser changes the address before it is there: until then what is shown is one run, form and view included,
    and says that it is not the address's. The run before the last edit the page has at hand, the one before that not.
    """
    dashboard.open()
    page, first, paper = dashboard.page, dashboard.address(), dashboard.shown_values()
    for height in ("0.08 m", "0.06 m"):
        dashboard.edit("Height", height)
    low = dashboard.shown_values()
    page.get_by_text("Time", exact=True).click()
    expect(page).to_have_url(re.compile("axis=time"))
    dashboard.open(dashboard.address())
    with dashboard.held("**/series?*"):
        with page.expect_request("**/series?*"):
            page.evaluate("history.go(-2)")
        expect(page).to_have_url(first)
        expect(dashboard.results).to_have_attribute("data-stale", "true")
        assert (dashboard.entry("Height").input_value(), dashboard.shown_values()) == ("6", low)
        expect(page.get_by_role("radio", name="Time")).to_be_checked()
    expect(page.get_by_role("radio", name="Distance")).to_be_checked()
    assert (dashboard.entry("Height").input_value(), dashboard.shown_values()) == ("10", paper)


@pytest.fixture
def cached(playwright: Playwright, server: Server) -> Iterator[Dashboard]:
    """A page in a browser with the back/forward cache, which brings it back as it was left."""
    with launch(playwright, back_forward_cache=True) as browser, profile(browser, server) as page:
        dashboard = Dashboard(page, server.url)
        yield dashboard
    assert dashboard.failures == []


def profile(browser: Browser, server: Server) -> Page:
    context = browser.new_context(base_url=server.url, viewport=LAPTOP, reduced_motion="reduce")
    context.add_init_script(f"{TOUR_SEEN}; addEventListener('pageshow', event => window.cached = event.persisted)")
    return context.new_page()


@pytest.mark.thorough
def test_back_from_another_document_goes_on_where_it_was(cached: Dashboard) -> None:
    """With what it had pressed and asked; and with the pins of another tab."""
    page, dashboard = cached.page, cached
    pins = page.get_by_role("list", name="Pinned results").get_by_role("button")
    dashboard.open()
    dashboard.edit("Height", "12")
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
        if step is None:
            with page.context.new_page() as tab:
                Dashboard(tab, dashboard.url).open()
                tab.get_by_role("region", name="Comparison").get_by_role("button", name="Pin", exact=True).click()
                expect(tab.get_by_role("list", name="Pinned results").get_by_role("button")).to_have_count(1)
        page.evaluate("history.back()")
        page.wait_for_function("() => window.cached")
        expect(page.locator("[data-loading]")).to_have_count(0)
    expect(dashboard.entry("Height")).to_have_value("12")
    expect(pins).to_have_count(1)
    page.get_by_role("button", name="Sweep…").click()
    expect(page.get_by_role("dialog", name="Sweep").get_by_role("button", name="Start")).to_be_enabled()


@pytest.mark.thorough
def test_a_pin_that_cannot_be_loaded_says_so_and_is_tried_again(dashboard: Dashboard) -> None:
    dashboard.open()
    page, first = dashboard.page, f"**/api/v1/runs/{dashboard.run_id}*"
    comparison, pins = page.get_by_role("region", name="Comparison"), page.get_by_role("list", name="Pinned results")
    comparison.get_by_role("button", name="Pin").click()
    comparison.get_by_label("Change against").select_option("Paper’s scenario")
    dashboard.edit("Height", "12")
    page.route(first, lambda route: route.fulfill(status=500, json={"title": "Not now"}))
    page.reload()
    expect(pins).to_contain_text("(could not be loaded: Not now)")
    dashboard.expect_curves()  # a part of the page that comes later would ask for the run by itself
    page.unroute(first)
    comparison.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_role("menuitem", name="Try again").click()
    expect(comparison.get_by_label("Change against").locator("option:checked")).to_have_text("Paper’s scenario")
