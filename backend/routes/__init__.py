"""HTTP: each route reads the request, calls one service and answers."""

from collections.abc import Callable, Coroutine
from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.routing import APIRoute

from backend import strict_json
from backend.models import Problem
from backend.problems import ProblemError

API = "/api/v1"


class StrictRequest(Request):
    """A request whose body is bounded and whose JSON is read strictly."""

    async def body(self) -> bytes:
        """The whole body, or 413 as soon as it is known to be too long, announced or in pieces."""
        if not hasattr(self, "_body"):
            limit: int = self.app.state.settings.max_body_bytes
            announced = self.headers.get("content-length", "")
            if announced.isdecimal() and (len(announced) > 12 or int(announced) > limit):
                raise ProblemError(413, f"The body may have {limit} bytes.", kind="too-long")
            pieces = bytearray()
            async for piece in self.stream():
                pieces += piece
                if len(pieces) > limit:
                    raise ProblemError(413, f"The body may have {limit} bytes.", kind="too-long")
            self._body = bytes(pieces)
        return self._body

    async def json(self) -> Any:
        """The body's value; anything doubtful is a problem."""
        try:
            return strict_json.parse(await self.body())
        except strict_json.StrictJSONError as error:
            message = error.message
            raise ProblemError(
                error.status, message, kind="strict-json", errors=[{"pointer": "", "message": message}]
            ) from None


class StrictRoute(APIRoute):
    """A route that reads its body with `StrictRequest`, and only as JSON."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """The framework's handler, given a stricter request."""
        handler = super().get_route_handler()
        takes_body = self.body_field is not None

        async def strict(request: Request) -> Response:
            kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
            if takes_body and kind != "application/json":
                raise ProblemError(415, "The body has to be JSON, with the header Content-Type: application/json.")
            return await handler(StrictRequest(request.scope, request.receive))

        return strict


def router(tag: str, *statuses: int) -> APIRouter:
    """A router of the API whose routes may answer with these problems."""
    responses: dict[int | str, dict[str, Any]] = {status: {"model": Problem} for status in (*statuses, 500)}
    return APIRouter(prefix=API, tags=[tag], route_class=StrictRoute, responses=responses)
