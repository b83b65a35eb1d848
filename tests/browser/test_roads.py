"""A run over several roads on the page: means, intervals, paired changes, and whose curves they are."""

import re

import pytest

from tests.browser.dashboard import LAPTOP, Dashboard, expect, expect_new_address
from tests.browser.server import Server

PEAK = '[data-cell="bump.body_acceleration.peak"]'


@pytest.mark.thorough
def test_several_roads_are_chosen_and_changes_against_a_pin_and_the_state_before_are_paired_by_road(
    dashboard: Dashboard, server: Server
) -> None:
    page, strategies = dashboard.page, ["lv", "lqr", "passive"]
    dashboard.open()
    comparison = page.get_by_role("region", name="Comparison")
    against = comparison.get_by_label("Change against")
    comparison.get_by_role("button", name="Pin").click()
    address = dashboard.address()
    dashboard.type_into("Height", "10.5")
    expect_new_address(page, address)
    against.select_option("Before the last edit")
    # A twentieth of LQR's peak is not beyond the random variation of one road, and so is no better or worse.
    expect(dashboard.row("lqr").locator(PEAK)).to_contain_text(
        re.compile(r"\+4.\d.%, not beyond the random variation of one road")
    )
    expect(dashboard.row("lqr").locator('[data-verdict="worse"]')).to_have_count(0)
    expect(page.get_by_test_id("changes-note")).to_contain_text("choose several roads")
    address, note = dashboard.address(), page.get_by_test_id("roads")
    expect(note).to_have_count(0)
    page.get_by_label("Roads").select_option("5")
    expect_new_address(page, address)
    expect(note).to_contain_text("Mean of 5 roads")
    page.set_viewport_size({"width": 1366, "height": 768})  # a laptop's, on which no metric is cut
    box = "document.querySelector('[data-intervals] table, table[data-intervals]').parentElement"
    assert page.evaluate(f"{box}.scrollWidth - {box}.clientWidth") == 0
    page.set_viewport_size(LAPTOP)
    dashboard.expect_curves()
    # What it was before and the pin were of one road: both are driven over as many.
    paper = server.post("/runs", {"scenario": {}, "strategies": strategies, "roads": 5})["id"]
    changes = server.get(f"/runs/{dashboard.run_id}/changes?against={paper}")["changes"]
    expected = {name: changes[name]["bump"]["body_acceleration"]["peak"] for name in strategies}
    assert expected["lqr"]["low"] > 0, "resolved by pairs; of independent means the interval would be 7 % wide"

    def expect_paired() -> None:
        for name, change in expected.items():
            half, size = change["high"] - change["mean"], abs(change["mean"])
            decimals = 1 if half < 0.95 else 0
            text = f"{size:.{decimals}f}\u2009±\u2009{half:.{decimals}f}\u2009%"
            expect(dashboard.row(name).locator(PEAK)).to_contain_text(text)
        expect(dashboard.row("lqr").locator(PEAK).locator('[data-verdict="worse"]')).to_be_visible()

    expect_paired()
    against.select_option("Paper’s scenario")
    expect_paired()
    assert "against=" in page.url
    page.reload()
    dashboard.expect_curves()
    expect_paired()
    comparison.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_role("menuitem", name="Unpin").click()
    comparison.get_by_role("checkbox", name="Before the last edit").uncheck()
    # Of each strategy a mean and the two edges of its band.
    expect(dashboard.panel("body_acceleration")).to_have_attribute("data-drawn", "9")
    expect(page.get_by_text("minimum to maximum of 5 roads")).to_be_visible()
    page.get_by_label("Roads").select_option("1")
    expect(note).to_have_count(0)
    expect(dashboard.panel("body_acceleration")).to_have_attribute("data-drawn", "3")
    page.get_by_label("Find a field").fill("roughness")
    dashboard.type_into("Roughness", "0")
    expect(page.get_by_test_id("changes-note")).to_have_text("A change without an arrow is zero.")
