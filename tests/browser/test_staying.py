"""What stays where something else goes: on a reload, in another tab, behind Back and Forward, without a file."""

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, Route

from tests.browser.dashboard import Dashboard, expect, expect_new_address

BEFORE = "Before the last edit"


def edited(dashboard: Dashboard) -> None:
    """Two edits, the second one undone, and changes against the state before that."""
    page, paper = dashboard.page, dashboard.address()
    dashboard.type_into("Height", "6")
    expect_new_address(page, paper)
    low = dashboard.address()
    dashboard.type_into("Width", "3")
    expect_new_address(page, low)
    entries = page.evaluate("history.length")
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(low)
    assert page.evaluate("history.length") == entries, "undos do not fill the browser's history"
    dashboard.expect_curves()
    page.get_by_label("Change against").select_option("Before the undo")
    expect(page).to_have_url(re.compile("against=before"))


def expect_edited(dashboard: Dashboard) -> None:
    """What `edited` has left behind, to be compared, undone and done again."""
    page = dashboard.page
    expect(page.get_by_label("Change against").locator("option:checked")).to_have_text("Before the undo")
    expect(page.get_by_test_id("differences")).to_contain_text("Bump width 3 → 4\u00a0m")
    page.get_by_role("button", name="Undo").click()
    expect(dashboard.entry("Height")).to_have_value("10")
    for height, width in (("6", "4"), ("6", "3")):
        page.get_by_role("button", name="Redo").click()
        expect(dashboard.entry("Height")).to_have_value(height)
        expect(dashboard.entry("Width")).to_have_value(width)
    expect(page.get_by_role("button", name="Redo")).to_be_disabled()


def go(page: Page, name: str) -> None:
    page.get_by_role("navigation", name="Pages").get_by_role("link", name=name).click()


@pytest.mark.thorough
def test_edits_outlive_other_pages_and_a_reload(dashboard: Dashboard) -> None:
    """Undo, redo, what changes are against, and the colours somebody chose; from page to page nothing is loaded."""
    page, scheme = dashboard.page, "data-mantine-color-scheme"
    page.emulate_media(color_scheme="dark")
    dashboard.open()
    expect(page.locator("html")).to_have_attribute(scheme, "dark")
    page.get_by_role("button", name="Use light colours").click()
    expect(page.locator("html")).to_have_attribute(scheme, "light")
    page.evaluate("window.unloaded = false")
    edited(dashboard)
    curves, before = dashboard.panel("body_acceleration"), page.get_by_role("checkbox", name="Before the undo")
    expect(page.locator("[data-layer]")).to_have_text([re.compile("before the undo")])
    expect(curves).to_have_attribute("data-drawn", "6")
    before.uncheck()
    expect(curves).to_have_attribute("data-drawn", "3")
    before.check()
    page.get_by_label("Change against").select_option("Before the undo")
    address = dashboard.address()
    go(page, "Sweeps")
    expect(page.get_by_role("region", name="Sweeps")).to_be_visible()
    go(page, "Lab")
    expect(page).to_have_url(address)
    dashboard.expect_curves()
    assert page.evaluate("window.unloaded") is False
    page.reload()
    dashboard.expect_curves()
    expect(page.locator("html")).to_have_attribute(scheme, "light")
    expect_edited(dashboard)


def test_a_closed_tab_comes_back_and_the_paper_is_a_click_away(dashboard: Dashboard) -> None:
    """Whichever page it comes back on; what is computed meanwhile is there then, and Back and Forward go by runs."""
    dashboard.open()
    page, paper, first = dashboard.page, dashboard.address(), dashboard.shown_values()
    dashboard.type_into("Height", "6")
    expect_new_address(page, paper)
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
    expect(page.get_by_text("Your last scenario.")).to_have_count(0)
    dashboard.expect_table_to_be_the_stored_run()
    dashboard.chip("LQR").click()
    expect(dashboard.row("lqr")).to_have_count(0)
    page.get_by_text("Time", exact=True).click()
    expect(page).to_have_url(re.compile("axis=time"))
    dashboard.open("/")
    assert dashboard.entry("Height").input_value() == "7"
    expect(dashboard.row("lqr")).to_have_count(0)
    expect(page.get_by_role("radio", name="Time")).to_be_checked()
    expect(page.get_by_text("Your last scenario.")).to_be_visible()
    page.get_by_role("button", name="Open the paper’s scenario").click()
    expect(dashboard.row("lqr")).to_be_visible()
    assert dashboard.entry("Height").input_value() == "10"
    assert dashboard.address().split("?")[0] == paper
    expect(page.get_by_text("Your last scenario.")).to_have_count(0)


@pytest.mark.thorough
def test_what_cannot_be_loaded_or_saved_says_so_and_leaves_the_lab(dashboard: Dashboard) -> None:
    """A pin, plots, or parts of the page after an update of the server: everything else goes on."""
    dashboard.open()
    page, first = dashboard.page, dashboard.run_id

    def refuse(route: Route) -> None:
        route.fulfill(status=500, json={"title": "Not now"})

    comparison, pins = page.get_by_role("region", name="Comparison"), page.get_by_role("list", name="Pinned results")
    comparison.get_by_role("button", name="Pin").click()
    comparison.get_by_label("Change against").select_option("Paper’s scenario")
    dashboard.type_into("Height", "12")
    expect(page.get_by_test_id("differences")).to_contain_text("Bump height 10 → 12\u00a0cm")
    page.route(f"**/api/v1/runs/{first}*", refuse)
    page.reload()
    expect(pins).to_contain_text("Paper’s scenario(could not be loaded: Not now)")
    dashboard.expect_curves()  # a part of the page that comes later would ask for the run by itself
    page.unroute(f"**/api/v1/runs/{first}*", refuse)
    comparison.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_role("menuitem", name="Try again").click()
    expect(comparison.get_by_label("Change against").locator("option:checked")).to_have_text("Paper’s scenario")

    page.route("**/series?*", refuse)
    page.get_by_label("Plot differences").check()
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem", name="PNG picture").click()
    dialog = page.get_by_role("dialog", name="The plots could not be saved")
    expect(dialog).to_contain_text("Not now")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    page.unroute("**/series?*", refuse)
    page.get_by_role("button", name="Export").click()
    with page.expect_download():
        page.get_by_role("menuitem", name="PNG picture").click()
    page.get_by_label("Plot differences").uncheck()

    page.route(re.compile(r"/assets/(\w+Dialog|Palette|Help|FigureMenu)-"), lambda route: route.abort())
    opening: tuple[Callable[[], object], ...] = (
        lambda: page.get_by_role("button", name="Library").click(),
        lambda: page.get_by_role("button", name="Sweep…").click(),
        lambda: page.get_by_role("button", name="How fast may it go: Body acceleration, bump").click(),
        lambda: page.keyboard.press("Control+k"),
        lambda: page.keyboard.press("?"),
        lambda: page.get_by_role("button", name="Save figure: Body acceleration").click(),
    )
    failed = page.get_by_role("dialog", name="This part of the page could not be shown")
    for open_part in opening:
        open_part()
        expect(failed).to_be_visible()
        expect(failed.get_by_role("button", name="Load again")).to_be_visible()
        failed.get_by_role("button", name="Close").last.click()
        expect(failed).to_have_count(0)
    dashboard.expect_table_to_be_the_stored_run()
    dashboard.failures.clear()  # the browser and React write a missing file to the console
