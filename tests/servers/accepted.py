"""Batches a service accepted: whatever becomes of it, each completes, and each result is stored once and stays."""

import itertools
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import NullPool, create_engine, func, select, text

from backend.db.tables import job_runs, results
from tests.servers.process import HANG_TIMEOUT, ask, wait_until

_counter = itertools.count()


@dataclass
class Accepted:
    """The batches submitted, and their results in the database.

    Attributes:
        url: Where the service is asked; it may be down at any moment.
        database: Where it is looked at from outside.
        seed: Same seed, same batches.
        runs: Of each batch; an even number.
        strategies: The two that drive.
        batches: How many runs each has, by its id.
        trials: Of tunings that were submitted beside them.
        stored: Rows of results by key, as they were first seen.
    """

    url: str
    database: str
    seed: int
    runs: int
    strategies: tuple[str, str] = ("lv", "passive")
    batches: dict[str, int] = field(default_factory=dict)
    trials: dict[str, Any] = field(default_factory=dict)
    stored: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        patience = {"timeout": HANG_TIMEOUT} if self.database.startswith("sqlite") else {}
        self.engine = create_engine(self.database, connect_args=patience, poolclass=NullPool)

    def submit(self, runs: int | None = None) -> str:
        """Submit a new batch, with one idempotency key until it is accepted; return its id."""
        number, runs = len(self.batches), runs or self.runs
        ranges = {"road.bump.height": [0.02, 0.12]}
        sweep = {"latin_hypercube": {"ranges": ranges, "samples": runs // 2, "seed": number}}
        body = {"scenario": {"road": {"length": 126.0}}, "strategies": self.strategies, "sweep": sweep}
        key = {"Idempotency-Key": f"accepted-{self.seed}-{next(_counter)}"}
        batch_id = str(ask(self.url, "POST", "/batches", json=body, headers=key)["id"])
        self.batches[batch_id] = runs
        return batch_id

    def forget(self, job: str) -> None:
        """Expect nothing of a job (its path) that was deleted."""
        self.batches.pop(job.rpartition("/")[2], None)

    def waiting(self) -> int:
        """Runs that are not computed yet."""
        query = select(func.count()).where(job_runs.c.job_id.in_(list(self.batches)), job_runs.c.status == "waiting")
        with self.engine.connect() as connection:
            return int(connection.execute(query).scalar_one())

    def await_work(self) -> None:
        """Wait for new results, if any are to come; a service that has just been killed takes some seconds."""
        before = self.waiting()
        wait_until(lambda: not before or self.waiting() != before, "results come in")

    def check_stored(self) -> None:
        """Every result stored before is the same row now: neither lost nor computed again."""
        with self.engine.connect() as connection:
            now = {
                row.key: (row.created_at, row.compute_ms, row.summary)
                for row in connection.execute(select(results)).all()
            }
        for key, row in self.stored.items():
            assert now.get(key) == row, "a stored result changed or was lost"
        self.stored = now

    def finish(self) -> None:
        """Wait for every batch, and check all of it."""
        for batch_id in self.batches:
            self._finish_one(batch_id)
        self.check_stored()
        keys = select(job_runs.c.result_key).where(job_runs.c.job_id.in_(list(self.batches)))
        with self.engine.connect() as connection:
            assert set(connection.execute(keys).scalars()) <= set(self.stored), "a result of every run"
            if self.engine.dialect.name == "sqlite":
                assert connection.execute(text("PRAGMA integrity_check")).scalar_one() == "ok"

    def _finish_one(self, batch_id: str) -> None:
        batch: dict[str, Any] = {}

        def is_over() -> bool:
            batch.update(ask(self.url, "GET", f"/batches/{batch_id}"))
            return batch["state"] not in ("planning", "queued", "running")

        wait_until(is_over, f"{batch_id} ends", pause=0.2)
        assert batch["state"] == "done", batch["reason"]
        self.check_rows(batch)

    def check_rows(self, batch: dict[str, Any]) -> None:
        """Check the rows of a batch that is done, or was cancelled and keeps what is finished."""
        rows = ask(self.url, "GET", f"/batches/{batch['id']}/results")["rows"]
        done = [row for row in rows if row["status"] == "ok"]
        if batch["state"] == "done":
            assert (batch["total"], len(done)) == (self.batches[batch["id"]],) * 2
        assert [row["run"] for row in rows] == list(range(batch["total"] or 0))
        assert {row["status"] for row in rows} <= {"ok", "cancelled"}
        assert (batch["done"], batch["failed"]) == (len(done), 0)
