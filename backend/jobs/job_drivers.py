"""A task for each job that is not computed run by run: its steps, or new keys after an upgrade."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Coroutine
from functools import partial
from typing import Any

from sqlalchemy.exc import SQLAlchemyError

from backend.errors import DamagedError, TemporaryError
from backend.jobs.kind import JobFailedError
from backend.jobs.leadership import LeadershipLostError
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED

logger = logging.getLogger(__name__)

MAX_TASKS = 4  # beyond it no job's steps are taken; the others wait in the order they were accepted
PAUSE_AFTER_FAILURE = 2.0  # after the database failed, or the service was full [s]
TRANSIENT = (SQLAlchemyError, OSError, TemporaryError, LeadershipLostError)
UNFORESEEN = "It failed with an unforeseen error, which is in the service's log"

Step = Callable[[StoredJob], Awaitable[None]]


class JobDrivers:
    """A task for each job; `ended` is set when one has ended."""

    def __init__(self, store: Store, ended: asyncio.Event) -> None:
        self._store = store
        self._ended = ended
        self._tasks: dict[str, asyncio.Task[None]] = {}

    def take_steps(self, job_id: str, step: Step) -> None:
        """Start a task that takes the job's steps to its end, if there is room."""
        if len(self._tasks) < MAX_TASKS:
            self.begin(job_id, partial(self._take_steps, job_id, step))

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
        except DamagedError as error:
            logger.error("Job %s: %s", job_id, error.message)
            await self._store.write(self._store.jobs.give_up, job_id, error.message)
        except TRANSIENT as error:
            logger.warning("Job %s rests: %s", job_id, type(error).__name__)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        except Exception:  # not even its failure could be noted: it is tried again
            logger.exception("Job %s rests", job_id)
            await asyncio.sleep(PAUSE_AFTER_FAILURE)
        finally:
            del self._tasks[job_id]
            self._ended.set()

    async def _take_steps(self, job_id: str, step: Step) -> None:
        while (job := await self._store.read(self._store.jobs.load, job_id)) is not None and job.state in UNFINISHED:
            try:
                await step(job)
            except TRANSIENT:
                raise
            except JobFailedError as error:
                await self._store.write(self._store.jobs.fail, job, str(error))
            except Exception:  # a bug of ours: this job fails and says so, the others go on
                logger.exception("Job %s failed", job.id)
                await self._store.write(self._store.jobs.fail, job, UNFORESEEN)
