"""What requests of every room need of the service."""

from dataclasses import dataclass

from starlette.requests import HTTPConnection

from backend.custom_controllers.registry import Watch
from backend.gate import Gate
from backend.http.tokens import Logins, Tokens
from backend.settings import Settings


@dataclass(frozen=True, slots=True, kw_only=True)
class RequestContext:
    """Limits, and who may ask; `tokens` and `logins` are None where the service has none."""

    settings: Settings
    gate: Gate
    tokens: Tokens | None
    logins: Logins | None
    own_files: Watch


def request_context(request: HTTPConnection) -> RequestContext:
    """Those of the application that was asked."""
    parts: RequestContext = request.app.state.services
    return parts
