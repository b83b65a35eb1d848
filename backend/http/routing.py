"""Routes that read strictly: the body is bounded and plain JSON, the parameters are those declared."""

import asyncio
from collections import Counter
from collections.abc import Callable, Coroutine, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from typing import Any, ClassVar

from fastapi import Request, Response
from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Param, Query
from fastapi.routing import APIRoute
from starlette.datastructures import QueryParams

from backend.errors import InvalidError
from backend.gate.turns import Ticket
from backend.http import strict_json
from backend.http.answers import cancel_on_disconnect
from backend.http.client_key import client_key
from backend.http.context import request_context
from backend.http.problems import MOST_ERRORS, RequestError
from backend.http.tokens import CALLER
from backend.http.validation import with_nested_scenario
from backend.plain_text import MESSAGE, is_plain
from backend.settings import MAX_BODY_BYTES
from backend.unknown_names import is_name, unknown_name

BULKY = 64 * 1024  # a longer body counts and is parsed beside the event loop; a scenario is a few kB [bytes]
LONGEST_FILE = 4 * 1024 * 1024  # as CSV [bytes]
SCENARIO_VALUES = 10_000  # a scenario has about a hundred

# One thread: the next long body waits, so that they never crowd out the event loop, whose lock they share.
_parsing = ThreadPoolExecutor(1, thread_name_prefix="strict-json")


def client_of(request: Request) -> str:
    """Who counts as one client: the request's token, or else its address, from the server or a trusted proxy.

    Empty where there is neither.
    """
    token = getattr(request.state, CALLER, None)
    if token is not None:
        return f"token {token}"
    return client_key(request.client.host) if request.client else ""


async def _read_body(request: Request, held: ExitStack, longest: int) -> bytes:
    """Return the whole body of at most so many bytes; `held` keeps the memory of a bulky one until it is answered.

    Raises:
        RequestError: It is too long, announced or in pieces, or comes too slowly.
        TemporaryError: Bulky ones take all the memory there is for them.
    """
    memory, client = request_context(request).gate.memory, client_of(request)
    pieces, counted = bytearray(), 0

    def expect(length: int) -> None:
        nonlocal counted
        if length > longest:
            raise RequestError("too-long", f"The body may have {longest} bytes.")
        if length > max(counted, BULKY):
            more = max(length, min(longest, 2 * counted)) - counted
            held.enter_context(memory.hold(client, more))
            counted += more

    announced = request.headers.get("content-length", "")
    expect(int(announced[:12]) if announced.isdecimal() else 0)
    async for piece in request.stream():
        pieces += piece
        expect(len(pieces))
    return bytes(pieces)


async def _parse(body: bytes, max_values: int) -> Any:
    """The body's value.

    Raises:
        RequestError: Anything about it is doubtful.
    """
    parse = partial(strict_json.parse, body, max_values=max_values)
    try:
        if len(body) > BULKY:
            return await asyncio.get_running_loop().run_in_executor(_parsing, parse)
        return parse()
    except strict_json.StrictJSONError as error:
        errors = [{"pointer": "", "message": error.message}]
        raise RequestError("strict-json", error.message, status=error.status, errors=errors) from None


class StrictRoute(APIRoute):
    """A route that takes the parameters it declares and reads its body as strict JSON, bounded in every way.

    Its requests wait for their client's turn; what nobody waits for any more is called off, but for what changes
    something and computes nothing.

    Attributes:
        FILES: The media types of a file that it takes in place of JSON, each with the longest one [bytes].
        COMPUTES: Whether it may lead to computing; what only reads has places of its own.
    """

    MAX_VALUES = strict_json.MAX_VALUES
    COMPUTES = False
    FILES: ClassVar[Mapping[str, int]] = {}

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the framework's handler, after checks that it does not make."""
        handler = super().get_route_handler()
        takes_body = self.body_field is not None or bool(self.FILES)
        declared = [(field.alias, field.field_info) for field in get_flat_params(self.dependant)]
        # The fields of a model of parameters are plain ones; only queries are models here.
        parameters = [name for name, info in declared if isinstance(info, Query) or not isinstance(info, Param)]
        called_off = self.COMPUTES or "GET" in (self.methods or ())

        async def in_turn(request: Request, ticket: Ticket, body: bytes) -> Response:
            await ticket.turn()
            await request_context(request).own_files.refresh_if_changed()
            if body and not self.FILES:
                request.state.sent = await _parse(body, self.MAX_VALUES)
                request._json = with_nested_scenario(request.state.sent)
            return await handler(request)

        async def strict(request: Request) -> Response:
            gate = request_context(request).gate
            turns = gate.computing_turns if self.COMPUTES else gate.reading_turns
            with turns.ticket(client_of(request)) as ticket, ExitStack() as held:
                if not all(map(is_plain, request.path_params.values())):
                    raise RequestError("not-found")  # there is nothing of such an id, and a database may fail on it
                _check_parameters(request.query_params, parameters)
                body = await _read_body(request, held, self._longest(request)) if takes_body else b""
                if takes_body:  # what the framework would read itself, and call any error a malformed body
                    request._body = body
                answer = in_turn(request, ticket, body)
                return await (cancel_on_disconnect(request, answer) if called_off else answer)

        return strict

    def _longest(self, request: Request) -> int:
        """How many bytes a body may have that is announced so.

        Raises:
            RequestError: It is of another type, or compressed.
        """
        types = self.FILES or {"application/json": MAX_BODY_BYTES}
        kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if kind not in types:
            message = f"The body has to be a file, with Content-Type: {' or '.join(types)}." if self.FILES else None
            raise RequestError("unsupported-media-type", message)
        if request.headers.get("content-encoding", "identity").strip().lower() != "identity":
            raise RequestError("unsupported-media-type", "The body has to come as it is, without a Content-Encoding.")
        return types[kind]


class ComputingRoute(StrictRoute):
    """A route whose answer may have to be computed."""

    COMPUTES = True


class ScenarioRoute(ComputingRoute):
    """A computing route whose body holds one scenario at most."""

    MAX_VALUES = SCENARIO_VALUES


class FileRoute(StrictRoute):
    """A route whose body is a file, read whole with `request.body()`."""

    FILES: ClassVar[Mapping[str, int]] = {"text/csv": LONGEST_FILE}


def _check_parameters(sent: QueryParams, declared: Sequence[str]) -> None:
    """Refuse unknown parameters, control characters and repeated ones: of two values one would be ignored.

    Raises:
        InvalidError: With every name that is unknown or appears twice, or whose value has control characters.
    """
    for name, value in sent.multi_items():
        if name in declared and not is_plain(value):
            raise InvalidError(MESSAGE, parameter=name)
    counts = Counter(name for name, _ in sent.multi_items())
    wrong = [name for name, count in counts.items() if count > 1 or name not in declared][:MOST_ERRORS]
    if not wrong:
        return
    errors = []
    for name in wrong:
        message = "This parameter is there twice" if name in declared else unknown_name("parameter", name, declared)
        errors.append({"pointer": "", "message": message} | ({"parameter": name} if is_name(name) else {}))
    raise InvalidError("The address has parameters that cannot be used; errors names each.", errors=errors)
