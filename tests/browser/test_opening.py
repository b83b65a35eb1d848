"""What a visitor meets first: the paper's scenario, in both colour schemes and at every size."""

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.dashboard import Dashboard
from tests.browser.server import Server


def test_opens_on_the_papers_scenario_with_every_figure(browser: Browser, server: Server) -> None:
    """From the address to drawn curves, with an empty cache; `make bench` says how long it takes."""
    context = browser.new_context(viewport={"width": 1440, "height": 900}, base_url=server.url)
    dashboard = Dashboard(context.new_page(), server.url)
    dashboard.page.goto("/")
    dashboard.expect_curves()
    expect(dashboard.page).to_have_title("100 mm bump, 50 → 22.5 km/h · Ridelab")
    expect(dashboard.page.get_by_text("The paper’s scenario")).to_be_visible()
    dashboard.expect_table_to_be_the_stored_run()
    names = server.get("/figures")["figures"]
    panels = dashboard.page.locator("section[data-figure]")
    assert panels.evaluate_all("panels => panels.map(panel => panel.dataset.figure)") == [
        figure["layout"]["meta"]["signal"] for figure in names.values()
    ]
    assert dashboard.failures == []
    context.close()


def test_colour_scheme_follows_the_system_and_the_toggle_keeps(dashboard: Dashboard) -> None:
    page = dashboard.page
    scheme = page.locator("html[data-mantine-color-scheme]")
    page.emulate_media(color_scheme="dark")
    dashboard.open()
    expect(scheme).to_have_attribute("data-mantine-color-scheme", "dark")
    page.get_by_role("button", name="Use light colours").click()
    expect(scheme).to_have_attribute("data-mantine-color-scheme", "light")
    page.reload()
    dashboard.expect_curves()
    expect(scheme).to_have_attribute("data-mantine-color-scheme", "light")


def expect_steady(dashboard: Dashboard, width: int, height: int) -> None:
    """Cumulative layout shift is good up to 0.1; a table or a plot without its place kept is over that."""
    dashboard.page.set_viewport_size({"width": width, "height": height})
    dashboard.page.goto("/")
    expect(dashboard.results).to_be_visible()
    expect(dashboard.page.locator("section[data-figure]").first).to_be_attached()
    shift = dashboard.page.evaluate(
        """() => new Promise(done => {
          const told = new PerformanceObserver(list =>
            done(list.getEntriesByType('layout-shift').reduce((sum, {value}) => sum + value, 0)));
          // There always is a paint to tell of.
          for (const type of ['paint', 'layout-shift']) told.observe({type, buffered: true});
        })"""
    )
    assert shift < 0.05
    assert dashboard.page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (820, 1180)])
def test_nothing_jumps_while_loading_or_is_wider_than_the_window(dashboard: Dashboard, width: int, height: int) -> None:
    expect_steady(dashboard, width, height)


def test_on_a_phone_nothing_jumps_and_the_form_leaves_the_plots_in_sight(dashboard: Dashboard) -> None:
    expect_steady(dashboard, 390, 844)
    page = dashboard.page
    page.get_by_role("button", name="Edit scenario").click()
    expect(dashboard.slider("Height")).to_be_visible()
    box = page.get_by_role("dialog").bounding_box()
    assert box is not None
    assert box["y"] > 0.4 * 844
