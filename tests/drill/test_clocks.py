"""DRILL_JUMPS (20, by DRILL_SEED) jumps of all clocks, forward and back by up to 400 days, between pieces of work.

Of a service, whose clock is its database's too, and of two replicas and PostgreSQL, each with a clock of its own.
"""

import contextlib
import os
import re
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest.mock import patch

import httpx
import numpy as np
import pytest

from backend.http.tokens import LIFETIME
from tests.faults.clock import Clock
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, submit
from tests.servers.postgres import Postgres
from tests.servers.process import request

JUMPS = int(os.environ.get("DRILL_JUMPS", "20"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
RUNS = 4  # of a batch
DAY = 86400
AHEAD = (0, 3600, -3600, 40 * DAY, -40 * DAY, 400 * DAY, -400 * DAY)
TOKEN = "ann-0123456789abcdef"  # noqa: S105  # nobody's


class Replica(Process):
    """A service that looks for what is old many times between two jumps, as one between jumps that last ten minutes."""

    PROGRAM = (
        "-c",
        "import sys; from backend.__main__ import main; from backend.jobs import retention; retention.INTERVAL = 0.05; "
        "sys.exit(main())",
    )

    def __init__(self, folder: Path, name: str, clock: Clock, **environment: str) -> None:
        (folder / "tokens").write_text(f"ann {TOKEN}\n")
        limits = {"RIDELAB_TOKENS_FILE": str(folder / "tokens"), "RIDELAB_RETENTION_DAYS": "30"}
        super().__init__(folder, name, **clock.environment, **limits, **environment)
        self.clock = clock
        self.client.headers["Authorization"] = f"Bearer {TOKEN}"


@pytest.fixture
def replicas(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[tuple[list[Replica], list[Clock]]]:
    """They, and all clocks."""
    with contextlib.ExitStack() as opened:
        count, variables, clocks = (2, dict[str, str](), list[Clock]()) if request.param else (1, {}, [])
        if request.param:
            folder = Path(opened.enter_context(tempfile.TemporaryDirectory()))  # which PostgreSQL's user may read
            folder.chmod(0o755)
            clocks.append(Clock(folder))
            with patch.dict(os.environ, clocks[0].environment):
                postgres = Postgres()
            opened.callback(postgres.remove)
            variables["RIDELAB_DATABASE_URL"] = postgres.new_database()
        started = list[Replica]()
        for number in range(count):
            (tmp_path / str(number)).mkdir()
            clocks.append(Clock(tmp_path / str(number)))
            replica = Replica(tmp_path / str(number), f"api-{number}", clocks[-1], **variables)
            started.append(opened.enter_context(replica))
            started[-1].wait_until_ready()
        yield started, clocks


def send(service: Replica, number: int) -> str:
    """The batch of that number, each with an idempotency key of its own."""
    return submit(
        service, {"road": {"length": 60 + number, "bump": {"start": 40}}}, RUNS, **{"Idempotency-Key": str(number)}
    )


def cookie(service: Replica) -> str:
    answer = request("POST", f"{service.url}/api/v1/login", json={"token": TOKEN})
    return answer.headers["set-cookie"].partition(";")[0]


def status(service: Replica, cookie: str) -> int:
    """Of an answer to who shows it."""
    return request("GET", f"{service.url}/api/v1/batches", headers={"Cookie": cookie}).status_code


def listed(client: httpx.Client) -> list[str]:
    """All batches, page by page."""
    ids, params = list[str](), {"limit": "3"}
    while True:
        page: Any = client.get("/api/v1/batches", params=params).json()
        ids += [each["id"] for each in page["batches"]]
        if page["next"] is None:
            return ids
        params["cursor"] = page["next"]


@pytest.mark.timeout(600 + 60 * JUMPS)
@pytest.mark.parametrize("replicas", [False, True], ids=["SQLite", "PostgreSQL"], indirect=True)
def test_what_was_accepted_is_there_and_goes_on_whatever_clocks_say(
    replicas: tuple[list[Replica], list[Clock]],
) -> None:
    services, clocks = replicas
    rng, batches, longest = np.random.default_rng(SEED), list[str](), 0.0
    ended, lasting = cookie(services[0]), cookie(services[0])
    assert request("DELETE", f"{services[0].url}/api/v1/login", headers={"Cookie": ended}).is_success
    for number in range(JUMPS):
        for clock in clocks:
            clock.set(int(rng.choice(AHEAD)))
        service, begun = services[number % len(services)], time.monotonic()
        batches.append(send(service, number))
        finished(service, batches[-1], RUNS)
        longest = max(longest, time.monotonic() - begun)
        batch = service.client.get(f"/api/v1/batches/{batches[-1]}").json()
        assert batch["created_at"] <= batch["started_at"] <= batch["finished_at"]
        events = service.client.get(f"/api/v1/batches/{batches[-1]}/events").text
        numbers = [int(each) for each in re.findall(r"^id: (\d+)$", events, re.MULTILINE)]
        assert numbers == sorted(set(numbers)) != []
        assert sorted(listed(service.client)) == sorted(batches)
        earlier = int(rng.integers(number + 1))
        assert send(service, earlier) == batches[earlier]
        assert status(service, ended) == 401
        assert status(service, lasting) == (200 if abs(service.clock.ahead) < LIFETIME else 401)
    for batch_id in batches:
        finished(services[0], batch_id, RUNS)
    print(f"\n{JUMPS} jumps of {len(clocks)} clocks, seed {SEED}: the longest batch took {longest:.1f} s")
