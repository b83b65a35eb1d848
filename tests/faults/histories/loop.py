"""An event loop whose clock jumps to what comes next, so that a history of hours takes seconds and a seed names it."""

import asyncio
import selectors
from collections.abc import Callable, Coroutine
from contextvars import ContextVar
from typing import Any, NoReturn, TypeVar

import numpy as np
from sqlalchemy.exc import OperationalError

from tests.servers import loops

T = TypeVar("T")
LONGEST_CALL = 0.05  # of a call in a thread [s]
replica: ContextVar[str] = ContextVar("replica", default="")  # who makes a call, in faults that are its own


class BrokenPromiseError(Exception):
    """An invariant does not hold; an error of the history itself is another one."""


class _Nothing(selectors.SelectSelector):
    """Waits for no file: the clock goes on to what is due."""

    loop: "SimulatedLoop"

    def select(self, timeout: float | None = None) -> list[Any]:
        self.loop.step(timeout)
        return []


class SimulatedLoop(asyncio.SelectorEventLoop):
    """Calls in threads are made in the loop itself, later by seed; while there are faults some fail, before or after.

    Attributes:
        rng: All chances.
        steps: How many there were.
        check: Looks at the invariants after each step.
        failing: Share of calls of replicas whose database is away, before it is asked or before its answer.
        paused: By replica until when its calls rest [s].
    """

    def __init__(self, seed: int) -> None:
        selector = _Nothing()
        selector.loop = self
        self.now = 1000.0
        super().__init__(selector)
        self.rng = np.random.default_rng(seed)
        self.steps = 0
        self.check: Callable[[], None] = lambda: None
        self.failing = 0.0
        self.paused: dict[str, float] = {}
        self._broken: BrokenPromiseError | None = None
        self._told = False

    def drive(self, main: Callable[[], Coroutine[Any, Any, None]]) -> int:
        """Run the history; the number of its steps.

        Raises:
            BrokenPromiseError: An invariant did not hold, whatever else came of that.
        """
        try:
            loops.run(main, lambda: self)
        except Exception:
            if self._broken is not None:
                raise self._broken from None
            raise
        return self.steps

    def time(self) -> float:
        """Of the history [s]."""
        return self.now

    def pause(self, who: str, seconds: float) -> None:
        """Have a replica's calls rest for so long; a pause in a longer one does not end it."""
        self.paused[who] = max(self.paused.get(who, 0.0), self.now + seconds)

    def broken(self, what: str) -> NoReturn:
        """End the history, whoever takes the error for one of his own."""
        self._broken = self._broken or BrokenPromiseError(what)
        self.check = lambda: None
        raise self._broken

    def step(self, timeout: float | None) -> None:
        """Look at the invariants, then go on to what is due next."""
        self.steps += 1
        self.check()
        if self._broken is not None and not self._told:
            self._told = True
            raise self._broken
        if timeout is None:
            self.broken("everybody waits for ever")
        self.now += timeout

    def run_in_executor(self, _executor: Any, function: Callable[..., T], *args: Any) -> "asyncio.Future[T]":  # type: ignore[override]
        """As a thread would, at a moment by seed; a caller who goes away meanwhile stops nothing."""
        future: asyncio.Future[T] = self.create_future()
        caller = replica.get()

        def call() -> None:
            if (rest := self.paused.get(caller, 0.0) - self.now) > 0:
                self.call_later(rest + self.rng.uniform(0, LONGEST_CALL), call)
                return
            fails = bool(caller) and self.rng.random() < self.failing
            result: Any = None
            error: BaseException | None = OperationalError(None, None, Exception("away")) if fails else None
            if not fails or self.rng.random() < 0.5:
                try:
                    result = function(*args)
                except Exception as raised:  # noqa: BLE001 - it is the caller's
                    error = raised
            if future.cancelled():
                return
            if error is None:
                future.set_result(result)
            else:
                future.set_exception(error)

        self.call_later(float(self.rng.uniform(0, LONGEST_CALL)), call)
        return future
