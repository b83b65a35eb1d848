"""Three times as much as the service can do, for a minute: it does nearly all it can, and refuses the rest at once.

Shipped settings, twenty addresses, each request a road nobody drove before. Every bound is a ratio to one of the same
run, so that the machine does not matter, or far above what is measured. DRILL_SECONDS= changes how long it takes.
"""

import asyncio
import itertools
import os
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.servers.api import Api

SECONDS = float(os.environ.get("DRILL_SECONDS", "60"))
WARM_UP = 5.0  # [s]
CAPACITY = 15.0  # as long is the capacity measured [s]
ADDRESSES = [f"127.0.0.{number}" for number in range(2, 22)]
LOOK = 0.1  # between two looks at what is stored, and at health [s]
_seeds = itertools.count(1)


@dataclass
class Tally:
    """What came back, and how long it took [s]."""

    good: list[float] = field(default_factory=list)
    refused: list[float] = field(default_factory=list)
    invalid: int = 0
    health: list[float] = field(default_factory=list)
    stored: list[float] = field(default_factory=list)
    waits: set[int] = field(default_factory=set)  # what refusals said of it


class Caller:
    """As little of an HTTP client as will do: a full one would need more of the machine than the service."""

    def __init__(self, port: int, address: str) -> None:
        self._port = port
        self._address = address
        self._idle: list[tuple[asyncio.StreamReader, asyncio.StreamWriter]] = []

    async def call(self, method: str, path: str, body: bytes = b"") -> tuple[int, dict[str, str], bytes]:
        """Status, headers and body."""
        reader, writer = self._idle.pop() if self._idle else await self._connect()
        head = f"{method} {path} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
        writer.write(f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body)
        first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().strip().split("\r\n")
        headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
        answer = await reader.readexactly(int(headers["content-length"]))
        self._idle.append((reader, writer))
        return int(first.split()[1]), headers, answer

    async def close(self) -> None:
        for _, writer in self._idle:
            writer.close()
        await asyncio.gather(*(writer.wait_closed() for _, writer in self._idle), return_exceptions=True)

    async def _connect(self) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
        return await asyncio.open_connection("127.0.0.1", self._port, local_addr=(self._address, 0))


async def ask(caller: Caller, tally: Tally, *, valid: bool = True) -> None:
    """A run nobody asked for yet, or what is none."""
    strategy = b"lqr" if valid else b"none"
    body = b'{"scenario": {"road": {"seed": %d}}, "strategies": ["lv", "%s"]}' % (next(_seeds), strategy)
    begin = time.monotonic()
    status, headers, _ = await caller.call("POST", "/api/v1/runs", body)
    took = time.monotonic() - begin
    if status == 200:
        tally.good.append(took)
    elif status == 422 and not valid:
        tally.invalid += 1
    else:
        assert status in (429, 503), status
        tally.refused.append(took)
        tally.waits.add(int(headers["retry-after"]))


async def look(caller: Caller, path: str, into: list[float], end: float) -> None:
    while time.monotonic() < end:
        begin = time.monotonic()
        assert (await caller.call("GET", path))[0] == 200
        into.append(time.monotonic() - begin)
        await asyncio.sleep(LOOK)


async def closed(callers: list[Caller], connections: int, seconds: float) -> float:
    """So many who each ask again when they are answered: the capacity [1/s]."""
    tally, begin = Tally(), time.monotonic()

    async def one(caller: Caller) -> None:
        while time.monotonic() < begin + seconds:
            await ask(caller, tally)

    await asyncio.gather(*(one(caller) for caller in callers[:connections]))
    return len(tally.good) / (time.monotonic() - begin)


async def opened(callers: list[Caller], rate: float, stored: str, valid: Iterator[bool]) -> tuple[Tally, float]:
    """So many a second [1/s], whatever becomes of those before: what came back, and what was done [1/s]."""
    tally, begin = Tally(), time.monotonic()
    onlookers = [Caller(callers[0]._port, "127.0.0.30"), Caller(callers[0]._port, "127.0.0.31")]
    async with asyncio.TaskGroup() as group:
        group.create_task(look(onlookers[0], "/healthz", tally.health, begin + SECONDS))
        group.create_task(look(onlookers[1], stored, tally.stored, begin + SECONDS))
        for number in range(int(rate * SECONDS)):
            await asyncio.sleep(max(0.0, begin + number / rate - time.monotonic()))
            group.create_task(ask(callers[number % len(callers)], tally, valid=next(valid)))
    took = time.monotonic() - begin
    await asyncio.gather(*(caller.close() for caller in onlookers))
    return tally, len(tally.good) / took


def quantile(times: list[float], share: float) -> float:
    """Of times in seconds [ms]."""
    return 1000 * sorted(times)[min(len(times) - 1, int(share * len(times)))]


def told(tally: Tally, done: float, rate: float, capacity: float) -> str:
    """One paragraph of figures."""
    good, stored, health = tally.good, tally.stored, tally.health
    return (
        f"capacity {capacity:.1f}/s, offered {rate:.1f}/s: done {done:.1f}/s ({done / capacity:.0%}), "
        f"answered after {quantile(good, 0.5):.0f} ms, p99 {quantile(good, 0.99):.0f}, max {1000 * max(good):.0f};\n"
        f"  refused {len(tally.refused)} after {quantile(tally.refused, 0.5):.0f} ms, p99 "
        f"{quantile(tally.refused, 0.99):.0f}, Retry-After {sorted(tally.waits)}; invalid {tally.invalid};\n"
        f"  stored GET {quantile(stored, 0.5):.0f} ms, p99 {quantile(stored, 0.99):.0f}; health "
        f"{quantile(health, 0.5):.0f} ms, p99 {quantile(health, 0.99):.0f}"
    )


async def overload(port: int) -> None:
    callers = [Caller(port, address) for address in ADDRESSES]
    try:
        _, _, answer = await callers[0].call("POST", "/api/v1/runs", b'{"strategies": ["lv"]}')
        stored = f"/api/v1/runs/{answer[7:29].decode()}"
        await closed(callers, 4, WARM_UP)
        capacity = await closed(callers, 4, CAPACITY)
        for name, valid in (("all valid", [True]), ("a tenth invalid", [True] * 9 + [False])):
            tally, done = await opened(callers, 3 * capacity, stored, itertools.cycle(valid))
            print(f"\n{name}: {told(tally, done, 3 * capacity, capacity)}")
            assert statistics.median(tally.refused) < statistics.median(tally.good) / 2, "a refusal comes sooner"
            assert quantile(tally.good, 0.99) < 5000
            assert quantile(tally.health, 0.99) < 2000
            assert done / capacity >= 0.7
    finally:
        await asyncio.gather(*(caller.close() for caller in callers))


@pytest.mark.timeout(120 + 4 * SECONDS)
def test_goodput_is_held_under_three_times_the_capacity(tmp_path: Path) -> None:
    api = Api(tmp_path)
    try:
        api.wait_until_ready()
        asyncio.run(overload(api.port))
    finally:
        api.end()
