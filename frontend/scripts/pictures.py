"""Pictures of every page for README and docs: `make screenshots` writes docs/images again, one file a page.

And the moving picture of the README, docs/images/ridelab.webp: the bump gets higher, then the cars drive over it. The
browser encodes each frame; a WebP file that moves is those frames in a row (RFC 9649, section 2.7), so nothing else is
needed.
"""

import base64
import struct
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import TOUR_SEEN, Dashboard, Scheme, expect
from tests.browser.server import Server
from tests.servers.process import ROOT, request

FOLDER = ROOT / "docs/images"
MOVING = FOLDER / "ridelab.webp"
LAPTOP, PHONE = (1440, 900), (390, 844)
PAPER_MS = 20 * 60 * 1000  # the paper's table on all its roads
SHOWN_MS, LAST_MS = 160, 1600  # each frame of the moving picture, and the last one
WIDTH, HEIGHT = 960, 600  # of it
ENCODE = """async ([png, width, height]) => {
  const image = await createImageBitmap(await (await fetch('data:image/png;base64,' + png)).blob());
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, 0, 0, width, height);
  const bytes = new Uint8Array(await (await canvas.convertToBlob({type: 'image/webp', quality: 0.6})).arrayBuffer());
  return btoa(bytes.reduce((text, byte) => text + String.fromCharCode(byte), ''));
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


def moving(frames: list[bytes]) -> bytes:
    """One WebP that shows these, single ones without transparency, one after the other, for ever."""
    size = struct.pack("<I", WIDTH - 1)[:3] + struct.pack("<I", HEIGHT - 1)[:3]
    chunks = _chunk(b"VP8X", b"\x02\0\0\0" + size) + _chunk(b"ANIM", b"\xff\xff\xff\xff\0\0")
    for number, frame in enumerate(frames, 1):
        duration = struct.pack("<I", LAST_MS if number == len(frames) else SHOWN_MS)[:3]
        picture = frame[frame.index(b"VP8 ") :]
        chunks += _chunk(b"ANMF", bytes(6) + size + duration + b"\x02" + picture)
    return _chunk(b"RIFF", b"WEBP" + chunks)


def _chunk(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def taken(dashboard: Dashboard) -> list[bytes]:
    """The frames as PNG: the slider of the bump's height is dragged, then the cursor goes along the bump."""
    page, frames = dashboard.page, [dashboard.page.screenshot()]
    for _ in range(8):
        dashboard.drag(dashboard.slider("Height"), (6,))
        dashboard.expect_curves()
        page.wait_for_load_state("networkidle")
        frames.append(page.screenshot())
    cursor = page.get_by_role("slider", name="Cursor")
    low, high = (float(cursor.get_attribute(name) or 0) for name in ("min", "max"))
    for share in range(1, 15):
        cursor.fill(str(low + (high - low) * share / 14))
        frames.append(page.screenshot())
    return frames


def encoded(page: Page, picture: bytes) -> bytes:
    """A PNG as a single WebP, in the size of the moving one."""
    text: str = page.evaluate(ENCODE, [base64.b64encode(picture).decode(), WIDTH, HEIGHT])
    return base64.b64decode(text)


def main() -> None:
    """Take them."""
    with (
        tempfile.TemporaryDirectory() as folder,
        sync_playwright() as playwright,
        Server(Path(folder)) as server,
        launch(playwright) as browser,
    ):
        server.wait_until_ready()

        def opened(address: str, size: tuple[int, int], scheme: Scheme) -> Dashboard:
            width, height = size
            context = browser.new_context(
                viewport={"width": width, "height": height},
                base_url=server.url,
                color_scheme=scheme,
                reduced_motion="reduce",
            )
            context.add_init_script(TOUR_SEEN)
            dashboard = Dashboard(context.new_page(), server.url)
            dashboard.page.goto(address)
            return dashboard

        for picture in PICTURES:
            dashboard = opened(picture.address(server), picture.size, picture.scheme)
            picture.ready(dashboard)
            dashboard.page.screenshot(path=FOLDER / f"{picture.name}.png")
            dashboard.page.context.close()
            print(FOLDER / f"{picture.name}.png")
        dashboard = opened("/", LAPTOP, "light")
        dashboard.expect_curves()
        frames = taken(dashboard)
        blank = browser.new_page()
        MOVING.write_bytes(moving([encoded(blank, frame) for frame in frames]))
        print(MOVING, f"{MOVING.stat().st_size / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
