"""Event loops for tests: the browser's tests leave one running in the main thread, where no other may run then."""

import asyncio
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from typing import Any, TypeVar

import httpx

T = TypeVar("T")


def run(
    main: Callable[[], Coroutine[Any, Any, T]], make_loop: Callable[[], asyncio.AbstractEventLoop] | None = None
) -> T:
    """The result of a coroutine, in a thread and an event loop of its own, or of this kind.

    The thread is a daemon: where a test runs into its time limit, nothing waits for it.
    """
    result: Future[T] = Future()

    def drive() -> None:
        try:
            with asyncio.Runner(loop_factory=make_loop) as runner:
                result.set_result(runner.run(main()))
        except BaseException as error:  # noqa: BLE001  # it is raised where the result is asked for
            result.set_exception(error)

    thread = threading.Thread(target=drive, daemon=True)
    thread.start()
    value = result.result()
    thread.join()  # until then it holds the value, and its loop is open
    return value


def ask(app: Any, method: str, address: str, *, peer: str = "127.0.0.1", **more: Any) -> httpx.Response:
    """The answer of an application that was not started to one request from that address.

    It goes to `http://lab.example` unless it says.
    """

    async def answer() -> httpx.Response:
        transport = httpx.ASGITransport(app, client=(peer, 123))
        async with httpx.AsyncClient(transport=transport, base_url="http://lab.example") as client:
            return await client.request(method, address, **more)

    return run(answer)
