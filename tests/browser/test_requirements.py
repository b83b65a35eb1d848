"""What the strategies are held to: set in a list, marked in words where the numbers stand, kept by address and link."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect

PEAK = "bump.body_acceleration.peak"
TITLE = "Body acceleration, peak, bump"


@pytest.mark.thorough
def test_a_limit_is_set_marked_and_kept(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    card = page.get_by_role("region", name="Requirements")
    card.get_by_label("Hold a metric to a limit").fill("body acceleration, peak, b")
    page.get_by_role("listbox").get_by_role("option", name=TITLE).click()
    limit = card.get_by_role("textbox", name=f"{TITLE}, at most")
    limit.fill("0.1 g")
    limit.press("Enter")
    expect(limit).to_have_value("0.980665")
    results = card.get_by_role("list", name=f"{TITLE}: results").get_by_role("listitem")
    expect(results).to_have_text([re.compile(r"LV control 0.898\d* m/s²\s+pass"), re.compile(r"LQR 1.47\d* .*\s+fail")])
    for strategy, word in (("lv", "pass"), ("lqr", "fail")):
        expect(dashboard.row(strategy).locator(f'[data-cell="{PEAK}"]')).to_contain_text(word)
    card.get_by_label(f"{TITLE}: kind of limit").select_option("changes by at most")
    limit = card.get_by_role("textbox", name=f"{TITLE}, changes by at most")
    limit.fill("-80")
    limit.press("Enter")
    card.get_by_label(f"{TITLE}: of which strategies").select_option("LQR")
    failed = [re.compile(r"LQR [-−]76[.]2 %\s+fail")]
    expect(results).to_have_text(failed)
    assert page.url.endswith(f"?require=lqr:{PEAK}%3C-80%25")
    dashboard.expect_accessible(card)
    page.reload()
    expect(results).to_have_text(failed)
    card.get_by_role("button", name="Keep this set").click()
    library = page.get_by_role("dialog", name="Library")
    library.get_by_label("Name", exact=True).fill("Ride")
    library.get_by_role("button", name="Save").click()
    card.get_by_role("button", name=f"Remove the requirement of {TITLE}").click()
    expect(page.locator("[data-result]")).to_have_count(0)
    page.get_by_role("button", name="Library").first.click()
    library.get_by_role("button", name=re.compile(f"^Ride ?lqr:{PEAK}<-80%")).click()
    expect(results).to_have_text(failed)
    dashboard.drag(dashboard.slider("Height"), (-20,))
    expect(results).to_have_text([re.compile(r"LQR [-−]\d\d[.]\d %\s+(fail|pass)")])
