"""Sweeps as the engine knows them: each run is one strategy at one point."""

from backend.batches.plan import rekeyed
from backend.jobs.kind import JobKind
from backend.metrics import BATCH_QUEUE, BATCHES
from backend.runs.compute_run import compute

SWEEP = JobKind(
    name="sweep",
    word="batch",
    plural="batches",
    size_pointer="/sweep",
    run_pointer="/sweep",
    compute=compute,
    rekey=rekeyed,
    jobs_gauge=BATCHES,
    runs_gauge=BATCH_QUEUE,
)
