"""Every error is answered as RFC 9457 `application/problem+json`; no answer repeats what was sent."""

import logging
from collections.abc import Mapping, Sequence
from itertools import product
from typing import Annotated, cast

import orjson
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from fastapi.routing import iter_route_contexts
from pydantic import BaseModel, ConfigDict, Field
from sqlalchemy.exc import SQLAlchemyError
from starlette.exceptions import HTTPException

from backend.errors import ServiceError
from backend.http.problem_types import KINDS, OF_STATUS, TYPES
from backend.http.validation import to_field_error
from backend.logs import REQUEST_ID
from backend.metrics import REFUSED, STORE_ERRORS
from backend.table_models import TableAnswer
from backend.unknown_names import pointer
from sim_core.errors import RidelabError, TooExpensiveError

logger = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"
MOST_ERRORS = 50
PROTECTING = frozenset({408, 413, 429, 503})  # counted by kind
CHALLENGE = {"WWW-Authenticate": 'Bearer realm="Ridelab"'}

# How a route declares one. Not by its model: FastAPI would build a validator for each route and status at every start.
ANSWER = {"content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}}


class ProblemPlace(BaseModel):
    """One value that cannot be used: a JSON pointer into the body, or a query parameter's name."""

    pointer: str
    message: str
    parameter: str | None = None


class Problem(BaseModel):
    """RFC 9457; docs/reference/api.md lists the kinds."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "type": f"{TYPES}invalid-request",
                    "title": KINDS["invalid-request"].title,
                    "status": 422,
                    "detail": KINDS["invalid-request"].meaning,
                    "errors": [
                        {
                            "pointer": "/sweep/grids",
                            "message": "Unknown field grids, perhaps grid; there are grid, latin_hypercube, list",
                        }
                    ],
                    "request_id": "9b2d1f0c6e7a4f7c8f4f4f0c2f1f9a10",
                }
            ]
        }
    )

    type: Annotated[str, Field(json_schema_extra={"enum": [f"{TYPES}{name}" for name in KINDS]})]
    title: str = Field(description="Of every problem of that type the same")
    status: int
    detail: str
    errors: list[ProblemPlace]
    request_id: str = Field(description="Also in the header X-Request-ID and in the service's log")
    table: TableAnswer | None = Field(None, description="Of `table-unsure`: what was understood of the file")


class RequestError(ServiceError):
    """A request that cannot be used as it was sent.

    Args:
        kind: One of `backend.http.problem_types`.
        message: What is wrong and what would be right, for a person to read; None is the kind's meaning.
        status: HTTP status, of a kind with several.
        errors: `{"pointer" or "parameter", "message"}` of each part that is to blame.
    """

    def __init__(
        self,
        kind: str,
        message: str | None = None,
        *,
        status: int | None = None,
        errors: Sequence[Mapping[str, str]] = (),
    ) -> None:
        super().__init__(message or KINDS[kind].meaning, kind=kind, errors=errors)
        self.status = status


def problem(
    kind: str,
    detail: str | None = None,
    *,
    status: int | None = None,
    errors: Sequence[Mapping[str, str]] = (),
    headers: Mapping[str, str] | None = None,
    table: Mapping[str, object] | None = None,
) -> Response:
    """The response with this problem.

    Args:
        kind: One of `backend.http.problem_types`.
        detail: What is wrong; None is the kind's meaning.
        status: None is the kind's first one.
        errors: `{"pointer" or "parameter", "message"}` of each part that is to blame.
        headers: Of the answer.
        table: Of a file that has to be asked about.
    """
    entry = KINDS[kind]
    status = status or entry.statuses[0]
    if status in PROTECTING:
        REFUSED.labels(kind).inc()
    headers = {**CHALLENGE, **(headers or {})} if status == 401 else dict(headers or {})
    content = Problem(
        type=f"{TYPES}{kind}",
        title=entry.title,
        status=status,
        detail=detail or entry.meaning,
        errors=[ProblemPlace.model_validate(place) for place in errors],
        request_id=REQUEST_ID.get(),
        table=TableAnswer.model_validate(table) if table else None,
    )
    body = content.model_dump(exclude_none=True, exclude={"table"})
    if content.table:  # with its own nulls
        body["table"] = content.table.model_dump(by_alias=True)
    return Response(orjson.dumps(body), status, headers, MEDIA_TYPE)


def register(app: FastAPI) -> None:
    """Answer every exception with a problem. `RequestMiddleware` answers other exceptions with 500."""
    app.add_exception_handler(HTTPException, _http)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(ServiceError, _service)
    app.add_exception_handler(RidelabError, _refused)
    app.add_exception_handler(TooExpensiveError, _too_expensive)
    app.add_exception_handler(SQLAlchemyError, _store)


async def _service(request: Request, error: Exception) -> Response:
    error = cast(ServiceError, error)
    headers = {} if error.retry_after is None else {"Retry-After": str(error.retry_after)}
    # Nothing points into a body that is not there.
    errors = [place for place in error.errors if not place["pointer"] or request.method not in ("GET", "HEAD")]
    status = getattr(error, "status", None)
    placed, table = _as_sent(request, errors), getattr(error, "table", None)
    return problem(error.kind, error.message, status=status, errors=placed, headers=headers, table=table)


async def _http(request: Request, error: Exception) -> Response:
    """The framework's own error: its text might hold the path or a value, so ours is sent."""
    error = cast(HTTPException, error)
    headers = dict(error.headers or {})
    if error.status_code == 405:
        headers = {"Allow": ", ".join(sorted(_methods(request)))}
    return problem(OF_STATUS[error.status_code].name, headers=headers)


def _methods(request: Request) -> set[str]:
    """Return the methods that the asked address answers: each may have a route of its own."""
    path = getattr(request.scope.get("route"), "path", None)
    same = (each for each in iter_route_contexts(request.app.routes) if each.path == path)
    return {method for each in same for method in each.methods or ()}


async def _invalid(request: Request, error: Exception) -> Response:
    error = cast(RequestValidationError, error)
    body = getattr(request.scope.get("route"), "body_field", None)
    model = body.field_info.annotation if body is not None else None
    errors = [to_field_error(item, model) for item in error.errors()[:MOST_ERRORS]]
    return problem("invalid-request", errors=_as_sent(request, errors))


async def _refused(request: Request, error: Exception) -> Response:
    error = cast(RidelabError, error)
    path = pointer(["scenario", *error.field.split(".")]) if error.field else ""
    errors = _as_sent(request, [{"pointer": path, "message": error.message}])
    return problem("refused", error.message, errors=errors)


async def _store(_: Request, error: Exception) -> Response:
    STORE_ERRORS.inc()
    # Its own text holds the statement's values; the driver's does not.
    logger.error("The database did not answer: %s", getattr(error, "orig", None) or type(error).__name__)
    return problem("store-unavailable", headers={"Retry-After": "5"})


async def _too_expensive(request: Request, error: Exception) -> Response:
    error = cast(TooExpensiveError, error)
    errors = [{"pointer": pointer(["scenario", *field.split(".")]), "message": error.message} for field in error.fields]
    return problem("too-expensive", f"{error.message}.", errors=_as_sent(request, errors))


def _as_sent(request: Request, errors: Sequence[Mapping[str, str]]) -> list[dict[str, str]]:
    """Return the errors with pointers into the body as it was sent: a scenario's fields may be dotted there."""
    sent = getattr(request.state, "sent", None)
    scenario = sent.get("scenario") if isinstance(sent, dict) else None
    dotted = [name for name in scenario if "." in name] if isinstance(scenario, dict) else []
    placed = [dict(error) for error in errors]
    for error, name in product(placed, dotted):
        nested = pointer(["scenario", *name.split(".")])
        if error["pointer"] == nested or error["pointer"].startswith(f"{nested}/"):
            error["pointer"] = pointer(["scenario", name]) + error["pointer"].removeprefix(nested)
    return placed
