"""The questions that the dashboard answers without a manual, each as somebody new finds its answer."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from playwright.sync_api import Locator, Page

from tests.browser.dashboard import Dashboard, expect, expect_new_address
from tests.servers.process import ROOT

Question = Callable[[Dashboard], None]


@contextmanager
def form(page: Page) -> Iterator[None]:
    """The scenario's form: beside the results, on a phone in a sheet that is closed again."""
    button = page.get_by_role("button", name="Edit scenario")
    narrow = button.is_visible()
    if narrow:
        button.click()
    yield
    if narrow:
        page.get_by_role("button", name="Close the form").click()


def section(page: Page, name: str) -> None:
    """Opens one of the form's."""
    button = page.get_by_role("button", name=name, exact=True)
    if button.get_attribute("aria-expanded") == "false":
        button.click()


def go(page: Page, name: str) -> None:
    """To another page, by the links or, where there is no room, by the menu."""
    navigation = page.get_by_role("navigation", name="Pages")
    link = navigation.get_by_role("link", name=name, exact=True)
    if link.is_visible():
        link.click()
    else:
        navigation.get_by_role("button", name=re.compile("^Pages, now ")).click()
        page.get_by_role("menuitem", name=name, exact=True).click()


def comparison(page: Page) -> Locator:
    """The table of results."""
    return page.get_by_role("region", name="Comparison")


def edited(dashboard: Dashboard, name: str, text: str) -> None:
    """Types a value and waits for its run."""
    address = dashboard.address()
    dashboard.type_into(name, text)
    expect_new_address(dashboard.page, address)


def what_got_better(dashboard: Dashboard) -> None:
    """I changed the bump weights: what got better, what got worse, against what I had?"""
    page = dashboard.page
    dashboard.open()
    comparison(page).get_by_role("button", name="Pin").click()
    with form(page):
        section(page, "LV weights per driving stage")
        edited(dashboard, "Bump, Body acceleration, value", "4")
    dashboard.expect_curves()
    expect(page.get_by_test_id("differences")).to_contain_text("1 → 4")
    page.get_by_label("Change against").select_option("Before the last edit")
    expect(comparison(page)).to_contain_text("choose several roads")
    page.get_by_label("Roads").select_option("5")
    expect(comparison(page)).to_contain_text("Changes are paired by road")
    expect(comparison(page)).to_contain_text("▼")
    expect(comparison(page)).to_contain_text("▲")
    expect(page.get_by_role("list", name="Pinned results")).to_contain_text("Paper’s scenario")


def my_van(dashboard: Dashboard) -> None:
    """My van, a 12 cm × 60 cm hump, 30 km/h: which control is best, by how much, and how fast may it go?"""
    page = dashboard.page
    dashboard.open()
    with form(page):
        section(page, "Vehicle")
        page.get_by_role("combobox", name="Vehicle").select_option("van")
        edited(dashboard, "Height", "12 cm")
        edited(dashboard, "Width", "600mm")
        edited(dashboard, "Initial speed", "30 km/h")
    comparison(page).get_by_label("Speed over the bump").select_option("Constant")
    dashboard.expect_curves()
    vehicle = dashboard.stored_run()["scenario"]
    assert (vehicle["road"]["bump"]["height"], vehicle["road"]["bump"]["width"]) == (0.12, 0.6)
    expect(comparison(page).get_by_text("30.0\u00a0km/h").nth(2)).to_be_visible()
    expect(comparison(page).get_by_text("22.5\u00a0km/h")).to_have_count(0)
    page.get_by_role("button", name="How fast may it go: Body acceleration, bump").click()
    dialog = page.get_by_role("dialog", name="How fast may it go?")
    dialog.get_by_label("From").fill("5")
    dialog.get_by_label("To", exact=True).fill("30")
    dialog.get_by_label("At most").fill("15 m/s²")
    dialog.get_by_role("button", name="Find").click()
    expect(dialog.get_by_role("status")).to_contain_text(re.compile(r"at most (about )?[\d.]+"))
    page.keyboard.press("Escape")
    expect(dialog).not_to_be_visible()


def where_it_stops_paying(dashboard: Dashboard) -> None:
    """Height × speed: where does LV stop paying?"""
    page = dashboard.page
    dashboard.open()
    page.get_by_role("button", name="Sweep…").click()
    dialog = page.get_by_role("dialog", name="Sweep")
    dialog.get_by_label("Height, number of values").fill("3")
    dialog.get_by_role("combobox", name="Add a field").fill("target_speed")
    page.get_by_role("listbox").get_by_role("option", name="Target speed").click()
    dialog.get_by_label("Target speed, number of values").fill("3")
    expect(dialog.get_by_role("button", name="Start")).to_be_enabled()
    dialog.get_by_role("button", name="Start").click()
    expect(page.get_by_test_id("batch-state")).to_have_text("Done")
    page.get_by_label("Change against", exact=True).select_option("lqr")
    page.get_by_label("Line at").fill("0")
    expect(page.get_by_test_id("map-note")).to_contain_text(
        re.compile(r"LV control is at or below LQR at \d of 9 points")
    )


def luck_of_one_road(dashboard: Dashboard) -> None:
    """Is that difference real or luck of one road?"""
    dashboard.open()
    dashboard.page.get_by_label("Roads").select_option("5")
    expect(dashboard.page.get_by_test_id("roads")).to_contain_text("Mean of 5 roads")
    dashboard.expect_curves()
    expect(comparison(dashboard.page)).to_contain_text("±")


def real_sensors(dashboard: Dashboard) -> None:
    """And with real sensors, dampers and actuators?"""
    page = dashboard.page
    dashboard.open()
    go(page, "Robustness")
    page.get_by_label("Samples").fill("20")
    start = page.get_by_role("button", name="Start")
    expect(start).to_be_enabled()
    start.click()
    expect(page.get_by_role("heading", name="Where LV control is better")).to_be_visible()
    expect(page.get_by_text("Done", exact=True)).to_be_visible()


def measured_road(dashboard: Dashboard) -> None:
    """On the road we measured?"""
    page = dashboard.page
    dashboard.open()
    address = dashboard.address()
    with form(page):
        section(page, "Road")
        page.get_by_label("Road file").set_input_files(ROOT / "docs/roads/street.csv")
        expect_new_address(page, address)
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"]["road"]["profile"]


def does_the_paper_hold(dashboard: Dashboard) -> None:
    """Does the paper hold? Which weights should I use? Does it fit my ECU?"""
    page = dashboard.page
    page.goto("/paper")
    expect(page.get_by_test_id("count")).to_contain_text(re.compile(r"\d+ of 48"))
    go(page, "Tuner")
    expect(page.get_by_role("button", name="Start")).to_be_enabled()
    go(page, "ECU")
    expect(page.get_by_role("heading", name="ECU against simulation")).to_be_visible()


QUESTIONS: tuple[Question, ...] = (
    what_got_better,
    my_van,
    where_it_stops_paying,
    luck_of_one_road,
    real_sensors,
    measured_road,
    does_the_paper_hold,
)
