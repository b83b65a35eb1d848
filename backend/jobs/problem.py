"""A problem that planning met, kept with its job in the form in which a request would have been answered."""

from backend.errors import ServiceError
from backend.http.problem_types import KINDS, TYPES
from backend.json_types import JsonObject
from backend.models import Answer
from backend.unknown_names import pointer
from sim_core.errors import RidelabError


class InvalidPlace(Answer):
    """A part of the request that cannot be used, by its JSON pointer."""

    pointer: str
    message: str


class JobProblem(Answer):
    """RFC 9457, without a request's id; a dry run of the same request is answered with it."""

    type: str
    title: str
    status: int
    detail: str
    errors: list[InvalidPlace]


def problem_of(error: ServiceError | RidelabError) -> JsonObject:
    """Return the problem that a request which met this error would be answered with."""
    if isinstance(error, RidelabError):
        field = "" if error.field is None else pointer(["scenario", *error.field.split(".")])
        error = ServiceError(error.message, kind="refused", errors=[{"pointer": field, "message": error.message}])
    kind = KINDS[error.kind]
    problem = JobProblem(
        type=f"{TYPES}{error.kind}",
        title=kind.title,
        status=kind.statuses[0],
        detail=error.message,
        errors=[InvalidPlace(pointer=place["pointer"], message=place["message"]) for place in error.errors],
    )
    return problem.model_dump()
