"""How routes are declared, read and answered: bodies are bounded and plain JSON, parameters are those declared."""

import asyncio
import ipaddress
from collections import Counter
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, asynccontextmanager, closing, nullcontext
from functools import partial
from pathlib import Path
from typing import Any

import orjson
from fastapi import APIRouter, Request, Response
from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Param, Query
from fastapi.responses import HTMLResponse
from fastapi.routing import APIRoute
from pydantic import BaseModel
from starlette.datastructures import QueryParams
from starlette.requests import ClientDisconnect

from backend.errors import InvalidError
from backend.http import problems
from backend.http.problems import MOST_ERRORS, RequestError
from backend.http.spool import refused_where_full
from backend.http.strict_json import MAX_VALUES, parse
from backend.plain_text import MESSAGE, is_plain
from backend.runs.reports.page import Report
from backend.services import Services
from backend.settings import MAX_BODY_BYTES
from backend.unknown_names import is_name, pointer, unknown_name
from sim_core.tables.text import MAX_BYTES

API = "/api/v1"
SPREADSHEET = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"
BULKY = 64 * 1024  # a longer body counts and is parsed beside the event loop; a scenario is a few kB [bytes]
IPV6_PREFIX = 64  # bits: one customer of a provider usually has 2^64 addresses
LONGEST_IN_MEMORY = 4 * 1024 * 1024  # of a longer file the rest is written to disk as it comes [bytes]
SCENARIO_VALUES = 10_000  # a scenario has about a hundred
TABLE_FILES = dict.fromkeys(("text/csv", SPREADSHEET), MAX_BYTES)
JSON_BODY = {"application/json": MAX_BODY_BYTES}

# One thread: the next long body waits, so that they never crowd out the event loop, whose lock they share.
_parsing = ThreadPoolExecutor(1, thread_name_prefix="strict-json")


class ApiRequest(Request):
    """A request as routes get it.

    Attributes:
        services: Of the application.
        token: Name of its token; None where the service has no tokens.
        client_id: Who counts as one client: the token, or else the address, from the server or a trusted proxy.
        file: Where a long body of a file lies until the request is answered; None where `body` has it.
    """

    services: Services
    token: str | None
    client_id: str
    file: Path | None = None

    async def content(self) -> bytes | Path:
        """Return the file that is sent, or where it lies."""
        return self.file or await self.body()


class StrictRoute(APIRoute):
    """A route that takes the parameters it declares and reads its body as strict JSON, bounded in every way.

    Its requests wait for their client's turn; what nobody waits for any more is called off, but for what changes
    something and computes nothing.
    """

    # As `router` sets them in the class of its routes.
    computes = False
    max_values = MAX_VALUES
    files: Mapping[str, int] = {}  # read only

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the framework's handler, after checks that it does not make."""
        answer = super().get_route_handler()
        takes_body = self.body_field is not None or bool(self.files)
        declared = [(field.alias, field.field_info) for field in get_flat_params(self.dependant)]
        # The fields of a model of parameters are plain ones; only queries are models here.
        parameters = [name for name, info in declared if isinstance(info, Query) or not isinstance(info, Param)]
        called_off = self.computes or "GET" in (self.methods or ())

        async def handle(plain_request: Request) -> Response:
            request = ApiRequest(plain_request.scope, plain_request.receive)
            request.services = services = request.app.state.services
            request.token = getattr(request.state, "caller", None)
            address = request.client.host if request.client else ""
            request.client_id = f"token {request.token}" if request.token else client_key(address)
            queue = services.gate.compute_queue if self.computes else services.gate.read_queue
            with queue.admit(request.client_id) as admission, ExitStack() as held:
                if not all(map(is_plain, request.path_params.values())):
                    raise RequestError("not-found")  # there is nothing of such an id, and a database may fail on it
                if request.query_params:
                    _check_parameters(request.query_params, parameters)
                body = await _read_body(request, self.files or JSON_BODY, held) if takes_body else b""
                async with ends_with_client(request) if called_off else nullcontext():
                    await admission.wait_for_slot()
                    await services.own_files.refresh_if_changed()
                    if body and not self.files:
                        work = partial(parse, body, max_values=self.max_values)
                        loop = asyncio.get_running_loop()
                        sent = work() if len(body) <= BULKY else await loop.run_in_executor(_parsing, work)
                        request.state.sent = sent  # errors point into it
                        request._json = _with_nested_scenario(sent)
                    return await answer(request)

        return handle


def router(
    tag: str,
    *statuses: int,
    computes: bool = False,
    max_values: int = MAX_VALUES,
    files: Mapping[str, int] | None = None,
) -> APIRouter:
    """Return a router of the API.

    Args:
        tag: Of its routes.
        *statuses: Of the problems that they may answer with; one that reads a body may also answer with 408.
        computes: Whether answers may have to be computed; what only reads has a queue of its own.
        max_values: How many values a body may hold.
        files: The media types of files that are taken in place of JSON, each with the longest one [bytes].
    """
    kinds: dict[int | str, dict[str, Any]] = dict.fromkeys((*statuses, 401, 414, 422, 429, 500, 503), problems.ANSWER)
    if 413 in statuses:
        kinds[408] = problems.ANSWER
    members = {"computes": computes, "max_values": max_values, "files": files or {}}
    route_class = type("Route", (StrictRoute,), members)
    return APIRouter(prefix=API, tags=[tag], route_class=route_class, responses=kinds)


def client_key(address: str) -> str:
    """Return who counts as one client: an IPv4 address, a whole IPv6 network, or whatever else the server calls it."""
    try:
        parsed = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(parsed, ipaddress.IPv4Address):
        return str(parsed)
    if parsed.ipv4_mapped is not None:
        return str(parsed.ipv4_mapped)
    return str(ipaddress.ip_network((parsed, IPV6_PREFIX), strict=False).network_address)


async def _read_body(request: ApiRequest, types: Mapping[str, int], held: ExitStack) -> bytes:
    """Return the whole body; the request then has it too.

    Args:
        request: Whose body it is.
        types: Media types that it may have, each with the longest body [bytes].
        held: Keeps the memory of a bulky one until it is answered.

    Raises:
        RequestError: It is of another type, compressed, too long, announced or in pieces, or comes too slowly.
        TemporaryError: Bulky ones take all the memory there is for them.
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind not in types:
        wanted = f"The body has to be a file, with Content-Type: {' or '.join(types)}."
        raise RequestError("unsupported-media-type", None if types is JSON_BODY else wanted)
    if request.headers.get("content-encoding", "identity").strip().lower() != "identity":
        raise RequestError("unsupported-media-type", "The body has to come as it is, without a Content-Encoding.")
    longest, counted, pieces = types[kind], 0, bytearray()
    too_long = f"The body may have {longest} bytes."
    length = request.headers.get("content-length", "")
    announced = int(length[:12]) if length.isdecimal() else 0
    if announced > longest:
        raise RequestError("too-long", too_long)
    stream = request.stream()
    async for piece in stream:
        pieces += piece
        expected = max(announced, len(pieces))
        if expected > longest:
            raise RequestError("too-long", too_long)
        if len(pieces) > LONGEST_IN_MEMORY:
            request.file = await _spooled(request, pieces, stream, announced or longest, held)
            if request.file.stat().st_size > longest:
                raise RequestError("too-long", too_long)
            pieces.clear()
            break
        if expected > max(counted, BULKY):
            more = max(min(expected, LONGEST_IN_MEMORY), min(longest, 2 * counted)) - counted
            held.enter_context(request.services.gate.memory.hold(request.client_id, more))
            counted += more
    request._body = bytes(pieces)  # what the framework would read itself, and call any error a malformed body
    return request._body


async def _spooled(
    request: ApiRequest, begun: bytearray, stream: AsyncIterator[bytes], size: int, held: ExitStack
) -> Path:
    """Write a body of about so many bytes to disk, which is freed with `held`; return where it lies.

    Raises:
        CostLimitError, TemporaryError: There is no space for it.
    """
    spool = request.services.spool.file(request.client_id, size, advice="send a shorter one")
    held.enter_context(closing(spool))
    with refused_where_full(), spool.path.open("wb") as file:
        written = file.write(begun)
        async for piece in stream:
            written += await asyncio.to_thread(file.write, piece)
            if written > size:
                break
    return spool.path


def _with_nested_scenario(body: Any) -> Any:
    """Return a body whose scenario's dotted fields (`road.bump.height`) are nested, as its other fields are.

    Raises:
        InvalidError: A field is there in both forms, or below one that has a value.
    """
    sent = body.get("scenario") if isinstance(body, dict) else None
    if not isinstance(sent, dict) or not any("." in name for name in sent):
        return body
    scenario = {name: value for name, value in sent.items() if "." not in name}
    for name in [each for each in sent if "." in each]:
        *parts, last = name.split(".")
        part = scenario
        for step in parts:
            inner = part.get(step, {})
            if not isinstance(inner, dict):
                raise InvalidError(f"{name} is below a field that has a value", pointer=pointer(["scenario", name]))
            part[step] = dict(inner)  # what was sent stays as it is
            part = part[step]
        if last in part:
            raise InvalidError(f"{name} is there twice, nested and dotted", pointer=pointer(["scenario", name]))
        part[last] = sent[name]
    return {**body, "scenario": scenario}


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
    errors = []
    for name in wrong:
        message = "This parameter is there twice" if name in declared else unknown_name("parameter", name, declared)
        errors.append({"pointer": "", "message": message} | ({"parameter": name} if is_name(name) else {}))
    if errors:
        raise InvalidError("The address has parameters that cannot be used; errors names each.", errors=errors)


@asynccontextmanager
async def ends_with_client(request: Request) -> AsyncIterator[None]:
    """Cancel the block when the client goes away first; raises ClientDisconnect then."""
    try:
        async with asyncio.timeout(None) as limit:
            watching = asyncio.create_task(_end_on_disconnect(request, limit))
            try:
                yield
            finally:
                watching.cancel()
    except TimeoutError:
        if limit.expired():
            raise ClientDisconnect from None
        raise


async def _end_on_disconnect(request: Request, limit: asyncio.Timeout) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass
    limit.reschedule(0)


def json_answer(content: Any, headers: Mapping[str, str] | None = None, *, status: int = 200) -> Response:
    """Return JSON as orjson writes it, or has written it; the route's `response_model` declares its shape."""
    if isinstance(content, BaseModel):
        content = content.model_dump(by_alias=True)
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    return Response(body, status, headers, media_type="application/json")


def html_answer(report: Report, name: str) -> Response:
    """Return a report with its own content security policy, shown by the browser or saved under that file name."""
    headers = {**report.headers, "Cache-Control": "no-cache", "Content-Disposition": f'inline; filename="{name}"'}
    return HTMLResponse(report.content, headers=headers)
