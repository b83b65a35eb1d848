"""Liveness and readiness, for those who operate the service."""

from fastapi import APIRouter, Request, Response
from prometheus_client.exposition import choose_encoder

from backend import models
from backend.api.deps import RunsService
from backend.http.answers import json_answer

health = APIRouter(tags=["health"])


@health.get("/healthz", operation_id="getHealth", response_model=models.Health)
async def healthz() -> Response:
    """The process answers."""
    return json_answer({"status": "ok"})


@health.get(
    "/readyz",
    operation_id="getReadiness",
    response_model=models.Readiness,
    responses={503: {"model": models.Readiness, "description": "Not yet, or not now"}},
)
async def readyz(request: Request, service: RunsService) -> Response:
    """The store answers and a warm worker is there."""
    parts = {"store": await service.store_usable(), "workers": request.app.state.workers.ready}
    ready = all(parts.values())
    return json_answer({"status": "ready" if ready else "starting", **parts}, status=200 if ready else 503)


@health.get(
    "/metrics",
    operation_id="getMetrics",
    response_class=Response,
    responses={200: {"content": {"text/plain": {"schema": {"type": "string"}}, "application/openmetrics-text": {}}}},
)
async def metrics(request: Request) -> Response:
    """Figures for Prometheus: counts, gauges and latencies, nothing of anybody's scenario."""
    encode, media_type = choose_encoder(request.headers.get("accept", ""))
    return Response(encode(request.app.state.metrics), headers={"Content-Type": media_type})
