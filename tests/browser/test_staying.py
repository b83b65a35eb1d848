"""What stays where something else goes: in a closed tab, on another page, behind Back and Forward."""

import re

from playwright.sync_api import Page

from tests.browser.dashboard import Dashboard, expect


def go(page: Page, name: str) -> None:
    page.get_by_role("navigation", name="Pages").get_by_role("link", name=name).click()


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
