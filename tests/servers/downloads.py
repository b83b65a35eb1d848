"""Downloads at a pace, and the memory of the service meanwhile."""

import contextlib
import socket
import threading
import time
from pathlib import Path

import psutil

from tests.servers.process import HANG_TIMEOUT, Api


class Watch:
    """The largest memory of each process of a service [MB], asked for as often as /proc answers."""

    def __init__(self, api: Api) -> None:
        self.peaks: dict[int, float] = {}
        self._api = api
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._look)

    def __enter__(self) -> "Watch":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()

    @property
    def service(self) -> float:
        return self.peaks[self._api.pid]

    @property
    def workers(self) -> list[float]:
        return sorted((peak for pid, peak in self.peaks.items() if pid != self._api.pid), reverse=True)

    def _look(self) -> None:
        while not self._ended.wait(0.01):
            for pid in (self._api.pid, *(child.pid for child in self._api.children())):
                with contextlib.suppress(OSError, psutil.NoSuchProcess):
                    self.peaks[pid] = max(self.peaks.get(pid, 0.0), proportional_mb(pid))


def proportional_mb(pid: int) -> float:
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024


def opened(api: Api, path: str, address: str) -> socket.socket:
    """A connection from that address, which has asked for it and reads little at once."""
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
    connection.settimeout(HANG_TIMEOUT)
    connection.bind((address, 0))
    connection.connect(("127.0.0.1", api.port))
    connection.sendall(f"GET /api/v1{path} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n".encode())
    return connection


def download(api: Api, path: str, address: str, pace: float | None = None) -> tuple[int, int, bool]:
    """Status, bytes of the body, and whether all came; read at that pace [bytes/s]."""
    with opened(api, path, address) as connection:
        head = b""
        while b"\r\n\r\n" not in head:
            head += connection.recv(65536)
        head, _, body = head.partition(b"\r\n\r\n")
        length = int(head.lower().partition(b"content-length: ")[2].split(b"\r\n")[0])
        begin, count = time.monotonic(), len(body)
        while piece := connection.recv(65536):
            count += len(piece)
            if pace is not None:
                time.sleep(max(0.0, begin + count / pace - time.monotonic()))
    return int(head.split()[1]), count, count == length


def spooled(folder: Path) -> list[Path]:
    return list((folder / "data" / "spool").glob("*"))
