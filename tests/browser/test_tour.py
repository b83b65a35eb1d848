"""What a visitor meets first: a tour that is offered once, question marks beside names."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, ViewportSize

from tests.browser.dashboard import Dashboard, expect
from tests.browser.server import Server


@pytest.fixture
def reader(browser: Browser, server: Server) -> Iterator[Dashboard]:
    """Somebody else: a browser that has seen nothing of this yet, in the dark."""
    size: ViewportSize = {"width": 1366, "height": 768}
    with browser.new_context(viewport=size, base_url=server.url, color_scheme="dark", reduced_motion="reduce") as own:
        dashboard = Dashboard(own.new_page(), server.url)
        yield dashboard
    assert dashboard.failures == []


@pytest.mark.thorough
def test_a_visitor_gets_a_tour_and_the_manual_beside_every_name(reader: Dashboard) -> None:
    """The tour goes by keyboard, on a laptop and on a phone; once taken it is offered no more, help has it."""
    page, step = reader.page, reader.page.get_by_role("dialog")
    for size in ({"width": 1366, "height": 768}, {"width": 390, "height": 844}):
        page.set_viewport_size({"width": size["width"], "height": size["height"]})
        reader.open()
        if size["width"] > 400:
            page.get_by_role("button", name="Take the tour").press("Enter")
        else:
            expect(page.get_by_text("New here?")).to_have_count(0)
            page.keyboard.press("?")
            page.get_by_role("dialog", name="Help").get_by_role("button", name="Take the tour").click()
        for number in range(1, 6):
            expect(step).to_contain_text(f"{number} of 5")
            expect(step).to_be_in_viewport(ratio=1)
            step.get_by_role("button", name="Done" if number == 5 else "Next").press("Enter")
        expect(step).to_have_count(0)
    page.get_by_role("button", name="Edit scenario").click()
    with page.context.expect_page() as manual:
        page.get_by_role("link", name="About Height, in the manual").click()
    expect(manual.value).to_have_url(re.compile(r"/manual/reference/scenario/#road\.bump\.height$"))
    expect(manual.value.locator("[id='road.bump.height']")).to_be_in_viewport()
