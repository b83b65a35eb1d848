"""Routes that read strictly: the body is bounded and plain JSON, the parameters are those declared."""

import asyncio
from collections import Counter
from collections.abc import Callable, Coroutine, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from typing import Any

from fastapi import Request, Response
from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Param, Query
from fastapi.routing import APIRoute
from starlette.datastructures import QueryParams
from starlette.types import Receive, Scope

from backend.errors import InvalidError
from backend.http import strict_json
from backend.http.problems import MOST_ERRORS, RequestError
from backend.unknown_names import is_name, unknown_name

BULKY = 64 * 1024  # a longer body takes a place and is parsed beside the event loop; a scenario is a few kB [bytes]
SCENARIO_VALUES = 10_000  # a scenario has about a hundred

# One thread: the next long body waits, so that they never crowd out the event loop, whose lock they share.
_parsing = ThreadPoolExecutor(1, thread_name_prefix="strict-json")


class StrictRequest(Request):
    """A request whose body is bounded in size, time and number of values, and whose JSON is read strictly.

    Args:
        scope: ASGI.
        receive: ASGI.
        held: Keeps the place of a bulky body until the request is answered.
        max_values: How many values the body may hold.
        computes: Whether it may lead to computing, and takes a place among those as soon as its body is there.
    """

    def __init__(self, scope: Scope, receive: Receive, *, held: ExitStack, max_values: int, computes: bool) -> None:
        super().__init__(scope, receive)
        self._held = held
        self._max_values = max_values
        self._computes = computes
        self._bulky = False

    async def body(self) -> bytes:
        """The whole body.

        Raises:
            RequestError: It is too long, announced or in pieces, or takes too long to come.
            TemporaryError: Too many bulky ones are being read.
        """
        if not hasattr(self, "_body"):
            announced = self.headers.get("content-length", "")
            if announced.isdecimal():
                self._expect(int(announced[:12]))
            try:
                async with asyncio.timeout(self.app.state.settings.body_timeout):
                    self._body = await self._read()
            except TimeoutError:
                raise RequestError("slow-body", "The request body did not come in time.") from None
        return self._body

    async def _read(self) -> bytes:
        pieces = bytearray()
        async for piece in self.stream():
            pieces += piece
            self._expect(len(pieces))
        return bytes(pieces)

    def _expect(self, length: int) -> None:
        """Refuse a body of at least that length, or take a place for it."""
        limit: int = self.app.state.settings.max_body_bytes
        if length > limit:
            raise RequestError("too-long", f"The body may have {limit} bytes.")
        if length > BULKY and not self._bulky:
            self._bulky = True
            self._held.enter_context(self.app.state.admission.receiving(client_address(self)))

    async def json(self) -> Any:
        """The body's value; anything doubtful is a problem."""
        if not hasattr(self, "_json"):
            self._json = await self._parsed(await self.body())
        return self._json

    async def _parsed(self, body: bytes) -> Any:
        if self._computes:
            self._held.enter_context(self.app.state.admission.admitted(client_address(self)))
        parse = partial(strict_json.parse, body, max_values=self._max_values)
        try:
            if len(body) > BULKY:
                return await asyncio.get_running_loop().run_in_executor(_parsing, parse)
            return parse()
        except strict_json.StrictJSONError as error:
            message = error.message
            errors = [{"pointer": "", "message": message}]
            raise RequestError("strict-json", message, status=error.status, errors=errors) from None


def client_address(request: Request) -> str:
    """The client's address by the server, or by a trusted proxy; empty where neither names one."""
    return request.client.host if request.client else ""


class StrictRoute(APIRoute):
    """A route that reads its body with `StrictRequest`, and only as JSON, and takes the parameters it declares.

    One that may lead to computing (`COMPUTES`) refuses a request that would wait too long before it does anything else.
    """

    MAX_VALUES = strict_json.MAX_VALUES
    COMPUTES = False

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """The framework's handler, given a stricter request."""
        handler = super().get_route_handler()
        takes_body = self.body_field is not None
        declared = [(field.alias, field.field_info) for field in get_flat_params(self.dependant)]
        # The fields of a model of parameters are plain ones; only queries are models here.
        parameters = [name for name, info in declared if isinstance(info, Query) or not isinstance(info, Param)]

        async def strict(request: Request) -> Response:
            if self.COMPUTES and takes_body:
                request.app.state.admission.check_admission(client_address(request))
            _check_parameters(request.query_params, parameters)
            kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
            if takes_body and kind != "application/json":
                raise RequestError("unsupported-media-type")
            if takes_body and request.headers.get("content-encoding", "identity").strip().lower() != "identity":
                raise RequestError(
                    "unsupported-media-type", "The body has to come as it is, without a Content-Encoding."
                )
            with ExitStack() as held:
                if self.COMPUTES and not takes_body:
                    held.enter_context(request.app.state.admission.admitted(client_address(request)))
                limits: dict[str, Any] = {"max_values": self.MAX_VALUES, "computes": self.COMPUTES}
                bounded = StrictRequest(request.scope, request.receive, held=held, **limits)
                if takes_body and await bounded.body():
                    await bounded.json()  # here: the framework would call any exception a malformed body
                return await handler(bounded)

        return strict


class ComputingRoute(StrictRoute):
    """A route whose answer may have to be computed."""

    COMPUTES = True


class ScenarioRoute(ComputingRoute):
    """One that computes what its body holds, one scenario at most."""

    MAX_VALUES = SCENARIO_VALUES


def _check_parameters(sent: QueryParams, declared: Sequence[str]) -> None:
    """Refuse unknown parameters and repeated ones: none is a list here, and of two values one would be ignored.

    Raises:
        InvalidError: With every name that is unknown or appears twice.
    """
    counts = Counter(name for name, _ in sent.multi_items())
    wrong = [name for name, count in counts.items() if count > 1 or name not in declared][:MOST_ERRORS]
    if not wrong:
        return
    errors = []
    for name in wrong:
        message = "This parameter is there twice" if name in declared else unknown_name("parameter", name, declared)
        errors.append({"pointer": "", "message": message} | ({"parameter": name} if is_name(name) else {}))
    raise InvalidError("The address has parameters that cannot be used; errors names each.", errors=errors)
