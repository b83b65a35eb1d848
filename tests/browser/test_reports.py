"""Paper, and reports as somebody reads them who has the file and nothing else."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Download, Page, Request

from backend.runs.figures import PANELS
from tests.browser.dashboard import RULES, THOROUGH, Dashboard, Scheme, expect, violations

TICKS: dict[Scheme, str] = {"light": "rgb(74, 85, 91)", "dark": "rgb(169, 179, 185)"}
DRAWN = "[data-figure] .scatterlayer .trace"


@pytest.fixture
def alone(browser: Browser) -> Iterator[BrowserContext]:
    """A browser that is not connected to anything."""
    context = browser.new_context(
        viewport={"width": 1366, "height": 768}, offline=True, color_scheme="light", reduced_motion="reduce"
    )
    yield context
    context.close()


def opened(context: BrowserContext, address: str, failures: list[str]) -> Page:
    """The page with all its figures drawn; what it would have asked for is a failure."""
    page = context.new_page()

    def listen(message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            failures.append(message.text)

    def ask(request: Request) -> None:
        if request.url != address:
            failures.append(f"asked for {request.url[:80]}")

    page.on("console", listen)
    page.on("pageerror", lambda error: failures.append(str(error)))
    page.on("request", ask)
    page.goto(address)
    expect(page.locator("[data-drawn]")).to_have_count(len(PANELS))
    return page


def saved_report(dashboard: Dashboard) -> Download:
    return dashboard.exported("HTML report")


def test_the_lab_is_printed_and_its_report_works_offline(
    dashboard: Dashboard, alone: BrowserContext, tmp_path: Path
) -> None:
    """A report draws its figures at any width, is light, dark and always light on paper, and accessible.

    The browser fires its events around printing: panels of the lab that nobody has scrolled to are drawn for them.
    """
    dashboard.open("/?baseline=lqr")
    lab = dashboard.page
    lab.evaluate(
        """() => window.addEventListener('afterprint', () => {
          window.printed = [...document.querySelectorAll('section[data-figure]')]
            .map(panel => Number(panel.querySelector('canvas').dataset.drawn));
        })"""
    )
    lab.pdf(path=tmp_path / "lab.pdf", prefer_css_page_size=True)
    assert lab.evaluate("window.printed") == [3] * len(PANELS)
    # The car, the road and two signals; two signals and the table; what the other panels show: none is lost or torn.
    assert len(re.findall(rb"/Type /Page\b", (tmp_path / "lab.pdf").read_bytes())) == 3
    lab.emulate_media(media="print")
    expect(lab.get_by_role("button", name="Share")).to_be_hidden()
    expect(lab.get_by_title("Make LQR stand out")).to_be_visible()  # whose curve is which
    expect(lab.get_by_text(dashboard.run_id)).to_be_visible()
    lab.emulate_media(media="null")

    download = saved_report(dashboard)
    assert download.suggested_filename == f"ridelab-{dashboard.run_id}.html"
    file = tmp_path / "report.html"
    download.save_as(file)
    failures: list[str] = []
    page = opened(alone, file.as_uri(), failures)
    expect(page.locator("header")).to_contain_text(dashboard.run_id)
    expect(page.locator("tr.baseline").first).to_contain_text("LQR")
    expect(page.locator(DRAWN)).to_have_count(3 * len(PANELS))
    speed = page.locator("[data-figure=speed]")
    axis = speed.locator(".xtick text").first
    for width in (1366, 400):
        page.set_viewport_size({"width": width, "height": 800})
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    expect(speed.locator("svg.main-svg").first).to_have_attribute(
        "width", str(speed.evaluate("node => node.clientWidth"))
    )

    colours = {}
    for scheme, colour in TICKS.items():
        page.emulate_media(color_scheme=scheme)
        expect(axis).to_have_css("fill", colour)
        colours[scheme] = page.evaluate("getComputedStyle(document.body).color")
        if scheme == "light" or THOROUGH:
            assert violations(page.locator("html"), RULES[scheme]) == []
    assert colours == {"light": "rgb(27, 35, 38)", "dark": "rgb(230, 234, 236)"}

    page.evaluate(
        """() => window.addEventListener('beforeprint', () => {
          window.printed = [...document.querySelectorAll('[data-figure]')].map(
            plot => [plot.dataset.drawn, plot.querySelectorAll('.scatterlayer .trace').length,
                     getComputedStyle(plot.querySelector('.xtick text')).fill].join(' '));
        })"""
    )
    page.pdf(path=tmp_path / "report.pdf", prefer_css_page_size=True)
    assert page.evaluate("window.printed") == [f"paper 3 {TICKS['light']}"] * len(PANELS)
    expect(axis).to_have_css("fill", TICKS["dark"])
    assert failures == []
