"""A batch of runs on a service: follow it, stop it, take its results."""

import json
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from backend.client.errors import RidelabAPIError, RidelabConnectionError
from backend.client.files import format_of, save
from backend.client.follow import events, rows
from backend.client.http import Http

FINAL = ("done", "cancelled", "failed")
SILENCE = 20.0  # events that stay away so long are asked for anew [s]
PATIENCE = 90.0  # a service may be away so long while a batch is waited for: a restart, another replica [s]
LONGEST_PAUSE = 2.0  # between two polls [s]

Progress = Callable[["Batch"], object]


class Batch:
    """A batch as it was last heard of."""

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
        """Why the batch as a whole failed."""
        return self._answer.get("reason")

    @property
    def total(self) -> int:
        """Runs: points times strategies."""
        return int(self._answer["total"])

    @property
    def done(self) -> int:
        """Runs that succeeded."""
        return int(self._answer["done"])

    @property
    def failed(self) -> int:
        """Runs that failed; their rows say why."""
        return int(self._answer["failed"])

    @property
    def finished(self) -> bool:
        """Whether nothing changes any more."""
        return self.state in FINAL

    def __repr__(self) -> str:
        return f"Batch({self.id}: {self.state}, {self.done} done, {self.failed} failed of {self.total})"

    def refresh(self) -> "Batch":
        """Ask how it stands.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        self._answer = self._http.json("GET", self._path())
        return self

    def wait(self, progress: Progress | None = None) -> "Batch":
        """Follow it to its end, over lost connections and restarts of the service; without events by polling.

        Args:
            progress: Called with this batch whenever something is heard of it, once of its end.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer for 90 s.
        """
        tell = progress or (lambda _: None)
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

    def cancel(self) -> "Batch":
        """Stop it; what is finished stays.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        self._answer = self._http.json("POST", self._path("/cancel"))
        return self

    def summary(self, figures: Sequence[str] = (), baseline: str | None = None) -> dict[str, Any]:
        """What its finished rows say as a whole: quantiles, extremes, paired margins, stability (docs/robustness.md).

        Args:
            figures: Keys such as `bump.body_acceleration.peak`; none are the paper's eight, travel and airborne.
            baseline: The strategy the others are compared with; None is LV, else the first.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        params = {"figures": ",".join(figures), **({} if baseline is None else {"baseline": baseline})}
        found: dict[str, Any] = self._http.json("GET", self._path("/summary"), params=params)
        return found

    def rows(self) -> Iterator[dict[str, Any]]:
        """Its rows as they come: swept fields, strategy, status, metrics; one for each run, failed ones too.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        with self._http.stream(self._path("/results"), params={"format": "json"}) as response:
            yield from rows(response.iter_text())

    def content(self, file_format: str) -> Iterator[bytes]:
        """Its results as the bytes of a `csv`, `parquet` or `json` file, piece by piece.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        with self._http.stream(self._path("/results"), params={"format": file_format}) as response:
            yield from response.iter_bytes()

    def download(self, path: str | os.PathLike[str], file_format: str | None = None) -> Path:
        """Its results as a file, in the format its name ends with or the one named.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        return save(self.content(format_of(path, file_format)), path)

    def _path(self, below: str = "") -> str:
        return f"/api/v1/batches/{self.id}{below}"

    def _follow(self, tell: Progress) -> bool:
        """Take events until the last one or until they stop coming; says whether there were any."""
        headers = {"Accept": "text/event-stream"}
        if self._last_event:
            headers["Last-Event-ID"] = self._last_event
        told = False
        try:
            with self._http.stream(self._path("/events"), headers=headers, silence=SILENCE) as response:
                for event in events(response.iter_lines(), self._last_event):
                    self._last_event, told = event.id, True
                    self._answer |= json.loads(event.data)
                    tell(self)
                    if self.finished:
                        break
        except (RidelabConnectionError, RidelabAPIError):
            pass  # asking how it stands says what is wrong, if anything is
        return told
