"""Who may list links, roads and recordings and take them back: the token that made them, or one who is alone."""

import ipaddress
from typing import Annotated

from fastapi import Depends, Request

from backend.errors import ForbiddenError
from backend.http.context import request_context
from backend.http.tokens import caller


async def _owner(request: Request) -> str | None:
    """Return the token whose things a request lists or takes back; None where there are no tokens, and all are its.

    Raises:
        ForbiddenError: There are no tokens, and the request may be anybody's.
    """
    parts = request_context(request)
    if parts.tokens is None and not parts.settings.one_user and not _is_from_this_machine(request):
        raise ForbiddenError(
            "This service has no tokens, so that it cannot tell what is yours: it lists and takes back nothing but for "
            "its own machine, asked by its own name and without a proxy. Its operator can set RIDELAB_TOKENS_FILE, or "
            "RIDELAB_ONE_USER=yes where one person uses it.",
            kind="not-alone",
        )
    return await caller(request)


Owner = Annotated[str | None, Depends(_owner)]


def _is_from_this_machine(request: Request) -> bool:
    """Check whether a program of this machine asks, by the machine's own name, and nobody's proxy before it."""
    forwarded = any(name == "forwarded" or name.startswith("x-forwarded-") for name in request.headers)
    peer = request.client.host if request.client else ""
    return not forwarded and _is_loopback(peer) and _is_loopback(request.url.hostname or "")


def _is_loopback(name: str) -> bool:
    try:
        address = ipaddress.ip_address(name)
    except ValueError:
        return name == "localhost"
    return (getattr(address, "ipv4_mapped", None) or address).is_loopback
