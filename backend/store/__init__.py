"""What is kept: one `Store` over one database, a file for each kind of thing it holds.

Methods are synchronous and short; services run them through `Store.read` and `Store.write`.
"""

from backend.store.batches import BatchStore, StoredBatch
from backend.store.database import Database
from backend.store.links import LinkStore, StoredLink
from backend.store.runs import RunStore, StoredResult, StoredRun
from backend.store.tunings import StoredTuning, TuningStore

__all__ = ["Store", "StoredBatch", "StoredLink", "StoredResult", "StoredRun", "StoredTuning"]


class Store(Database):
    """The database with everything in it."""

    def __init__(self, url: str) -> None:
        super().__init__(url)
        self.runs = RunStore(self)
        self.batches = BatchStore(self)
        self.links = LinkStore(self)
        self.tunings = TuningStore(self)
