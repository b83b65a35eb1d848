"""Every error leaves as RFC 9457 `application/problem+json`; none repeats what was sent."""

import logging
from collections.abc import Mapping, Sequence
from typing import Any, cast

import orjson
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from sqlalchemy.exc import SQLAlchemyError
from starlette.exceptions import HTTPException

from backend.compute import WorkerLostError, WorkersBusyError, WorkerTimeoutError
from backend.hil.drive import EcuUnavailableError
from backend.problem_kinds import CHEAPER_RUN, KINDS, OF_STATUS, TYPES
from backend.telemetry import REFUSED, STORE_ERRORS, request_id
from backend.unknown_names import locate_in_body, shown_path, unknown_name
from sim_core.errors import RidelabError, TooExpensiveError

logger = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"
MOST_ERRORS = 50
PROTECTING = frozenset({408, 413, 429, 503})  # counted by kind


class ProblemError(HTTPException):
    """An error with its own text; raised anywhere below a route.

    Args:
        status: HTTP status.
        detail: What is wrong and what would be right, for a person to read.
        kind: One of `backend.problem_kinds`; None is what that status usually means.
        errors: `{"pointer" or "parameter", "message"}` for each place concerned.
        retry_after: Seconds for the `Retry-After` header.
    """

    def __init__(
        self,
        status: int,
        detail: str,
        *,
        kind: str | None = None,
        errors: Sequence[Mapping[str, str]] = (),
        retry_after: int | None = None,
    ) -> None:
        headers = {"Retry-After": str(retry_after)} if retry_after is not None else None
        super().__init__(status, detail, headers)
        self.kind = kind
        self.errors = errors


def problem(
    status: int,
    detail: str | None = None,
    *,
    kind: str | None = None,
    errors: Sequence[Mapping[str, str]] = (),
    headers: Mapping[str, str] | None = None,
) -> Response:
    """The response that says so."""
    entry = KINDS[kind] if kind is not None else OF_STATUS[status]
    if status in PROTECTING:
        REFUSED.labels(entry.name).inc()
    content = {
        "type": f"{TYPES}{entry.name}",
        "title": entry.title,
        "status": status,
        "detail": detail or entry.meaning,
        "errors": list(errors),
        "request_id": request_id(),
    }
    return Response(orjson.dumps(content), status, dict(headers or {}), MEDIA_TYPE)


def pointer(path: Sequence[str | int]) -> str:
    """JSON pointer (RFC 6901) into the request body."""
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def register(app: FastAPI) -> None:
    """Make every exception leave as a problem. What none of these know, `GuardMiddleware` answers with 500."""
    app.add_exception_handler(HTTPException, _http)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(RidelabError, _refused)
    app.add_exception_handler(TooExpensiveError, _too_expensive)
    app.add_exception_handler(EcuUnavailableError, _ecu_unavailable)
    app.add_exception_handler(SQLAlchemyError, _store)
    app.add_exception_handler(WorkerLostError, _lost)
    app.add_exception_handler(WorkersBusyError, _busy)
    app.add_exception_handler(WorkerTimeoutError, _slow)


async def _http(request: Request, error: Exception) -> Response:
    error = cast(HTTPException, error)
    if isinstance(error, ProblemError):
        return problem(error.status_code, error.detail, kind=error.kind, errors=error.errors, headers=error.headers)
    # The framework's own: its text might hold the path or a value, so ours is sent.
    headers = dict(error.headers or {})
    if error.status_code == 405:
        # It names the methods of one route, and an address may have several.
        described = request.app.openapi()["paths"].get(getattr(request.scope.get("route"), "path", None), {})
        known = {name.strip() for name in headers.get("allow", headers.get("Allow", "")).split(",") if name}
        headers = {"Allow": ", ".join(sorted(known | {method.upper() for method in described}))}
    return problem(error.status_code, headers=headers)


async def _invalid(request: Request, error: Exception) -> Response:
    error = cast(RequestValidationError, error)
    body = getattr(request.scope.get("route"), "body_field", None)
    model = body.field_info.annotation if body is not None else None
    found = [_place(item, model) for item in error.errors()[:MOST_ERRORS]]
    return problem(422, errors=found)


async def _refused(_: Request, error: Exception) -> Response:
    error = cast(RidelabError, error)
    place = pointer(["scenario", *error.field.split(".")]) if error.field else ""
    return problem(422, error.message, kind="refused", errors=[{"pointer": place, "message": error.message}])


async def _ecu_unavailable(_: Request, error: Exception) -> Response:
    # Without Retry-After: somebody has to do what it says, and a client that waited would wait in vain.
    return problem(503, f"{cast(EcuUnavailableError, error).message}.", kind="ecu-unavailable")


async def _store(_: Request, error: Exception) -> Response:
    STORE_ERRORS.inc()
    # Its own text holds the statement's values; the driver's does not.
    logger.error("The database did not answer: %s", getattr(error, "orig", None) or type(error).__name__)
    return problem(503, "The database does not answer.", kind="store-unavailable", headers={"Retry-After": "5"})


async def _lost(_: Request, __: Exception) -> Response:
    text = "The computation ended unexpectedly, twice. Other requests are answered as before."
    return problem(503, text, kind="worker-lost", headers={"Retry-After": "5"})


async def _busy(_: Request, __: Exception) -> Response:
    return problem(503, "No worker came free in time.", kind="full", headers={"Retry-After": "10"})


async def _too_expensive(_: Request, error: Exception) -> Response:
    error = cast(TooExpensiveError, error)
    places = [{"pointer": pointer(["scenario", *field.split(".")]), "message": error.message} for field in error.fields]
    return problem(422, f"{error.message}.", kind="too-expensive", errors=places)


async def _slow(request: Request, _: Exception) -> Response:
    # Not 503: the same again would hold a worker as long again.
    text = f"The computation took longer than the limit and was ended; fewer roads, {CHEAPER_RUN}."
    places = [{"pointer": "/scenario", "message": text}] if request.method == "POST" else []
    return problem(422, text, kind="too-expensive", errors=places)


def _place(item: Mapping[str, Any], model: Any) -> dict[str, str]:
    """Where one validation error belongs and what it says, without the value sent."""
    where, *path = item["loc"] or ("body",)
    context = item.get("ctx") or {}
    message = str(item["msg"])
    if where != "body":
        return {"parameter": str(path[-1]) if path else "", "pointer": "", "message": message}
    if item["type"] == "extra_forbidden":
        path, names = locate_in_body(model, path[:-1])
        path.append(item["loc"][-1])
        message = unknown_name("field", item["loc"][-1], names)
    elif item["type"] == "unknown_key":
        path.append(context["key"])
        message = unknown_name(context["what"], context["key"], context["known"])
    elif item["type"] == "inconsistent":
        path += context["field"].split(".")
    elif item["type"] == "too_short" and context.get("min_length") == 1:
        message = "There has to be at least one"
    elif item["type"] == "model_attributes_type" or (not path and item["type"] != "missing"):
        message = "This has to be a JSON object"
    return {"pointer": pointer(shown_path(path)), "message": message}
