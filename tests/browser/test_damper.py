"""A damper's curve in the form: its points are dragged, stepped and typed; one that no damper has is refused."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect


@pytest.mark.thorough
def test_a_dampers_curve_is_drawn_dragged_typed_and_refused(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_label("Find a field").fill("damper curve")
    row = page.locator("[data-pointer='/vehicle/front_damper_curve']")
    with page.expect_response("**/api/v1/runs"):
        row.get_by_role("switch").press("Space")
    point = row.get_by_role("slider", name="Point 4")
    expect(point).to_have_attribute("aria-valuetext", re.compile(r"^1.m/s, 6000.N$"))

    box = point.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    with page.expect_response("**/api/v1/live"):
        page.mouse.move(x - 20, y + 10)
    with page.expect_response("**/api/v1/runs"):
        page.mouse.up()
    expect(point).to_have_attribute("aria-valuetext", re.compile(r"^0\.8\d*.m/s, 4\d{3}.N$"))

    force = row.get_by_role("textbox", name="Point 4, force")
    force.fill("-2 kN")
    force.press("Enter")
    expect(row.get_by_role("alert")).to_contain_text("Point 4: rebound and its force are positive")
    force.fill("200")
    force.press("Enter")
    expect(row.get_by_role("alert")).to_contain_text("which has to be from 0 to 500000")
    force.fill("4.5 kN")
    force.press("Enter")
    expect(row.get_by_role("alert")).to_have_count(0)
    expect(dashboard.results).to_have_attribute("data-source", "exact")
    row.get_by_role("button", name="Add a point").click()
    expect(row.get_by_role("slider")).to_have_count(5)
    dashboard.expect_accessible(row)
    page.get_by_role("button", name="Undo").click()
    expect(row.get_by_role("slider")).to_have_count(4)
