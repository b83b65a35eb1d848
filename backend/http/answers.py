"""How routes answer: JSON, 304, or nothing because the client has gone."""

import asyncio
from collections.abc import Coroutine
from typing import Any, TypeVar

import orjson
from fastapi import Request, Response
from pydantic import BaseModel
from starlette.requests import ClientDisconnect

T = TypeVar("T")

IMMUTABLE = "public, max-age=31536000, immutable"


def json_answer(content: Any, headers: dict[str, str] | None = None, *, status: int = 200) -> Response:
    """JSON as orjson writes it; the route's `response_model` declares its shape."""
    if isinstance(content, BaseModel):
        content = content.model_dump(by_alias=True)
    return Response(orjson.dumps(content), status, headers, media_type="application/json")


def takes_gzip(request: Request) -> bool:
    """Whether the client accepts a compressed answer, by the same rule as the service's other answers."""
    return "gzip" in request.headers.get("accept-encoding", "")


def answer_unless_cached(request: Request, tag: str, content: Any, cache_control: str) -> Response:
    """JSON with that entity tag, or 304 where the client has it (weak comparison, RFC 9110, 13.1.2)."""
    headers = {"ETag": tag, "Cache-Control": cache_control}
    offered = {item.strip().removeprefix("W/") for item in request.headers.get("if-none-match", "").split(",")}
    if "*" in offered or tag.removeprefix("W/") in offered:
        return Response(status_code=304, headers=headers)
    return json_answer(content, headers)


async def cancel_on_disconnect(request: Request, work: Coroutine[Any, Any, T]) -> T:
    """The result of `work`, which is cancelled when the client goes away first.

    Raises:
        ClientDisconnect: It went away.
    """
    task = asyncio.ensure_future(work)
    gone = asyncio.ensure_future(_disconnected(request))
    try:
        await asyncio.wait({task, gone}, return_when=asyncio.FIRST_COMPLETED)
        if not task.done():
            raise ClientDisconnect
        return task.result()
    finally:
        task.cancel()
        gone.cancel()


async def _disconnected(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass
