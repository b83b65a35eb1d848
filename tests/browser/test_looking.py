"""Cursor, zoom, the moving car, keyboard, accessibility; and a server that is not there yet."""

import re
from collections.abc import Callable

import pytest

from tests.browser.dashboard import THOROUGH, Dashboard, expect, expect_new_address, middle_of
from tests.browser.server import Server
from tests.there import there

# Scrolled to where the car stands, whichever lies there is the comparison's.
NOT_COVERED = """head => {
  const car = document.querySelector('[aria-label="The moving car"]').getBoundingClientRect();
  scrollBy(0, head.getBoundingClientRect().top - (car.top + car.bottom) / 2);
  const {left, top, width, height} = head.getBoundingClientRect();
  const x = Math.min(left + width / 2, innerWidth - 20);
  return head.closest('section').contains(document.elementFromPoint(x, top + height / 2));
}"""
CUT = """results => [...results.querySelectorAll('h2, h3, p, span, button, th')]
  .filter(each => getComputedStyle(each).overflowX === 'hidden' && each.scrollWidth > each.clientWidth + 1)
  .filter(each => !each.matches('.visually-hidden')).map(each => each.textContent)"""


@pytest.mark.thorough
def test_nothing_readable_is_cut_or_covered(dashboard: Dashboard) -> None:
    """Neither the comparison's head under the car, nor a sentence that ends in an ellipsis, nor a strategy's chip."""
    dashboard.open()
    page = dashboard.page
    dashboard.toggle("Single suspension control")
    dashboard.toggle("Hybrid hook")
    chips = page.get_by_role("group", name="Strategies")
    page.get_by_text("Plot differences").click()
    expect(page.get_by_text(", change against ").first).to_be_visible()
    head = page.get_by_role("region", name="Comparison", exact=True).locator("thead th").last
    for width, height in ((1440, 900), (1024, 768), (390, 844)):
        page.set_viewport_size({"width": width, "height": height})
        assert chips.evaluate("chips => chips.scrollWidth <= chips.clientWidth"), width
        head.scroll_into_view_if_needed()
        assert head.evaluate(NOT_COVERED), width
        assert dashboard.results.evaluate(CUT) == [], width


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
    expect(page.get_by_text("The paper’s scenario")).to_be_visible()
    dashboard.expect_table_to_be_the_stored_run()
    figures = page.locator("section[data-figure]").evaluate_all("panels => panels.map(panel => panel.dataset.figure)")
    assert figures == [each["layout"]["meta"]["signal"] for each in server.get("/figures")["figures"].values()]

    def part(signal: str) -> str:
        """Of the run, as the panel's name says it."""
        name = page.locator(f"section[data-figure={signal}] [role=img]").get_attribute("aria-label") or ""
        return name.partition(" over ")[2].partition(":")[0]

    def is_part(text: str) -> None:
        expect(page.get_by_role("img", name=f"over {text}")).to_have_count(10)

    x, y, width = middle_of(page.locator("section[data-figure=speed]"))
    bump = part("speed")
    is_part(bump)
    assert re.fullmatch(r"distance from 9\d\.\d to 11\d\.\d m", bump)
    assert "whole run" in part("front_road")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + width / 5, y, steps=4)
    page.mouse.up()
    expect(page).to_have_url(re.compile(r"zoom=\d"))
    is_part(part("speed"))
    assert part("speed") != bump
    page.mouse.dblclick(x, y)
    expect(page).to_have_url(re.compile("zoom=whole"))
    assert part("speed").startswith("distance from 0.0 to ")
    is_part(part("speed"))
    page.get_by_role("button", name="Bump", exact=True).last.click()
    expect(page).not_to_have_url(re.compile("zoom"))

    acceleration, speed = (page.locator(f"section[data-figure={name}]") for name in ("body_acceleration", "speed"))
    x, y, _ = middle_of(speed)
    page.mouse.move(x, y)
    expect(speed.locator("header")).to_contain_text("50.0")  # the passive car's speed, wherever the cursor is
    expect(acceleration.locator("header")).to_contain_text(re.compile(r"\d"))
    page.get_by_role("button", name="Whole run").click()
    cursor, lane = page.get_by_role("slider", name="Cursor"), page.get_by_role("region", name="The moving car")
    expect(cursor).to_have_attribute("aria-valuetext", re.compile(r"^\d+\.\d\d m$"))

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
    for button in ("Pause", "Play"):  # the space bar does the same
        page.keyboard.press("Space")
        expect(page.get_by_role("button", name=button, exact=True)).to_be_visible()


@pytest.mark.thorough
def test_a_panel_opens_enlarged_in_plotly(dashboard: Dashboard) -> None:
    """Which is loaded for it, not before: with values under the pointer, a box to zoom into, and a picture."""
    loaded: list[str] = []
    page = dashboard.page
    page.on("request", lambda request: loaded.append(request.url))
    dashboard.open()
    page.wait_for_load_state("networkidle")
    assert not any("charts" in url for url in loaded)

    page.get_by_role("button", name="Enlarge figure: Body acceleration").click()
    figure = page.get_by_role("dialog", name="Body acceleration")
    curves, ticks = figure.locator(".scatterlayer .trace"), figure.locator(".xaxislayer-above .xtick text")
    expect(curves).to_have_count(3)
    box = there(figure.locator(".nsewdrag").first.bounding_box())
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    expect(figure.locator(".hoverlayer")).to_contain_text("m/s²")
    dashboard.expect_accessible(figure)
    before = ticks.all_text_contents()
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + box["width"] / 5, y, steps=4)
    page.mouse.up()
    expect(ticks.first).not_to_have_text(before[0])
    page.mouse.move(x, y)
    with page.expect_download() as download:
        figure.locator(".modebar-btn").first.click()
    assert download.value.suggested_filename == f"ridelab-{dashboard.run_id}-body_acceleration.svg"
    page.keyboard.press("Escape")
    expect(figure).to_have_count(0)


def test_everything_goes_by_keyboard_and_undo_is_the_scenarios_wherever_the_focus_is(dashboard: Dashboard) -> None:
    """After a slider, a typed value and a select; text that is not a value yet is the input's own."""
    dashboard.open()
    page, paper = dashboard.page, dashboard.address()
    page.keyboard.press("Tab")
    skip = page.get_by_role("button", name="Skip to the page’s content")
    expect(skip).to_be_in_viewport()
    page.keyboard.press("Enter")
    expect(page.get_by_role("main")).to_be_focused()

    height = dashboard.entry("Height")
    dashboard.slider("Height").focus()
    page.keyboard.press("ArrowRight")
    expect_new_address(page, paper)
    expect(height).to_have_value("10.2")
    address = dashboard.address()
    dashboard.type_into("Height", "12")
    expect_new_address(page, address)
    for value in ("10.2", "10"):
        page.keyboard.press("Control+z")
        expect(height).to_have_value(value)
    expect(page).to_have_url(paper)
    page.keyboard.press("Control+y")
    expect(height).to_have_value("10.2")
    page.keyboard.press("Control+z")
    expect(page).to_have_url(paper)

    shape, width = page.get_by_role("combobox", name="Shape"), dashboard.entry("Width")
    shape.select_option("kerb")
    expect_new_address(page, paper)
    shape.press("Control+z")
    expect(page).to_have_url(paper)
    width.focus()
    page.keyboard.type("7")
    page.keyboard.press("Control+z")
    expect(width).not_to_have_value("7")
    page.keyboard.type("-1")
    page.keyboard.press("Enter")
    expect(page.get_by_role("alert")).to_be_visible()
    page.keyboard.press("Control+z")
    expect(page.get_by_role("alert")).to_have_count(0)
    assert dashboard.address() == paper

    height.focus()
    page.keyboard.press("Shift+ArrowUp")
    page.locator("aside h2").get_by_role("button", name="Bump").click()  # at once: no edit is lost
    expect(height).to_have_count(0)
    expect_new_address(page, paper)
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["bump"]["height"] == 0.12
    page.get_by_role("textbox", name="Find a field").fill("bump hei")
    expect(height).to_have_value("12")
    expect(page.locator("aside button[aria-expanded]")).to_have_count(1)
    page.get_by_role("textbox", name="Find a field").fill("sensor")
    expect(dashboard.entry("Deflection noise")).to_be_visible()
    page.get_by_role("textbox", name="Find a field").fill("natural frequency")
    expect(page.get_by_role("combobox", name="Vehicle")).to_be_visible()
    page.get_by_role("textbox", name="Find a field").press("Escape")

    dashboard.chip("LQR").focus()
    page.keyboard.press("Space")
    expect(dashboard.chip("LQR")).to_have_attribute("aria-pressed", "false")
    page.get_by_role("slider", name="Cursor").focus()
    before = page.get_by_role("slider", name="Cursor").input_value()
    page.keyboard.press("ArrowRight")
    expect(page.get_by_role("slider", name="Cursor")).not_to_have_value(before)


def test_commands_and_fields_are_found_by_name(dashboard: Dashboard) -> None:
    """The search closes and gives the focus back; what is found is gone to."""
    dashboard.open()
    page = dashboard.page
    search = page.get_by_role("textbox", name="Search commands and fields")
    close: tuple[Callable[[], None], ...] = (lambda: page.keyboard.press("Escape"), lambda: page.mouse.click(5, 400))
    for each in close:
        dashboard.entry("Height").focus()
        page.keyboard.press("Control+k")
        expect(search).to_be_focused()
        each()
        expect(search).to_have_count(0)
        expect(dashboard.entry("Height")).to_be_focused()

    page.keyboard.press("Control+k")
    found = page.get_by_role("dialog").get_by_role("button")
    for words, names in {
        "frequency": ("Frequencies: responses", "Front spring", "Bandwidth"),
        "sensor": ("Acceleration noise", "Sensor noise", "Preview noise"),
        "weight": ("Body mass", "Cruise: Body acceleration"),
    }.items():
        search.fill(words)
        for name in names:
            expect(found.filter(has_text=name).first).to_be_visible()
    search.fill("bandwid actuator")
    dashboard.expect_accessible(page.get_by_role("dialog"))
    page.keyboard.press("Enter")
    expect(page.get_by_role("switch", name="Bandwidth: limited")).to_be_focused()
    page.get_by_role("button", name="Vehicle", exact=True).click()
    page.keyboard.press("Control+k")
    search.fill("van, empty")
    page.keyboard.press("Enter")
    expect(page.get_by_role("combobox", name="Vehicle")).to_have_value("van")
    page.keyboard.press("Control+k")
    search.fill("hide lqr")
    page.keyboard.press("Enter")
    expect(dashboard.row("lqr")).to_have_count(0)
    expect(search).to_have_count(0)
    page.keyboard.press("?")
    keys = page.get_by_role("dialog", name="Help")
    expect(keys).to_contain_text("Undo")
    expect(keys.get_by_role("row", name="Play the car")).to_contain_text("Space")
    if THOROUGH:
        dashboard.expect_accessible(keys)
    page.keyboard.press("Escape")
    expect(keys).to_have_count(0)
    page.keyboard.press("Control+k")
    search.fill("tuner")
    page.get_by_role("button", name="Tuner", exact=True).click()
    expect(page).to_have_url(re.compile("/tuner"))


@pytest.mark.thorough
def test_opening_while_the_server_starts(dashboard: Dashboard) -> None:
    """Every request fails at first, as behind a proxy whose server is not up yet; then the page fills by itself."""
    page = dashboard.page
    refused = "**/{api,readyz}**"
    page.route(refused, lambda route: route.fulfill(status=503, body="{}", headers={"retry-after": "1"}))
    page.goto("/")
    expect(page.get_by_test_id("connection")).to_contain_text("starting")
    page.wait_for_function("document.getAnimations().length === 0")  # who asked for less motion sees nothing move
    page.unroute(refused)
    dashboard.expect_curves()
    expect(page.get_by_test_id("connection")).to_have_count(0)
