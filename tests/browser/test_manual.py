"""The manual beside the dashboard: it is searched without a script being refused, and its questions open in the lab."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect


def test_the_manual_is_searched(dashboard: Dashboard) -> None:
    page = dashboard.page
    page.goto("/manual/")
    page.get_by_role("button", name="Search").click()
    page.get_by_role("combobox", name="Search").fill("half-car")
    page.get_by_role("option", name="half-car").first.click()
    expect(page).to_have_url(re.compile("/manual/explanation/half-car/"))


@pytest.mark.thorough
def test_a_question_of_the_gallery_opens_in_the_lab(dashboard: Dashboard) -> None:
    page = dashboard.page
    page.goto("/manual/gallery/")
    heading = page.get_by_role("heading", name="On a road that was measured?")
    heading.locator("xpath=following::a[normalize-space()='Open this scenario'][1]").click()
    dashboard.expect_curves()
    expect(page).to_have_title(re.compile("measured road, 50"))
    assert page.evaluate("Object.keys(localStorage).filter(key => key.startsWith('ridelab-library:'))") == []
