"""A click into a plot says why this force, here; the panel follows the cursor, and a link leads to it."""

import re

import pytest

from tests.browser.dashboard import THOROUGH, Dashboard, centre, expect


def test_a_click_says_why_the_panel_follows_the_cursor_and_a_link_leads_there(dashboard: Dashboard) -> None:
    dashboard.open()
    page, panel = dashboard.page, dashboard.page.get_by_role("region", name="Why this force?")
    plot = page.locator("section[data-figure=body_acceleration] canvas")
    x, y, width = centre(plot)
    page.mouse.click(x, y)
    place, why = panel.get_by_test_id("instant-place"), panel.get_by_test_id("why")
    expect(place).to_contain_text("stage bump")
    expect(why).to_have_text(re.compile(r".+\.$"))
    expect(panel.locator("canvas[data-drawn]")).to_have_count(3)
    expect(panel.get_by_role("region", name="Limits").get_by_role("row")).to_have_count(5)
    expect(panel.get_by_role("region", name="Cost of the plan by term")).to_be_visible()
    before = place.inner_text()
    x, y, width = centre(plot)
    page.mouse.move(x - 0.2 * width, y)
    expect(place).not_to_have_text(before)
    panel.get_by_label("Whose controller").select_option("passive")
    expect(why).to_have_text("There are no actuators, so there is no force.")
    if THOROUGH:
        dashboard.expect_accessible(panel)
    panel.get_by_label("Whose controller").select_option("lv")
    panel.get_by_role("button", name="Copy a link to this instant").click()
    expect(page).to_have_url(re.compile(r"instant=lv~[\d.]+"))
    address = page.url
    page.keyboard.press("Escape")
    expect(panel).to_have_count(0)
    expect(page).not_to_have_url(re.compile("instant="))
    page.keyboard.press("w")
    expect(place).to_contain_text("stage bump")
    dashboard.open(re.sub(r"~[\d.]+", "~20", address))  # far from the bump: the plots' window goes there
    expect(place).to_contain_text("20.00 m")
    expect(page).to_have_url(re.compile("zoom="))


@pytest.mark.thorough
def test_responses_bands_and_margins_follow_a_dragged_value(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    part = page.get_by_role("region", name="Frequencies", exact=True)
    part.get_by_role("button", name="Show").click()
    bands = part.get_by_role("region", name="RMS on this road by frequency")
    expect(part.locator("canvas[data-drawn='3']")).to_have_count(4)
    expect(bands.get_by_role("row")).to_have_count(4)
    before = bands.inner_text()
    dashboard.expect_accessible(part)
    slider = dashboard.slider("Target speed")
    slider.scroll_into_view_if_needed()
    with page.expect_response("**/api/v1/frequency"):
        dashboard.drag(slider, (10, 20))
    expect(bands).not_to_have_text(before)
    part.get_by_label("Response from the road to").select_option("front_tyre_load")
    expect(bands).to_contain_text("N")
