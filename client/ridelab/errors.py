"""Errors between a client and a service."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

_SWEEPS = ("grid", "latin_hypercube", "list")
_TYPES = "urn:problem-type:ridelab"


class RidelabClientError(Exception):
    """Base of everything the client raises on purpose."""


class RidelabConnectionError(RidelabClientError):
    """No service answers there, or what answers is not Ridelab."""


class JobEndedError(RidelabClientError):
    """A job that was waited for was cancelled or failed; the message says which, and why."""


class JobTimeoutError(RidelabClientError, TimeoutError):
    """A job did not end in the time it was waited for; it goes on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorPlace:
    """One value that cannot be used: a JSON pointer into the request body, or a query parameter's name."""

    message: str
    pointer: str = ""
    parameter: str | None = None

    @property
    def field(self) -> str:
        """The field's dotted name: `road.bump.height`, and `road.bump.height[3]` in a sweep; may be empty."""
        if self.parameter:
            return self.parameter
        steps = [step.replace("~1", "/").replace("~0", "~") for step in self.pointer.split("/")[1:]]
        if steps[:1] == ["scenario"] and len(steps) > 1:  # nobody typed these parts of a request
            steps = steps[1:]
        elif steps[:1] == ["sweep"] and len(steps) > 2 and steps[1] in _SWEEPS:
            steps = [step for step in steps[2:] if step != "ranges"]
        return "".join(f"[{step}]" if step.isdecimal() else f".{step}" for step in steps).removeprefix(".")


@dataclass(eq=False)
class RidelabAPIError(RidelabClientError):
    """The service refused, and says why (RFC 9457).

    Attributes:
        status: HTTP status.
        detail: What is wrong, for a person to read.
        errors: Each value that cannot be used.
        request_id: What the service's log calls the request.
        kind: Which kind of problem, such as `not-found` (docs/reference/api.md lists them); None where it is not
            the service's.
        table: Of `table-unsure`: what was understood of a file, with the questions to answer; else None.
    """

    status: int
    detail: str
    errors: Sequence[ErrorPlace] = ()
    request_id: str | None = None
    kind: str | None = None
    table: Mapping[str, Any] | None = None

    @classmethod
    def of(cls, status: int, problem: Mapping[str, Any]) -> Self:
        """The error that a problem document describes."""
        errors = [
            ErrorPlace(
                message=item.get("message", ""), pointer=item.get("pointer") or "", parameter=item.get("parameter")
            )
            for item in problem.get("errors") or []
        ]
        detail = str(problem.get("detail") or problem.get("title") or f"HTTP {status}")
        prefix, _, kind = str(problem.get("type", "")).rpartition(":")
        kind = kind if prefix == _TYPES else ""
        return cls(status, detail, errors, problem.get("request_id"), kind or None, problem.get("table"))

    @property
    def lines(self) -> list[str]:
        """Lines to show: `field: message` for each error, or the detail; with the request's id where the log helps."""
        if self.status >= 500 and self.request_id:
            return [f"{self.detail} (request {self.request_id})"]
        named = [f"{error.field}: {error.message}" if error.field else error.message for error in self.errors]
        return named or [self.detail]

    def __str__(self) -> str:
        return "; ".join(self.lines)
