"""SQLite shared with others while runs are stored and read and a batch goes on: long foreign locks, and backups.

Printed is what of it a user feels; what was accepted is there afterwards, and the batch completes, from a copy as well.
"""

import contextlib
import os
import shutil
import sqlite3
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import httpx
import pytest

from backend.db.backup import back_up
from backend.settings import Settings
from tests.servers.accepted import Accepted
from tests.servers.process import HANG_TIMEOUT, Api, request

HELD = 8.0  # how long another program holds a lock [s]
COPIES = 4
FEW = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1", "RIDELAB_LOG_LEVEL": "warning"}
BIG = 300  # megabytes in the database, so that a copy takes its time
LOCKED_RUNS, COPIED_RUNS = 1500, 5000  # of the batch: it lasts until others let go, and longer than the copies take


class Users:
    """One looks at a stored run, one asks whether the service is ready, one has new runs stored, again and again."""

    def __init__(self, url: str) -> None:
        self._url = url
        self._end = threading.Event()
        self._seed = 0
        self._stored: list[str] = []
        self._longest: dict[str, float] = {}
        self._statuses: Counter[int] = Counter()
        self._store()
        looks = {"stored run": f"{url}/api/v1/runs/{self._stored[0]}", "/readyz": f"{url}/readyz"}
        self._threads = [threading.Thread(target=self._look, args=item) for item in looks.items()]
        self._threads.append(threading.Thread(target=self._write))
        for thread in self._threads:
            thread.start()

    def report(self, what: str) -> dict[str, float]:
        """Print, and begin anew: the longest wait for each kind [s], and the answers to those who write."""
        longest, self._longest = self._longest, {}
        statuses, self._statuses = self._statuses, Counter()
        waits = ", ".join(f"{name} {1000 * wait:.0f} ms" for name, wait in longest.items())
        print(f"{what}: at most {waits}; new runs {statuses[200]} stored, {statuses[503]} refused")
        assert set(statuses) <= {200, 503}
        return longest

    def end(self) -> None:
        """Nobody asks any more; what was answered is stored."""
        self._end.set()
        for thread in self._threads:
            thread.join()
        for run_id in self._stored:
            assert request("GET", f"{self._url}/api/v1/runs/{run_id}").status_code == 200

    def _timed(self, name: str, ask: Callable[[], httpx.Response]) -> httpx.Response:
        begin = time.monotonic()
        answer = ask()
        self._longest[name] = max(self._longest.get(name, 0), time.monotonic() - begin)
        return answer

    def _look(self, name: str, url: str) -> None:
        with httpx.Client(timeout=HANG_TIMEOUT) as client:
            while not self._end.wait(0.02):
                answer = self._timed(name, lambda: client.get(url))
                assert answer.status_code == 200, f"{name}: {answer.text}"

    def _write(self) -> None:
        while not self._end.wait(0.1):
            self._timed("new run", self._store)

    def _store(self) -> httpx.Response:
        self._seed += 1
        body = {"scenario": {"road": {"seed": self._seed}}, "strategies": ["lv"]}
        answer = request("POST", f"{self._url}/api/v1/runs", json=body)
        self._statuses[answer.status_code] += 1
        if answer.status_code == 200:
            self._stored.append(answer.json()["id"])
        return answer


@pytest.fixture
def api(tmp_path: Path) -> Iterator[Api]:
    with Api(tmp_path, **FEW) as api:
        api.wait_until_ready()
        with contextlib.closing(sqlite3.connect(tmp_path / "data/ridelab.sqlite")) as connection, connection:
            connection.execute("CREATE TABLE ballast (content BLOB)")
            connection.executemany("INSERT INTO ballast VALUES (?)", ((os.urandom(1_000_000),) for _ in range(BIG)))
        yield api


@pytest.fixture
def accepted(request: pytest.FixtureRequest, api: Api, tmp_path: Path) -> Iterator[Accepted]:
    """A batch that goes on while others do this and that; in the end it is complete."""
    database = f"sqlite:///{tmp_path}/data/ridelab.sqlite"
    accepted = Accepted(url=api.url, database=database, seed=1, runs=request.param)
    accepted.submit()
    accepted.await_work()
    yield accepted
    accepted.finish()


@pytest.fixture
def users(api: Api, accepted: Accepted) -> Iterator[Users]:
    users = Users(api.url)
    time.sleep(3)  # of use that nothing disturbs
    users.report("calm")
    yield users
    users.end()


@pytest.mark.timeout(900)  # both services have one process for the batch
@pytest.mark.parametrize("accepted", [LOCKED_RUNS], indirect=True)
def test_long_locks_of_others(users: Users, api: Api, tmp_path: Path) -> None:
    for what, begin in (("foreign writer", "BEGIN IMMEDIATE"), ("foreign reader", "BEGIN")):
        path = tmp_path / "data/ridelab.sqlite"
        with contextlib.closing(sqlite3.connect(path, isolation_level=None, timeout=HANG_TIMEOUT)) as other_program:
            other_program.execute(begin)
            other_program.execute("SELECT count(*) FROM runs").fetchone()
            time.sleep(HELD)  # the fault itself
        longest = users.report(f"{what}, {HELD:g} s")
        assert max(longest["stored run"], longest["/readyz"]) < 1
        time.sleep(2)  # of use without it
        users.report("afterwards")
    assert "Traceback" not in api.log


@pytest.mark.timeout(900)  # both services have one process for the batch
@pytest.mark.parametrize("accepted", [COPIED_RUNS], indirect=True)
def test_backups_during_a_batch(users: Users, accepted: Accepted, tmp_path: Path) -> None:
    path, copies = tmp_path / "data/ridelab.sqlite", tmp_path / "copies"
    copies.mkdir()
    settings, lock_times = Settings(data_dir=path.parent), []
    for number in range(COPIES):
        lock_times.append(back_up(settings, copies / f"{number}.sqlite", overwrite=False).seconds)
        time.sleep(1)  # between two copies users write
    longest = users.report(
        f"{COPIES} copies of {path.stat().st_size / 1e6:.0f} MB, writes kept waiting at most {max(lock_times):.2f} s"
    )
    assert max(longest["stored run"], longest["/readyz"]) < 1
    assert accepted.waiting() > 0, "the drill needs a longer batch"
    restored = tmp_path / "restored/data/ridelab.sqlite"
    restored.parent.mkdir(parents=True)
    shutil.copy(copies / f"{COPIES - 1}.sqlite", restored)
    with Api(restored.parents[1], **FEW) as other:
        other.wait_until_ready()
        there = replace(accepted, url=other.url, database=f"sqlite:///{restored}", stored={})
        left = there.waiting()
        there.finish()
        print(f"from the last copy: {left} runs were left, and the batch was finished")
        assert left > 0
