"""What stays where something else goes: on a reload, in another tab, behind Back and Forward, without a file."""

import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, Playwright, Route, expect

from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, Dashboard, expect_new_address
from tests.browser.server import Server

BEFORE = "Before the last edit"


@pytest.fixture(scope="module")
def caching(playwright: Playwright) -> Iterator[Browser]:
    """A browser with the back/forward cache."""
    browser = launch(playwright, back_forward_cache=True)
    yield browser
    browser.close()


@pytest.fixture
def cached(caching: Browser, server: Server) -> Iterator[Dashboard]:
    """A page that the browser brings back as it was left."""
    context = caching.new_context(base_url=server.url, viewport=LAPTOP, reduced_motion="reduce")
    context.add_init_script("addEventListener('pageshow', event => window.cached = event.persisted)")
    dashboard = Dashboard(context.new_page(), server.url)
    yield dashboard
    context.close()
    assert dashboard.failures == []


def edited(dashboard: Dashboard) -> None:
    """Two edits, the second one undone, and changes against the state before that."""
    page, paper = dashboard.page, dashboard.address()
    dashboard.type_into("Height", "6")
    expect_new_address(page, paper)
    low = dashboard.address()
    dashboard.type_into("Width", "3")
    expect_new_address(page, low)
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(low)
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


def pin(page: Page) -> None:
    page.get_by_role("region", name="Comparison").get_by_role("button", name="Pin", exact=True).click()


def pins(page: Page) -> Locator:
    return page.get_by_role("list", name="Pinned results").get_by_role("button")


def test_a_reload_keeps_undo_redo_and_what_changes_are_against(dashboard: Dashboard) -> None:
    """On the lab's page and on another one; a lab that opens as it was left still offers the paper's scenario."""
    dashboard.open()
    edited(dashboard)
    page = dashboard.page
    page.reload()
    dashboard.expect_curves()
    expect_edited(dashboard)
    page.goto("/tuner")
    page.get_by_role("navigation", name="Pages").get_by_role("link", name="Lab").click()
    dashboard.expect_curves()
    expect(page.get_by_text("Your last scenario.")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(dashboard.entry("Width")).to_have_value("4")
    expect(page.get_by_text("Your last scenario.")).to_have_count(0)


def test_back_from_another_document_keeps_them_and_brings_the_pins_of_another_tab(cached: Dashboard) -> None:
    """By the browser's cache; without it going back is a reload. A new tab has nothing to undo."""
    cached.open()
    edited(cached)
    page, address = cached.page, cached.address()
    pin(page)
    with page.context.new_page() as other:
        second = Dashboard(other, cached.url)
        second.open(address.split("?")[0])
        expect(other.get_by_role("button", name="Undo")).to_be_disabled()
        second.type_into("Height", "7")
        expect(second.results.get_by_test_id("differences")).to_be_visible()
        pin(other)
        expect(pins(page)).to_have_count(2)
        page.evaluate("window.cached = false; location.href = '/docs'")
        expect(page.locator("#swagger-ui")).to_be_attached()
        second.type_into("Height", "8")
        expect(second.entry("Height")).to_have_value("8")
        second.expect_curves()
        pin(other)
        expect(pins(other)).to_have_count(3)
    page.evaluate("history.back()")
    page.wait_for_function("() => window.cached")
    expect(pins(page)).to_have_count(3)
    cached.expect_curves()
    assert cached.address() == address
    expect_edited(cached)


def test_forward_leads_to_an_edit_that_back_has_left(cached: Dashboard) -> None:
    """Through another document: what is shown is what the address names, and Undo changes something."""
    cached.open()
    page, paper = cached.page, cached.address()
    cached.type_into("Height", "6")
    expect_new_address(page, paper)
    low = cached.address()
    page.evaluate("location.href = '/docs'")
    expect(page.locator("#swagger-ui")).to_be_attached()
    for address, height in ((low, "6"), (paper, "10"), (low, "6")):
        page.evaluate(f"history.{'forward' if page.url == paper else 'back'}()")
        expect(page).to_have_url(address)
        expect(cached.entry("Height")).to_have_value(height)
        cached.expect_curves()
    page.get_by_role("button", name="Undo").click()
    expect(cached.entry("Height")).to_have_value("10")


def test_plots_that_cannot_be_saved_say_so_and_a_missing_part_leaves_the_lab(dashboard: Dashboard) -> None:
    """As after an update of the server: it says so, and everything else goes on."""
    dashboard.open()
    page = dashboard.page

    def refuse(route: Route) -> None:
        route.fulfill(status=500, json={"title": "Not now"})

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
    opening: dict[str, Callable[[], None]] = {
        "the library": lambda: page.get_by_role("button", name="Library").click(),
        "a sweep": lambda: page.get_by_role("button", name="Sweep…").click(),
        "a limit": lambda: page.get_by_role("button", name="How fast may it go: Body acceleration, bump").click(),
        "commands": lambda: page.keyboard.press("Control+k"),
        "keys": lambda: page.keyboard.press("?"),
        "a figure": lambda: page.get_by_role("button", name="Save figure: Body acceleration").click(),
    }
    failed = page.get_by_role("dialog", name="This part of the page could not be shown")
    for what, open_part in opening.items():
        open_part()
        expect(failed, what).to_be_visible()
        expect(failed.get_by_role("button", name="Load again")).to_be_visible()
        failed.get_by_role("button", name="Close").last.click()
        expect(failed).to_have_count(0)
    dashboard.expect_table_to_be_the_stored_run()
    dashboard.failures.clear()  # the browser and React write a missing file to the console


def test_renaming_in_the_library_keeps_the_focus(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    for name in ("Low", "High"):
        page.keyboard.press("Control+s")
        page.get_by_role("textbox", name="Name", exact=True).fill(name)
        page.keyboard.press("Enter")
        expect(page.get_by_role("dialog", name="Library")).to_have_count(0)
    page.keyboard.press("Control+s")
    menu = page.get_by_role("button", name="Rename, export or delete Low")
    for answer in ("Close", "Rename"):
        menu.focus()
        page.keyboard.press("Enter")
        page.get_by_role("menuitem", name="Rename").press("Enter")
        entry = page.get_by_role("textbox", name="New name")
        expect(entry).to_be_focused()
        entry.fill("Flat")
        page.locator("form").get_by_role("button", name=answer, exact=True).press("Enter")
        expect(entry).to_have_count(0)
        after = "Flat" if answer == "Rename" else "Low"
        expect(page.get_by_role("button", name=f"Rename, export or delete {after}")).to_be_focused()
