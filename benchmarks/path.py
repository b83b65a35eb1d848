"""How much of the service's own code a request goes through: files and functions of backend/, entered in its process.

The service runs in a process of its own under `sys.setprofile`, in all its threads; its worker processes are not
counted. Each flow is asked for several times, and what counts is what every time enters, from the request until the
service is at rest again: so what the service does by itself now and then is left out. Functions are told apart by the
place of their definition; lambdas, comprehensions and module bodies are not counted.
"""

import contextlib
import dis
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import httpx

from benchmarks.timing import table

ROOT = Path(__file__).parents[1]
BACKEND = f"{ROOT / 'backend'}{os.sep}"
STRATEGIES = ["lv", "lqr", "passive"]
REPEATS = 5
REST = 0.15  # after an answer the service comes to rest within this time [s]
POLL_INTERVAL = 0.05  # of a batch [s]
NO_FUNCTIONS = ("<module>", "<lambda>", "<listcomp>", "<dictcomp>", "<setcomp>", "<genexpr>")
IDLE = {"RIDELAB_LOG_LEVEL": "warning"}
BASELINE = {  # of 899e0802, by this same program
    "POST /runs, new": (42, 162),
    "POST /runs, stored": (30, 88),
    "POST /live": (35, 124),
    "a batch of 6, with polls": (51, 182),
    "POST /links": (38, 145),
}


@dataclass(slots=True)
class Entered:
    """What of backend/ was entered in all threads.

    Attributes:
        open: Whether entries are counted at the moment.
        codes: The functions.
    """

    open: bool = False
    codes: set[CodeType] = field(default_factory=set)

    def __call__(self, frame: FrameType, event: str, _: object) -> None:
        """Count an entry, as `sys.setprofile` calls it; a coroutine that goes on is none."""
        code = frame.f_code
        if not (self.open and event == "call" and code.co_filename.startswith(BACKEND)):
            return
        if code.co_name not in NO_FUNCTIONS and frame.f_lasti <= _first_instruction(code):
            self.codes.add(code)

    @contextlib.contextmanager
    def counting(self) -> Iterator[set[CodeType]]:
        """Count in the block and until the service is at rest."""
        codes = self.codes = set()
        self.open = True
        try:
            yield codes
            time.sleep(REST)  # until it is at rest
        finally:
            self.open = False


_FIRST: dict[CodeType, int] = {}


def _first_instruction(code: CodeType) -> int:
    """Return where a call begins: the first RESUME, which a generator has behind the instructions that make it."""
    if code not in _FIRST:
        _FIRST[code] = next((each.offset for each in dis.get_instructions(code) if each.opname == "RESUME"), 0)
    return _FIRST[code]


class Asking:
    """Requests to the service over one connection."""

    def __init__(self, address: str) -> None:
        self._client = httpx.Client(base_url=f"{address}/api/v1", timeout=60, trust_env=False)

    def __call__(self, method: str, path: str, body: object = None) -> Any:
        """Return the JSON of an answer.

        Raises:
            httpx.HTTPStatusError: It is a problem.
        """
        return self._client.request(method, path, json=body).raise_for_status().json()


Flow = Callable[[Asking, int], Callable[[], object]]  # prepares, and returns what is counted


def _run(seed: int) -> dict[str, Any]:
    return {"scenario": {"road": {"seed": 7000 + seed}}, "strategies": STRATEGIES}


def _new(ask: Asking, number: int) -> Callable[[], object]:
    return lambda: ask("POST", "/runs", _run(number))


def _stored(ask: Asking, number: int) -> Callable[[], object]:
    ask("POST", "/runs", _run(100 + number))
    return lambda: ask("POST", "/runs", _run(100 + number))


def _live(ask: Asking, number: int) -> Callable[[], object]:
    return lambda: ask("POST", "/live", _run(200 + number))


def _batch(ask: Asking, number: int) -> Callable[[], object]:
    sweep = {"list": [{"road.seed": 8000 + 10 * number + road} for road in range(6)]}

    def submit_and_poll() -> None:
        job = ask("POST", "/batches", {"strategies": ["lv"], "sweep": sweep})
        while job["state"] not in ("done", "failed"):
            time.sleep(POLL_INTERVAL)
            job = ask("GET", f"/batches/{job['id']}")
        if job["failed"] or job["state"] == "failed":
            raise RuntimeError(f"The batch failed: {job}")

    return submit_and_poll


def _link(ask: Asking, number: int) -> Callable[[], object]:
    run = ask("POST", "/runs", _run(300 + number))["id"]
    return lambda: ask("POST", "/links", {"run_id": run, "view": {}})


FLOWS: dict[str, Flow] = {
    "POST /runs, new": _new,
    "POST /runs, stored": _stored,
    "POST /live": _live,
    "a batch of 6, with polls": _batch,
    "POST /links": _link,
}


def run() -> None:
    """Print the counts of now, as shares of those of 899e0802, and those."""
    rows = []
    for name, counts in measure().items():
        shares = [f"{100 * new / old:.0f} %" for new, old in zip(counts, BASELINE[name], strict=True)]
        rows.append([name, *counts, *shares, *BASELINE[name]])
    head = ["", "files", "functions", "of its files", "of its functions", "its files", "its functions"]
    table("What a request enters of backend/, beside what it did in 899e0802", head, rows)


def measure() -> dict[str, tuple[int, ...]]:
    """Return by flow the number of files and of functions."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "benchmarks.path", folder]
        done = subprocess.run(  # noqa: S603 - our own module, no shell
            command, stdout=subprocess.PIPE, text=True, check=False, cwd=ROOT, env={**os.environ, **IDLE}
        )  # it ends by SIGTERM
    return {name: tuple(counts) for name, counts in json.loads(done.stdout.splitlines()[-1]).items()}


def _serve(folder: str) -> None:
    """Serve in this process, and ask it from another thread, which prints the counts and ends it."""
    from backend import __main__ as command

    entered = Entered()
    reading, writing = os.pipe()
    output = os.dup(1)
    os.dup2(writing, 1)

    def ask_and_end() -> None:
        try:
            with os.fdopen(reading) as said:
                counts = _counted(Asking(said.readline().split()[-1]), entered)
            os.write(output, f"{json.dumps(counts)}\n".encode())
        finally:
            os.kill(os.getpid(), signal.SIGTERM)

    threading.Thread(target=ask_and_end).start()
    threading.setprofile(entered)
    sys.setprofile(entered)
    command.main(["--port", "0", "--data-dir", folder])


def _counted(ask: Asking, entered: Entered) -> dict[str, tuple[int, ...]]:
    counts: dict[str, tuple[int, ...]] = {}
    for name, prepare in FLOWS.items():
        prepare(ask, 0)()  # fills what is filled once
        times = []
        for number in range(1, REPEATS + 1):
            flow = prepare(ask, number)
            time.sleep(REST)  # what was asked before has ended
            with entered.counting() as codes:
                flow()
            times.append(codes)
        always = set.intersection(*times)
        counts[name] = (len({code.co_filename for code in always}), len(always))
    return counts


if __name__ == "__main__":
    _serve(sys.argv[1])
