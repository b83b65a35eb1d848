"""A run over several roads on the page: means, intervals, paired changes, and whose curves they are."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.dashboard import Dashboard, expect_new_address
from tests.browser.server import Server

PEAK = '[data-cell="bump.body_acceleration.peak"]'


@pytest.fixture(scope="module")
def run_id(server: Server) -> str:
    body = {"scenario": {"road": {"seed": 7}}, "strategies": ["lv", "lqr", "passive"], "roads": 3, "baseline": "lqr"}
    return str(server.post("/runs", body)["id"])


def test_a_stored_run_opens_with_its_statistics(dashboard: Dashboard, server: Server, run_id: str) -> None:
    dashboard.open(f"/r/{run_id}")
    run = server.get(f"/runs/{run_id}")
    note = dashboard.page.get_by_test_id("roads")
    expect(note).to_contain_text("Mean of 3 roads")
    expect(note).to_contain_text("road seed 7")
    expect(dashboard.row("lqr")).to_have_attribute("data-baseline", "true")
    expect(dashboard.page.get_by_label("Roads")).to_have_value("3")
    for strategy, entry in run["strategies"].items():
        cell = dashboard.row(strategy).locator(PEAK)
        interval = entry["metrics"]["bump"]["body_acceleration"]["peak"]
        expect(cell).to_have_attribute("data-value", re.compile(re.escape(f"{interval['mean']:.6f}"[:6])))
        expect(cell).to_contain_text(
            f"±\u2009{interval['high'] - interval['mean']:.{3 if interval['mean'] < 1 else 2}f}"
        )
    change = run["changes"]["lv"]["bump"]["body_acceleration"]["peak"]
    half = change["high"] - change["mean"]
    expect(dashboard.row("lv").locator(PEAK)).to_contain_text(
        f"−{abs(change['mean']):.0f}\u2009±\u2009{half:.0f}\u2009%"
    )
    dashboard.page.get_by_role("button", name="Travel, forces, comfort, time and events").click()
    expect(dashboard.page.locator('[data-cell="lv.weighted_rms"]')).to_contain_text("±")
    # Against another strategy they are paired as well, of the same run.
    dashboard.row("passive").get_by_title("Compare with Passive").click()
    change = server.get(f"/runs/{run_id}/changes?baseline=passive")["changes"]["lqr"]["bump"]["body_acceleration"][
        "peak"
    ]
    half = change["high"] - change["mean"]
    text = f"−{abs(change['mean']):.0f}\u2009±\u2009{half:.0f}\u2009%"
    expect(dashboard.row("lqr").locator(PEAK)).to_contain_text(text)
    assert dashboard.run_id == run_id
    dashboard.expect_no_wider(1440, 820, 400)
    dashboard.expect_accessible(dashboard.page.get_by_role("region", name="Comparison"))


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
    # A twentieth of LQR's peak is within one road's luck, and so is no better or worse.
    expect(dashboard.row("lqr").locator(PEAK)).to_contain_text(re.compile(r"\+4.\d.%, within one road’s luck"))
    expect(dashboard.row("lqr").locator('[data-verdict="worse"]')).to_have_count(0)
    expect(page.get_by_test_id("changes-note")).to_contain_text("choose several roads")
    address, note = dashboard.address(), page.get_by_test_id("roads")
    expect(note).to_have_count(0)
    page.get_by_label("Roads").select_option("5")
    expect_new_address(page, address)
    expect(note).to_contain_text("Mean of 5 roads")
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


def test_the_state_before_is_named_after_an_undo_and_can_be_hidden(dashboard: Dashboard) -> None:
    page = dashboard.page
    dashboard.open()
    comparison = page.get_by_role("region", name="Comparison")
    comparison.get_by_role("button", name="Pin").click()
    legend = page.locator("[data-layer]")
    expect(comparison.get_by_role("checkbox", name="Before the last edit")).to_be_disabled()
    address = dashboard.address()
    dashboard.type_into("Height", "12")
    expect_new_address(page, address)
    expect(legend).to_have_text([re.compile("before the last edit"), re.compile("Paper’s scenario")])
    entries = page.evaluate("history.length")
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(address)
    assert page.evaluate("history.length") == entries, "undos do not fill the browser's history"
    expect(legend).to_have_text([re.compile("before the undo")])
    expect(page.get_by_test_id("differences")).to_contain_text("12 → 10")
    curves = dashboard.panel("body_acceleration")
    expect(curves).to_have_attribute("data-drawn", "6")
    before = comparison.get_by_role("checkbox", name="Before the undo")
    before.uncheck()
    expect(curves).to_have_attribute("data-drawn", "3")
    expect(legend).to_have_count(0)
    expect(comparison.get_by_label("Change against")).not_to_contain_text("Before")
    page.reload()
    dashboard.expect_curves()
    expect(before).not_to_be_checked()
