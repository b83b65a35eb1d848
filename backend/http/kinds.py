"""The one list of problem kinds the service answers with; docs/api.md and OpenAPI show it.

A new kind is one more entry here and one more line in docs/api.md; a test compares the two with what the code raises.
"""

from dataclasses import dataclass

TYPES = "urn:problem-type:ridelab:"


@dataclass(frozen=True, slots=True, kw_only=True)
class ProblemKind:
    """One kind of problem (RFC 9457).

    Attributes:
        name: End of its `type`, for machines.
        statuses: HTTP statuses it comes with, nearly always one.
        title: Of every such problem the same.
        meaning: What happened, and what to do about it; the default of `detail`.
    """

    name: str
    statuses: tuple[int, ...]
    title: str
    meaning: str


def _kind(name: str, statuses: int | tuple[int, ...], title: str, meaning: str) -> ProblemKind:
    return ProblemKind(
        name=name, statuses=statuses if isinstance(statuses, tuple) else (statuses,), title=title, meaning=meaning
    )


# By status; the first of a status is the default for it.
_LIST = (
    _kind("malformed-request", 400, "Malformed request", "The request could not be read."),
    _kind("two-lengths", 400, "Two lengths", "The request has both Content-Length and Transfer-Encoding."),
    _kind(
        "token-required",
        401,
        "Token required",
        "The service answers those with a token: Authorization: Bearer, or the page's login.",
    ),
    _kind("forbidden", 403, "Forbidden", "The proxy before the service does not pass this request on."),
    _kind(
        "cross-site",
        403,
        "Request of another site",
        "Another site's page sent this request through a browser, and it would change or compute something.",
    ),
    _kind("other-token", 403, "Another token's", "It belongs to another token, which alone may change it."),
    _kind("not-found", 404, "Not found", "There is nothing at this address, or nothing of this id."),
    _kind(
        "method-not-allowed", 405, "Method not allowed", "This address does not answer that method; Allow names those."
    ),
    _kind("slow-body", 408, "Slow body", "The request body did not come in time."),
    _kind("slow-head", 408, "Slow head", "The request's head did not come in time."),
    _kind(
        "idempotency-key-reused", 409, "Idempotency key reused", "The Idempotency-Key came with another request before."
    ),
    _kind(
        "not-ended", 409, "Not ended", "A tuning that still runs cannot get another number of trials: cancel it first."
    ),
    _kind("done", 409, "Done", "Nothing is left to do; a tuning goes on with a greater number of trials."),
    _kind("not-deletable", 409, "Not deletable", "It has not ended, or a link shows it."),
    _kind(
        "other-core-version",
        410,
        "Other core version",
        "Another version computed the run, and its time histories are gone; its metrics stay.",
    ),
    _kind("road-gone", 410, "Road gone", "The measured road of the run is not stored any more; send its file again."),
    _kind("too-long", 413, "Too long", "The request body is longer than allowed."),
    _kind("address-too-long", 414, "Address too long", "The address with its parameters is longer than allowed."),
    _kind(
        "unsupported-media-type",
        415,
        "Unsupported media type",
        "The body has to be JSON as it is, with the header Content-Type: application/json; a road's is text/csv.",
    ),
    _kind(
        "other-host",
        421,
        "Other host",
        "The service does not answer to the name in the Host header; RIDELAB_ALLOWED_HOSTS lists the names it does.",
    ),
    _kind("invalid-request", 422, "Invalid request", "The request has values that cannot be used; errors names each."),
    _kind("refused", 422, "Refused", "The values fit one by one, but the simulation cannot work with them together."),
    _kind(
        "unknown",
        422,
        "Unknown",
        "The body names a run, a batch or a road that is not there, or a field it does not sweep.",
    ),
    _kind("cost-limit", 422, "Cost limit", "The estimated cost or the number of runs is over the limit."),
    _kind(
        "too-expensive", 422, "Too expensive", "A run takes more computing than one may; errors names what to change."
    ),
    _kind("no-solution", 422, "No solution", "No value in the range keeps the limit."),
    _kind(
        "strict-json",
        (422, 400, 413),
        "Strict JSON",
        "The body is not JSON (400), holds too many values (413), or something that two readers may understand "
        "differently (422): a key twice, NaN, an integer no double holds.",
    ),
    _kind("too-many-requests", 429, "Too many requests", "One client has too much open or asks too often."),
    _kind("headers-too-long", 431, "Headers too long", "The request's headers are longer than allowed."),
    _kind("internal-error", 500, "Internal error", "Something went wrong in the service. It is in its log."),
    _kind("unavailable", (503, 502, 504), "Unavailable", "The service, or the proxy before it, cannot answer now."),
    _kind("full", 503, "Full", "The service has too much to do at the moment."),
    _kind("connections", 503, "Too many connections", "Too many connections are open, of this client or of all."),
    _kind("store-unavailable", 503, "Database unavailable", "The database does not answer."),
    _kind("worker-lost", 503, "Computation lost", "The computation ended unexpectedly, twice."),
    _kind("newer-schema", 503, "Newer schema", "A newer version of the service stored this; it is being updated."),
    _kind(
        "ecu-unavailable",
        503,
        "ECU unavailable",
        "The ECU's program cannot be built here; detail names the remedy, and waiting is none.",
    ),
    _kind("not-built", 503, "Dashboard not built", "The dashboard's files are not there. The API answers."),
)

KINDS = {kind.name: kind for kind in _LIST}
OF_STATUS = {status: kind for kind in reversed(_LIST) for status in kind.statuses}
