"""The Prometheus metrics: counters and histograms of the process, gauges of one application.

Labels take their values from short lists only (states, route templates, reasons): nothing of a scenario, an address
or a client ever becomes a label.
"""

from collections.abc import Mapping
from platform import python_version
from typing import Protocol

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, ProcessCollector

from sim_core import __version__

REGISTRY = CollectorRegistry()
ProcessCollector(registry=REGISTRY)

# From a stored answer to the longest computation one request may ask for [s].
LATENCY_BUCKETS = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 90)

RUNS = Counter("ridelab_runs", "Results computed, one a strategy", ["kind", "status"], registry=REGISTRY)
CACHE = Counter("ridelab_cache", "Results asked for: there already, or computed", ["outcome"], registry=REGISTRY)
SOLVER_FALLBACKS = Counter(
    "ridelab_solver_fallbacks", "Control steps whose QP found no answer and fell back", registry=REGISTRY
)
WORKER_FAILURES = Counter(
    "ridelab_worker_failures", "Worker processes lost during a task", ["reason"], registry=REGISTRY
)
STORE_ERRORS = Counter("ridelab_store_errors", "Requests the database did not answer", registry=REGISTRY)
DAMAGED_RESULTS = Counter(
    "ridelab_damaged_results",
    "Stored results whose checksum was wrong, dropped to be computed again",
    ["what"],
    registry=REGISTRY,
)
REFUSED = Counter("ridelab_refused", "Requests refused to protect the service", ["reason"], registry=REGISTRY)
LATENCY = Histogram(
    "ridelab_request_seconds",
    "Time to the whole answer, of event streams to its beginning",
    ["method", "route", "status"],
    buckets=LATENCY_BUCKETS,
    registry=REGISTRY,
)
BATCHES = Gauge(
    "ridelab_batches", "Batches by state, as the replica that drives them sees it", ["state"], registry=REGISTRY
)
BATCH_QUEUE = Gauge("ridelab_batch_queue_runs", "Runs of open batches by state", ["state"], registry=REGISTRY)
REMOVED = Counter("ridelab_removed", "Jobs and results removed by age or size", ["what"], registry=REGISTRY)
STORED_BYTES = Gauge(
    "ridelab_stored_bytes",
    "Results and jobs in the database, as the replica that removes old ones sees it",
    registry=REGISTRY,
)
BUILD = Gauge("ridelab_build_info", "Always 1; the labels say what runs", ["version", "python"], registry=REGISTRY)

for _kind in ("interactive", "batch"):
    for _status in ("ok", "failed"):
        RUNS.labels(_kind, _status)
for _outcome in ("hit", "miss"):
    CACHE.labels(_outcome)
for _reason in ("died", "timeout"):
    WORKER_FAILURES.labels(_reason)
for _what in ("jobs", "results"):
    REMOVED.labels(_what)
for _what in ("result", "series"):
    DAMAGED_RESULTS.labels(_what)
BUILD.labels(__version__, python_version()).set(1)


def count_runs(kind: str, status: str, count: int = 1, fallbacks: float = 0) -> None:
    """Count computed results.

    Args:
        kind: `interactive` or `batch`.
        status: `ok` or `failed`.
        count: How many.
        fallbacks: Of the solver, in all of them.
    """
    RUNS.labels(kind, status).inc(count)
    SOLVER_FALLBACKS.inc(fallbacks)


class Loaded(Protocol):
    """A part of one application that reports its current load."""

    @property
    def load(self) -> Mapping[str, float]:
        """Amounts by name."""


def service_registry(workers: Loaded, gate: Loaded) -> CollectorRegistry:
    """Return the registry behind `/metrics` of one application: the process's counters, and gauges read on request.

    Args:
        workers: Holds `busy` and `idle` processes, and tasks `waiting` for one.
        gate: Holds `cost` not finished [s of one core], `requests` open and `waiting`, `streams` open, and bytes of
            `memory`.
    """
    registry = CollectorRegistry()
    registry.register(REGISTRY)

    def gauge(name: str, text: str, part: Loaded, amount: str) -> None:
        Gauge(name, text, registry=registry).set_function(lambda: part.load[amount])

    processes = Gauge("ridelab_workers", "Warm worker processes", ["state"], registry=registry)
    processes.labels("busy").set_function(lambda: workers.load["busy"])
    processes.labels("idle").set_function(lambda: workers.load["idle"])
    gauge("ridelab_worker_queue", "Interactive tasks that wait for a worker", workers, "waiting")
    accepted = "Estimated computing accepted and not finished, of one core"
    gauge("ridelab_admitted_cost_seconds", accepted, gate, "cost")
    gauge("ridelab_waiting_requests", "Requests that wait for their turn", gate, "waiting")
    gauge("ridelab_open_requests", "Computing requests that are open", gate, "requests")
    gauge("ridelab_open_streams", "Event streams that are open", gate, "streams")
    gauge("ridelab_held_bytes", "Long request bodies and pinned time histories in memory", gate, "memory")
    return registry
