"""The moving picture of the README, docs/images/ridelab.webp: the bump gets higher, then the cars drive over it.

`make screenshots` takes it. The browser encodes each frame; a WebP file that moves is those frames in a row
(RFC 9649, section 2.7), so nothing else is needed.
"""

import base64
import struct
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from tests.browser.chromium import launch
from tests.browser.dashboard import Dashboard
from tests.browser.screenshots import FOLDER
from tests.browser.server import Server

FILE = FOLDER / "ridelab.webp"
WIDTH, HEIGHT = 960, 600
SHOWN_MS, LAST_MS = 160, 1600  # each frame, and the last one
ENCODE = """async ([png, width, height]) => {
  const image = await createImageBitmap(await (await fetch('data:image/png;base64,' + png)).blob());
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, 0, 0, width, height);
  const bytes = new Uint8Array(await (await canvas.convertToBlob({type: 'image/webp', quality: 0.6})).arrayBuffer());
  return btoa(bytes.reduce((text, byte) => text + String.fromCharCode(byte), ''));
}"""


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
    """Take it."""
    with (
        tempfile.TemporaryDirectory() as folder,
        sync_playwright() as playwright,
        Server(Path(folder)) as server,
        launch(playwright) as browser,
    ):
        server.wait_until_ready()
        context = browser.new_context(viewport={"width": 1440, "height": 900}, base_url=server.url)
        dashboard = Dashboard(context.new_page(), server.url)
        dashboard.open("/")
        frames = taken(dashboard)
        blank = browser.new_page()
        FILE.write_bytes(moving([encoded(blank, frame) for frame in frames]))
    print(FILE, f"{FILE.stat().st_size / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
