"""HTTP: each route reads the request, calls one service and answers."""

from typing import Any

from fastapi import APIRouter

from backend.http import problems
from backend.http.routing import StrictRoute

API = "/api/v1"


def router(tag: str, *statuses: int, route_class: type[StrictRoute] = StrictRoute) -> APIRouter:
    """A router of the API whose routes may answer with these problems; one that reads a body also with 408."""
    responses: dict[int | str, dict[str, Any]] = dict.fromkeys(
        (*statuses, 401, 414, 422, 429, 500, 503), problems.ANSWER
    )
    if 413 in statuses:
        responses[408] = problems.ANSWER
    return APIRouter(prefix=API, tags=[tag], route_class=route_class, responses=responses)
