"""Clients of a load test: many addresses, and as little work as will do."""

import asyncio
import itertools

Connection = tuple[asyncio.StreamReader, asyncio.StreamWriter]
_seeds = itertools.count(1)


def new_run(strategies: bytes = b'"lv", "lqr"') -> bytes:
    """The body of a run that no request has asked for yet."""
    return b'{"scenario": {"road": {"seed": %d}}, "strategies": [%s]}' % (next(_seeds), strategies)


def run_id(answer: bytes) -> str:
    """The id in a run's answer."""
    return answer[7:29].decode()


class Caller:
    """One client. A full HTTP client would need more of the machine than the service.

    Args:
        port: Where the service is.
        address: Whence it asks, of 127.0.0.0/8.
    """

    def __init__(self, port: int, address: str) -> None:
        self.port = port
        self._address = address
        self._idle: list[Connection] = []

    async def call(
        self, method: str, path: str, body: bytes = b"", *, kind: str = "application/json"
    ) -> tuple[int, dict[str, str], bytes]:
        """Status, headers and body; asked again where the service closed an idle connection just then.

        A call that is cancelled hangs up.
        """
        while True:
            reused = bool(self._idle)
            reader, writer = await self._connection()
            try:
                answer = await _exchange(reader, writer, method, path, body, kind)
            except asyncio.CancelledError:
                writer.close()
                raise
            except (ConnectionError, asyncio.IncompleteReadError):
                writer.close()
                if not reused:
                    raise
            else:
                self._idle.append((reader, writer))
                return answer

    async def close(self) -> None:
        """End its connections."""
        for _, writer in self._idle:
            writer.close()
        await asyncio.gather(*(writer.wait_closed() for _, writer in self._idle), return_exceptions=True)

    async def _connection(self) -> Connection:
        while self._idle:
            reader, writer = self._idle.pop()
            if not reader.at_eof():
                return reader, writer
            writer.close()
        return await self._connect()

    async def _connect(self) -> Connection:
        return await asyncio.open_connection("127.0.0.1", self.port, local_addr=(self._address, 0))


async def _exchange(
    reader: asyncio.StreamReader, writer: asyncio.StreamWriter, method: str, path: str, body: bytes, kind: str
) -> tuple[int, dict[str, str], bytes]:
    head = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: {kind}\r\n"
    writer.write(f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body)
    first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().strip().split("\r\n")
    headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
    return int(first.split()[1]), headers, await reader.readexactly(int(headers["content-length"]))


def quantile(times: list[float], share: float) -> float:
    """Return the quantile of times in seconds [ms]; 0 of none."""
    if not times:
        return 0.0
    return 1000 * sorted(times)[min(len(times) - 1, int(share * len(times)))]
