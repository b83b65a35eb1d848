"""Sweeps as the engine knows them: each run is one strategy at one point."""

import numpy as np
from numpy.typing import NDArray

from backend.batches.plan import with_keys
from backend.jobs.kind import JobKind
from backend.metrics import BATCH_QUEUE, BATCHES
from backend.runs.compute_run import compute
from backend.store import StoredJob

COARSEST = 8  # the first round takes every eighth value of each of a grid's fields


def coarse_first(job: StoredJob) -> NDArray[np.intp]:
    """Positions of a sweep's runs; of a grid's those at every eighth value of each field first, then fourth, second.

    A point's strategies stay together, and so do the points of each round, as what neighbours share is worked out once.
    """
    names, shape = job.request["strategies"], job.request.get("shape")
    points = np.arange(job.total // len(names))
    if shape:
        steps = np.gcd.reduce(np.indices(shape).reshape(len(shape), -1), initial=COARSEST)
        points = points[np.argsort(-steps, kind="stable")]
    return (points[:, np.newaxis] * len(names) + np.arange(len(names))).ravel()


SWEEP = JobKind(
    name="sweep",
    word="batch",
    plural="batches",
    size_pointer="/sweep",
    run_pointer="/sweep",
    compute=compute,
    order=coarse_first,
    keys=with_keys,
    gauges=(BATCHES, BATCH_QUEUE),
)
