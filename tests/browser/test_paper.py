"""The paper page as a reader uses it: count, switches, tables, what each part contributes, figures."""

import re
from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Page

from tests.browser.dashboard import THOROUGH, Dashboard, expect
from tests.browser.server import Server

FIGURES = [3, 4, 5, 6, 8, *range(10, 18), *range(19, 23)]
VERDICTS = ("reached", "smaller", "contradicts")
# What the switches do is 12 reproductions more: the backend's tests compute it, here a table of the same shape stands.
COUNTS = {"reached": 16, "smaller": 12, "contradicts": 20}
EFFECT = {"reading": "preview", "choice": "none", "reached": 16, "total": 48, "counts": COUNTS, "changed": 25}


@pytest.fixture(scope="module", autouse=True)
def reproduced(server: Server, reproduction: Callable[[str], None]) -> None:
    """The twenty roads: tests/api shows that the service computes what lies there."""
    reproduction(f"sqlite:///{server.database}")


@pytest.fixture
def paper(dashboard: Dashboard) -> Page:
    """The page with its count."""
    effects = {"rows": [EFFECT], "complete": True}
    dashboard.page.route("**/api/v1/paper/readings*", lambda route: route.fulfill(json=effects))
    dashboard.page.goto("/paper")
    expect(dashboard.page.get_by_test_id("count")).to_be_visible()
    return dashboard.page


def expect_count(page: Page, answer: dict[str, Any]) -> None:
    """The page's count is the API's, under the readings that its switches stand at."""
    expect(page.locator("main")).to_have_attribute("aria-busy", "false")
    expect(page.get_by_test_id("count")).to_contain_text(f"{answer['reached']} of {answer['total']} cells reached")


def test_sets_count_and_misprints_are_what_the_tables_show_and_the_api_says(paper: Page, server: Server) -> None:
    api, table = server.get("/paper"), paper.get_by_test_id("interpretations")
    for item in api["interpretations"]:
        row = table.locator(f"tr[data-interpretation={item['id']}]")
        near = (item["agreement"]["within"], item["agreement"]["in_interval"])
        counts = [f"{part['reached']} of {part['total']}" for part in (item, item["simulated"], item["ecu"])]
        assert row.locator("td").all_inner_texts()[:5] == counts + [f"{number} of 40" for number in near]
    for name, address in (("Favourable", r"/paper\?interpretation=favourable$"), ("Default", r"/paper$")):
        table.get_by_role("button", name=f"Show {name}").click()
        expect(paper).to_have_url(re.compile(address))
        expect_count(paper, server.get("/paper?interpretation=favourable") if name == "Favourable" else api)
    rows = paper.locator("table[data-table] tr[data-verdict]")
    for verdict in VERDICTS:
        own = rows.filter(has=paper.locator("td[data-own]").get_by_text(verdict))
        assert own.count() == api["counts"][verdict]
    without = api["without_preview"]["reached"]
    expect(paper.get_by_test_id("count-without")).to_contain_text(f"{without} of {api['total']}")
    misprints = [cell for cell in api["cells"] if cell["misprint"]]
    assert len(misprints) == 3  # Table 8 rear tyre, Table 9 body acceleration twice
    for cell in misprints:
        row = paper.locator(f"#table-{cell['table']}-{cell['strategy']}-{cell['against']}-{cell['signal']}")
        follows = f"{abs(cell['misprint']['follows']):g}"
        expect(row).to_contain_text(re.compile(rf"misprint: [−+]{re.escape(follows)}\s%"))

    # What is not reached is named; a name leads to its row.
    paper.get_by_text(f"The {api['total'] - api['reached']} cells not reached").click()
    first = paper.locator("details li a").first
    target = first.get_attribute("href")
    first.click()
    expect(paper.locator(f"{target}:target")).to_be_in_viewport()


@pytest.mark.thorough
def test_a_switch_changes_address_and_count_and_only_tables_scroll_sideways(
    dashboard: Dashboard, paper: Page, server: Server
) -> None:
    before, after = server.get("/paper"), server.get("/paper?preview=none")
    assert before["reached"] != after["reached"]
    paper.get_by_role("radiogroup", name="Road preview").get_by_text("None", exact=True).click()
    expect(paper).to_have_url(re.compile(r"/paper\?preview=none$"))
    expect_count(paper, after)
    paper.reload()
    expect_count(paper, after)
    paper.go_back()
    expect_count(paper, before)
    # The table of what each switch does, which is asked for when it comes near the window, sets one from wherever the
    # others stand.
    paper.get_by_role("heading", name="What each switch does").scroll_into_view_if_needed()
    paper.get_by_test_id("effects").get_by_role("button", name="Try Road preview: None").click()
    expect_count(paper, after)
    paper.get_by_role("button", name="Reset 1 switch").click()
    expect(paper).to_have_url(re.compile(r"/paper$"))
    dashboard.expect_no_wider(400)
    assert paper.get_by_role("region", name="Table 4").evaluate("region => region.scrollWidth > region.clientWidth")


def test_figures_are_drawn_parts_sorted_and_the_scenario_opens_in_the_lab(
    dashboard: Dashboard, paper: Page, server: Server
) -> None:
    panels = paper.locator("figure[id^=figure-]")
    expect(panels).to_have_count(len(FIGURES))
    assert [panel.get_attribute("id") for panel in panels.all()] == [f"figure-{number}" for number in FIGURES]
    assert paper.locator("figure .scatterlayer .trace").count() == 0
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
    paper.get_by_role("combobox", name="Preview").select_option(label="Road ahead")
    paper.get_by_role("combobox", name="Controller").select_option(label="MPC")
    expect(rows).to_have_count(6)
    for first in ("Constant", "Planned"):  # ascending, then descending
        table.get_by_role("columnheader", name="Travel time").get_by_role("button").click()
        expect(rows.first).to_contain_text(first)
    expect(table.locator("tr[data-known=lv]")).to_have_count(1)

    figure = paper.locator("#figure-14")
    figure.scroll_into_view_if_needed()  # then it is drawn; another stretch draws it again
    expect(figure.locator(".scatterlayer .trace").first).to_be_attached()
    tick = figure.locator(".xtick text").first
    expect(tick).to_have_text("0")
    paper.get_by_text("Bump only").click()
    expect(tick).not_to_have_text("0")
    paper.get_by_role("button", name="Open this scenario in the lab").click()
    dashboard.expect_curves()
    assert dashboard.stored_run()["scenario"] == server.get("/paper")["scenario"]
