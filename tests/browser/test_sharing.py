"""A result is a link: made by a click, opened as it was, read-only, run again, copied to be edited."""

import pytest
from playwright.sync_api import Page

from tests.browser.dashboard import REFUSE_COPYING, Dashboard, expect


def share(page: Page) -> str:
    """Shares what is shown; the new link's address."""
    with page.expect_response("**/api/v1/links") as made:
        page.get_by_role("button", name="Share").click()
    address = page.get_by_role("dialog", name="Share").get_by_label("Address of the link")
    expect(address).to_be_visible()
    assert address.input_value().endswith(f"/s/{made.value.json()['slug']}")
    return address.input_value()


def test_a_link_opens_the_same_numbers_the_same_view_and_the_pins(dashboard: Dashboard) -> None:
    dashboard.open()
    page, paper = dashboard.page, dashboard.shown_values()
    comparison = page.get_by_role("region", name="Comparison")
    comparison.get_by_role("button", name="Pin").click()
    comparison.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_label("Name").fill("As printed")
    page.get_by_label("Name").press("Enter")
    page.keyboard.press("Escape")
    dashboard.edit("Height", "0.12 m")
    pinned = "[data-pinned='As printed'] [data-pinned-strategy=lv] [data-cell='bump.body_acceleration.peak']"
    key = "lv bump.body_acceleration.peak"
    expect(page.locator(pinned)).to_have_attribute("data-value", str(paper[key]))
    comparison.get_by_label("Change against").select_option("As printed")
    change = 100 * (dashboard.shown_values()[key] / paper[key] - 1)
    peak = dashboard.row("lv").locator("[data-cell='bump.body_acceleration.peak']")
    expect(peak).to_contain_text(f"+{change:.1f}\u2009%")
    dashboard.row("lqr").get_by_role("button", name="LQR").click()
    dashboard.chip("Passive").click()
    page.get_by_text("Time", exact=True).click()
    cursor = page.get_by_role("slider", name="Cursor")
    cursor.fill(str((float(cursor.get_attribute("min") or 0) + float(cursor.get_attribute("max") or 0)) / 2))
    place, values = cursor.get_attribute("aria-valuetext"), dashboard.shown_values()
    head = page.locator("section[data-figure=body_acceleration] header")
    reading, link = head.inner_text(), share(page)

    # Somebody else opens it, whose colours are dark.
    dashboard.forget()
    page.emulate_media(color_scheme="dark")
    dashboard.open(link)
    expect(page.locator(pinned)).to_have_attribute("data-value", str(paper[key]))
    expect(page.get_by_role("list", name="Pinned results")).to_have_text("As printed")
    expect(dashboard.panel("body_acceleration")).to_have_attribute("data-drawn", "4")
    expect(page.get_by_text("After an edit")).to_have_count(0)  # it is read-only
    expect(dashboard.row("lqr")).to_have_attribute("data-baseline", "true")
    assert dashboard.shown_values() == values
    expect(dashboard.row("passive")).to_have_count(0)
    expect(page.get_by_role("radio", name="Time")).to_be_checked()
    expect(cursor).to_have_attribute("aria-valuetext", place or "")
    expect(head).to_have_text(reading, use_inner_text=True)
    expect(page.locator("html")).to_have_attribute("data-mantine-color-scheme", "dark")  # the reader's own


@pytest.mark.thorough
def test_a_shared_result_is_read_only_and_a_copy_is_not(dashboard: Dashboard) -> None:
    """Its link is copied; where that is refused, it is shown to be copied by hand."""
    page = dashboard.page
    dashboard.open()
    with dashboard.clipboard() as copied:
        link = share(page)
        expect(page.get_by_text("Link copied")).to_be_visible()
        assert copied() == link
    dashboard.expect_accessible(page.get_by_role("dialog", name="Share"))
    page.keyboard.press("Escape")
    page.evaluate(REFUSE_COPYING)
    share(page)
    expect(page.get_by_text("Here is the link: select and copy it")).to_be_visible()
    dashboard.open(link)
    banner = page.get_by_role("region", name="Shared result")
    expect(banner).to_contain_text("Read-only.")
    enabled = "aside :is(input:not([type=hidden], [aria-label='Find a field']), select):enabled"
    expect(page.locator(enabled)).to_have_count(0)
    for name in ("Undo", "Redo", "Library"):
        expect(page.get_by_role("button", name=name)).to_be_disabled()
    dashboard.chip("LQR").click()  # looking at less of it changes nothing
    expect(dashboard.row("lqr")).to_have_count(0)
    assert page.url == link
    page.get_by_role("button", name="Run again on this version").click()
    differences = page.get_by_role("region", name="Differences")
    expect(differences).to_contain_text("No differences")
    page.get_by_role("button", name="Close the differences").click()

    with dashboard.new_address():
        page.get_by_role("button", name="Open a copy to edit").click()
    expect(banner).to_have_count(0)
    copy = page.url
    dashboard.edit("Height", "0.05 m")
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(copy)  # in place of the edit's address
    for address in (copy, link):
        page.go_back()
        expect(page).to_have_url(address)
    expect(banner).to_be_visible()
