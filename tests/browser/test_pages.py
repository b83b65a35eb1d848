"""From page to page: no page load, nothing lost."""

import re

from playwright.sync_api import Page

from tests.browser.dashboard import Dashboard, expect_new_address
from tests.browser.looks import expect

UNKNOWN = "A" * 22


def go(page: Page, name: str) -> None:
    page.get_by_role("navigation", name="Pages").get_by_role("link", name=name).click()


def test_an_edit_outlives_other_pages(dashboard: Dashboard) -> None:
    """Its run, its undo and its redo, by the navigation and by back; what is computed meanwhile is there then."""
    dashboard.open()
    page, paper = dashboard.page, dashboard.address()
    page.evaluate("window.unloaded = false")
    dashboard.type_into("Height", "6")
    expect_new_address(page, paper)
    low = dashboard.address()
    dashboard.type_into("Width", "3")
    expect_new_address(page, low)
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(low)
    go(page, "Sweeps")
    expect(page.get_by_role("region", name="Sweeps")).to_be_visible()
    go(page, "Lab")
    expect(page).to_have_url(low)
    dashboard.expect_curves()
    assert (dashboard.entry("Height").input_value(), dashboard.entry("Width").input_value()) == ("6", "4")
    expect(page.get_by_role("button", name="Redo")).to_be_enabled()

    with page.expect_response("**/series?*"), dashboard.held("**/series?*"):
        with page.expect_request("**/series?*"):
            dashboard.type_into("Height", "7")
        go(page, "Tuner")
        expect(page).to_have_url(re.compile(r"/tuner\?run="))
    page.go_back()
    dashboard.expect_curves()
    assert dashboard.entry("Height").input_value() == "7"
    assert dashboard.address() != low
    dashboard.expect_table_to_be_the_stored_run()
    assert page.evaluate("window.unloaded") is False


def test_a_closed_tab_comes_back_and_the_paper_is_a_click_away(dashboard: Dashboard) -> None:
    dashboard.open()
    page, paper = dashboard.page, dashboard.address()
    dashboard.type_into("Height", "6")
    dashboard.chip("LQR").click()
    expect(dashboard.row("lqr")).to_have_count(0)
    page.get_by_text("Time", exact=True).click()
    expect(page).to_have_url(re.compile("axis=time"))

    dashboard.open("/")
    assert dashboard.entry("Height").input_value() == "6"
    expect(dashboard.row("lqr")).to_have_count(0)
    expect(page.get_by_role("radio", name="Time")).to_be_checked()
    expect(page.get_by_text("Your last scenario.")).to_be_visible()
    page.get_by_role("button", name="Open the paper’s scenario").click()
    expect(dashboard.row("lqr")).to_be_visible()
    assert dashboard.entry("Height").input_value() == "10"
    assert dashboard.address().split("?")[0] == paper
    expect(page.get_by_text("Your last scenario.")).to_have_count(0)


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
