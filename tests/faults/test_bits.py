"""A bit that flips in the database's file is told, or changes nothing; the drill tries 10,000 of them."""

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import select

from backend.__main__ import main
from backend.db.tables import runs
from backend.store import Store
from backend.store.verify import verify
from tests.faults import bits


def test_no_flipped_bit_changes_an_answer_without_a_word(tmp_path: Path) -> None:
    bits.fill(f"sqlite:///{tmp_path / 'ridelab.sqlite'}")
    fates, silent = bits.flip(tmp_path / "ridelab.sqlite", seed=1, count=40)
    assert not silent
    assert fates["told"] > 10, "else nothing was tried"


def test_a_text_whose_type_became_bytes_is_damaged_and_its_run_is_computed_again(tmp_path: Path) -> None:
    """SQLite keeps the type with each value: one bit decides it."""
    file = tmp_path / "ridelab.sqlite"
    bits.fill(f"sqlite:///{file}")
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
    ],
)
def test_a_job_that_is_not_where_its_last_event_says_is_damaged(tmp_path: Path, change: str) -> None:
    file = tmp_path / "ridelab.sqlite"
    bits.fill(f"sqlite:///{file}")
    with closing(sqlite3.connect(file)) as connection:
        connection.execute(f"UPDATE jobs SET {change} WHERE kind = 'tuning'")  # noqa: S608  # our own
        connection.commit()
    with closing(Store(f"sqlite:///{file}")) as store:
        assert len(verify(store).damaged["jobs"]) == 1


def test_a_text_that_is_none_costs_the_row_it_stands_in_alone(tmp_path: Path) -> None:
    file = tmp_path / "ridelab.sqlite"
    bits.fill(f"sqlite:///{file}")
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("UPDATE job_events SET data = CAST(x'ff' AS TEXT)")
        connection.commit()
    with closing(Store(f"sqlite:///{file}")) as store:
        verdict = verify(store)
    assert len(verdict.damaged["jobs"]) == verdict.rows["jobs"] == 2


def test_a_result_whose_text_is_none_is_computed_again(tmp_path: Path) -> None:
    """The highest bit of a byte makes text that is not UTF-8."""
    file = tmp_path / "ridelab.sqlite"
    bits.fill(f"sqlite:///{file}")
    content = bytearray(file.read_bytes())
    content[content.index(b"metric_5")] ^= 128
    file.write_bytes(content)
    with closing(Store(f"sqlite:///{file}")) as store:
        assert sum(map(len, verify(store).damaged.values())) == 1
        with store.reading() as connection:
            ids = connection.execute(select(runs.c.id)).scalars().all()
        assert sum(run.expired for each in ids if (run := store.runs.load(each)) is not None) == 1


def test_verify_names_what_is_damaged(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, arguments = tmp_path / "ridelab.sqlite", ["--data-dir", str(tmp_path), "--verify"]
    bits.fill(f"sqlite:///{file}")
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
