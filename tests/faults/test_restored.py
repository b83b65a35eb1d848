"""A batch is in the middle of its runs while the database is copied, and from the copy another service finishes it."""

import subprocess
from pathlib import Path

from tests.api.cli import command, environment
from tests.faults.conftest import Process, Start
from tests.faults.test_batches import finished, submit
from tests.faults.test_disk_full import LONG_BATCH, halted


def test_a_batch_is_finished_from_a_copy_made_while_it_went_on(
    service: Process, database: Path, start: Start, tmp_path: Path
) -> None:
    batch_id = submit(service, {"road": {"length": 121.7}}, LONG_BATCH)
    process = halted(service, batch_id)
    restored = tmp_path / "data/ridelab.sqlite"
    restored.parent.mkdir()
    words = ["backup", str(restored), "--data-dir", str(database.parent)]
    subprocess.run(command(*words), env=environment(), check=True, capture_output=True)
    process.resume()
    other = start(RIDELAB_WORKERS="1", RIDELAB_BATCH_WORKERS="1")
    for each in (service, other):
        finished(each, batch_id, LONG_BATCH)
