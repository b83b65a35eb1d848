"""Reports as somebody reads them who has the file and nothing else."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from backend.figures import PANELS
from tests.browser.dashboard import AXE, Dashboard
from tests.browser.server import Server

DRAWN = "[data-figure] .scatterlayer .trace"


@pytest.fixture(scope="module")
def report(server: Server, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A saved report of a run of two strategies."""
    body = {"scenario": {"road": {"bump": {"height": 0.12}}}, "strategies": ["lv", "passive"]}
    run = httpx.post(f"{server.url}/api/v1/runs", json=body, timeout=60).raise_for_status().json()
    answer = httpx.get(f"{server.url}/api/v1/runs/{run['id']}/report.html", timeout=60).raise_for_status()
    path = tmp_path_factory.mktemp("reports") / "report.html"
    path.write_bytes(answer.content)
    return path


@pytest.fixture
def alone(browser: Browser) -> Iterator[BrowserContext]:
    """A browser that is not connected to anything and notes what it would have asked for."""
    context = browser.new_context(viewport={"width": 1366, "height": 768}, offline=True)
    yield context
    context.close()


def opened(context: BrowserContext, address: str, failures: list[str]) -> Page:
    """The page with all its figures drawn."""
    page = context.new_page()
    page.on("console", lambda message: message.type in ("error", "warning") and failures.append(message.text))
    page.on("pageerror", lambda error: failures.append(str(error)))
    page.on("request", lambda request: request.url != address and failures.append(f"asked for {request.url[:80]}"))
    page.goto(address)
    expect(page.locator("[data-drawn]")).to_have_count(len(PANELS))
    return page


def test_a_saved_report_draws_its_figures_offline(alone: BrowserContext, report: Path) -> None:
    failures: list[str] = []
    page = opened(alone, report.as_uri(), failures)
    expect(page.locator(DRAWN)).to_have_count(2 * len(PANELS))
    for width in (1366, 820, 400):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    speed = page.locator("[data-figure=speed]")
    expect(speed.locator("svg.main-svg").first).to_have_attribute(
        "width", str(speed.evaluate("node => node.clientWidth"))
    )
    assert failures == []


def test_it_is_light_dark_and_always_light_on_paper(alone: BrowserContext, report: Path, tmp_path: Path) -> None:
    failures: list[str] = []
    page = opened(alone, report.as_uri(), failures)
    axis = page.locator("[data-figure=speed] .xtick text").first
    colours = {}
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        colours[scheme] = page.evaluate("getComputedStyle(document.body).color")
    assert colours == {"light": "rgb(27, 35, 38)", "dark": "rgb(230, 234, 236)"}
    expect(axis).to_have_css("fill", "rgb(169, 179, 185)")
    page.evaluate(
        """() => window.addEventListener('beforeprint', () => {
          window.printed = [...document.querySelectorAll('[data-figure]')].map(
            plot => [plot.dataset.drawn, plot.querySelectorAll('.scatterlayer .trace').length,
                     getComputedStyle(plot.querySelector('.xtick text')).fill].join(' '));
        })"""
    )
    page.pdf(path=tmp_path / "report.pdf", prefer_css_page_size=True)
    assert page.evaluate("window.printed") == ["paper 2 rgb(74, 85, 91)"] * len(PANELS)
    expect(axis).to_have_css("fill", "rgb(169, 179, 185)")
    assert failures == []


def test_it_is_accessible(alone: BrowserContext, report: Path) -> None:
    page = opened(alone, report.as_uri(), [])
    page.evaluate(AXE.read_text())  # evaluated by the debugger, which the page's policy does not bind
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        found = page.evaluate(
            """async () => (await axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21aa']})).violations
               .map(({id, nodes}) => [id, ...nodes.slice(0, 3).map(({html}) => html.slice(0, 160))].join(' | '))"""
        )
        assert found == [], scheme


def test_the_export_menu_gives_the_report_of_what_is_shown(dashboard: Dashboard, tmp_path: Path) -> None:
    dashboard.open("/?baseline=lqr")
    page = dashboard.page
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as download:
        page.get_by_role("menuitem", name="HTML report").click()
    assert download.value.suggested_filename == f"ridelab-{dashboard.run_id}.html"
    download.value.save_as(tmp_path / "report.html")
    failures: list[str] = []
    report = opened(page.context, (tmp_path / "report.html").as_uri(), failures)
    expect(report.locator("header")).to_contain_text(dashboard.run_id)
    expect(report.locator("tr.baseline").first).to_contain_text("LQR")
    assert failures == []
    report.close()


def test_it_opens_by_its_address_under_its_own_policy(dashboard: Dashboard) -> None:
    dashboard.open()
    failures: list[str] = []
    page = opened(dashboard.page.context, f"{dashboard.url}/api/v1/runs/{dashboard.run_id}/report.html", failures)
    assert [text for text in failures if "favicon" not in text] == []
    page.close()
