"""What requests of every room need of the service."""

from dataclasses import dataclass

from starlette.requests import HTTPConnection

from backend.custom_controllers.watch import Watch
from backend.gate import Gate
from backend.http.tokens import Logins, Tokens
from backend.settings import Settings


@dataclass(frozen=True, slots=True, kw_only=True)
class HttpParts:
    """Limits, and who may ask; `tokens` and `logins` are None where the service has none."""

    settings: Settings
    gate: Gate
    tokens: Tokens | None
    logins: Logins | None
    own_files: Watch


def parts_of(request: HTTPConnection) -> HttpParts:
    """Those of the application that was asked."""
    parts: HttpParts = request.app.state.services
    return parts
