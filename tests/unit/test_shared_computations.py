"""Equal computations are joined, and one that nobody waits for any more is cancelled."""

import asyncio

import pytest

from backend.compute.shared_computations import SharedComputations
from tests.servers import loops


def test_two_that_are_equal_are_computed_once_and_the_last_that_goes_calls_it_off() -> None:
    async def use() -> None:
        computations: SharedComputations[str, int] = SharedComputations()
        begun, ended = 0, asyncio.Event()

        async def compute() -> int:
            nonlocal begun
            begun += 1
            await ended.wait()
            return begun

        waiting = [asyncio.create_task(computations.join("key", compute)) for _ in range(3)]
        await asyncio.sleep(0)
        in_progress = computations.find(lambda key: key == "key")
        assert in_progress is not None
        waiting[0].cancel()
        with pytest.raises(asyncio.CancelledError):
            await waiting[0]
        assert not in_progress.cancelled(), "two others wait"
        ended.set()
        assert await asyncio.gather(*waiting[1:]) == [1, 1]
        assert computations.find(lambda key: key == "key") is None
        ended.clear()
        last = asyncio.create_task(computations.join("key", compute))
        await asyncio.sleep(0)
        last.cancel()
        with pytest.raises(asyncio.CancelledError):
            await last
        assert computations.find(lambda key: key == "key") is None
        assert await computations.join("other", lambda: asyncio.sleep(0, 7)) == 7

    loops.run(use)
