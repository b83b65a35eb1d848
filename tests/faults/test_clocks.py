"""Replicas whose clocks differ: the database's decides what rows say and what is old."""

import subprocess
from collections.abc import Iterator
from contextlib import closing
from datetime import UTC, datetime, timedelta
from email.utils import parsedate_to_datetime
from pathlib import Path

import pytest

from backend.controller import build
from backend.store import Store
from tests.faults.conftest import Process
from tests.faults.test_batches import finished, submit
from tests.servers.postgres import Postgres
from tests.servers.process import wait_until

AHEAD = 30 * 86400  # [s]
# Loaded before the C library, of which Python asks the time.
CLOCK = f"""
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
int clock_gettime(clockid_t which, struct timespec *now) {{
    int status = (int)syscall(SYS_clock_gettime, which, now);
    if (which == CLOCK_REALTIME) now->tv_sec += {AHEAD};
    return status;
}}
time_t time(time_t *out) {{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (out) *out = now.tv_sec;
    return now.tv_sec;
}}
int gettimeofday(struct timeval *out, void *zone) {{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    out->tv_sec = now.tv_sec;
    out->tv_usec = now.tv_nsec / 1000;
    return 0;
}}
"""
SHORT = {"road": {"length": 121.3, "bump": {"start": 80}}}


@pytest.fixture
def ahead(postgres: Postgres, tmp_path: Path) -> Iterator[Process]:
    """A replica whose clock is a month ahead, and which removes what is older than a day."""
    source, library = tmp_path / "clock.c", tmp_path / "clock.so"
    source.write_text(CLOCK)
    subprocess.run([*build.compilers()[0], "-shared", "-fPIC", "-o", library, source], check=True)
    url = postgres.new_database()
    with closing(Store(url)) as store:
        store.migrate()
        long_ago(store)
    variables = {"RIDELAB_DATABASE_URL": url, "RIDELAB_RETENTION_DAYS": "1", "LD_PRELOAD": str(library)}
    service = Process(tmp_path, "ahead", **variables)
    try:
        service.wait_until_ready()
        yield service
    finally:
        service.client.close()
        service.end()


def long_ago(store: Store) -> None:
    """A result that is old by every clock, and one that is new by the database's."""
    row = "INSERT INTO results VALUES ('{}', 'lv', '0.4.0', 'ok', '{{}}', 1, now() - interval '{}')"
    with store.writing() as connection:
        for name, age in (("old", "3 days"), ("new", "1 hour")):
            connection.exec_driver_sql(row.format(name, age))


def test_a_replica_that_is_ahead_dates_nothing_and_removes_nothing_of_today(ahead: Process) -> None:
    shown = parsedate_to_datetime(ahead.client.get("/healthz").headers["date"])
    assert shown > datetime.now(UTC) + timedelta(seconds=AHEAD / 2), "the replica's clock is ahead"
    begun = datetime.now(UTC) - timedelta(minutes=1)
    run = ahead.client.post("/api/v1/runs", json={"scenario": SHORT, "strategies": ["passive"]}).json()
    link = ahead.client.post("/api/v1/links", json={"run_id": run["id"]}).json()
    batch_id = submit(ahead, SHORT, 2)
    finished(ahead, batch_id, 2)
    batch = ahead.client.get(f"/api/v1/batches/{batch_id}").json()
    opened = ahead.client.get(f"/api/v1/links/{link['slug']}").json()
    times = [batch[name] for name in ("created_at", "started_at", "finished_at")]
    times += [opened[name] for name in ("created_at", "computed_at")]
    for each in times:
        assert begun < datetime.fromisoformat(each) < datetime.now(UTC) + timedelta(minutes=1)
    assert times[:3] == sorted(times[:3])
    removed = 'ridelab_removed_total{what="results"} '
    wait_until(lambda: f"{removed}1.0" in ahead.client.get("/metrics").text, "what is old was removed")
    assert ahead.client.get(f"/api/v1/batches/{batch_id}").status_code == 200
