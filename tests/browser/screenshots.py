"""Pictures of every page for README and docs: `make screenshots` writes docs/images again, one file a page.

Beside them lies words.json, the words in each picture: `make drill` compares them with the page of today.
"""

import json
import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import TOUR_SEEN, Dashboard, Scheme, expect
from tests.browser.server import Server
from tests.servers.process import ROOT, request

FOLDER = ROOT / "docs/images"
WORDS = FOLDER / "words.json"
LAPTOP, PHONE = (1440, 900), (390, 844)
PAPER_MS = 20 * 60 * 1000  # the paper's table on all its roads
TIMES = re.compile(r"\d+ \w+ \d{4}, \d+:\d+|took [^·]*|from store|computed in")  # other words at another time
VISIBLE_TEXTS = """() => {
  const texts = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const range = document.createRange();
    range.selectNodeContents(walker.currentNode);
    const box = range.getBoundingClientRect();
    const inside = box.width > 1 && box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth;
    const element = walker.currentNode.parentElement;
    if (inside && element.checkVisibility({visibilityProperty: true})) texts.push(range.toString());
  }
  return texts;
}"""


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


def words(dashboard: Dashboard) -> list[str]:
    """The words in the visible part of the page, each once, in order of the alphabet; numbers and times are none."""
    texts = dashboard.page.evaluate(VISIBLE_TEXTS)
    return sorted({word for text in texts for word in re.findall(r"[^\W\d_]{3,20}", TIMES.sub("", text))})


def _plots(dashboard: Dashboard) -> None:
    expect(dashboard.page.locator("svg.main-svg").first).to_be_visible()
    _settled(dashboard)


def _ranges(dashboard: Dashboard) -> None:
    expect(dashboard.page.get_by_role("figure").first).to_be_visible()
    _settled(dashboard)


def _settled(dashboard: Dashboard) -> None:
    expect(dashboard.page.get_by_role("heading").nth(1)).to_be_visible()
    dashboard.page.wait_for_load_state("networkidle")


def _driven(dashboard: Dashboard) -> None:
    expect(dashboard.page.get_by_test_id("hil-count")).to_be_visible()
    _settled(dashboard)


def _counted(dashboard: Dashboard) -> None:
    _settled(dashboard)
    expect(dashboard.page.get_by_test_id("count")).not_to_contain_text("so far", timeout=PAPER_MS)


PICTURES = (
    Picture(name="dashboard", address=lambda server: "/"),
    Picture(name="dashboard-dark", address=lambda server: "/", scheme="dark"),
    Picture(name="dashboard-phone", address=lambda server: "/", size=PHONE),
    Picture(name="sweep", address=_sweep, ready=_plots),
    Picture(name="robustness", address=_study, ready=_ranges),
    Picture(name="tuner", address=_tuning, ready=_plots),
    Picture(name="paper", address=lambda server: "/paper", ready=_counted),
    Picture(name="ecu", address=lambda server: "/ecu", ready=_driven),
)


def main() -> None:
    """Take them."""
    shown = {}
    with (
        tempfile.TemporaryDirectory() as folder,
        sync_playwright() as playwright,
        Server(Path(folder)) as server,
        launch(playwright) as browser,
    ):
        server.wait_until_ready()
        for picture in PICTURES:
            address, (width, height) = picture.address(server), picture.size
            context = browser.new_context(
                viewport={"width": width, "height": height},
                base_url=server.url,
                color_scheme=picture.scheme,
                reduced_motion="reduce",
            )
            context.add_init_script(TOUR_SEEN)
            dashboard = Dashboard(context.new_page(), server.url)
            dashboard.page.goto(address)
            picture.ready(dashboard)
            dashboard.page.screenshot(path=FOLDER / f"{picture.name}.png")
            shown[picture.name] = words(dashboard)
            context.close()
            print(FOLDER / f"{picture.name}.png")
    WORDS.write_text(json.dumps(shown, ensure_ascii=False, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
