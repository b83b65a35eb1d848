"""Another program writes to the database for long: requests that write are refused, all others are answered."""

import contextlib
import sqlite3
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.faults.conftest import Process
from tests.faults.test_batches import finished, submit
from tests.faults.test_disk_full import SHORT, check_refused, post

WRITERS = 6


def test_writes_are_refused_and_reads_are_answered(service: Process, database: Path) -> None:
    kept, logged = post(service, 11).json(), len(service.log)
    with (
        contextlib.closing(sqlite3.connect(database, isolation_level=None)) as other_program,
        ThreadPoolExecutor(WRITERS) as threads,
    ):
        other_program.execute("BEGIN IMMEDIATE")
        writes = [threads.submit(post, service, 20 + number) for number in range(WRITERS)]
        answered = 0
        while not any(write.done() for write in writes):
            assert service.client.get(f"/api/v1/runs/{kept['id']}").status_code == 200
            assert service.client.get("/readyz").status_code == 200
            answered += 1
        assert answered > 1, "no read waits for a writer"
        for write in writes:
            check_refused(write.result())
        other_program.rollback()
    line = "The database did not answer: another program has held a lock on the SQLite database for more than 1 s"
    assert service.log[logged:].count(line) == WRITERS
    assert "Traceback" not in service.log[logged:]
    finished(service, submit(service, SHORT, 3), 3)
