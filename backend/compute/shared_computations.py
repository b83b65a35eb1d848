"""Computations in progress: equal ones are joined, and one that nobody waits for any more is cancelled."""

import asyncio
from collections import Counter
from collections.abc import Callable, Collection, Coroutine, Iterable
from typing import Any, Generic, TypeVar

K = TypeVar("K")
T = TypeVar("T")


class SharedComputations(Generic[K, T]):
    """Computations by key, one perhaps under several keys."""

    def __init__(self) -> None:
        self._by_key: dict[K, asyncio.Task[T]] = {}
        self._waiting: Counter[asyncio.Task[T]] = Counter()

    def find(self, matches: Callable[[K], bool]) -> asyncio.Task[T] | None:
        """A computation in progress with such a key."""
        return next((task for key, task in self._by_key.items() if matches(key)), None)

    def begin(self, keys: Iterable[K], work: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
        """Start the computation of these keys; wait for it with `wait`."""
        task = asyncio.create_task(work)
        self._by_key |= dict.fromkeys(keys, task)
        task.add_done_callback(self._forget)
        return task

    async def wait(self, tasks: Collection[asyncio.Task[T]]) -> dict[asyncio.Task[T], T]:
        """The result of each computation; raises what the first failed one raised."""
        self._waiting.update(tasks)
        try:
            return {task: await asyncio.shield(task) for task in tasks}
        finally:
            for task in tasks:
                self._waiting[task] -= 1
                if not self._waiting[task]:
                    del self._waiting[task]
                    self._forget(task)
                    task.cancel()

    async def join(self, key: K, begin: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """The result of the key, from the computation in progress or from a new one."""
        task = self._by_key.get(key) or self.begin([key], begin())
        return (await self.wait([task]))[task]

    def _forget(self, task: asyncio.Task[T]) -> None:
        self._by_key = {key: each for key, each in self._by_key.items() if each is not task}
