"""The stores: one `Store` over one database, a file for each kind of row.

Methods are synchronous and short; services run them through `Store.read` and `Store.write`.
"""

from backend.db.database import Database
from backend.store.job import FINAL, StoredJob
from backend.store.job_events import JobEventStore
from backend.store.job_runs import JobRunStore
from backend.store.jobs import JobStore
from backend.store.links import LinkStore, StoredLink
from backend.store.logins import LoginStore
from backend.store.recordings import RecordingStore
from backend.store.retention import RetentionStore
from backend.store.roads import RoadStore
from backend.store.runs import RunStore, StoredRun
from backend.store.trials import TrialStore

JOB_POLL_INTERVAL = 1.0  # between two looks at a job of another process, whose commits nothing tells here [s]
__all__ = ["Store", "StoredJob", "StoredLink", "StoredRun"]


class Store(Database):
    """The database with every store's methods."""

    def __init__(self, url: str) -> None:
        super().__init__(url)
        self.runs = RunStore(self)
        self.roads = RoadStore(self)
        self.recordings = RecordingStore(self)
        self.jobs = JobStore(self)
        self.job_runs = JobRunStore(self)
        self.job_events = JobEventStore(self)
        self.trials = TrialStore(self)
        self.links = LinkStore(self)
        self.logins = LoginStore(self)
        self.retention = RetentionStore(self)

    async def ended(self, job_id: str) -> StoredJob | None:
        """Wait until a job has ended, and return it then; None where it was deleted."""
        with self.commits.following(job_id) as changes:
            while True:
                changes.clear()
                job = await self.read(self.jobs.load, job_id)
                if job is None or job.state in FINAL:
                    return job
                await changes.wait(JOB_POLL_INTERVAL)
