"""The paper page as a reader uses it: count, switches, tables, what each part contributes, figures."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, Route

from tests.browser.dashboard import THOROUGH, Dashboard, expect
from tests.browser.server import Server
from tests.servers.process import request

FIGURES = [3, 4, 5, 6, 8, *range(10, 18), *range(19, 23)]
VERDICTS = ("reached", "smaller", "contradicts")
# What the switches do is 12 reproductions more: the backend's tests compute it, here a table of the same shape stands.
EFFECTS = {
    "rows": [
        {
            "reading": "preview",
            "choice": "none",
            "reached": 16,
            "total": 48,
            "counts": {"reached": 16, "smaller": 12, "contradicts": 20},
            "changed": 25,
        }
    ],
    "complete": True,
}


@pytest.fixture(scope="module", autouse=True)
def reproduced(server: Server, reproduction: Callable[[str], None]) -> None:
    """The twenty roads: tests/api shows that the service computes what lies there."""
    reproduction(f"sqlite:///{server.database}")


@pytest.fixture
def paper(dashboard: Dashboard) -> Page:
    """The page with its count."""

    def effects(route: Route) -> None:
        route.fulfill(status=200, content_type="application/json", body=json.dumps(EFFECTS))

    dashboard.page.route("**/api/v1/paper/readings*", effects)
    open_paper(dashboard.page)
    return dashboard.page


def open_paper(page: Page, query: str = "") -> None:
    page.goto(f"/paper{query}")
    expect(page.get_by_test_id("count")).to_be_visible()


def answer(page: Page, query: str = "") -> Any:
    """The API's answer for the same readings."""
    base = re.match(r"https?://[^/]+", page.url)
    assert base is not None
    return request("GET", f"{base[0]}/api/v1/paper{query}").raise_for_status().json()


def marks(page: Page, verdict: str) -> int:
    """Rows of the paper's tables with this verdict, by what a reader sees in them."""
    rows = page.locator("table[data-table] tr[data-verdict]")
    own = rows.filter(has=page.locator("td[data-own]").get_by_text(verdict))
    return own.count()


def choose(page: Page, reading: str, choice: str) -> None:
    page.get_by_role("radiogroup", name=reading).get_by_text(choice, exact=True).click()


def settled(page: Page) -> Locator:
    """The page under the readings the switches stand at."""
    main = page.locator("main")
    expect(main).to_have_attribute("aria-busy", "false")
    return main


def test_sets_count_and_misprints_are_what_the_tables_show_and_the_api_says(paper: Page) -> None:
    api = answer(paper)
    table = paper.get_by_test_id("interpretations")
    for item in api["interpretations"]:
        row = table.locator(f"tr[data-interpretation={item['id']}]")
        parts = (item, item["simulated"], item["ecu"])
        near = (item["agreement"]["within"], item["agreement"]["in_interval"])
        expected = [
            *(f"{part['reached']} of {part['total']}" for part in parts),
            *(f"{number} of 40" for number in near),
        ]
        assert row.locator("td").all_inner_texts()[:5] == expected
    expect(table.locator("tr[data-interpretation=default]")).to_have_attribute("aria-current", "true")
    favourable = answer(paper, "?interpretation=favourable")
    table.get_by_role("button", name="Show Favourable").click()
    expect(paper).to_have_url(re.compile(r"/paper\?interpretation=favourable$"))
    settled(paper)
    expect(paper.get_by_test_id("count")).to_contain_text(
        f"{favourable['reached']} of {favourable['total']} cells reached"
    )
    expect(paper.get_by_role("navigation", name="On this page")).to_contain_text(f"Default: {api['reached']} of")
    assert paper.get_by_role("radiogroup", name="Actuator force limit").get_by_role("radio", name="20 kN").is_checked()
    table.get_by_role("button", name="Show Default").click()
    expect(paper).to_have_url(re.compile(r"/paper$"))

    settled(paper)
    assert api["total"] == len(api["cells"])
    expect(paper.get_by_test_id("count")).to_contain_text(f"{api['reached']} of {api['total']} cells reached")
    for verdict in VERDICTS:
        assert marks(paper, verdict) == api["counts"][verdict]
    without = api["without_preview"]["reached"]
    expect(paper.get_by_test_id("count-without")).to_contain_text(f"{without} of {api['total']}")
    misprints = [cell for cell in api["cells"] if cell["misprint"]]
    assert len(misprints) == 3  # Table 8 rear tyre, Table 9 body acceleration twice
    for cell in misprints:
        row = paper.locator(f"#table-{cell['table']}-{cell['strategy']}-{cell['against']}-{cell['signal']}")
        follows = f"{abs(cell['misprint']['follows']):g}"
        expect(row).to_contain_text(re.compile(rf"misprint: [−+]{re.escape(follows)}\s%"))
        expect(row.locator("s")).to_have_css("text-decoration-line", "line-through")

    # What is not reached is named; a name leads to its row.
    missed = api["total"] - api["reached"]
    paper.get_by_text(f"The {missed} cells not reached").click()
    first = paper.locator("details li a").first
    target = first.get_attribute("href")
    first.click()
    expect(paper.locator(f"{target}:target")).to_be_in_viewport()


@pytest.mark.thorough
def test_a_switch_changes_address_and_count_and_only_tables_scroll_sideways(dashboard: Dashboard, paper: Page) -> None:
    before, after = answer(paper), answer(paper, "?preview=none")
    assert before["reached"] != after["reached"]
    choose(paper, "Road preview", "None")
    expect(paper).to_have_url(re.compile(r"/paper\?preview=none$"))
    settled(paper)
    count = f"{after['reached']} of {after['total']} cells reached"
    expect(paper.get_by_test_id("count")).to_contain_text(count)
    paper.reload()
    expect(paper.get_by_test_id("count")).to_contain_text(count)
    expect(paper.get_by_role("radio", name="None").first).to_be_checked()
    paper.go_back()
    expect(paper.get_by_test_id("count")).to_contain_text(f"{before['reached']} of")
    expect(paper.get_by_role("button", name="All as in the default set")).to_be_disabled()
    # The table of what each switch does, which is asked for when it comes near the window, sets one from wherever the
    # others stand.
    paper.get_by_role("heading", name="What each switch does").scroll_into_view_if_needed()
    paper.get_by_test_id("effects").get_by_role("button", name="Try Road preview: None").click()
    expect(paper.get_by_test_id("count")).to_contain_text(count)
    paper.get_by_role("button", name="Reset 1 switch").click()
    expect(paper).to_have_url(re.compile(r"/paper$"))

    dashboard.expect_no_wider(400)
    scrolls = "region => region.scrollWidth > region.clientWidth"
    assert paper.get_by_role("region", name="Table 4").evaluate(scrolls)
    # The verdict stands under the signal's name, in sight without scrolling.
    row = paper.locator("table[data-table='4'] tr[data-verdict]").first
    expect(row.locator("th").get_by_text(re.compile("|".join(VERDICTS)))).to_be_visible()
    paper.get_by_role("button", name="Pages").click()
    expect(paper.get_by_role("menuitem", name="Lab")).to_be_visible()


PENDING = {"our_change": None, "ci": None, "verdict": "pending", "certain": None}


def early(paper: dict[str, Any], done: int) -> dict[str, Any]:
    """The same answer while only the cells of Table 4 are there."""
    missing = PENDING | {"our_value": None, "our_base": None, "without_preview": PENDING}
    cells = [cell if cell["table"] == 4 else cell | missing for cell in paper["cells"]]
    verdicts = [cell["verdict"] for cell in cells]
    counts = {name: verdicts.count(name) for name in VERDICTS}
    patched = {"cells": cells, "counts": counts, "reached": counts["reached"]}
    return paper | patched | {"complete": False, "progress": {"done": done, "total": 420}}


@pytest.mark.thorough
def test_cells_come_as_they_are_computed_and_nothing_jumps(dashboard: Dashboard) -> None:
    page = dashboard.page

    def answer_early(route: Route) -> None:
        route.fulfill(json=early(route.fetch().json(), 60))

    page.route("**/api/v1/paper?partial=true", answer_early)
    page.route("**/api/v1/paper/*", lambda _: None)  # what follows the tables stays as high as it is
    open_paper(page)
    expect(page.get_by_test_id("progress")).to_have_text("60 of 420 runs")
    pending = page.locator("table[data-table] tr[data-verdict=pending]")
    expect(pending).to_have_count(40)
    expect(page.get_by_test_id("count")).to_contain_text(re.compile(r"^\d+\s+of 48 cells reached so far"))
    dashboard.expect_accessible(page.get_by_role("region", name="Table 5"))
    places = "() => [...document.querySelectorAll('section[id], table[data-table]')].map(each => each.offsetTop)"
    before = page.evaluate(places)
    page.unroute("**/api/v1/paper?partial=true")
    settled(page)
    expect(pending).to_have_count(0)
    expect(page.get_by_test_id("progress")).to_have_text("Computed from 420 runs.")
    after = page.evaluate(places)
    moved = max(abs(new - old) for old, new in zip(before, after, strict=True))
    assert moved < 60  # [px]: an uncertain verdict may take a line


def test_figures_are_drawn_parts_sorted_and_the_scenario_opens_in_the_lab(dashboard: Dashboard, paper: Page) -> None:
    panels = paper.locator("figure[id^=figure-]")
    expect(panels).to_have_count(len(FIGURES))
    ids = [panel.get_attribute("id") for panel in panels.all()]
    assert ids == [f"figure-{number}" for number in FIGURES]
    assert paper.locator("figure .scatterlayer .trace").count() == 0
    window = paper.viewport_size
    assert window is not None
    paper.emulate_media(media="print")
    paper.set_viewport_size({"width": 718, "height": 1000})  # A4 within its margins
    left, right = (panel.bounding_box() for panel in panels.all()[:2])
    assert left is not None
    assert right is not None
    assert left["y"] == right["y"]
    paper.emulate_media(media="null")
    paper.set_viewport_size(window)
    if THOROUGH:
        dashboard.expect_accessible()
    expect(paper.get_by_test_id("sentences").locator("li").first).to_contain_text("lower speed")
    shares = paper.get_by_test_id("shares").locator("tbody tr")
    expect(shares).to_have_count(8)
    for row in shares.all_inner_texts():
        parts = [int(text.replace("−", "-")) for text in re.findall(r"([−]?\d+) %", row)]
        assert abs(sum(parts) - 100) <= 2, row  # three rounded to whole percent: at most 1.5 off
    table = paper.get_by_test_id("combinations")
    rows = table.locator("tbody tr")
    everything = rows.count()
    paper.get_by_role("combobox", name="Preview").select_option(label="Road ahead")
    paper.get_by_role("combobox", name="Controller").select_option(label="MPC")
    expect(paper.get_by_text(f"6 of {everything} combinations")).to_be_visible()
    head = table.get_by_role("columnheader", name="Travel time")
    head.get_by_role("button").click()
    expect(head).to_have_attribute("aria-sort", "ascending")
    expect(rows.first).to_contain_text("Constant")
    head.get_by_role("button").click()
    expect(rows.first).to_contain_text("Planned")
    expect(table.locator("tr[data-known=lv]")).to_have_count(1)

    def expect_drawn(number: int) -> None:
        """When it is scrolled to."""
        figure = paper.locator(f"#figure-{number}")
        figure.scroll_into_view_if_needed()
        expect(figure.locator(".scatterlayer .trace").first).to_be_attached()

    expect_drawn(14)  # another stretch draws again what is drawn
    ticks = paper.locator("#figure-14 .xtick text")
    expect(ticks.first).to_have_text("0")
    paper.get_by_text("Bump only").click()
    expect(ticks.first).not_to_have_text("0")
    expect_drawn(FIGURES[-1])

    paper.get_by_role("button", name="Open this scenario in the lab").click()
    expect(paper).to_have_url(re.compile(r"/r/"))
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"] == answer(paper)["scenario"]
