"""Curves of the form: a damper's, and sets and rules of the fuzzy speed controller; what is wrong with one is said."""

import re

import pytest

from tests.browser.dashboard import Dashboard, centre, expect

pytestmark = pytest.mark.thorough


def test_a_dampers_curve_is_drawn_typed_and_refused(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_label("Find a field").fill("damper curve")
    row = page.locator("[data-pointer='/vehicle/front_damper_curve']")
    with dashboard.new_address():
        row.get_by_role("switch").press("Space")
    point = row.get_by_role("slider", name="Point 4")
    expect(point).to_have_attribute("aria-valuetext", re.compile(r"^1.m/s, 6000.N$"))
    x, y, _ = centre(point)
    runs, live = "**/api/v1/runs", "**/api/v1/live"
    with page.expect_response(runs), dashboard.held_at(x, y) as mouse, page.expect_response(live):
        mouse.move(x - 20, y + 10)
    expect(point).to_have_attribute("aria-valuetext", re.compile(r"^0\.8\d*.m/s, 4\d{3}.N$"))
    force = row.get_by_role("textbox", name="Point 4, force")
    force.fill("-2 kN")
    force.press("Enter")
    expect(row.get_by_role("alert")).to_contain_text("Point 4: rebound and its force are positive")
    force.fill("4.5 kN")
    force.press("Enter")
    expect(row.get_by_role("alert")).to_have_count(0)
    row.get_by_role("button", name="Add a point").click()
    expect(row.get_by_role("slider")).to_have_count(5)
    dashboard.expect_accessible(row)


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
    x, y, _ = centre(peak)
    runs, fuzzy = "**/api/v1/runs", "**/api/v1/fuzzy"
    with page.expect_response(runs), dashboard.held_at(x, y) as mouse, page.expect_response(fuzzy):
        mouse.move(x + 60, y)
    expect(peak).to_have_attribute("aria-valuetext", re.compile(r"^5\d"))

    left, wrong = panel.get_by_role("textbox", name="Left foot"), panel.get_by_text("takes three ascending corners")
    for text, count in (("70", 2), ("20", 0)):
        left.fill(text)
        left.press("Enter")
        expect(wrong).to_have_count(count)
    dashboard.expect_accessible(panel)
    panel.get_by_text("Rules", exact=True).click()
    panel.get_by_label("Distance M, speed error V").select_option("V")
    expect(page.get_by_text("The scenario has its own.")).to_have_count(2)
    paper.click()
    expect(page.get_by_text("The scenario has its own.")).to_have_count(0)
