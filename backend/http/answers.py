"""Answers that a client keeps and asks about, and long ones, sent piece by piece."""

import base64
import hashlib
from collections.abc import AsyncIterator, Mapping
from contextlib import ExitStack
from typing import Any

import orjson
from fastapi import Request, Response
from fastapi.responses import StreamingResponse
from pydantic import BaseModel
from starlette.types import Receive, Scope, Send

from backend.http.spool import SpoolFile

# Of files that are named by their content. Answers about what is stored are not: their shape is the release's.
IMMUTABLE = "public, max-age=31536000, immutable"
REVALIDATED = "public, no-cache"
JSON = "application/json"


class Download(StreamingResponse):
    """An answer that is sent piece by piece, and counts as open until all of it was sent or its client has gone.

    Args:
        content: The pieces.
        counted: Closed then.
        headers: Of the answer.
        media_type: Of the content.
    """

    def __init__(
        self, content: AsyncIterator[bytes], counted: ExitStack, *, headers: Mapping[str, str], media_type: str
    ) -> None:
        super().__init__(content, headers=headers, media_type=media_type)
        self._counted = counted

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """ASGI entry."""
        with self._counted:
            await super().__call__(scope, receive, send)


def content_answer(content: bytes | SpoolFile, headers: Mapping[str, str], media_type: str) -> Response:
    """Return a rendered answer, a long one piece by piece."""
    if isinstance(content, bytes):
        return Response(content, headers=headers, media_type=media_type)
    headers = {**headers, "Content-Length": str(content.size)}
    held = ExitStack()
    held.callback(content.close)
    return Download(content.pieces(), held, headers=headers, media_type=media_type)


def takes_gzip(request: Request) -> bool:
    """Check whether the client accepts a compressed answer, by the same rule as the service's other answers."""
    return "gzip" in request.headers.get("accept-encoding", "")


def not_modified(request: Request, tag: str) -> bool:
    """Check whether the client has what that entity tag names (weak comparison, RFC 9110, 13.1.2)."""
    offered = {item.strip().removeprefix("W/") for item in request.headers.get("if-none-match", "").split(",")}
    return "*" in offered or tag.removeprefix("W/") in offered


def revalidated(
    request: Request,
    content: Any,
    headers: Mapping[str, str] | None = None,
    media_type: str = JSON,
) -> Response:
    """Return an answer that its client may keep, and asks about before it is used: 304 where it has this content.

    Its entity tag is a digest of the content, as another release may answer otherwise. An answer so long that it comes
    from a file has none.

    Args:
        request: It may say what the client has.
        content: Bytes as they are sent, a file, or what JSON is made of.
        headers: Further ones.
        media_type: Of bytes and files.
    """
    all_headers = {**(headers or {}), "Cache-Control": REVALIDATED}
    if isinstance(content, SpoolFile):
        return content_answer(content, all_headers, media_type)
    if isinstance(content, BaseModel):
        content = content.model_dump(by_alias=True)
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    digest = hashlib.sha256(body).digest()[:16]
    tag = f'W/"{base64.urlsafe_b64encode(digest).decode().rstrip("=")}"'  # weak: the body may be compressed
    all_headers["ETag"] = tag
    if not_modified(request, tag):
        return Response(status_code=304, headers={name: all_headers[name] for name in ("ETag", "Cache-Control")})
    return Response(body, headers=all_headers, media_type=media_type)
