"""One server, one browser and one tab for all tests of a process; errors on a page fail its test."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Playwright, sync_playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, TOUR_SEEN, Dashboard
from tests.browser.server import Server
from tests.servers.process import ROOT


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    if not (ROOT / "frontend/dist/index.html").is_file():
        pytest.fail("The dashboard is not built: make setup builds it")
    with Server(tmp_path_factory.mktemp("server")) as server:
        server.wait_until_ready()
        yield server


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as playwright:
        yield playwright


@pytest.fixture(scope="session")
def browser(playwright: Playwright) -> Iterator[Browser]:
    browser = launch(playwright)
    yield browser
    browser.close()


@pytest.fixture(scope="session")
def context(browser: Browser, server: Server) -> Iterator[BrowserContext]:
    """One browser profile, which asked for no animations: they show nothing and cost frames."""
    context = browser.new_context(viewport=LAPTOP, base_url=server.url, color_scheme="light", reduced_motion="reduce")
    context.add_init_script(TOUR_SEEN)
    yield context
    context.close()


@pytest.fixture
def dashboard(context: BrowserContext, server: Server) -> Iterator[Dashboard]:
    """The profile's first tab, as if newly opened; the test fails when a script on its page does.

    A new tab is a new process, which compiles all scripts anew: two thirds of what opening a page costs.
    """
    dashboard = Dashboard(context.pages[0] if context.pages else context.new_page(), server.url)
    yield dashboard
    dashboard.leave()
    assert dashboard.failures == []
