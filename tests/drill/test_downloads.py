"""The longest answers there are, many at once and half of them read slowly: memory of the service and of each worker.

Shipped settings, Linux. Memory is the proportional set size of /proc/PID/smaps_rollup: each process's own pages, and
its share of those it shares with the others.
"""

import contextlib
import socket
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil
import pytest

from tests.servers.process import HANG_TIMEOUT, Api, ask, wait_until

SERVICE, WORKER = 700, 500  # at most [MB]
SLOWLY = 4_000_000  # bytes a second
WALKING = {"initial_speed_kmh": 5, "target_speed_kmh": 5}
# Passive at walking pace over the longest road: 2.2 million samples, a CSV of 289 MB.
LONGEST = {"scenario": {"road": {"length": 3000}, "speed": WALKING}, "strategies": ["passive"]}
LONG = {"scenario": {"road": {"length": 1500}, "speed": WALKING}, "strategies": ["passive", "lqr", "skyhook"]}
# As many samples as bands over several roads may have.
ROADS = {"scenario": {"road": {"length": 700}, "speed": WALKING}, "strategies": ["passive"], "roads": 3}
OF_SEVERAL = (
    *(f"series?strategy=passive,lqr,skyhook&format={kind}" for kind in ("json", "csv")),
    "series?strategy=lqr&encoding=base64",
    "series?strategy=passive,lqr,skyhook&points=100000",
    "figures",
    "report.html",
)


@contextlib.contextmanager
def bounded(api: Api) -> Iterator[None]:
    """Look at the memory of all processes meanwhile; neither the service nor a worker takes too much."""
    peaks, ended = dict[int, float](), threading.Event()

    def look() -> None:
        while not ended.wait(0.01):
            for pid in (api.pid, *(child.pid for child in api.children())):
                with contextlib.suppress(OSError, psutil.NoSuchProcess):
                    lines = Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines()
                    now = next(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024
                    peaks[pid] = max(peaks.get(pid, 0.0), now)

    with ThreadPoolExecutor(1) as thread:
        looking = thread.submit(look)
        try:
            yield
        finally:
            ended.set()
        looking.result()
    service, workers = peaks.pop(api.pid), sorted(peaks.values())
    print(f"\nservice {service:.0f} MB, workers {', '.join(f'{each:.0f}' for each in workers)} MB")
    assert service < SERVICE
    assert workers[-1] < WORKER


def download(api: Api, path: str, number: int) -> int:
    """Status of a whole answer, read by a client of its own, slowly by every other one."""
    with socket.socket() as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
        connection.settimeout(HANG_TIMEOUT)
        connection.bind((f"127.0.0.{number + 2}", 0))
        connection.connect(("127.0.0.1", api.port))
        connection.sendall(f"GET /api/v1/runs/{path} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n".encode())
        with connection.makefile("rb") as answer:
            status = int(answer.readline().split()[1])
            headers = dict(line.decode().lower().split(": ", 1) for line in iter(answer.readline, b"\r\n"))
            begin, count = time.monotonic(), 0
            while piece := answer.read1(65536):
                count += len(piece)
                if number % 2:
                    time.sleep(max(0.0, begin + count / SLOWLY - time.monotonic()))
    assert count == int(headers["content-length"]), path
    return status


@pytest.mark.parametrize("kinds", ["six of the longest files", "all long answers twice"])
def test_long_answers_to_fast_and_slow_readers_take_little_memory(api: Api, folder: Path, kinds: str) -> None:
    if kinds.startswith("six"):
        paths = [f"{ask(api.url, 'POST', '/runs', json=LONGEST)['id']}/series?strategy=passive&format=csv"] * 6
    else:
        several, roads = (ask(api.url, "POST", "/runs", json=body)["id"] for body in (LONG, ROADS))
        paths = [*(f"{several}/{path}" for path in OF_SEVERAL), f"{roads}/bands"] * 2
    with bounded(api), ThreadPoolExecutor(len(paths)) as threads:
        statuses = list(threads.map(lambda each: download(api, *each), zip(paths, range(len(paths)), strict=True)))
    good = {200} if kinds.startswith("six") else {200, 429, 503}
    assert not [(path, status) for path, status in zip(paths, statuses, strict=True) if status not in good]
    spool = folder / "data" / "spool"
    wait_until(lambda: len(list(spool.glob("*"))) <= 1, "every file is gone but the cached band's")
