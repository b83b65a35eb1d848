"""Power cuts of a store's recorded work, by seed: `python -m tests.faults.power.cuts URL SEED PIECES` does the work.

After each transaction its process notes what the database then has: that is acknowledged.
"""

import hashlib
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from sqlalchemy import event, select
from sqlalchemy.exc import SQLAlchemyError

from backend import digest
from backend.db.sqlite import UnusableDatabaseError
from backend.db.tables import metadata
from backend.job_run import JobRun
from backend.outcome import Outcome
from backend.store import Store, StoredJob, StoredLink, StoredRun
from sim_core.scenario.measured import MeasuredRoad
from tests.faults.power.disk import NOTE, Disk, Record, note, read, recording

FILE = "ridelab.sqlite"


@dataclass
class Cuts:
    """What became of power cuts: how many, by what happened to unsynced writes; those that broke the promise."""

    fates: Counter[str] = field(default_factory=Counter)
    broken: list[str] = field(default_factory=list)


def content(store: Store) -> str:
    """A digest of every row."""
    queries = [select(table).order_by(*table.primary_key) for table in metadata.sorted_tables]
    with store.reading() as connection:
        found = [connection.execute(query).all() for query in queries]
    return hashlib.sha256(repr(found).encode()).hexdigest()


def work(store: Store, rng: np.random.Generator) -> Iterator[None]:
    """One piece, transaction by transaction: a run and a link, a road, or a batch of which some runs have ended."""
    result = Outcome(key=rng.bytes(16).hex(), strategy="lv", status="ok", json=b"{}", compute_ms=5.0)
    what = rng.integers(4)
    if what == 0:
        store.roads.save(MeasuredRoad.of(rng.normal(0, 0.01, int(rng.integers(100, 4000)))))
    elif what == 1:
        run = StoredRun(
            id=digest.random_id(),
            core_version="1",
            schema_version=1,
            scenario={"road": {"profile": None}},
            by_strategy={"lv": [result]},
        )
        store.runs.save(run)
        yield
        link = StoredLink(slug=digest.random_id(), kind="run", target=run.id, view={})
        store.links.save(link, {result.key: rng.bytes(int(rng.integers(100, 20_000)))})
    else:
        job = StoredJob(kind="sweep", request={"scenario": {}}, estimated_cost=1.0, total=60, request_hash="h")
        store.jobs.create(job, [JobRun(at, "{}", "lv", result.key) for at in range(60)])
        yield
        if what == 2:
            store.job_runs.save(job.id, [result], "1", dict.fromkeys(range(5), "lost"))
        else:
            store.jobs.cancel(job.id)
    yield


def record(folder: Path, *, seed: int, pieces: int, mode: str) -> list[Record]:
    """Work in a process of its own, with a journal mode or (`off`) with nothing synced: what it wrote and noted."""
    log, data = folder / f"log-{seed}", folder / f"data-{seed}"
    data.mkdir()
    arguments = [f"sqlite:///{data / FILE}", str(seed), str(pieces)]
    environment = recording(log, data) | {"RECORD_MODE": mode}
    subprocess.run([sys.executable, "-m", "tests.faults.power.cuts", *arguments], env=environment, check=True)
    records = list(read(log))
    log.unlink()
    return records


def cut(records: list[Record], folder: Path, *, seed: int, count: int) -> Cuts:
    """Cut the power so many times at random calls: a store has to start, sound, with all that was acknowledged.

    What was under way may be there too, as a whole.
    """
    rng, cuts, disk = np.random.default_rng(seed), Cuts(), Disk(folder)
    moments = Counter(rng.choice([at for at, each in enumerate(records) if each.kind != NOTE], count).tolist())
    noted = [each.data.decode() for each in records if each.kind == NOTE]
    before = 0
    for at, each in enumerate(records):
        if each.kind == NOTE:
            before += 1
            continue
        disk.apply(each)
        for _ in range(moments[at]):
            with TemporaryDirectory() as left:
                fate = disk.cut(Path(left), rng)
                cuts.fates[fate] += 1
                if fault := _fault(Path(left), noted[max(0, before - 1) : before + 1]):
                    cuts.broken.append(f"seed {seed}, after call {at}, unsynced: {fate}: {fault}")
    return cuts


def _fault(folder: Path, allowed: list[str]) -> str | None:
    with closing(Store(f"sqlite:///{folder / FILE}")) as store:
        try:
            store.migrate()
            with store.reading() as connection:
                said = connection.exec_driver_sql("PRAGMA integrity_check").scalars().all()
            if said != ["ok"]:
                return "; ".join(said)
            return None if content(store) in allowed else "what was acknowledged is not there"
        except (SQLAlchemyError, UnusableDatabaseError) as error:
            return f"{type(error).__name__}: {error}"


def main() -> None:
    """Do the work that the module's documentation says."""
    url, seed, pieces = sys.argv[1:]
    mode, rng = os.environ["RECORD_MODE"], np.random.default_rng(int(seed))
    pragma = "synchronous=OFF" if mode == "off" else f"journal_mode={mode}"
    with Path(os.environ["RECORD_LOG"]).open("ab", buffering=0) as log, closing(Store(url)) as store:
        event.listen(store.engine, "connect", lambda connection, _: connection.execute(f"PRAGMA {pragma}").close())
        store.migrate()
        note(log, content(store))
        for _ in range(int(pieces)):
            for _ in work(store, rng):
                note(log, content(store))


if __name__ == "__main__":
    main()
