"""Kill -9 at random while batches run: afterwards everything accepted is complete, each result stored once.

`make test` does it a few times, `make drill` fifty times; by hand: DRILL_KILLS=200 python -m pytest tests/drill -s
"""

import random
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import psutil
from sqlalchemy import Engine, create_engine, func, select, text

from backend.store.tables import batch_runs, results
from sim_core import dotted
from sim_core.scenario import Scenario
from sim_core.simulation import simulate
from tests.servers.api import ask
from tests.servers.process import Program

RUNS = 240  # of one batch: some seconds of two cores
LEAST_WORK = 200  # runs that wait while it kills
WHILE_WORKING = 0.7  # of the kills come while results come in, the others at any moment, such as during a start

Victim = Callable[[], str | None]  # kills something and tells what, or tells that there is nothing to kill


@dataclass
class Drill:
    """Random kills under load.

    Attributes:
        url: Where the service is asked; it may be down at any moment.
        victims: What can be killed.
        engine: The database, looked at from outside.
        seed: Same seed, same choices.
    """

    url: str
    victims: Sequence[Victim]
    engine: Engine
    seed: int
    batches: list[str] = field(default_factory=list)
    killed: Counter[str] = field(default_factory=Counter)
    stored: dict[str, Any] = field(default_factory=dict)

    def run(self, kills: int, say: Callable[[str], None] = lambda _: None) -> None:
        """Kill so often, at random moments; then wait for everything and check it."""
        chance = random.Random(self.seed)  # noqa: S311 - reproducible is what it has to be
        self._submit()
        while self.killed.total() < kills:
            if chance.random() < WHILE_WORKING:
                self._await_work()
            time.sleep(chance.uniform(0.01, 1.5))
            what = chance.choice(self.victims)()
            if what is None:
                continue
            self.killed[what] += 1
            self._check_stored()
            say(f"{self.killed.total():3} of {kills}: killed {what}, {len(self.stored)} results stored")
            if self._waiting() < LEAST_WORK:
                self._submit()
        self._finish()
        say(f"killed {dict(self.killed)}; {len(self.batches)} batches, {len(self.stored)} results")

    def _submit(self) -> None:
        """A batch nobody had before, accepted for certain: asked with one key until it is."""
        number = len(self.batches)
        sweep = {
            "latin_hypercube": {"ranges": {"road.bump.height": [0.02, 0.12]}, "samples": RUNS // 2, "seed": number}
        }
        body = {"scenario": {"road": {"length": 126.0}}, "strategies": ["lv", "passive"], "sweep": sweep}
        key = {"Idempotency-Key": f"drill-{self.seed}-{number}"}
        self.batches.append(ask(self.url, "POST", "/batches", json=body, headers=key)["id"])

    def _await_work(self) -> None:
        """Until results come in again; a service that has just been killed takes some seconds."""
        before, end = self._waiting(), time.monotonic() + 60
        while self._waiting() == before and time.monotonic() < end:
            time.sleep(0.05)

    def _waiting(self) -> int:
        chosen = select(func.count()).select_from(batch_runs).where(batch_runs.c.status == "waiting")
        with self.engine.connect() as connection:
            return int(connection.execute(chosen).scalar_one())

    def _check_stored(self) -> None:
        """What was stored once is there still, and is the same row: it was neither lost nor computed again."""
        with self.engine.connect() as connection:
            now = {
                row.key: (row.created_at, row.compute_ms, row.summary)
                for row in connection.execute(select(results)).all()
            }
        for key, row in self.stored.items():
            assert now.get(key) == row, "a stored result changed or was lost"
        self.stored = now

    def _finish(self) -> None:
        for batch_id in self.batches:
            end = time.monotonic() + 180
            while True:
                batch = ask(self.url, "GET", f"/batches/{batch_id}")
                if batch["state"] not in ("queued", "running"):
                    break
                assert time.monotonic() < end, f"{batch_id} does not go on: {batch['done']} of {batch['total']}"
                time.sleep(0.2)
            assert (batch["state"], batch["done"], batch["failed"]) == ("done", RUNS, 0), batch["reason"]
            rows = ask(self.url, "GET", f"/batches/{batch_id}/results")["rows"]
            assert [row["run"] for row in rows] == list(range(RUNS))
            assert {row["status"] for row in rows} == {"ok"}
            _is_right(batch, rows[self.seed % RUNS])
        self._check_stored()
        with self.engine.connect() as connection:
            wanted = set(connection.execute(select(batch_runs.c.result_key)).scalars())
            if self.engine.dialect.name == "sqlite":
                assert connection.execute(text("PRAGMA integrity_check")).scalar_one() == "ok"
        assert wanted == set(self.stored), "a result of every run, and none besides"


def kill_program(program: Program) -> Victim:
    """The program itself, what it started left to notice."""

    def kill() -> str | None:
        if not program.running:
            return None
        program.kill()
        return program.name

    return kill


def kill_worker(program: Program, chance: random.Random) -> Victim:
    """One of the processes that compute for it."""

    def kill() -> str | None:
        found = []
        for child in program.children():
            try:
                if "spawn_main" in " ".join(child.cmdline()):
                    found.append(child)
            except psutil.NoSuchProcess:
                continue
        if not found:
            return None
        try:
            chance.choice(found).kill()
        except psutil.NoSuchProcess:
            return None
        return f"a process of {program.name}"

    return kill


def database(url: str) -> Engine:
    """The database as an onlooker reads it."""
    return create_engine(url, connect_args={"timeout": 30} if url.startswith("sqlite") else {})


def _is_right(batch: dict[str, Any], row: dict[str, Any]) -> None:
    """One row against the core itself."""
    changes = {each["name"]: row[each["name"]] for each in batch["fields"]}
    scenario = Scenario.model_validate(dotted.with_changes(batch["scenario"], changes))
    expected = simulate(scenario, row["strategy"]).metrics["bump"]["body_acceleration"]["peak"]
    found = row["metrics"]["bump"]["body_acceleration"]["peak"]
    # Only the blocks a control law is computed in may differ between processes, in their last bits.
    assert abs(found - expected) <= 1e-9 * expected
