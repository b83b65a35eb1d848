"""The page behind Back and Forward from another document, with the browser's back/forward cache."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, Playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, Dashboard, expect, expect_new_address
from tests.browser.server import Server
from tests.browser.test_staying import edited, expect_edited


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


def pin(page: Page) -> None:
    page.get_by_role("region", name="Comparison").get_by_role("button", name="Pin", exact=True).click()


def pins(page: Page) -> Locator:
    return page.get_by_role("list", name="Pinned results").get_by_role("button")


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


def test_back_from_another_document_goes_on_where_it_was(cached: Dashboard) -> None:
    """With the back/forward cache, which brings a page back as it was left, with what it had pressed and asked."""
    page, dashboard = cached.page, cached
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
