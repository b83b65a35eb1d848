"""Whose turn it is, and what is refused: queues by client, sums, rates."""

import asyncio
import contextlib
import random
from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest

from backend.api.routing import client_key
from backend.errors import BusyError, CostLimitError, TooManyRequestsError
from backend.gate import Budget, Gate, LinkRate, RequestQueue
from backend.settings import Settings
from tests.servers import loops

SLOTS, CLIENT_SLOTS = 16, 12


class Crowd:
    """Requests that wait for their turn; those that have it end when they are told to."""

    def __init__(self) -> None:
        self.queue = RequestQueue(client_slots=CLIENT_SLOTS, slots=SLOTS, max_client_requests=1000, max_requests=1000)
        self.handled: list[tuple[str, asyncio.Event]] = []  # in the order of their turns
        self.tasks: list[asyncio.Task[None]] = []

    async def send(self, *clients: str) -> None:
        self.tasks += [asyncio.create_task(self._request(client)) for client in clients]
        await self.settle()

    async def settle(self) -> None:
        for _ in range(5):
            await asyncio.sleep(0)

    async def end(self, client: str) -> None:
        """End the oldest request of that client that is handled."""
        request = next(each for each in self.handled if each[0] == client)
        self.handled.remove(request)
        request[1].set()
        await self.settle()

    @property
    def counts(self) -> Counter[str]:
        return Counter(client for client, _ in self.handled)

    async def _request(self, client: str) -> None:
        with self.queue.admit(client) as admission:
            await admission.wait_for_slot()
            over = asyncio.Event()
            self.handled.append((client, over))
            await over.wait()

    async def drain(self) -> None:
        """Call everything off; nothing may be left."""
        for task in self.tasks:
            task.cancel()
        await asyncio.gather(*self.tasks, return_exceptions=True)
        assert (self.queue.open, self.queue.waiting, self.queue.handled) == ({}, 0, {})


async def another_client_finds_a_place_at_once_and_then_each_has_its_turn(crowd: Crowd) -> None:
    await crowd.send(*["greedy"] * 50)
    await crowd.send(*["polite"] * 6)
    assert crowd.counts == {"greedy": CLIENT_SLOTS, "polite": SLOTS - CLIENT_SLOTS}
    await crowd.send("late")
    assert crowd.counts["late"] == 0
    for _ in range(3):
        await crowd.end("greedy")
    assert crowd.counts["late"] == 1, "it did not wait for all that the others sent before"


async def a_turn_that_comes_as_its_request_goes_away_is_the_next_ones(crowd: Crowd) -> None:
    await crowd.send(*["a"] * (CLIENT_SLOTS + 2))
    crowd.handled[0][1].set()  # its place goes to the first that waits, which is called off just then
    crowd.handled.pop(0)
    await asyncio.sleep(0)
    crowd.tasks[CLIENT_SLOTS].cancel()
    await crowd.settle()
    assert crowd.counts["a"] == CLIENT_SLOTS


@pytest.mark.parametrize(
    "story",
    [
        another_client_finds_a_place_at_once_and_then_each_has_its_turn,
        a_turn_that_comes_as_its_request_goes_away_is_the_next_ones,
    ],
    ids=lambda story: str(story.__name__),
)
def test_requests_take_turns(story: Callable[[Crowd], Any]) -> None:
    async def told() -> None:
        crowd = Crowd()
        await story(crowd)
        await crowd.drain()

    loops.run(told)


@pytest.mark.parametrize("seed", range(5))
def test_no_client_is_passed_over_whatever_is_sent_and_called_off(seed: int) -> None:
    async def told() -> None:
        drawn, crowd = random.Random(seed), Crowd()  # noqa: S311  # a test's draws
        for _ in range(300):
            match drawn.choice(("send", "send", "end", "cancel")):
                case "send":
                    await crowd.send(drawn.choice("abcde"))
                case "end" if crowd.handled:
                    await crowd.end(drawn.choice(crowd.handled)[0])
                case "cancel" if crowd.tasks:
                    drawn.choice(crowd.tasks).cancel()
                    await crowd.settle()
                    crowd.handled = [each for each in crowd.handled if crowd.queue.handled[each[0]]]
            assert all(count <= CLIENT_SLOTS for count in crowd.queue.handled.values())
            assert crowd.queue.handled.total() <= SLOTS
            if crowd.queue.waiting and crowd.queue.handled.total() < SLOTS:
                assert all(crowd.queue.handled[client] == CLIENT_SLOTS for client in crowd.queue.waiting_clients)
        await crowd.drain()

    loops.run(told)


def test_only_a_queue_longer_than_stated_is_refused() -> None:
    queue = RequestQueue(client_slots=2, slots=4, max_client_requests=4, max_requests=6)
    with contextlib.ExitStack() as held:

        def take(client: str, count: int = 1) -> None:
            for _ in range(count):
                held.enter_context(queue.admit(client))

        take("greedy", 4)
        with pytest.raises(TooManyRequestsError, match="4 requests open") as refused:
            take("greedy")
        assert refused.value.retry_after
        take("second", 3)
        with pytest.raises(BusyError, match="6 requests are open"):
            take("second")
        take("polite")
        assert queue.open.total() == 8, "it had less than its share"
    assert not queue.open


def test_a_long_computation_leaves_its_place_to_others() -> None:
    async def told() -> None:
        gate = Gate(Settings())
        queue = gate.compute_queue
        with queue.admit("a") as admission:
            await admission.wait_for_slot()
            with gate.computing("a", 0.5):
                assert queue.handled["a"] == 1
            with gate.computing("a", 30.0), gate.computing("a", 2.0):
                assert (queue.handled["a"], queue.open["a"], gate.load["cost"]) == (0, 1, 32.0)
        assert set(gate.load.values()) == {0}

    loops.run(told)


def test_one_request_costs_no_more_than_stated() -> None:
    gate = Gate(Settings(max_request_cost=5))
    gate.check_cost(5.0)
    with pytest.raises(CostLimitError, match="6 s of computing is over the limit of 5 s"):
        gate.check_cost(6.0)


def test_of_a_sum_one_client_has_half() -> None:
    budget = Budget("room", 100)
    with budget.hold("a", 30), budget.hold("a", 20):
        with pytest.raises(TooManyRequestsError, match="its share of room"), budget.hold("a", 1):
            pass
        with budget.hold("b", 40), pytest.raises(BusyError, match="nothing is left of room"), budget.hold("c", 11):
            pass
        assert budget.held == 50
    assert (budget.held, budget._held) == (0, {})


@pytest.mark.parametrize("amounts", [(1.1e9 / 3, 7e8 / 9 * 1.37), (0.0, 0.0)])
def test_what_several_requests_of_a_client_hold_is_given_back_to_the_last_byte(amounts: tuple[float, float]) -> None:
    budget = Budget("room", 4e9)
    first, second = (budget.hold("a", amount) for amount in amounts)
    for step in (first.__enter__, second.__enter__):
        step()
    for each in (first, second):
        each.__exit__(None, None, None)
    assert (budget.held, budget._held) == (0, {})


def test_links_are_limited_by_rate() -> None:
    now = 100.0
    rate = LinkRate(3, 0.5, clock=lambda: now)

    def take(client: str, tokens: int = 1) -> int:
        """Return 0, or after how many seconds it may be asked again."""
        try:
            rate.take(client, tokens)
        except TooManyRequestsError as error:
            return error.retry_after or 0
        return 0

    assert [take("a") for _ in range(4)] == [0, 0, 0, 2]
    assert take("b", 1000) == 0, "no more than all that there are"
    now += 1.9
    assert take("a") == 1
    now += 0.2
    assert [take("a"), take("a")] == [0, 2]
    now += 1000
    assert [take("a") for _ in range(4)] == [0, 0, 0, 2]
    assert len(rate._full_at) == 1, "whoever has all again is forgotten"


@pytest.mark.parametrize(
    ("address", "key"),
    [
        ("192.0.2.1", "192.0.2.1"),
        ("2001:db8:0:1::ffff:2", "2001:db8:0:1::"),
        ("::ffff:192.0.2.1", "192.0.2.1"),
        ("fe80::1%eth0", "fe80::"),
        ("", ""),
        ("unix", "unix"),
    ],
)
def test_an_ipv6_network_is_one_client(address: str, key: str) -> None:
    assert client_key(address) == key
