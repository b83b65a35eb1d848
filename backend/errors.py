"""The errors of the service. `backend.http` turns them into answers; nothing here knows HTTP."""

from collections.abc import Mapping, Sequence

# What a refused run's sender can do; the solver first, since it changes most.
CHEAPER_RUN = "the solver daqp, a shorter road, a higher speed, a longer sample time or shorter horizons cost less"
TIME_LIMIT = f"The computation took longer than the limit and was ended; fewer roads, {CHEAPER_RUN}."


class ServiceError(Exception):
    """Base of what a service raises on purpose.

    Args:
        message: What is wrong and what would be right, for a person to read.
        kind: One of `backend.http.problem_types`, where the class has several.
        pointer: The part of the request's body that is to blame (RFC 6901).
        parameter: The parameter that is to blame.
        errors: `{"pointer" or "parameter", "message"}` of each, where several are.
        retry_after: When it may be over [s].
    """

    kind = "internal-error"
    retry_after: int | None = None

    def __init__(
        self,
        message: str,
        *,
        kind: str | None = None,
        pointer: str | None = None,
        parameter: str | None = None,
        errors: Sequence[Mapping[str, str]] = (),
        retry_after: int | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.kind = kind or self.kind
        self.retry_after = retry_after or self.retry_after
        self.errors = list(errors)
        if parameter is not None:
            self.errors.append({"parameter": parameter, "pointer": "", "message": message.removesuffix(".")})
        elif pointer is not None:
            self.errors.append({"pointer": pointer, "message": message.removesuffix(".")})


class NotFoundError(ServiceError):
    """There is nothing of this id."""

    kind = "not-found"


class ForbiddenError(ServiceError):
    """It belongs to another token."""

    kind = "other-token"


class GoneError(ServiceError):
    """Another version computed the run, and its time histories are gone."""

    kind = "other-core-version"


class RoadGoneError(GoneError):
    """The measured road of a stored run is not stored any more."""

    kind = "road-gone"

    def __init__(self) -> None:
        super().__init__(
            "The measured road of this run is not stored any more: what is not stored of the run cannot be made "
            "again before somebody sends the road's file."
        )


class RevokedError(GoneError):
    """A link that was taken back."""

    kind = "revoked"

    def __init__(self) -> None:
        super().__init__("This link was taken back by whoever made it: it opens nothing any more.")


class DamagedError(GoneError):
    """A stored row is not what was written, and nothing can make it again.

    Args:
        what: The kind of thing.
    """

    kind = "damaged"

    def __init__(self, what: str) -> None:
        super().__init__(f"What is stored of this {what} is damaged, and cannot be made again.")


class ConflictError(ServiceError):
    """The request does not fit the state of what is there; the kind says why."""


class InvalidError(ServiceError):
    """Values that cannot be used."""

    kind = "invalid-request"


class UnsureError(InvalidError):
    """A file that has to be asked about before it can be read.

    Args:
        message: The questions.
        table: What was understood of it, with the questions.
    """

    kind = "table-unsure"

    def __init__(self, message: str, table: Mapping[str, object]) -> None:
        super().__init__(message, pointer="")
        self.table = table


class CostLimitError(ServiceError):
    """The estimated cost or the number of runs is over a limit."""

    kind = "cost-limit"


class ShortRoadError(InvalidError):
    """The measured road is shorter than the scenario's."""


class NoSolutionError(ServiceError):
    """No value in the range keeps the limit."""

    kind = "no-solution"


class WorkerTimeoutError(ServiceError):
    """The task took longer than the limit and was ended: not temporary, the same again would take as long again."""

    kind = "too-expensive"

    def __init__(self) -> None:
        super().__init__(TIME_LIMIT, pointer="/scenario")


class TemporaryError(ServiceError):
    """The request is right, and may be answered later."""


class BusyError(TemporaryError):
    """The service has too much to do at the moment."""

    kind = "full"
    retry_after = 2


class TooManyRequestsError(TemporaryError):
    """One client has too much open, or asks too often."""

    kind = "too-many-requests"
    retry_after = 2


class NewerSchemaError(TemporaryError):
    """A newer version of the service stored this."""

    kind = "newer-schema"
    retry_after = 60


class WorkerLostError(TemporaryError):
    """The worker died during the task, and so did the one that tried again."""

    kind = "worker-lost"
    retry_after = 5

    def __init__(self) -> None:
        super().__init__("The computation ended unexpectedly, twice. Other requests are answered as before.")


class WorkersBusyError(TemporaryError):
    """No worker came free in time."""

    kind = "full"
    retry_after = 10

    def __init__(self) -> None:
        super().__init__("No worker came free in time.")
