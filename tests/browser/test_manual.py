"""The manual beside the dashboard: it is found, searched and read without a script being refused."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect
from tests.servers.process import ROOT


def test_the_manual_is_searched(dashboard: Dashboard) -> None:
    assert (ROOT / "build/manual/index.html").is_file(), "The manual is not built: make manual builds it"
    page = dashboard.page
    page.goto("/manual/")
    expect(page.get_by_role("heading", level=1)).to_contain_text("Ridelab")
    page.get_by_role("button", name="Search").click()
    page.get_by_role("combobox", name="Search").fill("half-car")
    page.get_by_role("option", name="half-car").first.click()
    expect(page).to_have_url(re.compile("/manual/explanation/half-car/"))


@pytest.mark.parametrize(
    ("question", "title"),
    [("A van, a hump", "120 mm bump, 30 → 30 km/h"), ("On a road that was measured?", "measured road, 50")],
)
@pytest.mark.thorough
def test_a_question_of_the_gallery_opens_in_the_lab(dashboard: Dashboard, question: str, title: str) -> None:
    page = dashboard.page
    page.goto("/manual/gallery/")
    heading = page.get_by_role("heading", name=question)
    heading.locator("xpath=following::a[normalize-space()='Open this scenario'][1]").click()
    expect(page.get_by_role("status").filter(has_text="is opened")).to_be_visible()
    expect(page).to_have_title(re.compile(title))
    dashboard.expect_curves()
    assert page.evaluate("Object.keys(localStorage).filter(key => key.startsWith('ridelab-library:'))") == []
