"""The ECU page: what the loop changes, whether the program fits, the sources."""

import re
import zipfile
from typing import Any

from playwright.sync_api import Page

from tests.browser.dashboard import WINDOWS, Dashboard, expect
from tests.browser.server import Server
from tests.servers.process import ROOT

REPORT = ROOT / "tests/data/ecu_report.json"
SIGNALS = ("body_acceleration", "pitch_acceleration", "front_tyre_load", "rear_tyre_load")
SHORT = {
    "road": {"length": 40, "bump": {"start": 20, "height": 0.05}},
    "speed": {"initial_speed_kmh": 80, "target_speed_kmh": 80, "detection_distance": 15},
}


def run(server: Server, scenario: dict[str, Any]) -> Any:
    body = {"scenario": scenario, "strategies": ["lv", "lv_hil", "lqr"]}
    return server.post("/runs", body)


def changes(answer: dict[str, Any]) -> list[float]:
    """Of `lv_hil` against `lv` [%], in the page's order."""
    lv, hil = (answer["strategies"][name]["metrics"] for name in ("lv", "lv_hil"))
    return [
        100 * (hil[window][signal][statistic] / lv[window][signal][statistic] - 1)
        for window, statistic in WINDOWS.items()
        for signal in SIGNALS
    ]


def expect_rule(page: Page, answer: dict[str, Any]) -> None:
    """The count at the top and the marks are what the rule of ±8 % makes of the API's figures."""
    within = [abs(change) <= 8 for change in changes(answer)]
    expect(page.get_by_test_id("hil-count")).to_have_text(f"{sum(within)} of 8 within ±8\u00a0%")
    marks = page.locator("tr[data-cell] td[data-within]").evaluate_all(
        "cells => cells.map(cell => cell.dataset.within)"
    )
    assert marks == [str(each).lower() for each in within]


def test_the_loop_is_held_to_the_rule_the_report_says_what_fits_and_the_controller_is_taken_along(
    dashboard: Dashboard, server: Server
) -> None:
    """Of a made-up report, for which the page needs no compiler for ten seconds; tests/api checks the real one."""
    page = dashboard.page
    page.route("**/controller/report", lambda route: route.fulfill(path=REPORT))
    page.goto("/ecu")
    expect(page.get_by_text("This is software in the loop with the ECU’s code, not a bench")).to_be_visible()
    expect_rule(page, run(server, {}))
    page.get_by_role("region", name="Time histories").locator("section").first.scroll_into_view_if_needed()
    expect(page.locator("canvas[data-drawn]").first).to_be_visible()

    bits = page.get_by_role("textbox", name="Converter bits")
    bits.fill("3")
    bits.press("Enter")
    expect(page.get_by_role("alert")).to_have_text("Must be from 4 to 24")
    runs = "**/api/v1/runs"
    with page.expect_event("requestfailed", lambda request: '"bits":5' in (request.post_data or "")):
        with page.expect_request(runs):
            page.route(runs, lambda route: None, times=1)  # its answer does not come before the next one's
            bits.fill("5")
            bits.press("Enter")
        bits.fill("6")
        bits.press("Enter")
    expect(page).to_have_url(re.compile(r"/ecu\?run="))
    rough = run(server, {"hil": {"bits": 6}})
    assert any(abs(change) > 8 for change in changes(rough))
    expect_rule(page, rough)
    page.reload()
    expect(bits).to_have_value("6")
    expect_rule(page, rough)

    card = page.get_by_role("region", name="Build report")
    card.get_by_role("button", name="Measure", exact=True).click()
    expect(card.get_by_test_id("fits")).to_contain_text(
        "own controller does not fit: the longest step takes about 30.1 ms"
    )
    expect(card.locator("tr[data-fits=true]")).to_contain_text("5 unfinished")
    card.get_by_role("switch", name="All eight metrics").check()
    expect(card.locator("tr[data-fits=false] td")).to_have_count(15)
    dashboard.expect_accessible()
    dashboard.expect_no_wider(820, 400)
    saved = dashboard.exported("Controller (C)")
    assert saved.suggested_filename == "ridelab-controller.zip"
    with zipfile.ZipFile(saved.path()) as archive:
        assert archive.testzip() is None
        assert {"ridelab-controller/Makefile", "ridelab-controller/ridelab_controller.c"} <= set(archive.namelist())
