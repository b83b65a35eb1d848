"""Parameters that are lists of names, or read a list page by page; and who may list what was shared or sent."""

import ipaddress
from collections.abc import Collection
from typing import Annotated

from fastapi import Depends, Query

from backend.api.routing import ApiRequest
from backend.errors import ForbiddenError, InvalidError
from backend.store.pages import CURSOR

Limit = Annotated[int, Query(ge=1, le=500, description="At most so many")]
Cursor = Annotated[str | None, Query(pattern=CURSOR, description="`next` of the page before")]
DEFAULT_LIMIT = 50


async def _owner(request: ApiRequest) -> str | None:
    """Return the token whose things a request lists or takes back; None where there are no tokens, and all are its.

    Raises:
        ForbiddenError: There are no tokens, and the request may be anybody's.
    """
    services = request.services
    if services.tokens is None and not services.settings.one_user and not _is_from_this_machine(request):
        raise ForbiddenError(
            "This service has no tokens, so that it cannot tell what is yours: it lists and takes back nothing but for "
            "its own machine, asked by its own name and without a proxy. Its operator can set RIDELAB_TOKENS_FILE, or "
            "RIDELAB_ONE_USER=yes where one person uses it.",
            kind="not-alone",
        )
    return request.token


Owner = Annotated[str | None, Depends(_owner)]


def _is_from_this_machine(request: ApiRequest) -> bool:
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


def names_in(parameter: str, text: str | None, offered: Collection[str] | None = None) -> list[str] | None:
    """Return the names with commas between in a parameter, each once; None where there are none.

    Raises:
        InvalidError: One of them is not among those `offered`.
    """
    names = dict.fromkeys(name.strip() for name in (text or "").split(",") if name.strip())
    if offered is not None and not names.keys() <= set(offered):
        raise InvalidError(f"Unknown name; there are {', '.join(offered)}", parameter=parameter)
    return list(names) or None
