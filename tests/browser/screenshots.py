"""Pictures of every page for README and docs: `make screenshots` writes docs/images again, one file a page."""

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import expect, sync_playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import Dashboard, Scheme
from tests.browser.server import Server
from tests.servers.process import ROOT, request

FOLDER = ROOT / "docs/images"
LAPTOP, PHONE = (1440, 900), (390, 844)


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """One file.

    Attributes:
        address: Of the page; made on the server where it shows a job.
        ready: What is waited for before the picture is taken.
    """

    name: str
    address: Callable[[Server], str]
    ready: Callable[[Dashboard], None] = lambda dashboard: dashboard.expect_curves()
    size: tuple[int, int] = LAPTOP
    scheme: Scheme = "light"


def _sweep(server: Server) -> str:
    grid = {"road.bump.height": [0.04, 0.06, 0.08, 0.1, 0.12], "speed.target_speed_kmh": [15, 20, 25, 30, 35, 40]}
    return _finished(server, server.submit({"grid": grid}, ["lv", "lqr"]))


def _study(server: Server) -> str:
    ranges = {"mismatch.body_mass": [0.8, 1.25], "mismatch.damping": [0.7, 1.3], "mismatch.preview_offset": [-0.3, 0.3]}
    sweep = {"latin_hypercube": {"ranges": ranges, "samples": 60, "seed": 1}}
    return _finished(server, server.submit(sweep, ["lv", "lqr", "passive"])).replace("/b/", "/robustness/")


def _tuning(server: Server) -> str:
    objectives = [{"kind": "paper"}, {"kind": "peaks"}]
    body = {"strategy": "lqr", "objectives": objectives, "seeds": [1, 2], "trials": 64, "population": 16}
    tuning = server.post("/tunings", body)["id"]
    _end(server, f"/tunings/{tuning}")
    return f"/tuner/{tuning}"


def _finished(server: Server, path: str) -> str:
    batch = f"/batches/{path.removeprefix('/b/')}"
    _end(server, batch)
    return path


def _end(server: Server, job: str) -> None:
    request("GET", f"{server.url}/api/v1{job}/events").raise_for_status()  # a stream that ends with the job
    assert server.get(job)["state"] == "done"


def _plots(dashboard: Dashboard) -> None:
    expect(dashboard.page.locator("svg.main-svg").first).to_be_visible()


def _settled(dashboard: Dashboard) -> None:
    expect(dashboard.page.get_by_role("heading").nth(1)).to_be_visible()
    dashboard.page.wait_for_load_state("networkidle")


def _counted(dashboard: Dashboard) -> None:
    _settled(dashboard)
    expect(dashboard.page.get_by_text("so far")).to_have_count(0)


PICTURES = (
    Picture(name="dashboard", address=lambda server: "/"),
    Picture(name="dashboard-dark", address=lambda server: "/", scheme="dark"),
    Picture(name="dashboard-phone", address=lambda server: "/", size=PHONE),
    Picture(name="sweep", address=_sweep, ready=_plots),
    Picture(name="robustness", address=_study, ready=_settled),
    Picture(name="tuner", address=_tuning, ready=_plots),
    Picture(name="paper", address=lambda server: "/paper", ready=_counted),
    Picture(name="ecu", address=lambda server: "/ecu", ready=_settled),
)


def main() -> None:
    """Take them."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = Server(Path(folder))
        server.wait_until_ready()
        browser = launch(playwright)
        try:
            for picture in PICTURES:
                address, (width, height) = picture.address(server), picture.size
                context = browser.new_context(
                    viewport={"width": width, "height": height},
                    base_url=server.url,
                    color_scheme=picture.scheme,
                    reduced_motion="reduce",
                )
                dashboard = Dashboard(context.new_page(), server.url)
                dashboard.page.goto(address)
                picture.ready(dashboard)
                dashboard.page.screenshot(path=FOLDER / f"{picture.name}.png")
                context.close()
                print(FOLDER / f"{picture.name}.png")
        finally:
            browser.close()
            server.end()


if __name__ == "__main__":
    main()
