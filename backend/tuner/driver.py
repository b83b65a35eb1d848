"""Drives the tunings, a few side by side; of several services on one database the one that drives the batches."""

import asyncio
import contextlib
import logging
from collections.abc import Sequence

from sqlalchemy.exc import SQLAlchemyError

from backend.batches.driver import Driver
from backend.batches.service import Batches
from backend.errors import ServiceError, TemporaryError, WorkerTimeoutError
from backend.store import Store, StoredTuning
from backend.store.tunings import UNFINISHED
from backend.tuner.batching import TuningBatches, TuningFailedError
from backend.tuner.objectives import UndefinedObjectiveError
from backend.tuner.steps import Steps
from sim_core import __version__ as CORE_VERSION
from sim_core.errors import RidelabError
from sim_core.scenario import SCHEMA_VERSION
from sim_core.scenario.versions import restored

logger = logging.getLogger(__name__)

AT_ONCE = 4  # tunings driven side by side; the others wait in the order they were accepted
LOOK = 0.4  # between two looks at what was accepted, here or by another service [s]
PAUSE = 2.0  # after the database failed or the service was full [s]
UNFORESEEN = "It failed with an unforeseen error, which is in the service's log"


class TuningDriver:
    """One for each service; its methods belong to the event loop."""

    def __init__(self, *, store: Store, batches: Batches, driver: Driver) -> None:
        self._store = store
        self._batches = driver
        self._steps = Steps(store, TuningBatches(store=store, batches=batches, driver=driver))
        self._wake = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._driven: dict[str, asyncio.Task[None]] = {}

    def start(self) -> None:
        """Begin, in the background."""
        self._task = asyncio.create_task(self._run())

    def wake(self) -> None:
        """A tuning was accepted or resumed: look now."""
        self._wake.set()

    async def close(self) -> None:
        """Stop driving; what is unfinished waits for the next service or start."""
        for task in [task for task in (self._task, *self._driven.values()) if task is not None]:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
        self._steps.close()

    async def _run(self) -> None:
        while True:
            try:
                if self._batches.leads:
                    self._begin(await self._store.read(self._store.tunings.unfinished))
                else:
                    self._leave()
            except SQLAlchemyError as error:
                logger.warning("The tunings rest: %s", type(error).__name__)
                await asyncio.sleep(PAUSE)
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(LOOK):
                    await self._wake.wait()
            self._wake.clear()

    def _begin(self, unfinished: Sequence[str]) -> None:
        """Drive the first of these; those that have ended leave by themselves."""
        for tuning_id in unfinished:
            if len(self._driven) < AT_ONCE and tuning_id not in self._driven:
                self._driven[tuning_id] = asyncio.create_task(self._drive(tuning_id))

    def _leave(self) -> None:
        """Another service drives now."""
        for task in self._driven.values():
            task.cancel()

    async def _drive(self, tuning_id: str) -> None:
        """Step by step to its end, or until something passing is in the way: a later look begins again."""
        try:
            while (tuning := await self._store.read(self._store.tunings.load, tuning_id)) is not None:
                if tuning.state not in UNFINISHED:
                    return
                reason = await self._step(tuning)
                if reason is not None:
                    await self._store.write(self._store.tunings.fail, tuning, reason)
        except (SQLAlchemyError, OSError, ServiceError) as error:
            logger.warning("Tuning %s rests: %s", tuning_id, type(error).__name__)
            await asyncio.sleep(PAUSE)
        except Exception:  # not even its failure could be noted: it is tried again
            logger.exception("Tuning %s rests", tuning_id)
            await asyncio.sleep(PAUSE)
        finally:
            del self._driven[tuning_id]
            self._wake.set()

    async def _step(self, tuning: StoredTuning) -> str | None:
        """Take the next step; the reason why there is none, where it failed.

        Raises:
            TemporaryError, WorkerTimeoutError: The service is full or the machine slow; it is tried again.
        """
        try:
            if tuning.core_version != CORE_VERSION:
                await self._restart(tuning)
            else:
                await self._steps.take(tuning)
        except (TuningFailedError, UndefinedObjectiveError) as error:
            return str(error)
        except (SQLAlchemyError, OSError, TemporaryError, WorkerTimeoutError):
            raise
        except ServiceError as error:
            return error.message
        except Exception:  # a bug of ours: this tuning fails and says so, the others go on
            logger.exception("Tuning %s failed", tuning.id)
            return UNFORESEEN
        return None

    async def _restart(self, tuning: StoredTuning) -> None:
        """Another core version's numbers are not mixed with this one's: from the beginning, which is repeatable."""
        logger.warning("Tuning %s begins again with core %s", tuning.id, CORE_VERSION)
        try:
            scenario = restored(tuning.request["scenario"], tuning.schema_version).model_dump(mode="json")
        except (RidelabError, ValueError) as error:
            raise TuningFailedError(f"Core {CORE_VERSION} cannot read its scenario") from error
        await self._store.write(self._store.tunings.restart, tuning, scenario, CORE_VERSION, SCHEMA_VERSION)
