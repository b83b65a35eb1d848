"""Something under way on a service: followed to its end, over lost connections and restarts."""

import json
import time
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Self

from backend.client.errors import RidelabAPIError, RidelabConnectionError
from backend.client.follow import events
from backend.client.http import Http

FINAL = ("done", "cancelled", "failed")
SILENCE = 20.0  # events that stay away so long are asked for anew [s]
PATIENCE = 90.0  # a service may be away so long while something is waited for: a restart, another replica [s]
LONGEST_PAUSE = 2.0  # between two polls [s]


class Followed:
    """What it is about as it was last heard of."""

    PLACE: ClassVar[str]  # its path on the service, without its id

    def __init__(self, http: Http, answer: Mapping[str, Any]) -> None:
        self._http = http
        self._answer = dict(answer)
        self._last_event = ""

    @property
    def answer(self) -> dict[str, Any]:
        """The JSON as the service sent it."""
        return self._answer

    @property
    def id(self) -> str:
        """Names it for ever."""
        return str(self._answer["id"])

    @property
    def state(self) -> str:
        """`queued`, `running`, `done`, `cancelled` or `failed`."""
        return str(self._answer["state"])

    @property
    def reason(self) -> str | None:
        """Why it failed as a whole."""
        return self._answer.get("reason")

    @property
    def finished(self) -> bool:
        """Whether nothing changes any more."""
        return self.state in FINAL

    def refresh(self) -> Self:
        """Ask how it stands.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        self._answer = self._http.json("GET", self._path())
        return self

    def wait(self, progress: Callable[[Self], object] | None = None) -> Self:
        """Follow it to its end, over lost connections and restarts of the service; without events by polling.

        Args:
            progress: Called with it whenever something is heard of it, once of its end.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer for 90 s.
        """
        tell: Callable[[Self], object] = progress or (lambda _: None)
        pause, heard = 0.1, time.monotonic()
        while not self.finished:
            try:
                told = self._follow(tell)
                ended = self.finished
                self.refresh()
                if not ended:
                    tell(self)
                pause, heard = 0.1 if told else min(2 * pause, LONGEST_PAUSE), time.monotonic()
            except (RidelabConnectionError, RidelabAPIError) as error:
                away = isinstance(error, RidelabConnectionError) or error.status >= 500
                if not away or time.monotonic() - heard > PATIENCE:
                    raise
                pause = LONGEST_PAUSE
            if not self.finished:
                self._http.sleep(pause)
        return self

    def cancel(self) -> Self:
        """Stop it; what is finished stays.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        self._answer = self._http.json("POST", self._path("/cancel"))
        return self

    def _path(self, below: str = "") -> str:
        return f"{self.PLACE}/{self.id}{below}"

    def _follow(self, tell: Callable[[Self], object]) -> bool:
        """Take events until the last one or until they stop coming; says whether there were any."""
        headers = {"Accept": "text/event-stream"}
        if self._last_event:
            headers["Last-Event-ID"] = self._last_event
        told = False
        try:
            with self._http.stream(self._path("/events"), headers=headers, silence=SILENCE) as response:
                for event in events(response.iter_lines(), self._last_event):
                    self._last_event, told = event.id, True
                    self._heard(json.loads(event.data))
                    tell(self)
                    if self.finished:
                        break
        except (RidelabConnectionError, RidelabAPIError):
            pass  # asking how it stands says what is wrong, if anything is
        return told

    def _heard(self, told: Mapping[str, Any]) -> None:
        """Take in what an event told."""
        self._answer |= told
