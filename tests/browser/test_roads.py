"""A run over several roads on the page: means, intervals, paired changes, and whose curves they are."""

import pytest

from tests.browser.dashboard import Dashboard, expect
from tests.browser.server import Server

PEAK = '[data-cell="bump.body_acceleration.peak"]'


def expect_change(dashboard: Dashboard, strategy: str, change: dict[str, float]) -> None:
    """The table's change of the peak on the bump, with its interval, is the API's."""
    half = change["high"] - change["mean"]
    decimals = 1 if half < 0.95 else 0
    text = f"{abs(change['mean']):.{decimals}f}\u2009±\u2009{half:.{decimals}f}\u2009%"
    expect(dashboard.row(strategy).locator(PEAK)).to_contain_text(text)


@pytest.mark.thorough
def test_several_roads_are_chosen_and_changes_against_a_pin_and_the_state_before_are_paired_by_road(
    dashboard: Dashboard, server: Server
) -> None:
    page, strategies = dashboard.page, ["lv", "lqr", "passive"]
    dashboard.open()
    comparison, note = page.get_by_role("region", name="Comparison"), page.get_by_test_id("roads")
    against = comparison.get_by_label("Change against")
    comparison.get_by_role("button", name="Pin").click()
    dashboard.edit("Height", "10.5")
    against.select_option("Before the last edit")
    # A twentieth of LQR's peak is not beyond the random variation of one road, and so is no better or worse.
    expect(dashboard.row("lqr").locator(PEAK)).to_contain_text("not beyond the random variation of one road")
    with dashboard.new_address():
        page.get_by_label("Roads").select_option("5")
    expect(note).to_contain_text("Mean of 5 roads")
    # What it was before and the pin were of one road: both are driven over as many.
    paper = server.post("/runs", {"scenario": {}, "strategies": strategies, "roads": 5})["id"]
    changes = server.get(f"/runs/{dashboard.run_id}/changes?against={paper}")["changes"]
    for choice in (None, "Paper’s scenario", "after a reload"):
        if choice == "after a reload":
            page.reload()
            dashboard.expect_curves()
        elif choice:
            against.select_option(choice)
        for name in strategies:
            expect_change(dashboard, name, changes[name]["bump"]["body_acceleration"]["peak"])
        expect(dashboard.row("lqr").locator(PEAK).locator('[data-verdict="worse"]')).to_be_visible()
    comparison.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_role("menuitem", name="Unpin").click()
    comparison.get_by_role("checkbox", name="Before the last edit").uncheck()
    # Of each strategy a mean and the two edges of its band.
    expect(dashboard.panel("body_acceleration")).to_have_attribute("data-drawn", "9")
    expect(page.get_by_text("minimum to maximum of 5 roads")).to_be_visible()
    page.get_by_label("Roads").select_option("1")
    expect(note).to_have_count(0)
    expect(dashboard.panel("body_acceleration")).to_have_attribute("data-drawn", "3")
