"""A bit that flips in the database's file is told, or changes nothing; the drill tries 10,000 of them."""

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import select

from backend.__main__ import main
from backend.db.tables import runs
from backend.errors import DamagedError
from backend.store import Store
from backend.store.verify import verify
from tests.faults import bits


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("full") / "ridelab.sqlite"
    bits.fill(f"sqlite:///{file}")
    return file


@pytest.fixture
def file(full: Path, tmp_path: Path) -> Path:
    """A copy of a database of every kind of thing."""
    return Path(shutil.copy(full, tmp_path))


def test_no_flipped_bit_changes_an_answer_without_a_word(file: Path) -> None:
    fates, silent = bits.flip(file, seed=1, count=40)
    assert not silent
    assert fates["told"] > 10, "else nothing was tried"


def test_a_text_whose_type_became_bytes_is_damaged_and_its_run_is_computed_again(file: Path) -> None:
    """SQLite keeps the type with each value: one bit decides it."""
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("UPDATE results SET summary = CAST(summary AS BLOB) WHERE strategy = 'lv'")
        connection.commit()
        (run_id,) = connection.execute("SELECT id FROM runs LIMIT 1").fetchone()
    with closing(Store(f"sqlite:///{file}")) as store:
        assert len(verify(store).damaged["results"]) == bits.RUNS + bits.POINTS
        run = store.runs.load(run_id)
    assert run is not None
    assert run.expired


@pytest.mark.parametrize(
    "change",
    [
        "state = 'failed'",
        "state = CAST(x'ff' AS TEXT)",
        "done = done - 1",
        "progress = '{\"attempt\":2}'",
        "progress = '{'",
        "created_at = CAST(created_at AS BLOB)",
    ],
)
def test_a_job_that_is_not_as_its_last_event_says_or_not_readable_is_damaged(file: Path, change: str) -> None:
    with closing(sqlite3.connect(file)) as connection:
        connection.execute(f"UPDATE jobs SET {change} WHERE kind = 'tuning'")  # noqa: S608  # our own
        connection.commit()
    with closing(Store(f"sqlite:///{file}")) as store:
        assert len(verify(store).damaged["jobs"]) == 1


def test_a_number_in_place_of_no_reason_is_damage(file: Path) -> None:
    """One bit of a record's head makes 0 of nothing."""
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("ALTER TABLE job_runs RENAME COLUMN reason TO reason_before")
        connection.execute("ALTER TABLE job_runs ADD COLUMN reason")  # of any type: a text's column makes '0' of 0
        connection.execute("UPDATE job_runs SET reason = 0 WHERE position = 1")
        connection.commit()
    with closing(Store(f"sqlite:///{file}")) as store:
        assert len(verify(store).damaged["job_runs"]) == 2


def test_a_text_that_is_none_costs_the_row_it_stands_in_alone(file: Path) -> None:
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("UPDATE job_events SET data = CAST(x'ff' AS TEXT)")
        connection.commit()
    with closing(Store(f"sqlite:///{file}")) as store:
        verdict = verify(store)
    assert len(verdict.damaged["jobs"]) == verdict.rows["jobs"] == 2


def test_a_result_whose_text_is_none_is_computed_again(file: Path) -> None:
    """The highest bit of a byte makes text that is not UTF-8."""
    content = bytearray(file.read_bytes())
    content[content.index(b"metric_5")] ^= 128
    file.write_bytes(content)
    with closing(Store(f"sqlite:///{file}")) as store:
        assert sum(map(len, verify(store).damaged.values())) == 1
        with store.reading() as connection:
            ids = connection.execute(select(runs.c.id)).scalars().all()
        assert sum(run.expired for each in ids if (run := store.runs.load(each)) is not None) == 1


def test_verify_names_what_is_damaged(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--data-dir", str(file.parent), "--verify"]
    assert main(arguments) == 0
    assert capsys.readouterr().out.endswith("Everything is as it was written\n")
    content = bytearray(file.read_bytes())
    content[content.index(b"metric_5") + 12] ^= 1
    file.write_bytes(content)
    assert main(arguments) == 1
    assert "results: 87 rows, 1 damaged\n" in capsys.readouterr().out
    assert main([*arguments, "--json"]) == 1
    verdict = json.loads(capsys.readouterr().out)
    assert (verdict["sound"], verdict["rows"]["results"], len(verdict["damaged"]["results"])) == (False, 87, 1)


@pytest.mark.parametrize("value", ["CAST(created_at AS BLOB)", "'no time'"])
def test_a_run_whose_time_is_none_is_damaged(file: Path, value: str) -> None:
    with closing(sqlite3.connect(file)) as connection:
        connection.execute(f"UPDATE runs SET created_at = {value}")  # noqa: S608  # our own
        connection.commit()
        (run_id,) = connection.execute("SELECT id FROM runs LIMIT 1").fetchone()
    with closing(Store(f"sqlite:///{file}")) as store, pytest.raises(DamagedError):
        store.runs.load(run_id)
