"""A job on a service, a batch or a tuning: follow it to its end, stop it, go on with it."""

import time
from collections.abc import Callable, Iterator, Mapping
from typing import Any, ClassVar, Self

from ridelab.errors import JobEndedError, JobTimeoutError, RidelabAPIError, RidelabConnectionError
from ridelab.http import Http
from ridelab.streams import Event, server_sent

FINAL = ("done", "cancelled", "failed")
SILENCE = 20.0  # a stream that says nothing for so long is asked for anew [s]; the service speaks every 15 s
PATIENCE = 90.0  # a service may be away so long while a job is waited for: a restart, another replica [s]
LONGEST_PAUSE = 2.0  # between two polls [s]


class Job:
    """A job as it was last heard of; `answer` is the JSON as the service sent it."""

    NAME: ClassVar[str]
    PLACE: ClassVar[str]  # its path on the service, without its id

    def __init__(self, http: Http, answer: Mapping[str, Any]) -> None:
        self._http = http
        self.answer = dict(answer)
        self._last_event = ""

    @property
    def id(self) -> str:
        """Names it for ever."""
        return str(self.answer["id"])

    @property
    def state(self) -> str:
        """`queued`, `running`, `done`, `cancelled` or `failed`."""
        return str(self.answer["state"])

    @property
    def reason(self) -> str | None:
        """Why it failed as a whole."""
        return self.answer.get("reason")

    @property
    def label(self) -> str | None:
        """What somebody called it."""
        return self.answer.get("label")

    @property
    def position(self) -> int | None:
        """How many runs of other jobs are computed before its own."""
        return self.answer.get("position")

    @property
    def finished(self) -> bool:
        """Whether nothing changes any more."""
        return self.state in FINAL

    @property
    def counts(self) -> Mapping[str, Any]:
        """How many there are, by `total`, `done` and `failed`."""
        return self.answer

    @property
    def total(self) -> int:
        """Runs of a batch (points times strategies), trials wanted of a tuning."""
        return int(self.counts["total"])

    @property
    def done(self) -> int:
        """Those that succeeded."""
        return int(self.counts["done"])

    @property
    def failed(self) -> int:
        """Those that failed; each says why."""
        return int(self.counts["failed"])

    def __repr__(self) -> str:
        name = f"{self.id} {self.label!r}" if self.label else self.id
        return f"{type(self).__name__}({name}: {self.state}, {self.done} done, {self.failed} failed of {self.total})"

    def refresh(self) -> Self:
        """Ask how it stands."""
        self.answer = self._http.document("GET", self._path())
        return self

    def cancel(self) -> Self:
        """Stop it; what is finished stays."""
        self.answer = self._http.document("POST", self._path("/cancel"))
        return self

    def resume(self) -> Self:
        """Go on where it stopped."""
        self.answer = self._http.document("POST", self._path("/resume"))
        return self

    def rename(self, label: str | None) -> Self:
        """Give it a label, by which lists find it."""
        self.answer = self._http.document("PATCH", self._path(), body={"label": label})
        return self

    def delete(self) -> None:
        """Remove it; the service refuses with 409 while it runs or while a link shows it."""
        self._http.send("DELETE", self._path())

    def wait(self, progress: Callable[[Self], object] | None = None, *, timeout: float | None = None) -> Self:
        """Follow it until it is done, over lost connections and restarts of the service; without events by polling.

        Args:
            progress: Called with it whenever something is heard of it, once of its end.
            timeout: Wait so long at most [s].

        Raises:
            JobEndedError: It was cancelled, or failed as a whole.
            JobTimeoutError: It has not ended in that time.
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer for 90 s.
        """
        self.follow(progress, timeout=timeout)
        if self.state != "done":
            why = f": {self.reason}" if self.reason else ""
            raise JobEndedError(f"The {self.NAME} {self.id} {'was ' * (self.state == 'cancelled')}{self.state}{why}")
        return self

    def follow(self, progress: Callable[[Self], object] | None = None, *, timeout: float | None = None) -> Self:
        """As `wait`, but however it ends is well.

        Raises:
            JobTimeoutError: It has not ended in that time.
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer for 90 s.
        """
        report: Callable[[Self], object] = progress or (lambda _: None)
        pause, last_answer = 0.1, time.monotonic()
        end = None if timeout is None else last_answer + timeout
        while not self.finished:
            try:
                any_events = self._listen(report, end)
                ended = self.finished
                self.refresh()
                if not ended:
                    report(self)
                pause, last_answer = 0.1 if any_events else min(2 * pause, LONGEST_PAUSE), time.monotonic()
            except (RidelabConnectionError, RidelabAPIError) as error:
                away = isinstance(error, RidelabConnectionError) or error.status >= 500
                if not away or time.monotonic() - last_answer > PATIENCE:
                    raise
                pause = LONGEST_PAUSE
            if not self.finished:
                left = LONGEST_PAUSE if end is None else end - time.monotonic()
                if left <= 0:
                    raise JobTimeoutError(f"The {self.NAME} {self.id} is {self.state} after {timeout:g} s")
                self._http.sleep(min(pause, left))
        return self

    def events(self, after: str = "") -> Iterator[Event]:
        """What happened to it since the event of that id, and then as it happens.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        yield from (event for event in self._stream(after) if event is not None)

    def _path(self, below: str = "") -> str:
        return f"{self.PLACE}/{self.id}{below}"

    def _stream(self, after: str) -> Iterator[Event | None]:
        headers = {"Accept": "text/event-stream"} | ({"Last-Event-ID": after} if after else {})
        with self._http.stream(self._path("/events"), headers=headers, silence=SILENCE) as response:
            yield from server_sent(response.iter_lines(), after)

    def _listen(self, report: Callable[[Self], object], end: float | None) -> bool:
        """Take events until the last one, or until they or the time end; says whether there were any."""
        any_events = False
        try:
            for event in self._stream(self._last_event) if self._in_time(end) else ():
                if event is not None:
                    self._last_event, any_events = event.id, True
                    self._take_in(event.data)
                    report(self)
                if self.finished or not self._in_time(end):
                    break
        except (RidelabConnectionError, RidelabAPIError):
            pass  # asking how it stands says what is wrong, if anything is
        return any_events

    @staticmethod
    def _in_time(end: float | None) -> bool:
        """Whether a stream that falls silent is noticed before the end; else polls are more exact."""
        return end is None or time.monotonic() + SILENCE < end

    def _take_in(self, data: Mapping[str, Any]) -> None:
        self.answer |= data
