"""What Prometheus reads: counters and histograms of the process, gauges of one application.

Labels take their values from short lists only (states, route templates, reasons): nothing of a scenario, an address
or a client ever becomes a label.
"""

from collections.abc import Iterator, Mapping
from platform import python_version
from typing import Any, Protocol

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, ProcessCollector
from prometheus_client.core import GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

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
BUILD = Gauge("ridelab_build_info", "Always 1; the labels say what runs", ["version", "python"], registry=REGISTRY)

for _kind in ("interactive", "batch"):
    for _status in ("ok", "failed"):
        RUNS.labels(_kind, _status)
for _outcome in ("hit", "miss"):
    CACHE.labels(_outcome)
for _reason in ("died", "timeout"):
    WORKER_FAILURES.labels(_reason)
BUILD.labels(__version__, python_version()).set(1)


def count_run(kind: str, status: str, summary: Mapping[str, Any]) -> None:
    """Count one computed result.

    Args:
        kind: `interactive` or `batch`.
        status: `ok` or `failed`.
        summary: `StrategyResult.summary()`, or the reason of a failure.
    """
    RUNS.labels(kind, status).inc()
    fallbacks = summary.get("events", {}).get("qp_fallbacks")
    if fallbacks:
        SOLVER_FALLBACKS.inc(fallbacks)


class LoadedWorkers(Protocol):
    """The worker pool, as far as it is measured."""

    @property
    def load(self) -> dict[str, int]:
        """Processes `busy` and `idle`, tasks `waiting`."""


class LoadedAdmission(Protocol):
    """Admission, as far as it is measured."""

    @property
    def load(self) -> dict[str, float]:
        """`cost` [s of one core] not finished; expected `wait` [s]; `requests`, `streams`, long `bodies` open."""


class ServiceCollector(Collector):
    """Gauges of one application: two of them in a process do not meet."""

    def __init__(self, workers: LoadedWorkers, admission: LoadedAdmission) -> None:
        self._workers = workers
        self._admission = admission

    def collect(self) -> Iterator[Metric]:
        """The gauges' values now."""
        load = self._workers.load
        workers = GaugeMetricFamily("ridelab_workers", "Warm worker processes", labels=["state"])
        for state in ("busy", "idle"):
            workers.add_metric([state], load[state])
        yield workers
        yield GaugeMetricFamily("ridelab_worker_queue", "Interactive tasks that wait for a worker", load["waiting"])
        held = self._admission.load
        yield GaugeMetricFamily(
            "ridelab_admitted_cost_seconds", "Estimated computing accepted and not finished, of one core", held["cost"]
        )
        yield GaugeMetricFamily("ridelab_expected_wait_seconds", "How long a new request would wait", held["wait"])
        yield GaugeMetricFamily("ridelab_open_requests", "Computing requests that are open", held["requests"])
        yield GaugeMetricFamily("ridelab_open_streams", "Event streams that are open", held["streams"])
        yield GaugeMetricFamily("ridelab_open_bodies", "Long request bodies being worked on", held["bodies"])


def service_registry(workers: LoadedWorkers, admission: LoadedAdmission) -> CollectorRegistry:
    """What `/metrics` of one application shows: the process's counters and the application's gauges."""
    registry = CollectorRegistry()
    registry.register(REGISTRY)
    registry.register(ServiceCollector(workers, admission))
    return registry
