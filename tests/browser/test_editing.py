"""What-if: drag, type, undo, reset; wrong values; strategies and baseline."""

import re
from pathlib import Path

import pytest

from tests.browser.dashboard import THOROUGH, Dashboard, expect

PEAK = "td[data-cell='bump.body_acceleration.peak']"


def test_dragging_is_live_the_release_exact_and_both_are_compared_with_before(dashboard: Dashboard) -> None:
    """I changed the bump: what got better, what got worse, against what I had?"""
    dashboard.open()
    page, drawn = dashboard.page, dashboard.panel("body_acceleration")
    comparison = page.get_by_role("region", name="Comparison")
    expect(drawn).to_have_attribute("data-drawn", "3")
    before = dashboard.shown_values()
    with dashboard.new_address():
        answers = dashboard.drag(dashboard.slider("Height"), (10, 20, 30))
    assert all(answer.ok for answer in answers)
    height = float(dashboard.entry("Height").input_value())  # in cm
    assert height > 10
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == pytest.approx(height / 100)
    expect(page.get_by_role("img", name=f"Bump of height {height:g}\u00a0cm")).to_be_visible()
    dashboard.expect_table_to_be_the_stored_run()
    key = "passive bump.body_acceleration.peak"
    assert dashboard.shown_values()[key] > before[key]
    expect(dashboard.status).to_contain_text(re.compile(r"(from store|computed in [\d.]+ ms)"))

    expect(drawn).to_have_attribute("data-drawn", "6")  # the state before as thin curves
    expect(page.get_by_test_id("differences")).to_contain_text(f"Bump height 10 → {height:g}\u00a0cm")
    comparison.get_by_label("Change against").select_option("Before the last edit")
    values = dashboard.shown_values()
    for strategy in ("lv", "passive"):
        peak = f"{strategy} bump.body_acceleration.peak"
        change = 100 * (values[peak] / before[peak] - 1)
        expect(dashboard.row(strategy).locator(PEAK)).to_contain_text(f"▲ +{change:.1f}\u2009%, worse")
    comparison.get_by_label("Plot differences").check()
    expect(drawn).to_have_attribute("data-drawn", "3")
    comparison.get_by_label("Plot differences").uncheck()
    comparison.get_by_label("Change against").select_option("Passive")
    expect(dashboard.row("passive")).to_have_attribute("data-baseline", "true")

    with dashboard.new_address():
        comparison.get_by_label("Speed over the bump").select_option("Planned")  # what of it is braking?
    expect(dashboard.row("passive")).to_contain_text("22.5\u00a0km/h")
    slowed = dashboard.shown_values()
    assert slowed["lv bump.body_acceleration.peak"] == values["lv bump.body_acceleration.peak"]
    assert slowed[key] < values[key]


def test_fields_are_switched_mistyped_and_set_by_a_vehicle(dashboard: Dashboard, tmp_path: Path) -> None:
    """A class shows its number; what is wrong is told at its field and kept."""
    dashboard.open()
    page, address, alert = dashboard.page, dashboard.page.url, dashboard.page.get_by_role("alert")
    page.get_by_role("button", name="Actuator", exact=True).click()
    switch = page.get_by_role("switch", name="Bandwidth: limited")
    with dashboard.new_address():
        switch.press("Space")
    expect(dashboard.entry("Bandwidth")).to_have_value("10")
    switch.press("Space")
    expect(page).to_have_url(address)
    page.get_by_role("button", name="Road", exact=True).click()
    with dashboard.new_address():
        page.get_by_role("radiogroup", name="Road class").get_by_text("C", exact=True).click()
    expect(page.get_by_text("Class C · Gd = 256×10⁻⁶ m³")).to_be_visible()
    assert dashboard.stored_run()["scenario"]["road"]["roughness"] == 256e-6

    for text, said in (("3 kg", "Takes cm (also without a unit)"), ("3 m", "Must be from −100 to 100 cm")):
        dashboard.type_into("Height", text)
        expect(alert).to_contain_text(said)
    dashboard.edit("Width", "5")  # another edit goes through, and the wrong one stays as typed
    expect(dashboard.entry("Height")).to_have_value("3 m")
    dashboard.edit("Height", "80mm")
    expect(alert).to_have_count(0)
    bump = dashboard.stored_run()["scenario"]["road"]["bump"]
    assert (bump["height"], bump["width"]) == (0.08, 5)

    # A vehicle is chosen, saved and opened again.
    address = page.url
    page.get_by_role("button", name="Vehicle", exact=True).click()
    choice = page.get_by_role("combobox", name="Vehicle")
    with dashboard.new_address():
        choice.select_option("van_loaded")
    expect(dashboard.entry("Body mass")).to_have_value("1101.5")
    file = tmp_path / "van.json"
    dashboard.downloaded(page.get_by_role("button", name="Save file")).save_as(file)
    page.get_by_role("button", name="Undo").click()
    expect(choice).to_have_value("paper")
    expect(page).to_have_url(address)
    with dashboard.new_address():
        page.get_by_label("Vehicle file").set_input_files(file)
    expect(choice).to_have_value("van_loaded")

    # A limit between two fields, which only the server knows; its section opens even after being closed.
    section = page.get_by_role("button", name="MPC")
    section.click()
    dashboard.type_into("Control horizon", "80")
    expect(alert).to_have_text("Control horizon must not exceed the prediction horizon")
    section.click()
    expect(alert).to_be_visible()
    dashboard.edit("Prediction horizon", "90")
    expect(alert).to_have_count(0)
    mpc = dashboard.stored_run()["scenario"]["mpc"]
    assert (mpc["control_horizon"], mpc["prediction_horizon"]) == (80, 90)


SHEET = {
    "Front axle load": "1.2 t",
    "Rear axle load": "1200",
    "Front unsprung mass": "70",
    "Rear unsprung mass": "60",
    "Wheelbase": "2.6",
    "Front natural frequency": "1.2",
    "Rear natural frequency": "1.4",
    "Front damping ratio": "0.25",
    "Rear damping ratio": "0.3",
    "Front tyre stiffness": "200 N/mm",
    "Rear tyre stiffness": "200000",
}


def test_a_whole_cars_data_sheet_becomes_one_track_and_its_mass_on_one_track_is_cautioned(dashboard: Dashboard) -> None:
    dashboard.open()
    page, cautions = dashboard.page, dashboard.page.get_by_test_id("caution")
    page.get_by_role("button", name="Vehicle", exact=True).click()
    # The paper's own sag is said at its spring, and not beside each result of its scenario.
    expect(cautions).to_have_text(re.compile(r"by 300 mm at the front axle.* the paper's own values \(Table 2\)\.$"))
    page.get_by_role("button", name="Data sheet…").click()
    sheet = page.get_by_role("dialog", name="A whole car’s data sheet")
    apply = sheet.get_by_role("button", name="Take it as the vehicle")
    for name, text in SHEET.items():
        expect(apply).to_be_disabled()
        sheet.get_by_label(name).fill(text)
    outcome = sheet.get_by_role("region", name="What becomes of a car of 2400 kg: one track of two")
    expect(outcome.get_by_role("row", name="Body mass, one track of two")).to_contain_text("1135 kg")
    sheet.get_by_label("Rear tyre stiffness").fill("40000")
    expect(sheet.get_by_text("The tyre alone is softer than this frequency needs")).to_be_visible()
    sheet.get_by_label("Rear tyre stiffness").fill("200000 kg")
    expect(sheet.get_by_text("Takes N/m (also without a unit), kN/m or N/mm")).to_be_visible()
    sheet.get_by_label("Rear tyre stiffness").fill("200000")
    sheet.get_by_label("Front natural frequency").fill("0.6")
    expect(sheet.get_by_test_id("caution")).to_contain_text("compresses the suspension by 662 mm at the front axle")
    dashboard.expect_accessible(sheet)
    sheet.get_by_label("Front natural frequency").fill("1.2")
    with dashboard.new_address():
        apply.click()
    expect(dashboard.entry("Body mass")).to_have_value("1135")
    expect(cautions).to_have_count(0)
    dashboard.type_into("Body mass", "2400")  # the whole car's, on one track's springs
    expect(dashboard.results.get_by_test_id("caution")).to_contain_text("are those of one track, half of the car.")


def test_a_field_that_nothing_shown_uses_says_who_does(dashboard: Dashboard) -> None:
    """As strategies are shown and hidden, and as switches of the scenario change."""
    dashboard.open()
    page = dashboard.page
    search, unused = page.get_by_label("Find a field"), page.get_by_test_id("unused")
    search.fill("Sensor noise")
    noise = page.locator("[data-pointer='/hil/noise']").first.get_by_test_id("unused")
    expect(noise).to_have_text("No shown strategy uses this. LV as ECU code does.")
    dashboard.toggle("LV as ECU code")
    expect(noise).to_have_count(0)
    search.fill("MPC preview")
    page.get_by_label("Preview", exact=True).select_option("None")
    search.fill("Preview noise")
    expect(unused.first).to_have_text("Used only with MPC preview: Lookahead")
    expect(dashboard.entry("Preview noise")).to_be_disabled()
    for name in ("LV control", "LV as ECU code", "LQR", "Passive"):
        dashboard.chip(name).click()
    expect(page.get_by_role("heading", name="No strategy chosen")).to_be_visible()
    page.get_by_role("button", name="Show all strategies").click()
    expect(dashboard.row("lqr")).to_be_visible()


def test_presets_and_own_scenarios_are_opened_saved_and_imported(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_role("button", name="Library").click()
    with dashboard.new_address():
        page.get_by_role("list", name="Presets").get_by_role("button", name="Pothole").click()
    expect(dashboard.entry("Height")).to_have_value("-6")
    expect(page).to_have_title(re.compile("60 mm pothole"))

    page.keyboard.press("Control+s")
    page.get_by_role("textbox", name="Name", exact=True).fill("My pothole")
    page.keyboard.press("Enter")
    expect(page.get_by_role("status").filter(has_text="in the library as “My pothole”")).to_be_visible()
    dashboard.drop({"hump.json": '{"road": {"bump": {"height": 0.12}}}', "photo.png": "?"})
    alert = page.get_by_role("alert").filter(has_text="photo.png: There are no rows of numbers in this file")
    expect(alert.filter(has_text="The scenario “hump” is opened, and in the library")).to_be_visible()
    expect(dashboard.entry("Height")).to_have_value("12")

    page.get_by_role("button", name="Library").click()
    own = page.get_by_role("list", name="Your scenarios")
    expect(own.get_by_role("button", name="Bump height 10 → 12\u00a0cm")).to_be_visible()
    if THOROUGH:
        dashboard.expect_accessible(page.get_by_role("dialog"))
    page.get_by_role("button", name="Rename, export or delete My pothole").click()
    page.get_by_role("menuitem", name="Rename").press("Enter")
    page.get_by_role("textbox", name="New name").fill("Flat")
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Rename, export or delete Flat")).to_be_focused()
    own.get_by_role("button", name="Flat Bump shape").click()
    expect(dashboard.entry("Height")).to_have_value("-6")
    page.keyboard.press("Control+z")
    expect(dashboard.entry("Height")).to_have_value("12")
