"""Files that are no road and no recorded drive, for half a minute: each is refused, and nobody else notices.

Each is sent by a client of its own, which sends it again as soon as it is answered. At which line each is refused is
shown by tests/api/test_measured_roads.py and test_recordings.py.
"""

import asyncio
import time

import httpx

from tests.drill.callers import quantile, served
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, Api

SECONDS = 30.0
OTHER = "127.0.0.2"
ROWS = "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000)).replace("1000.00,5", "1000.00,inf")
# The longest that are read to their middle or end before they are refused, and what is too long.
UPLOADS = {
    "a road with an infinite height": ("roads", 422, f"distance [m],height [mm]\n{ROWS}".encode()),
    "2 million empty lines": ("roads", 422, b"x [m],z [m]\n" + 2_000_000 * b"\n"),
    "4 MB in one line": ("roads", 422, b"x [m],z [m]\n" + 4_000_000 * b"1"),
    "20 MB": ("roads", 413, b"distance [m],height [mm]\n" + 20_000_000 * b"1"),
    "a drive with an infinite value": ("recordings", 422, f"time [s],body_acceleration [m/s^2]\n{ROWS}".encode()),
    "a drive of 2000 columns": ("recordings", 422, 2000 * b"a," + b"b\n" + 900 * (2000 * b"1," + b"1\n")),
    "a drive without a signal": ("recordings", 422, b"time [s],height [mm]\n" + 500_000 * b"0,1\n"),
    "bytes that are no text": ("recordings", 422, 4_000_000 * b"\xff"),
}


async def again_and_again(port: int, name: str, address: str, end: float) -> None:
    to, status, content = UPLOADS[name]
    times = list[float]()
    transport = httpx.AsyncHTTPTransport(local_address=address)
    base_url = f"http://127.0.0.1:{port}/api/v1/"
    async with httpx.AsyncClient(transport=transport, base_url=base_url, timeout=HANG_TIMEOUT) as client:
        while time.monotonic() < end or not times:
            begin = time.monotonic()
            try:
                answer = await client.post(to, content=content, headers={"Content-Type": "text/csv"})
            except (httpx.WriteError, httpx.ReadError):  # refused, and hung up on when it went on and on
                assert status == 413
            else:
                if answer.status_code in (429, 503):
                    await asyncio.sleep(min(1.0, float(answer.headers["retry-after"])))
                    continue
                assert answer.status_code == status, answer.text
            times.append(time.monotonic() - begin)
    print(f"\n{name}: {status}, {len(times)} times, {quantile(times, 0.5):.0f} ms", end="")


async def drive(port: int) -> None:
    end = time.monotonic() + SECONDS
    async with asyncio.TaskGroup() as group:
        for number, name in enumerate(UPLOADS, 3):
            group.create_task(again_and_again(port, name, f"127.0.0.{number}", end))
        other = group.create_task(served(port, [OTHER], end))
    health, runs = other.result()
    assert quantile(health, 0.99) < 500
    assert quantile(runs, 0.5) < 2000


def test_bad_files_are_refused_and_disturb_nobody(api: Api) -> None:
    loops.run(lambda: drive(api.port))
