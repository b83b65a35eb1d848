"""Which task is next, by the clock that the test hands in."""

import pytest

from backend.compute.fair_queue import HALF_LIFE, SHORT, FairQueue, Task


class Processes:
    """So many processes that take tasks from a queue."""

    def __init__(self, count: int, *, reserved: int = 0) -> None:
        self.now = 1000.0
        self.queue = FairQueue(reserved=reserved, clock=lambda: self.now)
        self.count = count
        self.running: list[Task] = []
        self.order: list[str] = []  # clients, as their tasks began

    def ask(self, client: str, cost: float = 0.1, count: int = 1) -> None:
        for _ in range(count):
            self.queue.add(client, cost)
        self._begin()

    def work(self, seconds: float = 0.1, *, client: str | None = None) -> None:
        """Time goes by, then the oldest running task (of that client) ends."""
        self.now += seconds
        task = next(each for each in self.running if client in (None, each.client))
        self.running.remove(task)
        self.queue.end(task)
        self._begin()

    def _begin(self) -> None:
        while (task := self.queue.begin_next(self.count)) is not None:
            self.running.append(task)
            self.order.append(task.client)


def test_whoever_has_least_in_work_is_next_then_the_oldest() -> None:
    processes = Processes(1)
    processes.ask("greedy", count=50)
    processes.work()
    processes.ask("other", count=2)
    processes.ask("third")
    for _ in range(6):
        processes.work()
    assert processes.order == ["greedy", "greedy", "other", "third", "other", "greedy", "greedy", "greedy"]
    assert processes.queue.waiting == 45


def test_what_a_task_took_counts_and_not_what_was_estimated() -> None:
    processes = Processes(1)
    processes.ask("cheap by estimate", 0.01, count=3)
    processes.ask("as estimated", 1.0, count=3)
    processes.work(5.0)
    for _ in range(3):
        processes.work(1.0)
    assert processes.order == ["cheap by estimate", *3 * ["as estimated"], "cheap by estimate"]
    assert processes.queue.in_work("as estimated") == pytest.approx(3.0, rel=0.2)


def test_what_was_used_is_forgotten() -> None:
    processes = Processes(1)
    processes.ask("earlier", 8.0)
    processes.work(8.0)
    assert processes.queue.in_work("earlier") == 8.0
    processes.now += HALF_LIFE
    assert processes.queue.in_work("earlier") == pytest.approx(4.0)
    processes.now += 20 * HALF_LIFE
    assert processes.queue.in_work("earlier") == 0.0


def test_a_reserved_process_takes_a_short_task_of_a_client_that_has_none_running() -> None:
    processes = Processes(3, reserved=1)
    processes.ask("greedy", 20.0, count=4)
    assert processes.order == ["greedy"] * 2, "two of three"
    processes.ask("greedy", SHORT / 2)
    processes.ask("other", 2 * SHORT)
    assert processes.order == ["greedy"] * 2, "one client has others running, the other's task is long"
    processes.ask("third", SHORT / 2)
    assert processes.order == ["greedy", "greedy", "third"]
    processes.ask("fourth", SHORT / 2)
    processes.work(0.1, client="third")
    assert processes.order[3:] == ["fourth"], "the reserved one is free again"
    processes.work(20.0)
    assert processes.order[4:] == ["other"]


def test_while_processes_are_missing_the_reserved_one_stays_reserved() -> None:
    processes = Processes(2, reserved=1)
    processes.ask("long", 20.0, count=2)
    assert processes.order == ["long"]
    processes.ask("short")
    assert processes.order == ["long", "short"]


def test_the_only_process_alive_takes_long_tasks_too() -> None:
    processes = Processes(1, reserved=1)
    processes.ask("long", 20.0)
    assert processes.order == ["long"]
    processes.ask("short")
    assert processes.order == ["long"], "it is busy"
    processes.work(20.0)
    assert processes.order == ["long", "short"]


def test_a_task_that_is_killed_counts_as_all_that_was_estimated() -> None:
    queue = FairQueue(clock=lambda: 0.0)
    queue.add("gone", 20.0)
    task = queue.begin_next(1)
    assert task is not None
    queue.end(task, killed=True)
    assert queue.in_work("gone") == 20.0
