"""Flows of the lab and the tuner whose parts tests of api, the page's own and shorter ones in the browser hold."""

import json
import re
from pathlib import Path

import pytest

from tests.browser.dashboard import Dashboard, expect, expect_new_address
from tests.browser.server import Server
from tests.browser.test_measured_roads import open_with_road
from tests.browser.test_roads import PEAK
from tests.browser.test_tuner import expect_state, stored, submit
from tests.servers.process import ROOT

ROADS = ROOT / "docs/roads"


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


def test_a_measured_road_is_driven_taken_off_chosen_saved_and_taken_to_another_server(
    dashboard: Dashboard, tmp_path: Path
) -> None:
    page, address = open_with_road(dashboard, ROADS / "street.csv")
    remarks = page.get_by_text(re.compile(r"^\d remarks$"))
    remarks.click()
    expect(page.get_by_text("Bumps in it: 71 mm at 100.1 m over 3.6 m.")).to_be_visible()
    expect(page.get_by_text("The mean of left and right track is taken")).to_be_visible()
    expect(dashboard.entry("Length")).to_have_value("180")
    expect(dashboard.entry("Height")).to_have_value("0")
    expect_new_address(page, address)
    road = dashboard.stored_run()["scenario"]["road"]
    assert (len(road["profile"]), road["bump"]["start"]) == (22, 100.1)
    (tmp_path / "bad.csv").write_text("distance [m],height [mm]\n0,0\n1,x\n", encoding="utf-8")
    page.get_by_label("Road file").set_input_files(tmp_path / "bad.csv")
    expect(page.get_by_role("alert").filter(has_text="bad.csv: Line 3: A value is not a number")).to_be_visible()
    page.get_by_test_id("reset-all").click()
    expect(page).to_have_url(address)
    expect(page.get_by_text("Bumps in it")).to_have_count(0)

    page.get_by_label("Road file").set_input_files(ROADS / "street.csv")
    choice = page.locator("[data-pointer='/road/profile'] select")
    expect(choice.locator("option:checked")).to_have_text("street")
    profile = choice.input_value()
    dashboard.expect_accessible(page.locator("[data-pointer='/road/profile']"))
    choice.select_option("None")
    expect(page.get_by_text("Bumps in it")).to_have_count(0)
    choice.select_option("street")
    expect(dashboard.entry("Length")).to_have_value("180")
    with page.expect_download() as saved:
        page.get_by_role("link", name="Save CSV").click()
    first, columns = saved.value.path().read_text().splitlines()[:2]
    assert first.startswith(f"# Ridelab road {profile}: ")
    assert columns == "distance [m],height [m]"

    row = page.locator("[data-pointer='/road/profile']")
    with page.expect_download() as saved:
        row.get_by_role("link", name="Save OpenCRG").click()
    saved.value.save_as(tmp_path / "street.crg")
    page.get_by_test_id("reset-all").click()
    expect(row.get_by_role("img", name="The road that is driven")).to_have_count(0)
    page.get_by_label("Road file").set_input_files(tmp_path / "street.crg")
    expect(page.get_by_text("This is an exported road: its heights are taken as they are")).to_be_visible()
    expect(choice).to_have_value(profile)
    grid = (tmp_path / "street.crg").read_bytes().replace(b"# Ridelab road ", b"* Another road ")
    (tmp_path / "other.crg").write_bytes(grid)
    page.get_by_label("Road file").set_input_files(tmp_path / "other.crg")
    wheels = page.get_by_role("dialog", name="Wheels on other.crg")
    wheels.get_by_label("Left wheel").fill("60 cm")
    wheels.get_by_label("Right wheel").fill("-3")
    dashboard.expect_accessible(wheels)
    wheels.get_by_role("button", name="Drive this road").click()
    expect(wheels.get_by_role("alert")).to_contain_text("are within the road: v from -1.5 m right to 1.5 m left")
    wheels.get_by_label("Right wheel").fill("−0.6")
    wheels.get_by_role("button", name="Drive this road").click()
    remarks.click()
    expect(page.get_by_text("Wheels run 0.6 m left of the reference line and 0.6 m right of it")).to_be_visible()
    choice.select_option("street")

    page.get_by_role("button", name="Library").click()
    page.get_by_role("textbox", name="Name", exact=True).fill("On the street")
    with page.expect_download() as saved:
        page.get_by_role("dialog").get_by_role("button", name="Export", exact=True).click()
    content = json.loads(saved.value.path().read_text())
    assert content["measured_road"].startswith(first)
    content["scenario"]["road"]["profile"] = "A" * 22  # of a road that this server does not have
    content["scenario"]["road"]["bump"]["width"] = 3
    (tmp_path / "street.json").write_text(json.dumps(content), encoding="utf-8")
    page.get_by_label("Files for the library").set_input_files(tmp_path / "street.json")
    expect(page.get_by_role("status").filter(has_text="The scenario “On the street” is opened")).to_be_visible()
    expect(choice).to_have_value(profile)
    content |= {"schema_version": 99}
    wrong = {"road": {"bump": {"height": 5}}}
    dashboard.drop({"new.json": json.dumps(content), "high.json": json.dumps(wrong)})
    alert = page.get_by_role("alert").filter(has_text="new.json: This file comes from a newer version of Ridelab")
    expect(alert).to_contain_text("high.json: Bump height: Must be from −100 to 100\u00a0cm; the file has 500\u00a0cm")


def test_a_tuning_is_cancelled_and_goes_on(dashboard: Dashboard, server: Server) -> None:
    """It is far longer than any click takes: nothing here waits for its end."""
    page = dashboard.page
    tuning = submit(server, scenario={}, trials=3000, population=4, seeds=list(range(1, 9)))
    page.goto(f"/tuner/{tuning}")
    expect_state(page, "Searching")
    expect(page.get_by_test_id("tuning-counts")).to_contain_text(re.compile(r"^[1-9]\d* of 3000 trials"))
    page.get_by_role("button", name="Cancel").click()
    expect_state(page, "Cancelled; complete generations are kept")
    done = stored(server, tuning)["trials"]["done"]
    expect(page.get_by_text("The comparison is made once the search is complete")).to_be_visible()
    page.get_by_label("Trials in all").fill("10")
    expect(page.get_by_role("button", name="Resume")).to_be_disabled()
    page.get_by_label("Trials in all").fill("3000")
    page.get_by_role("button", name="Resume").click()
    expect_state(page, "Searching")
    page.wait_for_function(
        "done => Number(document.querySelector('[data-testid=tuning-counts]').textContent.split(' ')[0]) > done",
        arg=done,
    )
    page.get_by_role("button", name="Cancel").click()
    expect_state(page, "Cancelled; complete generations are kept")

    page.get_by_role("link", name="New tuning").click()
    entry = page.get_by_role("region", name="Earlier tunings").locator(f"a[href='/tuner/{tuning}']")
    expect(entry).to_contain_text("cancelled")
