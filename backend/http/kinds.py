"""The one list of problem kinds the service answers with; docs/reference/api.md and OpenAPI show it.

A new kind is one more entry here and one more line in docs/reference/api.md; a test compares the two with what the code
raises.
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
        meaning: What happened; the default of `detail`.
        remedy: What whoever asked can do about it.
    """

    name: str
    statuses: tuple[int, ...]
    title: str
    meaning: str
    remedy: str


def _kind(
    name: str, statuses: int | tuple[int, ...], meaning: str, remedy: str, *, title: str | None = None
) -> ProblemKind:
    """One of them; its title is its name in words where it has no other."""
    several = statuses if isinstance(statuses, tuple) else (statuses,)
    title = title or name.replace("-", " ").capitalize()
    return ProblemKind(name=name, statuses=several, title=title, meaning=meaning, remedy=remedy)


# By status; the first of a status is the default for it.
_LIST = (
    _kind(
        "malformed-request",
        400,
        "The request could not be read.",
        "Send HTTP/1.1; a proxy or a program of your own between may have changed the request.",
    ),
    _kind(
        "two-lengths",
        400,
        "The request has both Content-Length and Transfer-Encoding.",
        "Send one of the two; HTTP libraries do.",
    ),
    _kind(
        "token-required",
        401,
        "The service answers those with a token: Authorization: Bearer, or the page's login.",
        "Send a token of the service: its operator gives them out.",
    ),
    _kind(
        "forbidden",
        403,
        "The proxy before the service does not pass this request on.",
        "Ask the service itself, from inside.",
    ),
    _kind(
        "cross-site",
        403,
        "Another site's page sent this request through a browser, and it would change or compute something.",
        "Send it from the service's own page, or from a program.",
        title="Request of another site",
    ),
    _kind(
        "other-token",
        403,
        "It belongs to another token, which alone may change it.",
        "Use the token that submitted it.",
        title="Another token's",
    ),
    _kind(
        "not-found",
        404,
        "There is nothing at this address, or nothing of this id.",
        "Check the address and the id; what retention or somebody removed is gone.",
    ),
    _kind(
        "method-not-allowed",
        405,
        "This address does not answer that method; Allow names those.",
        "Use one of the methods in Allow.",
    ),
    _kind(
        "slow-body",
        408,
        "The request body did not come in time.",
        "Send it again at once, over a faster connection.",
    ),
    _kind("slow-head", 408, "The request's head did not come in time.", "Send it again at once."),
    _kind(
        "idempotency-key-reused",
        409,
        "The Idempotency-Key came with another request before.",
        "Give every new request a key of its own.",
    ),
    _kind(
        "not-ended",
        409,
        "A tuning that still runs cannot get another number of trials: cancel it first.",
        "Cancel it, then resume it with the new number.",
    ),
    _kind(
        "done",
        409,
        "Nothing is left to do; a tuning goes on with a greater number of trials.",
        "Resume it with a greater number of trials.",
    ),
    _kind(
        "not-deletable",
        409,
        "It has not ended, or a link shows it.",
        "Cancel it or wait for its end; what a link shows stays.",
    ),
    _kind(
        "other-core-version",
        410,
        "Another version computed the run, and its time histories are gone; its metrics stay.",
        "Post the scenario again: this version computes it anew.",
    ),
    _kind(
        "road-gone",
        410,
        "The measured road of the run is not stored any more; send its file again.",
        "Send the road's file again, then ask again.",
    ),
    _kind(
        "damaged",
        410,
        "What is stored of it is not what was written, and cannot be made again.",
        "Post the scenario again; the operator finds all that is damaged with ridelab verify.",
    ),
    _kind(
        "too-long",
        413,
        "The request body is longer than allowed.",
        "Send less, such as a sweep as ranges in place of a list.",
    ),
    _kind(
        "address-too-long",
        414,
        "The address with its parameters is longer than allowed.",
        "Name fewer strategies or signals, or ask several times.",
    ),
    _kind(
        "unsupported-media-type",
        415,
        "The body has to be JSON as it is, with the header Content-Type: application/json; a file has its own.",
        "Set the header, and send the body uncompressed.",
    ),
    _kind(
        "other-host",
        421,
        "The service does not answer to the name in the Host header; RIDELAB_ALLOWED_HOSTS lists the names it does.",
        "Use one of those names, or have the operator add this one.",
    ),
    _kind(
        "invalid-request",
        422,
        "The request has values that cannot be used; errors names each.",
        "Change what errors names.",
    ),
    _kind(
        "refused",
        422,
        "The values fit one by one, but the simulation cannot work with them together.",
        "Change the values that detail names.",
    ),
    _kind(
        "unknown",
        422,
        "The body names a run, a batch or a road that is not there, or a field it does not sweep.",
        "Check the id or the name; a road's file has to be sent first.",
    ),
    _kind(
        "cost-limit",
        422,
        "The estimated cost or the number of runs is over the limit.",
        "Ask for fewer runs, or for shorter or simpler ones.",
    ),
    _kind(
        "too-expensive",
        422,
        "A run takes more computing than one may; errors names what to change.",
        "Change the fields that errors names.",
    ),
    _kind(
        "no-solution",
        422,
        "No value in the range keeps the limit.",
        "Widen the range, or raise the limit.",
    ),
    _kind(
        "strict-json",
        (422, 400, 413),
        "The body is not JSON (400), holds too many values (413), or something that two readers may understand "
        "differently (422): a key twice, NaN, an integer no double holds.",
        "Send plain JSON with each key once.",
        title="Strict JSON",
    ),
    _kind(
        "too-many-requests",
        429,
        "One client has too much open or asks too often.",
        "Wait for Retry-After, and have fewer requests open.",
    ),
    _kind(
        "headers-too-long",
        431,
        "The request's headers are longer than allowed.",
        "Send fewer or shorter headers; delete the site's cookies.",
    ),
    _kind(
        "internal-error",
        500,
        "Something went wrong in the service. It is in its log.",
        "Report it with the request_id; the same again may fail again.",
    ),
    _kind(
        "unavailable",
        (503, 502, 504),
        "The service, or the proxy before it, cannot answer now.",
        "Wait for Retry-After, then ask again.",
    ),
    _kind("full", 503, "The service has too much to do at the moment.", "Wait for Retry-After, then ask again."),
    _kind(
        "connections",
        (503, 429),
        "Too many connections are open: of this client (429), or of all (503).",
        "Close connections that you do not need; wait for Retry-After.",
        title="Too many connections",
    ),
    _kind(
        "store-unavailable",
        503,
        "The database does not answer.",
        "Wait for Retry-After, then ask again; operators find the reason in the log and at /readyz.",
        title="Database unavailable",
    ),
    _kind(
        "worker-lost",
        503,
        "The computation ended unexpectedly, twice.",
        "Ask again once; if it ends again, ask for something shorter.",
        title="Computation lost",
    ),
    _kind(
        "newer-schema",
        503,
        "A newer version of the service stored this; it is being updated.",
        "Wait for Retry-After, until the update has ended.",
    ),
    _kind(
        "ecu-unavailable",
        503,
        "The ECU's program cannot be built here; detail names the remedy, and waiting is none.",
        "Do what detail says; waiting does not help.",
        title="ECU unavailable",
    ),
    _kind(
        "not-built",
        503,
        "The dashboard's files are not there. The API answers.",
        "Run make setup, or use the API.",
        title="Dashboard not built",
    ),
)

KINDS = {kind.name: kind for kind in _LIST}
OF_STATUS = {status: kind for kind in reversed(_LIST) for status in kind.statuses}
