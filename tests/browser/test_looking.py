"""Cursor, zoom, the moving car, keyboard, commands; what a phone shows; accessibility."""

import re

import pytest
from playwright.sync_api import Locator

from tests.browser.dashboard import THOROUGH, Dashboard, centre, expect
from tests.browser.server import Server


@pytest.mark.thorough
@pytest.mark.parametrize("path", ["/", "/sweeps", "/robustness", "/tuner", "/paper", "/ecu"])
def test_every_page_is_accessible_and_no_wider_than_a_phone(dashboard: Dashboard, path: str) -> None:
    page = dashboard.page
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(path)
    expect(page.get_by_role("heading").nth(1)).to_be_visible()
    page.wait_for_load_state("networkidle")
    dashboard.expect_accessible()
    dashboard.expect_no_wider(390)


def test_a_van_over_a_hump_on_a_phone(dashboard: Dashboard) -> None:
    """My van, a 12 cm × 60 cm hump, 30 km/h: which control is best, and how fast may it go?"""
    page = dashboard.page
    page.set_viewport_size({"width": 390, "height": 844})
    dashboard.open()
    page.get_by_role("button", name="Edit scenario").click()
    expect(dashboard.slider("Height")).to_be_visible()
    box = page.get_by_role("dialog").bounding_box()
    assert box is not None
    assert box["y"] > 0.4 * 844, "plots stay in sight"
    page.get_by_role("button", name="Vehicle", exact=True).click()
    page.get_by_role("combobox", name="Vehicle").select_option("van")
    for name, text in (("Height", "12 cm"), ("Width", "600mm"), ("Initial speed", "30 km/h")):
        dashboard.edit(name, text)
    page.get_by_role("button", name="Close the form").click()
    with dashboard.new_address():
        page.get_by_label("Speed over the bump").select_option("Constant")
    bump = dashboard.stored_run()["scenario"]["road"]["bump"]
    assert (bump["height"], bump["width"]) == (0.12, 0.6)
    comparison = page.get_by_role("region", name="Comparison", exact=True)
    expect(comparison.get_by_text("30.0\u00a0km/h").nth(2)).to_be_visible()
    page.get_by_role("button", name="How fast may it go: Body acceleration, bump").click()
    dialog = page.get_by_role("dialog", name="How fast may it go?")
    for label, text in (("From", "5"), ("To", "30"), ("At most", "15 m/s²")):
        dialog.get_by_label(label, exact=True).fill(text)
    dialog.get_by_role("button", name="Find").click()
    expect(dialog.get_by_role("status")).to_contain_text(re.compile(r"at most (about )?[\d.]+"))


def test_no_serious_accessibility_violation(dashboard: Dashboard) -> None:
    """With every section of the form and a tooltip open."""
    dashboard.open()
    page = dashboard.page
    closed = page.locator("aside button[aria-expanded=false]")
    for left in range(closed.count(), 0, -1):
        closed.first.click()
        expect(closed).to_have_count(left - 1)
    page.get_by_role("button", name="Travel, forces, comfort, time and events").click()
    dashboard.row("passive").get_by_role("button", name="airborne").hover()
    expect(page.get_by_role("tooltip")).to_be_visible()
    dashboard.expect_accessible(in_the_dark=True)


def test_opens_on_the_papers_bump_which_every_plot_shows_and_one_cursor_reads(
    dashboard: Dashboard, server: Server
) -> None:
    """With every figure and number. Dragging zooms; a double click shows the whole run, and so does its address."""
    dashboard.open()
    page = dashboard.page
    expect(page).to_have_title("100 mm bump, 50 → 22.5 km/h · Ridelab")
    dashboard.expect_table_to_be_the_stored_run()
    figures = page.locator("section[data-figure]").evaluate_all("panels => panels.map(panel => panel.dataset.figure)")
    assert figures == [each["layout"]["meta"]["signal"] for each in server.get("/figures")["figures"].values()]
    speed = page.locator("section[data-figure=speed]")

    def part() -> str:
        """Of the run, as the panel's name says it; ten panels show the same."""
        name = speed.get_by_role("img").get_attribute("aria-label") or ""
        text = name.partition(" over ")[2].partition(":")[0]
        expect(page.get_by_role("img", name=f"over {text}")).to_have_count(10)
        return text

    x, y, width = centre(speed.locator("canvas"))
    bump = part()
    assert re.fullmatch(r"distance from 9\d\.\d to 11\d\.\d m", bump)
    with dashboard.held_at(x, y) as mouse:
        mouse.move(x + width / 5, y, steps=4)
    expect(page).to_have_url(re.compile(r"zoom=\d"))
    assert part() != bump
    page.mouse.dblclick(x, y)
    expect(page).to_have_url(re.compile("zoom=whole"))
    assert part().startswith("distance from 0.0 to ")
    page.get_by_role("button", name="Bump", exact=True).last.click()
    expect(page).not_to_have_url(re.compile("zoom"))

    x, y, _ = centre(speed.locator("canvas"))
    page.mouse.move(x, y)
    expect(speed.locator("header")).to_contain_text("50.0")  # the passive car's speed, wherever the cursor is
    page.get_by_role("button", name="Whole run").click()
    cursor, lane = page.get_by_role("slider", name="Cursor"), page.get_by_role("region", name="The moving car")
    cursor.fill("60")
    expect(lane).to_contain_text("60.0 m")
    page.get_by_text("Time", exact=True).click()  # another axis, the same place
    expect(cursor).to_have_attribute("aria-valuetext", re.compile(" s$"))
    expect(lane).to_contain_text(re.compile(r"(59\.9|60\.0|60\.1) m"))
    cursor.fill("0")
    page.get_by_role("button", name="Play").click()
    expect(lane).to_contain_text(re.compile(r"· [1-9]\d*\.\d m"))
    page.get_by_role("button", name="Pause").click()
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()


def test_everything_goes_by_keyboard_and_undo_is_the_scenarios_wherever_the_focus_is(dashboard: Dashboard) -> None:
    """After a slider, a typed value and a select; text that is not a value yet is the input's own."""
    dashboard.open()
    page, paper = dashboard.page, dashboard.address()
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Skip to the page’s content")).to_be_in_viewport()
    page.keyboard.press("Enter")
    expect(page.get_by_role("main")).to_be_focused()

    height, width, shape = (*map(dashboard.entry, ("Height", "Width")), page.get_by_role("combobox", name="Shape"))
    dashboard.slider("Height").focus()
    with dashboard.new_address():
        page.keyboard.press("ArrowRight")
    expect(height).to_have_value("10.2")
    dashboard.edit("Height", "12")
    for value in ("10.2", "10"):
        page.keyboard.press("Control+z")
        expect(height).to_have_value(value)
    expect(page).to_have_url(paper)
    with dashboard.new_address():
        shape.select_option("kerb")
    shape.press("Control+z")
    expect(page).to_have_url(paper)
    width.focus()
    page.keyboard.type("7")
    page.keyboard.press("Control+z")
    expect(width).not_to_have_value("7")
    assert dashboard.address() == paper

    height.focus()
    page.keyboard.press("Shift+ArrowUp")
    with dashboard.new_address():
        page.locator("aside h2").get_by_role("button", name="Bump").click()  # at once: no edit is lost
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.12
    search = page.get_by_role("textbox", name="Find a field")
    for words, found in (("bump hei", height), ("sensor", dashboard.entry("Deflection noise"))):
        search.fill(words)
        expect(found).to_be_visible()
    search.press("Escape")
    dashboard.chip("LQR").focus()
    page.keyboard.press("Space")
    expect(dashboard.chip("LQR")).to_have_attribute("aria-pressed", "false")


def test_commands_and_fields_are_found_by_name(dashboard: Dashboard) -> None:
    """The search closes and gives the focus back; what is found is gone to."""
    dashboard.open()
    page = dashboard.page
    search = page.get_by_role("textbox", name="Search commands and fields")
    dashboard.entry("Height").focus()
    page.keyboard.press("Control+k")
    expect(search).to_be_focused()
    page.keyboard.press("Escape")
    expect(search).to_have_count(0)
    expect(dashboard.entry("Height")).to_be_focused()

    page.keyboard.press("Control+k")
    found = page.get_by_role("dialog").get_by_role("button")
    for words, name in {
        "frequency": "Frequencies: responses",
        "sensor": "Preview noise",
        "weight": "Body mass",
    }.items():
        search.fill(words)
        expect(found.filter(has_text=name).first).to_be_visible()
    dashboard.expect_accessible(page.get_by_role("dialog"))

    def enter(words: str, then: Locator) -> None:
        if not search.is_visible():
            page.keyboard.press("Control+k")
        search.fill(words)
        page.keyboard.press("Enter")
        expect(then).to_be_visible()

    enter("bandwid actuator", page.get_by_role("switch", name="Bandwidth: limited"))
    expect(page.get_by_role("switch", name="Bandwidth: limited")).to_be_focused()
    enter("van, empty", page.get_by_role("group", name="Changes against the state before the last edit"))
    enter("hide lqr", dashboard.row("lv"))
    expect(dashboard.row("lqr")).to_have_count(0)
    page.keyboard.press("?")
    keys = page.get_by_role("dialog", name="Help")
    expect(keys.get_by_role("row", name="Play the car")).to_contain_text("Space")
    if THOROUGH:
        dashboard.expect_accessible(keys)
    page.keyboard.press("Escape")
    expect(keys).to_have_count(0)
    enter("tuner", page.get_by_role("heading", name="Tuner"))
