"""What one service's parts hold right now, read when Prometheus asks."""

from collections.abc import Iterator
from typing import Protocol

from prometheus_client import CollectorRegistry
from prometheus_client.core import GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from backend.telemetry.metrics import REGISTRY


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
