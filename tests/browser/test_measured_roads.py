"""Files of measured roads on the page: mapped, without a bump, shorter than the paper's place of one, in all units."""

import json
import re
from math import sin
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.browser.dashboard import THOROUGH, Dashboard, expect, expect_new_address
from tests.servers.process import ROOT

PROFILE = "[data-pointer='/road/profile']"


def open_with_road(dashboard: Dashboard, file: Path) -> tuple[Page, str]:
    """Opens the first run and a road's file in its form; the page, and its address before."""
    dashboard.open()
    page, address = dashboard.page, dashboard.page.url
    page.get_by_role("button", name="Road", exact=True).click()
    page.get_by_label("Road file").set_input_files(file)
    return page, address


def wavy(length: float, head: str, scale: tuple[float, float] = (1, 1)) -> str:
    """A road without a bump, its distances [m] and heights [mm] over these scales."""
    places = [0.25 * step for step in range(int(4 * length) + 1)]
    rows = [f"{x / scale[0]:.4f},{9 * sin(x) / scale[1]:.4f}" for x in places]
    return "\n".join([head, *rows])


@pytest.mark.parametrize("length", [60, 160])
def test_a_measured_road_without_a_bump_is_driven_as_it_is(dashboard: Dashboard, tmp_path: Path, length: float) -> None:
    """At any length: a bump of height 0 has no place to end."""
    (tmp_path / "street.csv").write_text(wavy(length, "distance [m],height [mm]"))
    page, address = open_with_road(dashboard, tmp_path / "street.csv")
    row = page.locator(PROFILE)
    expect(row.get_by_text("No bump was found in it.")).to_be_visible()
    expect(row.get_by_test_id("caution")).to_have_text(re.compile("No ISO 8608 class: the road's spectrum is not a"))
    expect(row.get_by_text(re.compile(r"^IRI [\d.]+ m/km\.$"))).to_be_visible()  # and no class
    expect_new_address(page, address)
    dashboard.expect_curves()
    road = dashboard.stored_run()["scenario"]["road"]
    assert (road["length"], road["bump"]["height"]) == (length, 0)
    expect(page.locator("[data-error]")).to_have_count(0)


def test_units_are_read_in_words_and_one_that_is_not_understood_is_chosen(dashboard: Dashboard, tmp_path: Path) -> None:
    (tmp_path / "words.csv").write_text(wavy(160, "distance (feet), height (inches)", (0.3048, 25.4)))
    page, address = open_with_road(dashboard, tmp_path / "words.csv")
    expect_new_address(page, address)
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["length"] == pytest.approx(160, abs=0.01)

    (tmp_path / "old.csv").write_text(wavy(160, "distance [m],height [barleycorn]", (1, 8.4667)))
    page.get_by_label("Road file").set_input_files(tmp_path / "old.csv")
    mapping = page.get_by_role("dialog", name="Columns of old.csv")
    expect(mapping.get_by_role("alert")).to_contain_text(
        "“barleycorn”, the unit of “height [barleycorn]”, is not understood"
    )
    drive = mapping.get_by_role("button", name="Drive this road")
    expect(drive).to_be_disabled()
    mapping.get_by_label("Unit of height [barleycorn]").select_option("m")
    drive.click()
    caution = re.compile(r"The International Roughness Index of these heights is \d+ m/km; .* Is the unit")
    expect(page.get_by_role("status").filter(has_text=caution)).to_contain_text("The road “old” is opened")
    expect(page.locator(PROFILE).get_by_test_id("caution").first).to_have_text(caution)


def test_a_table_of_ones_own_is_mapped_looked_at_and_driven_over_the_bump_one_chooses(
    dashboard: Dashboard, tmp_path: Path
) -> None:
    """No header, semicolons, decimal commas, centimetres, two tracks, two humps."""
    heights = [(x, 6 * (20 < x < 24) + 9 * (80 < x < 85) + 0.2 * sin(x)) for x in (0.2 * step for step in range(601))]
    rows = [f"{x:.1f};ok;{z:.2f};{z:.2f}".replace(".", ",") for x, z in heights]
    (tmp_path / "mine.txt").write_text("\n".join(rows), encoding="utf-8")
    page, address = open_with_road(dashboard, tmp_path / "mine.txt")
    mapping = page.get_by_role("dialog", name="Columns of mine.txt")
    mapping.get_by_label("Column 2 is").select_option("left out")
    expect(mapping.get_by_text("Is this a road or a recorded drive?")).to_be_visible()
    for column, role, unit in ((1, "Distance", "m"), (3, "Left height", "cm"), (4, "Right height", "cm")):
        mapping.get_by_label(f"Column {column} is").select_option(role)
        mapping.get_by_label(f"Unit of Column {column}").select_option(unit)
    expect(mapping.get_by_role("img", name="The road as it is read")).to_contain_text("mm from the lowest")
    expect(mapping.get_by_label("Decimal commas")).to_be_checked()
    if THOROUGH:
        dashboard.expect_accessible(mapping)
    mapping.get_by_role("button", name="Drive this road").click()
    choice, row = page.get_by_label("Bump that counts"), page.locator(PROFILE)
    expect(choice.locator("option:checked")).to_contain_text("at 80 m")
    expect_new_address(page, address)
    choice.select_option(index=1)
    expect(dashboard.entry("Position")).to_have_value(re.compile(r"^(19|20)"))
    expect(row.get_by_text(re.compile(r"IRI [\d.]+ m/km \(left [\d.]+, right [\d.]+\)\. ISO 8608 c"))).to_be_visible()
    if THOROUGH:
        dashboard.expect_accessible(row)


@pytest.mark.thorough
def test_a_measured_road_is_chosen_saved_as_opencrg_and_taken_to_another_server(
    dashboard: Dashboard, tmp_path: Path
) -> None:
    page, address = open_with_road(dashboard, ROOT / "docs/roads/street.csv")
    row, choice = page.locator(PROFILE), page.locator(f"{PROFILE} select")
    expect_new_address(page, address)
    profile = choice.input_value()
    choice.select_option("None")
    expect(row.get_by_role("img", name="The road that is driven")).to_have_count(0)
    choice.select_option("street")
    expect(dashboard.entry("Length")).to_have_value("180")
    (tmp_path / "bad.csv").write_text("distance [m],height [mm]\n0,0\n1,x\n", encoding="utf-8")
    page.get_by_label("Road file").set_input_files(tmp_path / "bad.csv")
    expect(
        page.get_by_role("alert").filter(has_text="bad.csv: Line 3: A value of “height [mm]” is not a number")
    ).to_be_visible()

    grid = dashboard.downloaded(row.get_by_role("link", name="Save OpenCRG")).path().read_bytes()
    page.get_by_test_id("reset-all").click()
    (tmp_path / "street.crg").write_bytes(grid)
    page.get_by_label("Road file").set_input_files(tmp_path / "street.crg")
    expect(page.get_by_text("This is an exported road: its heights are taken as they are")).to_be_visible()
    expect(choice).to_have_value(profile)
    (tmp_path / "other.crg").write_bytes(grid.replace(b"# Ridelab road ", b"* Another road "))
    page.get_by_label("Road file").set_input_files(tmp_path / "other.crg")
    wheels = page.get_by_role("dialog", name="Wheels on other.crg")
    wheels.get_by_label("Left wheel").fill("60 cm")
    wheels.get_by_label("Right wheel").fill("-3")
    wheels.get_by_role("button", name="Drive this road").click()
    expect(wheels.get_by_role("alert")).to_contain_text("v from -1.5 m right to 1.5 m left")
    wheels.get_by_label("Right wheel").fill("−0.6")
    dashboard.expect_accessible(wheels)
    wheels.get_by_role("button", name="Drive this road").click()
    page.get_by_text(re.compile(r"^\d remarks$")).click()
    expect(page.get_by_text("Wheels run 0.6 m left of the reference line and 0.6 m right of it")).to_be_visible()
    choice.select_option("street")

    page.get_by_role("button", name="Library").click()
    page.get_by_role("textbox", name="Name", exact=True).fill("On the street")
    export = page.get_by_role("dialog").get_by_role("button", name="Export", exact=True)
    content = json.loads(dashboard.downloaded(export).path().read_text())
    content["scenario"]["road"]["profile"] = "A" * 22  # of a road that this server does not have
    (tmp_path / "street.json").write_text(json.dumps(content), encoding="utf-8")
    page.get_by_label("Files for the library").set_input_files(tmp_path / "street.json")
    expect(page.get_by_role("status").filter(has_text="The scenario “On the street” is opened")).to_be_visible()
    expect(choice).to_have_value(profile)
