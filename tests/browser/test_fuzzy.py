"""The fuzzy speed controller's panel: a point that is moved changes curves, surface and drive; faults are said."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect


@pytest.mark.thorough
def test_sets_and_rules_are_edited_beside_the_drive(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_label("Find a field").fill("fuzzy")
    page.get_by_role("button", name="Edit Input sets").click()
    panel = page.get_by_role("region", name="Fuzzy speed controller")
    paper = panel.get_by_role("button", name="Back to the paper’s Table 1")
    expect(paper).to_be_disabled()
    panel.get_by_text("Distance", exact=True).click()
    panel.get_by_label("Set", exact=True).select_option("M")
    peak = panel.get_by_role("slider", name="Peak")
    expect(peak).to_have_attribute("aria-valuetext", "40\u00a0m")

    box = peak.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    with page.expect_response("**/api/v1/live"), page.expect_response("**/api/v1/fuzzy"):
        page.mouse.move(x + 60, y)
    expect(dashboard.results).to_have_attribute("data-source", "live")
    with page.expect_response("**/api/v1/runs"):
        page.mouse.up()
    expect(peak).to_have_attribute("aria-valuetext", re.compile(r"^5\d"))
    dragged = peak.get_attribute("aria-valuetext") or ""
    peak.press("Shift+ArrowRight")
    expect(panel.get_by_role("textbox", name="Peak")).to_have_value("60")  # no further than the right foot
    expect(dashboard.results).to_have_attribute("data-source", "exact")
    page.get_by_role("button", name="Undo").click()
    expect(peak).to_have_attribute("aria-valuetext", dragged)

    left = panel.get_by_role("textbox", name="Left foot")
    left.fill("70")
    left.press("Enter")
    expect(panel.get_by_text("trimf takes three ascending corners").last).to_be_visible()
    left.fill("20")
    left.press("Enter")
    expect(panel.get_by_text("trimf takes three ascending corners")).to_have_count(0)
    dashboard.expect_accessible(panel)

    panel.get_by_text("Rules", exact=True).click()
    panel.get_by_label("Distance M, speed error V").select_option("V")
    expect(page.get_by_text("The scenario has its own.")).to_have_count(2)
    dashboard.expect_accessible(panel)
    paper.click()
    expect(page.get_by_text("The scenario has its own.")).to_have_count(0)
