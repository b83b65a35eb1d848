"""A job on a service, a batch or a tuning: follow it to its end, cancel it, resume it, read its results."""

import io
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

from ridelab.connection import Connection, comma_separated
from ridelab.errors import JobEndedError, JobTimeoutError, RidelabAPIError, RidelabConnectionError
from ridelab.files import format_of, save, table_in
from ridelab.http import Http
from ridelab.notebooks import needed
from ridelab.requirements import RequirementResult
from ridelab.streams import Event, json_rows, server_sent

if TYPE_CHECKING:
    import pandas as pd

FINAL = ("done", "cancelled", "failed")
SILENCE = 20.0  # a stream that says nothing for so long is asked for anew [s]; the service speaks every 15 s
LONGEST_ABSENCE = 90.0  # a service may be away so long while a job is waited for: a restart, another replica [s]
LONGEST_PAUSE = 2.0  # between two polls [s]
Trial = dict[str, Any]  # number, weights, values, limits, feasible, …, as the service sends it


def _field(key: str, doc: str) -> Any:
    """A property: the value of that key in the last answer."""
    return property(lambda job: job.answer.get(key), doc=doc)


def _count(key: str, doc: str) -> Any:
    return property(lambda job: job.counts[key], doc=doc)


def _again(kind: "type[Job]", address: str, answer: Mapping[str, Any]) -> "Job":
    """A job that was pickled."""
    return kind(Connection(address)._http, answer)


class Job:
    """A job in its last known state; `answer` is the JSON as the service sent it."""

    NAME: ClassVar[str]
    PATH: ClassVar[str]  # of its kind on the service, without an id

    id: str = _field("id", "Names it for ever.")
    state: str = _field("state", "`planning`, `queued`, `running`, `done`, `cancelled` or `failed`.")
    reason: str | None = _field("reason", "Why it failed as a whole.")
    label: str | None = _field("label", "What somebody called it.")
    position: int | None = _field("position", "How many runs of other jobs are computed before its own.")
    total: int | None = _count(
        "total", "Runs of a batch (points times strategies), None until it is planned; trials wanted of a tuning."
    )
    done: int = _count("done", "Those that succeeded.")
    failed: int = _count("failed", "Those that failed; each says why.")

    def __init__(self, http: Http, answer: Mapping[str, Any]) -> None:
        self._http = http
        self.answer = dict(answer)
        self._last_event = ""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled with its service's address, without a login."""
        return _again, (type(self), self._http.address, self.answer)

    def __len__(self) -> int:
        return self.total or 0

    def __bool__(self) -> bool:
        return True

    @property
    def finished(self) -> bool:
        """Check whether its state is final."""
        return self.state in FINAL

    @property
    def problem(self) -> RidelabAPIError | None:
        """Why it could not be planned: what a dry run of the same request would have raised."""
        problem = self.answer.get("problem")
        return None if problem is None else RidelabAPIError.of(problem["status"], problem)

    @property
    def counts(self) -> Mapping[str, Any]:
        """The numbers `total`, `done` and `failed`; of a tuning also `feasible`."""
        return self.answer

    def __repr__(self) -> str:
        name = f"{self.id} {self.label!r}" if self.label else self.id
        of_total = "" if self.total is None else f" of {self.total}"
        return f"{type(self).__name__}({name}: {self.state}, {self.done} done, {self.failed} failed{of_total})"

    def refresh(self) -> Self:
        """Read its state again."""
        return self._ask("GET")

    def cancel(self) -> Self:
        """Cancel it; finished runs stay."""
        return self._ask("POST", "/cancel")

    def resume(self) -> Self:
        """Continue where it stopped."""
        return self._ask("POST", "/resume")

    def rename(self, label: str | None) -> Self:
        """Set its label, by which lists find it."""
        return self._ask("PATCH", body={"label": label})

    def delete(self) -> None:
        """Delete it; the service refuses with 409 while it runs or while a link shows it."""
        self._http.send("DELETE", self._path())

    def wait(self, progress: Callable[[Self], object] | None = None, *, timeout: float | None = None) -> Self:
        """Follow it until it is done, across lost connections and restarts of the service; without events by polling.

        Args:
            progress: Called with it whenever something is heard of it, once of its end.
            timeout: Wait so long at most [s].

        Raises:
            JobEndedError: It was cancelled, or failed as a whole.
            JobTimeoutError: It has not ended in that time.
            RidelabAPIError: The service refused, or could not plan it.
            RidelabConnectionError: No answer for 90 s.
        """
        self.follow(progress, timeout=timeout)
        if self.problem is not None:
            raise self.problem
        if self.state != "done":
            why = f": {self.reason}" if self.reason else ""
            raise JobEndedError(f"The {self.NAME} {self.id} {'was ' * (self.state == 'cancelled')}{self.state}{why}")
        return self

    def follow(self, progress: Callable[[Self], object] | None = None, *, timeout: float | None = None) -> Self:
        """Follow it as `wait` does, but accept every final state."""
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
                if not away or time.monotonic() - last_answer > LONGEST_ABSENCE:
                    raise
                pause = LONGEST_PAUSE
            if not self.finished:
                left = LONGEST_PAUSE if end is None else end - time.monotonic()
                if left <= 0:
                    raise JobTimeoutError(f"The {self.NAME} {self.id} is {self.state} after {timeout:g} s")
                self._http.sleep(min(pause, left))
        return self

    def events(self, after: str = "") -> Iterator[Event]:
        """Yield its events since the event of that id, and then each new one."""
        yield from (event for event in self._stream(after) if event is not None)

    def _path(self, below: str = "") -> str:
        return f"{self.PATH}/{self.id}{below}"

    def _ask(self, method: str, below: str = "", **request: Any) -> Self:
        self.answer = self._http.json(method, self._path(below), **request)
        return self

    def _stream(self, after: str) -> Iterator[Event | None]:
        headers = {"Accept": "text/event-stream"} | ({"Last-Event-ID": after} if after else {})
        with self._http.stream(self._path("/events"), headers=headers, silence=SILENCE) as response:
            yield from server_sent(response.iter_lines(), after)

    def _listen(self, report: Callable[[Self], object], end: float | None) -> bool:
        """Read events until the last one, or until the stream or the time ends; returns whether there were any."""
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
        """Check whether a silent stream would be noticed before the deadline; if not, polling is more exact."""
        return end is None or time.monotonic() + SILENCE < end

    def _take_in(self, data: Mapping[str, Any]) -> None:
        self.answer |= data


class Batch(Job):
    """A batch of runs: its rows, as they are computed, as a file or a frame, and its summary."""

    NAME = "batch"
    PATH = "/api/v1/batches"

    def summary(self, figures: Sequence[str] = (), baseline: str | None = None) -> dict[str, Any]:
        """The summary of its finished rows: quantiles, extremes, paired margins, stability.

        docs/explanation/robustness.md explains them.

        Args:
            figures: Metrics such as `bump.body_acceleration.peak`; none are the paper's eight, travel and airborne.
            baseline: The strategy the others are compared with; None is LV, else the first.
        """
        params = {"figures": comma_separated(figures), "baseline": baseline}
        return self._http.json("GET", self._path("/summary"), params=params)

    def sweep(self) -> dict[str, Any]:
        """Return its sweep as it was sent, the fields by dotted names."""
        return self._http.json("GET", self._path("/sweep"))

    def requirement_results(self) -> list[RequirementResult]:
        """Return how its runs keep its requirements: how many pass and fail, and where each first fails."""
        answer = self._http.json("GET", self._path("/requirements"))
        return [RequirementResult.of(each) for each in answer["requirement_results"]]

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield its rows as they are computed: swept fields, strategy, status, metrics; failed runs have one too."""
        with self._http.stream(self._path("/results"), params={"format": "json"}) as response:
            yield from json_rows(response.iter_text())

    def frame(self) -> "pd.DataFrame":
        """Return its rows as a pandas frame, a column for each swept field and metric, units in `frame.attrs["units"]`.

        Raises:
            ImportError: pandas is not installed.
        """
        pandas = needed("pandas", "A frame")
        frame: pd.DataFrame = pandas.read_csv(io.BytesIO(b"".join(self.content("csv"))))
        heads = [head.removesuffix("]").partition(" [") for head in map(str, frame.columns)]
        frame.columns = pandas.Index([name for name, _, _ in heads])
        frame.attrs["units"] = {name: unit or "1" for name, _, unit in heads}
        return frame

    def content(self, file_format: str) -> Iterator[bytes]:
        """Return its results as the bytes of a `csv`, `parquet` or `json` file, piece by piece."""
        return table_in(file_format, self._results)

    def _results(self, file_format: str) -> Iterator[bytes]:
        with self._http.stream(self._path("/results"), params={"format": file_format}) as response:
            yield from response.iter_bytes()

    def download(self, path: str | os.PathLike[str], file_format: str | None = None) -> Path:
        """Write its results to a file, in the format named, else that of the file's ending.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
        """
        return save(self.content(format_of(path, file_format)), path)


class Tuning(Job):
    """A tuning of weights: its trials, and resuming it."""

    NAME = "tuning"
    PATH = "/api/v1/tunings"

    feasible: int = _count("feasible", "Trials within every limit.")
    paper: Trial | None = _field("paper", "The paper's weights; None until the first generation is complete.")
    best: list[Trial | None] = _field("best", "Of each objective the feasible trial with its smallest value, or None.")
    knee: Trial | None = _field("knee", "Of several objectives the point of the front nearest to its ideal corner.")
    front: list[Trial] = _field("front", "Feasible trials that no other one betters.")
    comparison: dict[str, Any] | None = _field(
        "comparison", "The paper's weights and the tuned ones on training and validation roads; None until done."
    )

    @property
    def counts(self) -> Mapping[str, Any]:
        """The numbers of trials: `total`, `done`, `failed` and `feasible`."""
        return dict(self.answer["trials"])

    def resume(self, trials: int | None = None) -> Self:
        """Continue where it stopped, perhaps with more trials in all; 409 where nothing is left to do."""
        return self._ask("POST", "/resume", params={"trials": trials})

    def trials(self) -> list[Trial]:
        """Every trial, in order."""
        return list(self._http.json("GET", self._path("/trials"))["trials"])

    def _take_in(self, data: Mapping[str, Any]) -> None:
        counts = {name: data[name] for name in self.counts}
        self.answer |= {name: data[name] for name in ("state", "step", "generation")} | {"trials": counts}
