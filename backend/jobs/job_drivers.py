"""A task for each job that is no sweep: the steps of the other kinds, and new keys after an upgrade."""

import asyncio
import logging
from collections.abc import Callable, Coroutine, Mapping
from functools import partial
from typing import Any, Protocol

from sqlalchemy.exc import SQLAlchemyError

from backend.errors import TemporaryError
from backend.jobs.leadership import LeadershipLostError
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED, Kind

logger = logging.getLogger(__name__)

MAX_TASKS = 4  # beyond it no job is driven; the others wait in the order they were accepted
PAUSE_AFTER_FAILURE = 2.0  # after the database failed, or the service was full [s]
TRANSIENT = (SQLAlchemyError, OSError, TemporaryError, LeadershipLostError)
UNFORESEEN = "It failed with an unforeseen error, which is in the service's log"


class JobFailedError(Exception):
    """The job cannot go on; the message tells its owner why."""


class Stepper(Protocol):
    """Takes the steps of one kind of job."""

    async def step(self, job: StoredJob) -> None:
        """Take the next step of the job to its end; the stored state says which it is.

        Raises:
            JobFailedError: The job cannot go on.
            TemporaryError: It can be tried again later.
        """


class JobDrivers:
    """A task for each job.

    Args:
        store: The database.
        steppers: By kind, of the kinds that are not computed run by run.
        ended: Set when a task has ended.
    """

    def __init__(self, store: Store, steppers: Mapping[Kind, Stepper], ended: asyncio.Event) -> None:
        self._store = store
        self._steppers = steppers
        self._ended = ended
        self._tasks: dict[str, asyncio.Task[None]] = {}

    def drives(self, kind: Kind) -> bool:
        """Whether jobs of that kind have steps."""
        return kind in self._steppers

    def drive(self, job: StoredJob) -> None:
        """Start a task that takes the job's steps to its end, if there is room."""
        if len(self._tasks) < MAX_TASKS:
            self.begin(job.id, partial(self._drive, job.id, self._steppers[job.kind]))

    def begin(self, job_id: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Start a task with that work for the job, unless it has one."""
        if job_id not in self._tasks:
            self._tasks[job_id] = asyncio.create_task(self._run(job_id, work))

    def cancel(self) -> None:
        """End every task."""
        for task in self._tasks.values():
            task.cancel()

    async def _run(self, job_id: str, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Run the work until it ends or meets a transient error, after which a later look starts it again."""
        try:
            await work()
        except TRANSIENT as error:
            logger.warning("Job %s rests: %s", job_id, type(error).__name__)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        except Exception:  # not even its failure could be noted: it is tried again
            logger.exception("Job %s rests", job_id)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        finally:
            del self._tasks[job_id]
            self._ended.set()

    async def _drive(self, job_id: str, stepper: Stepper) -> None:
        """Take the job's steps to its end."""
        while (job := await self._store.read(self._store.jobs.load, job_id)) is not None and job.state in UNFINISHED:
            try:
                await stepper.step(job)
            except TRANSIENT:
                raise
            except JobFailedError as error:
                await self._store.write(self._store.jobs.fail, job, str(error))
            except Exception:  # a bug of ours: this job fails and says so, the others go on
                logger.exception("Job %s failed", job.id)
                await self._store.write(self._store.jobs.fail, job, UNFORESEEN)
