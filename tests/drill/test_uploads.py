"""Files that are no road and no recorded drive, for half a minute: each is refused at its line, nobody else notices.

Shipped settings. Each is sent by a client of its own, which sends it again as soon as it is answered.
"""

import asyncio
import time
from collections.abc import Mapping
from dataclasses import dataclass, field

import httpx
import numpy as np
import pytest

from backend.roads.opencrg import as_binary
from sim_core.scenario.measured import MeasuredRoad
from tests.drill.callers import quantile, served
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, Api

SECONDS = 30.0
OTHER = "127.0.0.2"
ROAD = "distance [m],height [mm]\n" + "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000))
MIDDLE = 100_002  # the line of step 100000


OPENCRG = "application/x-opencrg"
GRID = as_binary(MeasuredRoad.of(0.01 * np.random.default_rng(1).standard_normal(20_001)))
BEGIN = GRID.index(b"$$$$") + 73


def broken(file: str, line: str) -> bytes:
    """The file with another line in its middle."""
    lines = file.split("\n")
    lines[MIDDLE - 1] = line
    return "\n".join(lines).encode()


@dataclass(slots=True)
class Upload:
    """A bad file, what it is answered, and how long that took [s]."""

    content: bytes
    status: int
    detail: str
    kind: str = "text/csv"
    to: str = "roads"
    times: list[float] = field(default_factory=list)
    put_off: int = 0


DRIVE = "time [s],body_acceleration [m/s^2]\n" + "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000))


def recording(content: bytes, status: int, detail: str) -> Upload:
    return Upload(content, status, detail, to="recordings")


UPLOADS = {
    "NaN": Upload(broken(ROAD, "1000.00,nan"), 422, f"Line {MIDDLE}: A value is not a finite number."),
    "no number": Upload(broken(ROAD, "1000.00,3mm"), 422, f"Line {MIDDLE}: A value is not a number."),
    "a distance going back": Upload(broken(ROAD, "999.00,3"), 422, f"Line {MIDDLE}: The distance goes back"),
    "20 MB": Upload(b"distance [m],height [mm]\n" + 20_000_000 * b"1", 413, "The body may have 4194304 bytes."),
    "3 million short lines": Upload(b"x [m],z [m]\n" + 3_000_000 * b"1\n", 413, "The body may have 4194304 bytes."),
    "2 million empty lines": Upload(b"x [m],z [m]\n" + 2_000_000 * b"\n", 422, "Line 350001: The file may have"),
    "4 MB in one line": Upload(b"x [m],z [m]\n" + 4_000_000 * b"1", 422, "Line 2: A line may have 500 characters."),
    "a grid that is cut off": Upload(GRID[: len(GRID) // 2], 422, "The file is cut off: 20001 cross-sections", OPENCRG),
    "a grid of the wrong endianness": Upload(
        GRID[:BEGIN] + np.frombuffer(GRID, ">f4", offset=BEGIN).astype("<f4").tobytes(),
        422,
        "Values are none of a road; are they big-endian",
        OPENCRG,
    ),
    "16 MB of empty lines for a grid": Upload(
        GRID[:BEGIN].replace(b"KRBI", b"LRFI") + 16_000_000 * b"\n", 422, "Line 350", OPENCRG
    ),
    "a header without an end": Upload(b"$CT\n" + 4_000_000 * b"*\n", 422, "Line 20000: The header may have", OPENCRG),
    "4 MB of commas": Upload(4_000_000 * b",", 422, "Line 1: A line may have 500 characters."),
    "a drive whose clock goes back": recording(broken(DRIVE, "999.00,3"), 422, f"Line {MIDDLE}: The time goes back"),
    "a drive with an infinite value": recording(broken(DRIVE, "1000.00,inf"), 422, f"Line {MIDDLE}: "),
    "a drive with a formula": recording(broken(DRIVE, "1000.00,=1+1"), 422, f"Line {MIDDLE}: A value of column 2"),
    "a drive whose clock jumps ahead": recording(broken(DRIVE, "9999999,1"), 422, f"Line {MIDDLE + 1}: The time"),
    "a drive without a signal": recording(b"time [s],height [mm]\n" + 500_000 * b"0,1\n", 422, "Line 1: No column is"),
    "a drive of 2000 columns": recording(2000 * b"a," + b"b\n" + 900 * (2000 * b"1," + b"1\n"), 422, "Line 1: "),
    "a drive of 20 MB": recording(b"time [s],speed [m/s]\n" + 20_000_000 * b"1", 413, "The body may have 4194304"),
    "bytes that are no text": recording(4_000_000 * b"\xff", 422, "Line 1: This is not UTF-8"),
}


async def again_and_again(port: int, upload: Upload, address: str, end: float) -> None:
    transport = httpx.AsyncHTTPTransport(local_address=address)
    async with httpx.AsyncClient(
        transport=transport, base_url=f"http://127.0.0.1:{port}", timeout=HANG_TIMEOUT
    ) as client:
        while time.monotonic() < end or not upload.times:
            begin = time.monotonic()
            try:
                answer = await client.post(
                    f"/api/v1/{upload.to}", content=upload.content, headers={"Content-Type": upload.kind}
                )
            except (httpx.WriteError, httpx.ReadError):  # refused, and hung up on when it went on and on
                assert upload.status == 413
                upload.times.append(time.monotonic() - begin)
                continue
            if answer.status_code in (429, 503):
                upload.put_off += 1
                await asyncio.sleep(min(1.0, float(answer.headers["retry-after"])))
                continue
            upload.times.append(time.monotonic() - begin)
            assert answer.status_code == upload.status
            assert answer.json()["detail"].startswith(upload.detail)


async def drive(port: int, uploads: Mapping[str, Upload]) -> None:
    end = time.monotonic() + SECONDS
    addresses = [f"127.0.0.{number}" for number in range(3, 3 + len(uploads))]
    async with asyncio.TaskGroup() as group:
        for address, upload in zip(addresses, uploads.values(), strict=True):
            group.create_task(again_and_again(port, upload, address, end))
        other = group.create_task(served(port, [OTHER], end))
    for name, upload in uploads.items():
        print(
            f"\n{name}: {upload.status}, {len(upload.times)} times, {upload.put_off} put off, "
            f"{quantile(upload.times, 0.5):.0f} ms, at most {quantile(upload.times, 1):.0f}",
            end="",
        )
    health, runs = other.result()
    assert quantile(health, 0.99) < 500
    assert quantile(runs, 0.5) < 2000


@pytest.mark.parametrize("to", ["roads", "recordings"])
def test_bad_files_are_refused_at_their_line_and_disturb_nobody(api: Api, to: str) -> None:
    uploads = {name: upload for name, upload in UPLOADS.items() if upload.to == to}
    loops.run(lambda: drive(api.port, uploads))
