"""What the lab says at first sight: who won, what an edit changed, and which curve is whose."""

import re

from tests.browser.dashboard import Dashboard, expect, expect_new_address


def test_says_who_won_which_curve_is_whose_and_what_an_edit_changed(dashboard: Dashboard) -> None:
    page = dashboard.page
    dashboard.open()
    panel = dashboard.panel("body_acceleration")
    picture = "canvas => canvas.toDataURL()"
    before = panel.evaluate(picture)
    entry = page.get_by_title("Make LQR stand out")
    entry.click()
    expect(entry).to_have_attribute("aria-pressed", "true")
    page.mouse.move(0, 0)
    panel.scroll_into_view_if_needed()
    page.wait_for_function(
        f"([canvas, before]) => ({picture})(canvas) !== before", arg=[panel.element_handle(), before]
    )
    entry.click()
    page.mouse.move(0, 0)
    panel.scroll_into_view_if_needed()
    page.wait_for_function(
        f"([canvas, before]) => ({picture})(canvas) === before", arg=[panel.element_handle(), before]
    )

    comparison = page.get_by_role("region", name="Comparison", exact=True)
    verdict = page.get_by_test_id("verdict")
    told = verdict.get_by_role("status")
    expect(told).to_contain_text(re.compile(r"LV control is best in \d of 8 metrics"))
    expect(told).to_contain_text("at 22.5 instead of 50.0 km/h")
    address = dashboard.address()
    page.get_by_role("button", name="Compare at equal speed").click()
    expect_new_address(page, address)
    expect(told).to_contain_text("all at 22.5 km/h")
    expect(page.get_by_role("button", name="Compare at equal speed")).to_have_count(0)
    changes = page.get_by_role("group", name="Changes against the state before the last edit")
    expect(changes.get_by_label("Changes of")).to_have_value("passive")  # the one that slows down by it
    expect(changes.get_by_role("button", name=re.compile("better"))).to_have_count(6)
    expect(changes.get_by_role("button", name=re.compile("one road’s luck"))).to_have_count(2)
    changes.get_by_role("button", name=re.compile("^Rear tyre dynamic load")).first.click()
    expect(page.get_by_role("button", name="Whole run")).to_have_attribute("aria-pressed", "true")
    expect(page.get_by_role("region", name=re.compile("^Rear tyre dynamic load"))).to_be_in_viewport()

    address = dashboard.address()
    dashboard.type_into("Height", "12 cm")
    expect_new_address(page, address)
    comparison.get_by_role("button", name="Pin").click()
    expect(page.get_by_role("list", name="Pinned results")).to_contain_text("Bump height 12\u00a0cm")
    address = dashboard.address()
    dashboard.type_into("Height", "8 cm")
    expect_new_address(page, address)
    comparison.get_by_label("Group by strategy").check()
    expect(comparison.get_by_role("rowheader", name="LV control", exact=True)).to_be_visible()
    expect(comparison.locator("table").get_by_role("button", name="Bump height 12")).to_have_count(3)
