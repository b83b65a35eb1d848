"""What the lab says at first sight: who won, what an edit changed, and which curve is whose."""

import re

from tests.browser.dashboard import Dashboard, expect


def test_says_who_won_which_curve_is_whose_and_what_an_edit_changed(dashboard: Dashboard) -> None:
    page = dashboard.page
    dashboard.open()
    panel, picture = dashboard.panel("body_acceleration"), "canvas => canvas.toDataURL()"
    before = panel.evaluate(picture)
    entry = page.get_by_title("Make LQR stand out")
    for same in ("!==", "==="):
        entry.click()
        page.mouse.move(0, 0)
        panel.scroll_into_view_if_needed()
        drawn = f"([canvas, before]) => ({picture})(canvas) {same} before"
        page.wait_for_function(drawn, arg=[panel.element_handle(), before])

    comparison = page.get_by_role("region", name="Comparison", exact=True)
    told = page.get_by_test_id("verdict").get_by_role("status")
    expect(told).to_contain_text("LV control is best in all 8 metrics.")
    expect(told).to_contain_text("LV control and LQR meet the bump at 22.5 km/h, Passive at 50.0 km/h.")
    with dashboard.new_address():
        page.get_by_role("button", name="Compare at equal speed").click()
    expect(told).to_contain_text("All meet the bump at 22.5 km/h.")
    changes = page.get_by_role("group", name="Changes against the state before the last edit")
    expect(changes.get_by_label("Changes of")).to_have_value("passive")  # the one that slows down by it
    expect(changes.get_by_role("button", name=re.compile("better"))).to_have_count(6)
    expect(changes.get_by_role("button", name=re.compile("random variation of one road"))).to_have_count(2)
    changes.get_by_role("button", name=re.compile("^Rear tyre dynamic load")).first.click()
    expect(page.get_by_role("button", name="Whole run")).to_have_attribute("aria-pressed", "true")
    expect(page.get_by_role("region", name=re.compile("^Rear tyre dynamic load"))).to_be_in_viewport()
    dashboard.edit("Height", "12 cm")
    comparison.get_by_role("button", name="Pin").click()
    expect(page.get_by_role("list", name="Pinned results")).to_contain_text("Bump height 12\u00a0cm")
