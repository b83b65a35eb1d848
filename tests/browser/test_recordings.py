"""A recorded drive on the page: dropped on it, its columns mapped, then it is one more strategy."""

import pytest

from sim_core import Scenario, simulate
from tests.browser.dashboard import Dashboard, expect

PEAK = '[data-cell="bump.body_acceleration.peak"]'


def recorded() -> str:
    """A passive drive over the paper's road as a logger may write it: own names and units, semicolons, a lost cell."""
    series = simulate(Scenario(), "passive").series
    columns = (series["time"][::4], series["speed"][::4], series["body_acceleration"][::4] / 9.80665)
    rows = [f"{t:.4f};{v:.3f};{a:.5f};on" for t, v, a in zip(*columns, strict=True)]
    rows[40] = rows[40].rsplit(";", 2)[0] + ";;on"
    return "\n".join(["t [s];v [m/s];acc_z;lights", *(row.replace(".", ",") for row in rows), ""])


@pytest.mark.thorough
def test_a_recorded_drive_stands_beside_the_simulated_ones(dashboard: Dashboard) -> None:
    """Also after an edit and after the page is loaded anew."""
    dashboard.open()
    page = dashboard.page
    dashboard.drop({"drive.csv": recorded()})
    mapping = page.get_by_role("dialog", name="Columns of drive.csv")
    expect(mapping.get_by_label("The file is of")).to_have_value("drive")
    expect(mapping.get_by_role("alert")).to_contain_text("In which unit is “acc_z”?")
    expect(mapping.get_by_label("v [m/s] is", exact=True)).to_have_value("speed")
    expect(mapping.get_by_label("acc_z is")).to_have_value("body_acceleration")
    mapping.get_by_label("Unit of acc_z").select_option("g")
    dashboard.expect_accessible(mapping)
    with dashboard.new_address():
        mapping.get_by_role("button", name="Show the drive").click()
    own = page.locator('tr[data-strategy^="recording:"]').first

    def peaks() -> tuple[float, float]:
        cells = (dashboard.row("passive").locator(PEAK), own.locator(PEAK))
        simulated, measured = (float(cell.get_attribute("data-value") or "nan") for cell in cells)
        return simulated, measured

    simulated, measured = peaks()
    assert abs(measured - simulated) < 0.02 * simulated
    expect(own.locator('[data-cell="bump.rear_tyre_load.peak"]')).to_contain_text("–")
    page.get_by_role("region", name="Comparison", exact=True).get_by_label("Change against").select_option("drive.csv")
    expect(page.get_by_test_id("verdict")).to_contain_text("than with the recorded drive")
    dashboard.edit("Height", "8")
    expect(page.get_by_test_id("verdict")).to_contain_text("than with the recorded drive")
    page.reload()
    dashboard.expect_curves()
    expect(dashboard.chip("drive.csv")).to_be_visible()
    lower, again = peaks()
    assert lower < simulated
    assert abs(again - measured) < 0.02 * measured
