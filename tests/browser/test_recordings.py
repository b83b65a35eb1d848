"""A recorded drive on the page: its columns are shown before it is sent, then it is one more strategy."""

from playwright.sync_api import FilePayload, expect

from sim_core import Scenario, simulate
from tests.browser.dashboard import Dashboard

PEAK = '[data-cell="bump.body_acceleration.peak"]'


def recorded() -> bytes:
    """A passive drive over the paper's road with names and units of a test engineer's own."""
    series = simulate(Scenario(), "passive").series
    rows = zip(series["time"][::4], series["speed"][::4], series["body_acceleration"][::4] / 9.80665, strict=True)
    return ("t [s],v [m/s],acc_z\n" + "".join(f"{t:.4f},{v:.3f},{a:.5f}\n" for t, v, a in rows)).encode()


def test_a_recorded_drive_stands_beside_the_simulated_ones(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_role("button", name="Library").first.click()
    file: FilePayload = {"name": "drive.csv", "mimeType": "text/csv", "buffer": recorded()}
    page.get_by_label("Files for the library").set_input_files(file)
    dialog = page.get_by_role("dialog", name="Recorded drive “drive.csv”")
    expect(dialog.get_by_role("alert")).to_contain_text("No column is a signal to compare")
    expect(dialog.get_by_label("Signal of v [m/s]")).to_have_value("speed")
    dialog.get_by_label("Signal of acc_z").select_option("Body acceleration")
    dialog.get_by_label("Unit of acc_z").fill("N")
    dialog.get_by_role("button", name="Show the drive").click()
    expect(dialog.get_by_role("alert")).to_contain_text("Column 3, acc_z")
    dashboard.expect_accessible(dialog)
    dialog.get_by_label("Unit of acc_z").fill("g")
    dialog.get_by_role("button", name="Show the drive").click()
    expect(page.get_by_role("status").filter(has_text="“drive.csv” is shown")).to_be_visible()
    expect(page.get_by_test_id("recording")).to_contain_text("drive.csv: Its distance is its speed over its time")
    own = page.locator('tr[data-strategy^="recording:"]').first
    passive, ours = dashboard.row("passive").locator(PEAK), own.locator(PEAK)
    simulated, measured = (float(cell.get_attribute("data-value") or "nan") for cell in (passive, ours))
    assert abs(measured - simulated) < 0.02 * simulated
