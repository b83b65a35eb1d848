"""Histories of requests: gate, shared computations and workers, their clients by seed."""

import asyncio
from collections import Counter
from dataclasses import dataclass
from typing import Any

from backend.compute.fair_queue import SHORT
from backend.compute.shared_computations import SharedComputations
from backend.compute.workers import RESERVED, Workers
from backend.errors import TemporaryError, WorkerLostError, WorkersBusyError, WorkerTimeoutError
from backend.gate.gate import Gate
from backend.settings import Settings
from tests.faults.histories.loop import SimulatedLoop
from tests.faults.histories.workers import Machine

LASTS = 300.0  # for which clients ask [s]
LONGEST_WAIT = 600.0  # of a request, refused or not [s]
LONGEST_OF_POLITE = 6.0  # who has one short request at a time, where no process dies [s]
FORGOTTEN = 5.0  # what nobody waits for any more runs no longer than this [s]
TIMEOUT = 30.0  # of a task [s]
FAILURES = (WorkerLostError, WorkersBusyError, WorkerTimeoutError)


@dataclass(frozen=True, slots=True)
class Key:
    """What is computed: equal ones are, while one is in progress, computed once."""

    number: int
    seconds: float


class Requests:
    """One history.

    Attributes:
        loop: Its clock and chances.

    Args:
        seed: Names it.
        lasts: Clients ask for so long [s].
    """

    def __init__(self, seed: int, lasts: float = LASTS) -> None:
        self.loop = SimulatedLoop(seed)
        self._end = self.loop.time() + lasts
        self._rng = self.loop.rng
        self._machine = Machine(self.loop, lambda args: args[0].seconds)
        self._machine.begun = self._begun
        self._dies, self._leaves = (bool(self._rng.random() < 0.5) for _ in range(2))
        self._alone = self._rng.random() < 0.2
        if self._alone:
            self._machine.slowest_start = 300.0
        elif self._dies:
            self._machine.dying = 0.05
        self._shared: SharedComputations[Key, Key] = SharedComputations()
        self._used: Counter[str] = Counter()
        self._forgotten: dict[tuple[Any, ...], float] = {}  # what runs and nobody waits for, since when

    def run(self) -> int:
        """Drive it; the number of its steps. Raises BrokenPromiseError where an invariant does not hold."""
        return self.loop.drive(self._run)

    async def _run(self) -> None:
        settings = Settings(workers=2)
        self._gate = Gate(settings)
        with self._machine.workers(2, timeout=TIMEOUT, reserved=RESERVED) as self._workers:
            await self._workers.wait_until_warm()
            self.loop.check = self._check
            clients = [self._client("alone", 4.0)] if self._alone else []
            if not self._alone:
                clients += [self._client(f"polite {number}", SHORT) for number in range(2)]
                clients += [self._client("long", 8.0) for _ in range(4)]
                clients += [self._client("short", 2.0) for _ in range(8)]
            await asyncio.gather(*clients)
            await asyncio.sleep(2 * TIMEOUT)
            self._check_end(self._workers)
            await self._workers.close()

    async def _client(self, name: str, longest: float) -> None:
        polite = name.startswith("polite")
        while self.loop.time() < self._end:
            if polite or self._alone or self._rng.random() < 0.1:
                await asyncio.sleep(float(self._rng.uniform(0, 5)))
            key = Key(int(self._rng.integers(30)), float(self._rng.uniform(0.01, longest)))
            if not polite and self._rng.random() < 0.3 and self._shared._by_key:  # the same as somebody else
                key = next(iter(self._shared._by_key))
            request = asyncio.create_task(self._request(name, key))
            if self._leaves and not polite and not self._alone and self._rng.random() < 0.3:
                self.loop.call_later(float(self._rng.uniform(0, 2 * key.seconds)), request.cancel)
            begun = self.loop.time()
            await asyncio.wait({request}, timeout=LONGEST_WAIT)
            if not request.done():
                self.loop.broken(f"a request of {name} waits for ever")
            waited = self.loop.time() - begun
            refused = None if request.cancelled() else request.result()
            if self._alone and refused:
                self.loop.broken(f"a client alone is refused: {refused}")
            if polite and not self._dies and (refused or waited > LONGEST_OF_POLITE):
                self.loop.broken(f"{name} waited {waited:.1f} s: {refused}")
            if refused:
                await asyncio.sleep(1.0)

    async def _request(self, name: str, key: Key) -> str | None:
        """Why it is refused, or has failed."""
        try:
            with self._gate.computing_turns.ticket(name) as ticket:
                await ticket.turn()
                with self._gate.computing(name, key.seconds):
                    answer = await self._shared.join(key, lambda: self._compute(name, key))
        except (TemporaryError, *FAILURES) as error:
            return f"{type(error).__name__}: {error}"
        if answer != key:
            self.loop.broken("a request has the answer to another one")
        return None

    async def _compute(self, name: str, key: Key) -> Key:
        answer = await self._workers.call(_same, key, client=name, cost=key.seconds)
        self._used[name] += round(1000 * key.seconds)
        return answer

    def _begun(self, args: tuple[Any, ...]) -> None:
        if not self._leaves and list(self._machine.running.values()).count(args) > 1:
            self.loop.broken("equal computations run at once")

    def _check(self) -> None:
        turns = self._gate.computing_turns
        handled = turns._handled
        if any(not 0 < count <= turns.client_places for count in handled.values()) or handled.total() > turns.places:
            self.loop.broken(f"places: {handled}")
        forgotten = {args for args in self._machine.running.values() if args[0] not in self._shared._by_key}
        self._forgotten = {args: self._forgotten.get(args, self.loop.time()) for args in forgotten}
        if any(self.loop.time() - since > FORGOTTEN for since in self._forgotten.values()):
            self.loop.broken("a process computes what nobody waits for any more")

    def _check_end(self, workers: Workers) -> None:
        held = {name: amount for name, amount in self._gate.load.items() if amount > 1e-9}
        if held or self._shared._by_key or self._shared._waiting:
            self.loop.broken(f"what nobody asks for is held: {held}, {self._shared._by_key}")
        if workers.load["waiting"] or workers.load["busy"]:
            self.loop.broken(f"processes work for nobody: {workers.load}")
        greedy = self._used["long"], self._used["short"]
        if not self._alone and not self._leaves and min(greedy) < 0.8 * max(greedy):
            self.loop.broken(f"of two that always wait one got much more: {dict(self._used)}")


def _same(key: Key) -> Key:
    return key
