"""A million steps of histories by DRILL_SEED, and mended faults put back, each of which one of them finds.

DRILL_STEPS (1,000,000) are shared: four in five are of requests, the others of jobs, which write a database.
"""

import inspect
import itertools
import os
import sys
import textwrap
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from backend.compute.fair_queue import FairQueue
from backend.compute.workers import Workers
from backend.jobs.leadership import Leadership
from backend.jobs.scheduler import Scheduler
from tests.faults.histories.jobs import Jobs
from tests.faults.histories.loop import BrokenPromiseError
from tests.faults.histories.requests import Requests

STEPS = int(os.environ.get("DRILL_STEPS", "1000000"))
SEED = int(os.environ.get("DRILL_SEED", "1"))
FOUND_WITHIN = 60.0  # of one core [s]

History = Requests | Jobs
# Where it stood, what stands there now, what stood there before, and the histories that find it.
FAULTS: dict[str, tuple[Any, str, str, str, type[History]]] = {
    "clients are served first come, first served": (
        *(FairQueue, "begin_next", "min(eligible, key=lambda each: in_work[each.client])", "eligible[0]"),
        Requests,
    ),
    "the only process alive computes nothing long": (
        *(FairQueue, "begin_next", "min(self._reserved, places - 1)", "self._reserved"),
        Requests,
    ),
    "a run whose client has gone computes on to its end": (
        *(Workers, "call", "self._call_off(task, process, attempt)", "pass"),
        Requests,
    ),
    "a leader that hangs keeps the lead": (
        *(Leadership, "_wait_for_session_lock", "if await self._store.read(_end_hung_leader, self._store)", "if False"),
        Jobs,
    ),
    "who has lost the lead writes on": (
        *(Leadership, "write", "partial(self._store.guarded, _check_lead, ", "partial(self._store.guarded, id, "),
        Jobs,
    ),
    "an error while the lead ends takes the place of the cancellation": (
        *(Scheduler, "_run", "while not self._closed:", "while True:"),
        Jobs,
    ),
    "jobs rest for ever where the end of a lead fails": (
        *(Scheduler, "_run", "except Exception:", "except ZeroDivisionError:"),
        Jobs,
    ),
}


def histories(kind: type[History], folder: Path) -> Iterator[tuple[int, History]]:
    """One after the other, by seed."""
    for seed in itertools.count(1000 * SEED):
        if kind is Requests:
            yield seed, Requests(seed)
        else:
            (folder / str(seed)).mkdir()
            yield seed, Jobs(seed, folder / str(seed))


@pytest.mark.timeout(7200)
@pytest.mark.parametrize(("kind", "share"), [(Requests, 0.8), (Jobs, 0.2)])
def test_no_history_breaks_a_promise(kind: type[History], share: float, tmp_path: Path) -> None:
    steps = 0
    for seed, history in histories(kind, tmp_path):
        try:
            steps += history.run()
        except BrokenPromiseError as error:
            pytest.fail(f"seed {seed}: {error}")
        if steps >= share * STEPS:
            print(f"\n{kind.__name__}: {steps} steps of {seed - 1000 * SEED + 1} histories, seeds from {1000 * SEED}")
            return


@pytest.mark.timeout(600)
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_that_is_put_back_is_found(fault: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    owner, name, new, old, kind = FAULTS[fault]
    source = textwrap.dedent(inspect.getsource(getattr(owner, name)))
    assert source.count(new) == 1, "it is written otherwise now"
    module = vars(sys.modules[owner.__module__]).copy()
    exec(source.replace(new, old), module)  # noqa: S102 - our own, with the fault
    monkeypatch.setattr(owner, name, module[name])
    begun = time.process_time()
    for seed, history in histories(kind, tmp_path):
        try:
            history.run()
        except BrokenPromiseError as error:
            print(f"\n{fault}: found in {time.process_time() - begun:.1f} s, seed {seed}: {error}"[:300])
            return
        assert time.process_time() - begun < FOUND_WITHIN
