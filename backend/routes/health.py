"""Liveness and readiness, for those who operate the service."""

from fastapi import APIRouter, Request, Response

from backend import models
from backend.routes.deps import RunsService, json_answer

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
    answer = json_answer({"status": "ready" if ready else "starting", **parts})
    answer.status_code = 200 if ready else 503
    return answer
