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
    expect(told).to_contain_text("LV control is best in all 8 metrics. Its peak body acceleration on the bump is")
    expect(told).to_contain_text("LV control and LQR meet the bump at 22.5 km/h, Passive at 50.0 km/h.")
    address = dashboard.address()
    page.get_by_role("button", name="Compare at equal speed").click()
    expect_new_address(page, address)
    expect(told).to_contain_text("All meet the bump at 22.5 km/h.")
    expect(page.get_by_role("button", name="Compare at equal speed")).to_have_count(0)
    changes = page.get_by_role("group", name="Changes against the state before the last edit")
    expect(changes.get_by_label("Changes of")).to_have_value("passive")  # the one that slows down by it
    expect(changes.get_by_role("button", name=re.compile("better"))).to_have_count(6)
    expect(changes.get_by_role("button", name=re.compile("random variation of one road"))).to_have_count(2)
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


def test_the_chosen_baseline_stays_when_it_is_hidden(dashboard: Dashboard) -> None:
    """In select, table, verdict, chips, report and link alike; an edit computes it, too."""
    page = dashboard.page
    dashboard.open()
    told = page.get_by_test_id("verdict").get_by_role("status")
    comparison = page.get_by_role("region", name="Comparison", exact=True)
    change = dashboard.row("lqr").locator("[data-cell='bump.body_acceleration.peak']")
    expect(told).to_contain_text("than with Passive")
    before = change.inner_text()
    dashboard.chip("Passive").click()
    expect(dashboard.row("passive")).to_have_count(0)

    def expect_baseline() -> None:
        expect(comparison.get_by_label("Change against")).to_have_value("strategy:passive")
        expect(comparison.get_by_label("Change against").locator("option:checked")).to_have_text("Passive (hidden)")
        expect(told).to_contain_text("than with Passive")
        expect(change).to_contain_text("▼ −")

    expect_baseline()
    assert change.inner_text() == before
    address = dashboard.address()
    dashboard.type_into("Height", "12 cm")
    expect_new_address(page, address)
    expect_baseline()
    assert list(dashboard.stored_run()["strategies"]) == ["lv", "lqr", "passive"]
    page.reload()
    expect_baseline()
    expect(dashboard.row("passive")).to_have_count(0)

    comparison.get_by_label("Change against").select_option("LQR")
    expect(told).to_contain_text("than with LQR")
    expect(told).not_to_contain_text("Passive")

    # Where it cannot be asked, the one before is not shown in its place: it is of another baseline.
    page.route("**/api/v1/runs/*?*compare=*", lambda route: route.fulfill(status=404))
    comparison.get_by_label("Change against").select_option("LV control")
    expect(page.get_by_test_id("verdict")).not_to_contain_text("LQR")
    expect(page.get_by_test_id("verdict")).not_to_contain_text("best")
