"""What the service tells those who operate it: metrics for Prometheus, structured logs, a name for each request."""

from backend.telemetry.gauges import service_registry
from backend.telemetry.logs import configure
from backend.telemetry.metrics import (
    BATCH_QUEUE,
    BATCHES,
    CACHE,
    LATENCY,
    REFUSED,
    REGISTRY,
    RUNS,
    SOLVER_FALLBACKS,
    STORE_ERRORS,
    WORKER_FAILURES,
    count_run,
)
from backend.telemetry.requests import TelemetryMiddleware, request_id

__all__ = [
    "BATCHES",
    "BATCH_QUEUE",
    "CACHE",
    "LATENCY",
    "REFUSED",
    "REGISTRY",
    "RUNS",
    "SOLVER_FALLBACKS",
    "STORE_ERRORS",
    "WORKER_FAILURES",
    "TelemetryMiddleware",
    "configure",
    "count_run",
    "request_id",
    "service_registry",
]
