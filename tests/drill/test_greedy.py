"""One client keeps 800 connections open for half a minute: the others are served as if it were not there."""

import time

import pytest

from tests.drill.callers import Caller, served
from tests.servers import loops
from tests.servers.process import Api

OTHERS = [f"127.0.0.{number}" for number in range(3, 49)]
SECONDS = 30.0


async def idle(port: int) -> None:
    greedy = Caller(port, "127.0.0.2")
    try:
        await greedy.hold(800)
        await served(port, OTHERS, time.monotonic() + SECONDS)
        assert (await greedy.call("GET", "/healthz"))[0] == 200
    finally:
        await greedy.close()


@pytest.mark.timeout(180)
def test_idle_connections_of_one_client_keep_nobody_out(api: Api) -> None:
    loops.run(lambda: idle(api.port))
