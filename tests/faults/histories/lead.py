"""PostgreSQL as far as leadership asks it: sessions with an advisory lock, which one that hangs loses."""

import itertools
from collections.abc import Callable, Mapping
from functools import partial
from types import SimpleNamespace
from typing import Any

from sqlalchemy.exc import OperationalError

from backend.db.server import APPLICATION
from backend.jobs import leadership
from backend.jobs.leadership import Leadership
from backend.store import Store
from tests.faults.histories.loop import SimulatedLoop


class Server:
    """Who is connected, and whose lock it is.

    Attributes:
        loop: The history's.
        writing: Called with the name of a replica that is about to write as the leader.
    """

    def __init__(self, loop: SimulatedLoop) -> None:
        self.loop = loop
        self.sessions: dict[int, _Session] = {}
        self.leader: _Session | None = None
        self.writing: Callable[[str], None] = lambda _: None
        self.pids = itertools.count(1)

    def leadership(self, store: Store, name: str) -> Leadership:
        """The production class of a replica of that name, which asks this server for the lock."""
        asked = SimpleNamespace(
            engine=SimpleNamespace(
                dialect=SimpleNamespace(name="postgresql"), url=None, connect=lambda: _Session(self, name)
            ),
            read=store.read,
            write=partial(self._write, store, name),
            guarded=lambda check, method: self._guarded(name, check, method),
        )
        return Leadership(asked)  # type: ignore[arg-type]  # all of the store that it uses

    async def _write(self, store: Store, name: str, method: Callable[[], Any]) -> Any:
        self.writing(name)
        return await store.write(method)

    def _guarded(self, name: str, check: Callable[[Any], None], method: Callable[[], Any]) -> Any:
        with _Session(self, name) as connection:
            check(connection)
        if self.leader is None or self.leader.name != APPLICATION + name:
            self.loop.broken(f"{name} writes as the leader, and is not")
        return method()


class _Session:
    def __init__(self, server: Server, name: str) -> None:
        self.server, self.name = server, APPLICATION + name
        self.pid = next(server.pids)
        self.used = server.loop.time()
        server.sessions[self.pid] = self

    def __enter__(self) -> "_Session":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def execution_options(self, **_: Any) -> "_Session":
        return self

    def execute(self, statement: Any, values: Mapping[str, Any] | None = None) -> Any:
        if self.pid not in self.server.sessions:
            raise OperationalError(None, None, Exception("terminated"))
        self.used = self.server.loop.time()
        answer = self._answer(statement, dict(values or {}))
        return SimpleNamespace(
            scalar_one=lambda: answer,
            all=lambda: answer,
            first=lambda: answer,
            scalars=lambda: SimpleNamespace(all=lambda: answer),
        )

    def _answer(self, statement: Any, values: dict[str, Any]) -> Any:
        server, leader = self.server, self.server.leader
        if statement is leadership._IS_OURS:
            return [] if leader is None else [leader.name == self.name]
        if statement is leadership._HUNG:
            hangs = leader is not None and server.loop.time() - leader.used > values["seconds"]
            return SimpleNamespace(pid=leader.pid, application_name=leader.name) if leader and hangs else None
        if statement is leadership._END_OTHERS:
            others = [each for each in server.sessions.values() if each.name == values["name"]]
            for each in others:
                if each.pid != values["pid"]:
                    each.close()
            return []
        if statement is leadership._END_HOLDER:
            if values["pid"] in server.sessions:
                server.sessions[values["pid"]].close()
            return True
        if "pg_try_advisory_lock" in str(statement) and leader is None:
            server.leader = self
        return server.leader is self

    def invalidate(self) -> None:
        self.close()

    def close(self) -> None:
        self.server.sessions.pop(self.pid, None)
        if self.server.leader is self:
            self.server.leader = None
