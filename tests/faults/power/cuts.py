"""Power cuts of recorded work, and what a store says of what is left."""

import subprocess
import sys
from collections import Counter
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from sqlalchemy.exc import SQLAlchemyError

from backend.db.sqlite import UnusableDatabaseError
from backend.store import Store
from tests.faults.power.disk import NOTE, Disk, Record, read, recording
from tests.faults.power.work import content

FILE = "ridelab.sqlite"


@dataclass
class Cuts:
    """What became of power cuts: how many, by what happened to unsynced writes; those that broke the promise."""

    fates: Counter[str] = field(default_factory=Counter)
    broken: list[str] = field(default_factory=list)


def record(folder: Path, *, seed: int, pieces: int, wal: bool) -> list[Record]:
    """Do mixed work in a process of its own; what it wrote, and its notes."""
    log, data = folder / f"log-{seed}", folder / f"data-{seed}"
    data.mkdir()
    environment = recording(log, data) | ({"RECORD_WAL": "1"} if wal else {})
    arguments = [f"sqlite:///{data / FILE}", str(seed), str(pieces)]
    subprocess.run([sys.executable, "-m", "tests.faults.power.work", *arguments], env=environment, check=True)
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
