"""What-if: drag, type, undo, reset; wrong values; strategies and baseline."""

import re
from pathlib import Path

import pytest

from tests.browser.dashboard import THOROUGH, Dashboard, expect, expect_new_address


def test_dragging_is_live_the_release_exact_and_both_are_compared_with_before(dashboard: Dashboard) -> None:
    """I changed the bump: what got better, what got worse, against what I had?"""
    dashboard.open()
    drawn = dashboard.panel("body_acceleration")
    expect(drawn).to_have_attribute("data-drawn", "3")
    before, address = dashboard.shown_values(), dashboard.page.url
    answers = dashboard.drag(dashboard.slider("Height"), (10, 20, 30))
    assert all(answer.ok for answer in answers)

    expect(dashboard.results).to_have_attribute("data-source", "exact")
    expect_new_address(dashboard.page, address)
    height = float(dashboard.entry("Height").input_value())  # in cm
    assert height > 10
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == pytest.approx(height / 100)
    expect(dashboard.page.get_by_role("img", name=f"Bump of height {height:g}\u00a0cm")).to_be_visible()
    dashboard.expect_table_to_be_the_stored_run()
    key = "passive bump.body_acceleration.peak"
    assert dashboard.shown_values()[key] > before[key]
    expect(dashboard.status).to_contain_text(re.compile(r"(from store|computed in [\d.]+ ms)"))

    expect(drawn).to_have_attribute("data-drawn", "6")  # the state before as thin curves
    expect(dashboard.page.get_by_test_id("differences")).to_contain_text(f"Bump height 10 → {height:g}\u00a0cm")
    dashboard.page.get_by_label("Change against").select_option("Before the last edit")
    values = dashboard.shown_values()
    for strategy in ("lv", "passive"):
        peak = f"{strategy} bump.body_acceleration.peak"
        cell = dashboard.row(strategy).locator("td[data-cell='bump.body_acceleration.peak']")
        expect(cell).to_contain_text(f"▲ +{100 * (values[peak] / before[peak] - 1):.1f}\u2009%, worse")
    expect(dashboard.row("passive")).to_contain_text("50.0\u00a0km/h")
    comparison = dashboard.page.get_by_role("region", name="Comparison")
    comparison.get_by_label("Plot differences").check()
    expect(drawn).to_have_attribute("data-drawn", "3")
    body = dashboard.page.get_by_role("region", name="Body acceleration")
    expect(body).to_contain_text("change against before the last edit")
    comparison.get_by_label("Plot differences").uncheck()
    expect(drawn).to_have_attribute("data-drawn", "6")
    comparison.get_by_label("Change against").select_option("Passive")
    expect(dashboard.row("passive")).to_have_attribute("data-baseline", "true")

    comparison.get_by_label("Speed over the bump").select_option("Planned")  # what of it is braking?
    expect(dashboard.row("passive")).to_contain_text("22.5\u00a0km/h")
    assert dashboard.stored_run()["scenario"]["speed"]["policy"] == "planned"
    slowed = dashboard.shown_values()
    assert slowed["lv bump.body_acceleration.peak"] == values["lv bump.body_acceleration.peak"]
    assert slowed[key] < values[key]


def test_fields_are_switched_mistyped_and_set_by_a_vehicle(dashboard: Dashboard, tmp_path: Path) -> None:
    """A class shows its number; what is wrong is told at its field and kept."""
    dashboard.open()
    page, address = dashboard.page, dashboard.page.url
    page.get_by_role("button", name="Actuator", exact=True).click()
    switch = page.get_by_role("switch", name="Bandwidth: limited")
    expect(switch).not_to_be_checked()
    switch.press("Space")
    expect(dashboard.entry("Bandwidth")).to_have_value("10")
    expect_new_address(page, address)
    assert dashboard.stored_run()["scenario"]["actuator"]["bandwidth"] == 10
    switch.press("Space")
    expect(page).to_have_url(address)

    page.get_by_role("button", name="Road", exact=True).click()
    expect(page.get_by_text("Class B · Gd = 64×10⁻⁶ m³")).to_be_visible()
    page.get_by_role("radiogroup", name="Road class").get_by_text("C", exact=True).click()
    expect(page.get_by_text("Class C · Gd = 256×10⁻⁶ m³")).to_be_visible()
    expect_new_address(page, address)
    assert dashboard.stored_run()["scenario"]["road"]["roughness"] == 256e-6

    dashboard.expect_curves()
    address = page.url
    dashboard.type_into("Height", "3 kg")
    expect(page.get_by_role("alert")).to_have_text("Takes cm (also without a unit), m, mm, km, in, ft or µm")
    dashboard.type_into("Height", "3 m")
    expect(page.get_by_role("alert")).to_have_text("Must be from −100 to 100 cm")
    expect(dashboard.entry("Height")).to_have_value("3 m")
    dashboard.type_into("Width", "5")  # another edit goes through, and the wrong one stays as typed
    expect_new_address(page, address)
    expect(dashboard.entry("Height")).to_have_value("3 m")
    address = page.url
    dashboard.type_into("Height", "80mm")
    expect(page.get_by_role("alert")).to_have_count(0)
    expect_new_address(page, address)
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["bump"] == {
        "count": 1,
        "spacing": 10,
        "shape": "cosine",
        "height": 0.08,
        "width": 5,
        "start": 100,
    }

    # A vehicle is chosen, saved and opened again.
    dashboard.expect_curves()
    address = page.url
    page.get_by_role("button", name="Vehicle", exact=True).click()
    choice = page.get_by_role("combobox", name="Vehicle")
    choice.select_option("van_loaded")
    expect(dashboard.entry("Body mass")).to_have_value("1101.5")
    expect(page.get_by_text("The same van with 887 kg")).to_be_visible()
    expect_new_address(page, address)
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save file").click()
    file = tmp_path / saved.value.suggested_filename
    saved.value.save_as(file)
    page.get_by_role("button", name="Undo").click()
    expect(choice).to_have_value("paper")
    expect(page).to_have_url(address)
    page.get_by_label("Vehicle file").set_input_files(file)
    expect(choice).to_have_value("van_loaded")
    expect_new_address(page, address)
    dashboard.expect_curves()

    # A limit between two fields, which only the server knows; its section opens even after being closed.
    address = page.url
    section = page.get_by_role("button", name="MPC")
    section.click()
    dashboard.type_into("Control horizon", "80")
    alert = page.get_by_role("alert")
    expect(alert).to_have_text("Control horizon must not exceed the prediction horizon")
    section.click()
    expect(alert).to_be_visible()
    expect(dashboard.entry("Control horizon")).to_have_value("80")

    dashboard.type_into("Prediction horizon", "90")
    expect(alert).to_have_count(0)
    expect_new_address(page, address)
    dashboard.expect_curves()
    mpc = dashboard.stored_run()["scenario"]["mpc"]
    assert (mpc["control_horizon"], mpc["prediction_horizon"]) == (80, 90)

    file.write_text("no vehicle", encoding="utf-8")
    page.get_by_label("Vehicle file").set_input_files(file)
    expect(page.get_by_role("alert").filter(has_text=f"{file.name}: This file is not JSON")).to_be_visible()


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
    "Rear tyre stiffness": "40000",
}


def test_a_whole_cars_data_sheet_becomes_one_track_and_its_mass_on_one_track_is_cautioned(dashboard: Dashboard) -> None:
    dashboard.open()
    page, address, cautions = dashboard.page, dashboard.page.url, dashboard.page.get_by_test_id("caution")
    page.get_by_role("button", name="Vehicle", exact=True).click()
    expect(page.locator("[data-pointer='/vehicle/body_mass']").get_by_test_id("note")).to_have_text("one track of two")
    # The paper's own sag is said at its spring, and not beside each result of its scenario.
    expect(cautions).to_have_text(re.compile(r"by 300 mm at the front axle.* the paper's own values \(Table 2\)\.$"))
    page.get_by_role("button", name="Data sheet…").click()
    sheet = page.get_by_role("dialog", name="A whole car’s data sheet")
    apply = sheet.get_by_role("button", name="Take it as the vehicle")
    for name, text in SHEET.items():
        expect(apply).to_be_disabled()
        sheet.get_by_label(name).fill(text)
    rear = sheet.get_by_label("Rear natural frequency")
    expect(rear).to_have_attribute("aria-invalid", "true")
    expect(sheet.get_by_text("The tyre alone is softer than this frequency needs")).to_be_visible()
    expect(apply).to_be_disabled()
    sheet.get_by_label("Rear tyre stiffness").fill("200000 kg")
    expect(sheet.get_by_text("Takes N/m (also without a unit), kN/m or N/mm")).to_be_visible()
    sheet.get_by_label("Rear tyre stiffness").fill("200000")
    outcome = sheet.get_by_role("region", name="What becomes of a car of 2400 kg: one track of two")
    expect(outcome.get_by_role("row", name="Body mass, one track of two")).to_contain_text("1135 kg")
    expect(sheet.get_by_role("row", name="Natural frequency, body")).to_contain_text("1.20 Hz, ζ 0.25")
    dashboard.expect_accessible(sheet)
    sheet.get_by_label("Front natural frequency").fill("0.6")
    caution = sheet.get_by_test_id("caution")
    expect(caution).to_contain_text("compresses the suspension by 662 mm at the front axle")
    warned, table = caution.bounding_box(), outcome.bounding_box()
    assert warned is not None
    assert table is not None
    assert warned["y"] + warned["height"] <= table["y"]
    sheet.get_by_label("Front natural frequency").fill("1.2")
    apply.click()
    expect(dashboard.entry("Body mass")).to_have_value("1135")
    expect_new_address(page, address)
    dashboard.expect_curves()
    expect(cautions).to_have_count(0)
    dashboard.type_into("Body mass", "2400")  # the whole car's, on one track's springs
    expect(cautions).to_have_count(2)
    expect(dashboard.results.get_by_test_id("caution")).to_contain_text("are those of one track, half of the car.")
    for _ in range(2):
        page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(address)


def test_a_field_that_nothing_shown_uses_says_who_does(dashboard: Dashboard) -> None:
    """As strategies are shown and hidden, and as switches of the scenario change."""
    dashboard.open()
    page, address = dashboard.page, dashboard.page.url
    search, unused = page.get_by_label("Find a field"), page.get_by_test_id("unused")
    shown = ("LV control", "LQR", "Passive")
    search.fill("Sensor noise")
    noise = page.locator("[data-pointer='/hil/noise']").first
    expect(noise.get_by_test_id("unused")).to_have_text("No shown strategy uses this. LV as ECU code does.")
    expect(dashboard.entry("Sensor noise")).to_be_enabled()
    dashboard.toggle("LV as ECU code")
    expect(noise.get_by_test_id("unused")).to_have_count(0)
    dashboard.toggle("LV as ECU code")
    expect(noise.get_by_test_id("unused")).to_have_count(1)
    search.fill("Preview noise")
    expect(unused).to_have_count(0)
    dashboard.chip("LV control").click()
    expect(unused.first).to_have_text(
        "No shown strategy uses this. LV control, LV as ECU code and Single suspension control do."
    )
    dashboard.chip("LV control").click()
    search.fill("MPC preview")
    page.get_by_label("Preview", exact=True).select_option("None")
    search.fill("Preview noise")
    expect(unused.first).to_have_text("Used only with MPC preview: Lookahead")
    expect(dashboard.entry("Preview noise")).to_be_disabled()
    search.fill("skyhook damping")
    damping = page.locator("[data-pointer='/hook/skyhook_damping']").first
    expect(damping.get_by_test_id("unused")).to_have_text("No shown strategy uses this. Skyhook and Hybrid hook do.")
    search.fill("least damping")
    expect(unused).to_have_text("Used only with Semi-active: On, by Skyhook, Groundhook and Hybrid hook.")
    search.fill("bump")
    expect(page.get_by_role("img", name=re.compile("^Bump of height 10 cm"))).to_be_visible()
    for name in shown:
        dashboard.chip(name).click()
    expect(page.get_by_role("img", name=re.compile("^Bump of height 10 cm"))).to_be_visible()
    expect(page.locator("[data-pointer='/road/bump/spacing']").get_by_test_id("unused")).to_have_text(
        "Without effect with Bumps: 1"
    )
    dashboard.type_into("Height", "8")
    expect(page.get_by_text("The bump is drawn as soon as a strategy is shown.")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    for name in shown:
        dashboard.chip(name).click()
    page.get_by_role("button", name="Undo").click()
    expect(page).to_have_url(address)


def test_presets_and_own_scenarios_are_opened_saved_and_imported(dashboard: Dashboard) -> None:
    dashboard.open()
    page, address = dashboard.page, dashboard.page.url
    page.get_by_role("button", name="Library").click()
    page.get_by_role("list", name="Presets").get_by_role("button", name="Pothole").click()
    expect(dashboard.entry("Height")).to_have_value("-6")
    expect_new_address(page, address)
    expect(page).to_have_title(re.compile("60 mm pothole"))

    page.keyboard.press("Control+s")
    page.get_by_role("textbox", name="Name", exact=True).fill("My pothole")
    page.keyboard.press("Enter")
    expect(page.get_by_role("status").filter(has_text="in the library as “My pothole”")).to_be_visible()
    dashboard.drop({"hump.json": '{"road": {"bump": {"height": 0.12}}}', "photo.png": "?"})
    alert = page.get_by_role("alert").filter(has_text="photo.png: Expected a scenario, a vehicle or requirements")
    expect(alert.filter(has_text="The scenario “hump” is opened, and in the library")).to_be_visible()
    expect(dashboard.entry("Height")).to_have_value("12")

    page.get_by_role("button", name="Library").click()
    own = page.get_by_role("list", name="Your scenarios")
    expect(own.get_by_role("button", name="Bump height 10 → 12\u00a0cm")).to_be_visible()
    if THOROUGH:
        dashboard.expect_accessible(page.get_by_role("dialog"))
    # Renaming gives the focus back to the menu.
    for answer, after in (("Close", "My pothole"), ("Rename", "Flat")):
        page.get_by_role("button", name="Rename, export or delete My pothole").focus()
        page.keyboard.press("Enter")
        page.get_by_role("menuitem", name="Rename").press("Enter")
        entry = page.get_by_role("textbox", name="New name")
        expect(entry).to_be_focused()
        entry.fill("Flat")
        page.locator("form").get_by_role("button", name=answer, exact=True).press("Enter")
        expect(entry).to_have_count(0)
        expect(page.get_by_role("button", name=f"Rename, export or delete {after}")).to_be_focused()
    own.get_by_role("button", name="Flat Bump shape").click()
    expect(dashboard.entry("Height")).to_have_value("-6")
    page.keyboard.press("Control+z")
    expect(dashboard.entry("Height")).to_have_value("12")
    dashboard.expect_curves()
    address = page.url
    slider = dashboard.slider("Height")
    slider.press("Home")
    expect_new_address(page, address)
    lowest = float(dashboard.entry("Height").input_value())
    assert lowest < -6
    assert slider.input_value() == slider.get_attribute("min")
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == pytest.approx(lowest / 100)


def test_the_nearest_reading_of_the_paper_opens_and_its_car_stands_on_each_axles_own_road(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_role("button", name="Library").click()
    page.get_by_role("list", name="Presets").get_by_role("button", name="Paper, nearest").click()
    expect(page.locator("[data-road=rear]").first).to_be_attached()
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["rear_axle"] == "together"
    page.get_by_label("Find a field").fill("rear axle")
    choice = page.locator("[data-pointer='/road/rear_axle']")
    expect(choice.get_by_role("combobox", name="Rear axle")).to_have_value("together")
    expect(choice.get_by_role("link", name="the paper's equations name no delay")).to_be_visible()


@pytest.mark.thorough
def test_baseline_and_strategies_are_chosen_by_clicks(dashboard: Dashboard) -> None:
    dashboard.open()
    cell = "td[data-cell='bump.body_acceleration.peak']"
    lv = dashboard.row("lv").locator(cell)
    expect(lv).to_contain_text(re.compile(r"▼ −[\d.]+\s%, better"))
    dashboard.row("lv").scroll_into_view_if_needed()
    expect(dashboard.panel("pitch_acceleration")).to_have_attribute("data-drawn", "3")
    drawn = dashboard.drawings()
    dashboard.row("lv").get_by_role("button").click()
    expect(dashboard.row("lv")).to_have_attribute("data-baseline", "true")
    assert drawn() == 0  # no curve is drawn anew for it
    expect(lv).not_to_contain_text("%")
    values = dashboard.shown_values()
    worse = 100 * (values["passive bump.body_acceleration.peak"] / values["lv bump.body_acceleration.peak"] - 1)
    expect(dashboard.row("passive").locator(cell)).to_contain_text(f"▲ +{worse:.0f}\u2009%, worse")

    panel = dashboard.panel("body_acceleration")
    panel.scroll_into_view_if_needed()  # what nobody sees is not drawn anew
    expect(panel).to_have_attribute("data-drawn", "3")
    dashboard.chip("LQR").click()
    expect(panel).to_have_attribute("data-drawn", "2")
    expect(dashboard.row("lqr")).to_have_count(0)
    expect(dashboard.page).to_have_url(re.compile("hide=lqr"))

    dashboard.toggle("Single speed control")  # not in the run yet: a new one
    expect(dashboard.row("speed_only")).to_be_visible()
    assert set(dashboard.stored_run()["strategies"]) == {"lv", "speed_only", "passive"}

    for name in ("LV control", "Single speed control", "Passive"):
        dashboard.chip(name).click()
    expect(dashboard.page.get_by_role("heading", name="No strategy chosen")).to_be_visible()
    dashboard.page.get_by_role("button", name="Show all strategies").click()
    expect(panel).to_have_attribute("data-drawn", "9")
