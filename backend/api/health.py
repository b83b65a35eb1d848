"""Liveness and readiness, for those who operate the service."""

from typing import Literal

from fastapi import APIRouter, Request, Response
from prometheus_client.exposition import choose_encoder
from pydantic import Field

from backend.api.routing import json_answer
from backend.custom_controllers import registry as custom_controllers
from backend.models import Answer
from backend.services import Services

health = APIRouter(tags=["health"])


class Health(Answer):
    """Liveness."""

    status: Literal["ok"]


class Readiness(Answer):
    """Readiness, part by part."""

    status: Literal["ready", "starting"]
    store: bool
    workers: bool
    reason: str | None = Field(description="What an operator has to do before it can work; null where nothing")
    controllers: dict[str, str] = Field(
        description="By file name why a controller file cannot be used; it keeps nothing else from working"
    )


@health.get("/healthz", operation_id="getHealth", response_model=Health)
async def healthz() -> Response:
    """The process answers."""
    return json_answer({"status": "ok"})


@health.get(
    "/readyz",
    operation_id="getReadiness",
    response_model=Readiness,
    responses={503: {"model": Readiness, "description": "Not yet, or not now"}},
)
async def readyz(request: Request) -> Response:
    """The store answers and a warm worker is there."""
    services: Services = request.app.state.services
    parts = {"store": await services.store.usable(), "workers": services.workers.ready}
    ready = all(parts.values())
    answer: dict[str, object] = {"status": "ready" if ready else "starting", **parts, "reason": services.store.damage}
    answer["controllers"] = custom_controllers.faults()
    return json_answer(answer, status=200 if ready else 503)


@health.get(
    "/metrics",
    operation_id="getMetrics",
    response_class=Response,
    responses={200: {"content": {"text/plain": {"schema": {"type": "string"}}, "application/openmetrics-text": {}}}},
)
async def metrics(request: Request) -> Response:
    """Figures for Prometheus: counts, gauges and latencies, nothing of anybody's scenario."""
    services: Services = request.app.state.services
    encode, media_type = choose_encoder(request.headers.get("accept", ""))
    return Response(encode(services.metrics), headers={"Content-Type": media_type})
