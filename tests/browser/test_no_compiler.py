"""The pages of a service that finds no C compiler: what needs one says so where its result would stand."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from backend.ecu.build import NO_COMPILER
from tests.browser.dashboard import LAPTOP, Dashboard
from tests.servers.api import Api
from tests.servers.compilers import Bare
from tests.servers.process import request
from tests.servers.reproduction import store_in_database

LONG_MS = 60_000  # computing on a busy machine


def typeset(sentence: str) -> str:
    return sentence.replace("'", "’")


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Api]:
    """It has stored what of the paper's reproduction is only simulated."""
    folder = tmp_path_factory.mktemp("bare")
    store_in_database(f"sqlite:///{folder}/data/ridelab.sqlite", ecu=False)
    api = Api(folder, **Bare(folder).environment)
    api.wait_until_ready()
    yield api
    api.end()


@pytest.fixture(scope="module")
def tab(browser: Browser, bare: Api) -> Iterator[Page]:
    context = browser.new_context(viewport=LAPTOP, base_url=bare.url, color_scheme="light", reduced_motion="reduce")
    yield context.new_page()
    context.close()


@pytest.fixture
def visitor(tab: Page, bare: Api) -> Iterator[Dashboard]:
    dashboard = Dashboard(tab, bare.url)
    yield dashboard
    dashboard.leave()
    assert dashboard.failures == []


def test_the_paper_counts_what_is_available_and_names_the_rest(visitor: Dashboard, bare: Api) -> None:
    page = visitor.page
    found = request("GET", f"{bare.url}/api/v1/paper").json()
    # What the switches do is 12 reproductions more: tests/api looks at the real answer.
    effects = {"rows": [], "complete": True, "unavailable": found["unavailable"]}
    page.route("**/api/v1/paper/readings*", lambda route: route.fulfill(json=effects))
    page.goto("/paper")
    count = page.get_by_test_id("count")
    expect(count).to_be_visible(timeout=LONG_MS)
    expect(count).to_contain_text(f"{found['reached']} of 40 cells reached, 8 not available here")
    expect(page.get_by_test_id("count-without")).to_contain_text(f"{found['without_preview']['reached']} of 40")
    expect(page.get_by_test_id("unavailable")).to_contain_text(f"not counted. {typeset(NO_COMPILER)}.")
    expect(page.get_by_text(f"The {40 - found['reached']} cells not reached")).to_be_visible()
    page.locator("#switches").get_by_role("heading", name="What each switch does").scroll_into_view_if_needed()
    expect(page.get_by_text("Without the 8 cells that are not available here.")).to_be_visible()
    for table in (9, 10):
        shown = page.locator(f"table[data-table='{table}']")
        own = shown.locator("tr[data-verdict=unavailable]")
        expect(own.locator("td[data-own]").get_by_text("not available")).to_have_count(4)
        expect(own.locator("td[data-without]").get_by_text("not available")).to_have_count(4)
        expect(shown.get_by_text(typeset(NO_COMPILER))).to_be_visible()
    figure = page.locator("#figure-19")
    expect(figure).to_contain_text(typeset(NO_COMPILER), timeout=LONG_MS)
    expect(page.locator("#figure-14")).not_to_contain_text("compiler")
