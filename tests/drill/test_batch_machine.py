"""Submit, poll, cancel and kill in any order: what a service said once stays true, however often it dies."""

import os
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import Bundle, RuleBasedStateMachine, precondition, rule, run_state_machine_as_test

from tests.servers.api import Api, ask
from tests.servers.process import wait_until

ENDS = ("done", "cancelled")


@dataclass
class Accepted:
    """What the service said about a batch so far."""

    body: dict[str, Any]
    key: str
    id: str
    total: int
    state: str = "queued"
    done: int = 0
    rows: dict[int, Any] = field(default_factory=dict)


GAMES = int(os.environ.get("DRILL_GAMES", "25"))
STEPS = 25  # of each game


@pytest.mark.timeout(3600)
def test_what_was_said_once_stays_true(tmp_path: Path) -> None:
    """Games on one service that is never emptied."""
    api = Api(tmp_path, RIDELAB_WORKERS="1", RIDELAB_LOG_LEVEL="warning")

    class Game(RuleBasedStateMachine):
        batches = Bundle("batches")

        def __init__(self) -> None:
            super().__init__()
            self.known: list[Accepted] = []

        @rule(target=batches, runs=st.integers(1, 60), strategy=st.sampled_from(["lv", "passive", "lqr"]))
        def submit(self, runs: int, strategy: str) -> Accepted:
            heights = [0.03 + number * 1e-3 for number in range(runs)]
            sweep = {"grid": {"road.bump.height": heights}}
            body = {"scenario": {"road": {"length": 128.0}}, "strategies": [strategy], "sweep": sweep}
            key = f"{time.monotonic_ns()}"
            told = ask(api.url, "POST", "/batches", json=body, headers={"Idempotency-Key": key})
            batch = Accepted(body=body, key=key, id=told["id"], total=told["total"])
            assert batch.total == runs
            self.known.append(batch)
            return batch

        @rule(batch=batches)
        def submit_again(self, batch: Accepted) -> None:
            told = ask(api.url, "POST", "/batches", json=batch.body, headers={"Idempotency-Key": batch.key})
            assert told["id"] == batch.id

        @rule(batch=batches)
        def poll(self, batch: Accepted) -> None:
            told = ask(api.url, "GET", f"/batches/{batch.id}")
            assert batch.done <= told["done"] <= batch.total
            assert told["failed"] == 0
            assert batch.state not in ENDS or told["state"] == batch.state
            assert (told["state"], told["done"]) != ("queued", batch.total)
            batch.state, batch.done = told["state"], told["done"]

        @rule(batch=batches)
        def read(self, batch: Accepted) -> None:
            rows = ask(api.url, "GET", f"/batches/{batch.id}/results")["rows"]
            assert [row["run"] for row in rows] == list(range(batch.total))
            finished = {row["run"]: row for row in rows if row["status"] == "ok"}
            assert batch.rows.items() <= finished.items(), "a result that was read once stays as it was"
            batch.rows = finished

        @rule(batch=batches)
        def cancel(self, batch: Accepted) -> None:
            told = ask(api.url, "POST", f"/batches/{batch.id}/cancel")
            assert told["state"] in ENDS
            assert batch.state not in ENDS or told["state"] == batch.state
            batch.state, batch.done = told["state"], told["done"]

        @precondition(lambda self: self.known)
        @rule(seconds=st.floats(0, 3))
        def kill(self, seconds: float) -> None:
            time.sleep(seconds)  # the moment of the kill is chance
            if api.running:
                api.kill()

        def ended(self, batch: Accepted) -> bool:
            self.poll(batch)
            return batch.state in ENDS

        def teardown(self) -> None:
            for batch in self.known:
                wait_until(lambda batch=batch: self.ended(batch), f"{batch.id} ends", 180, pause=0.1)
                self.read(batch)
                assert len(batch.rows) == batch.done
                assert batch.state != "done" or batch.done == batch.total

    try:
        api.wait_until_ready()
        run_state_machine_as_test(  # type: ignore[no-untyped-call]
            Game,
            settings=settings(
                max_examples=GAMES,
                stateful_step_count=STEPS,
                deadline=None,
                suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
            ),
        )
    finally:
        api.end()
