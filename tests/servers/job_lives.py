"""Jobs of a service that is killed at any moment: submitted, cancelled, resumed, deleted in any order (hypothesis)."""

import contextlib
import os
import random
import signal
import socket
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any, cast

import httpx
import psutil
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    Bundle,
    RuleBasedStateMachine,
    consumes,
    initialize,
    invariant,
    rule,
    run_state_machine_as_test,
)

from tests.api import tuning
from tests.api.streams import read_events
from tests.servers.accepted import Accepted
from tests.servers.forwarder import Direction, Forwarder
from tests.servers.process import FORK_SERVER, HANG_TIMEOUT, Api, Program, ask, request, wait_until

Victim = Callable[[], object]  # what is done to a program
FINAL = ("done", "cancelled", "failed")
# Some minutes of a core: an end that waited for it would be taken for one that hangs.
ENDLESS = {
    "road": {"length": 1500.3, "bump": {"start": 30}},
    "mpc": {"solver": "osqp", "force_limit": 500, "prediction_horizon": 100, "control_horizon": 80},
}
TUNING = {**tuning.REQUEST, "strategy": "lqr", "trials": 8, "population": 4}
UNPLANNED = {"strategies": ["passive"], "sweep": {"list": [{"road.profile": "A" * 22}]}}  # nobody sent such a road
RUN = {"scenario": {"road": {"length": 131.7}}, "strategies": ["lv", "passive"]}


class JobLives(RuleBasedStateMachine):
    """What was accepted ends as its last request says, each result is stored once, and nothing stored changes.

    Args:
        accepted: The service and its database.
        victims: What may be done to it and to its surroundings.
    """

    jobs: Bundle[str] = Bundle("jobs")

    def __init__(self, accepted: Accepted, victims: Sequence[Victim]) -> None:
        super().__init__()
        self._accepted = accepted
        self._victims = victims
        self._ends: dict[str, str] = {}  # by path the state in which the job has to end
        self._run = ask(accepted.url, "POST", "/runs", json=RUN)
        self._link = ask(accepted.url, "POST", "/links", json={"run_id": self._run["id"], "view": {"zoom": [1, 2]}})
        self._series = self._read_series()

    @initialize(target=jobs)
    def begin_with_a_batch(self) -> str:
        """Every life has one, and a tuning, and meets each victim once."""
        return self._submit_batch(200)

    @initialize(target=jobs)
    def begin_with_a_tuning(self) -> str:
        """Likewise."""
        return self._submit_tuning()

    @initialize()
    def begin_with_every_victim(self) -> None:
        """Likewise."""
        for victim in self._victims:
            self._accepted.await_work()
            victim()

    @rule(target=jobs, runs=st.sampled_from([2, 60, 400]))
    def submit_a_batch(self, runs: int) -> str:
        """Of few or of many runs."""
        return self._submit_batch(runs)

    @rule(target=jobs)
    def submit_a_batch_that_cannot_be_planned(self) -> str:
        """Refused by its planning."""
        return self._expect(f"/batches/{ask(self._accepted.url, 'POST', '/batches', json=UNPLANNED)['id']}", "failed")

    @rule(target=jobs)
    def submit_a_tuning(self) -> str:
        """Taken step by step."""
        return self._submit_tuning()

    @rule(job=jobs)
    def cancel(self, job: str) -> None:
        """Cancel it; where it has ended, it stays as it is."""
        state = ask(self._accepted.url, "POST", f"{job}/cancel")["state"]
        assert state in ("cancelled", self._ends[job])
        self._ends[job] = state

    @rule(job=jobs)
    def resume(self, job: str) -> None:
        """Continue one that was cancelled."""
        if self._ends[job] == "cancelled":
            ask(self._accepted.url, "POST", f"{job}/resume")
            self._ends[job] = "done"

    @rule(job=consumes(jobs))
    def delete(self, job: str) -> None:
        """Delete one that was cancelled: what others have of its results stays."""
        self.cancel(job)
        path = f"{self._accepted.url}/api/v1{job}"

        def is_gone() -> bool:
            request("DELETE", path)
            return request("GET", path).status_code == 404

        wait_until(is_gone, "it is deleted")
        del self._ends[job]
        self._accepted.forget(job)

    @rule(number=st.integers(0, 1000), seconds=st.floats(0, 1))
    def kill(self, number: int, seconds: float) -> None:
        """Do something to one of the victims, at any moment."""
        time.sleep(seconds)  # the moment is what chance is for
        self._victims[number % len(self._victims)]()

    @rule()
    def await_work(self) -> None:
        """Let it compute."""
        self._accepted.await_work()

    @invariant()
    def results_stay(self) -> None:
        """Each stored result is the same row."""
        self._accepted.check_stored()

    def teardown(self) -> None:
        """Wait for each job's end, and check all that it has."""
        for job, end in self._ends.items():
            self._check(job, end)
        self._accepted.check_stored()
        again = ask(self._accepted.url, "POST", "/runs", json=RUN)
        assert again["strategies"] == {
            name: {**each, "cached": True} for name, each in self._run["strategies"].items()
        }, "a stored run is not computed again"
        link = ask(self._accepted.url, "GET", f"/links/{self._link['slug']}")
        assert (link["series_pinned"], link["view"]) == (True, {"zoom": [1, 2]})
        assert self._read_series() == self._series

    def _check(self, job: str, end: str) -> None:
        answer: dict[str, Any] = {}

        def is_over() -> bool:
            answer.update(ask(self._accepted.url, "GET", job))
            return answer["state"] in FINAL

        wait_until(is_over, f"{job} ends", pause=0.2)
        assert answer["state"] == end, answer["reason"]
        with httpx.Client(base_url=self._accepted.url, timeout=HANG_TIMEOUT) as client:
            heard = read_events(client, f"/api/v1{job}/events")
        assert [event["id"] for event in heard] == list(range(1, len(heard) + 1))
        assert heard[-1]["state"] == end
        if job.startswith("/tunings"):
            done = ask(self._accepted.url, "GET", f"{job}/trials")["trials"] if end == "done" else []
            assert self._accepted.trials.setdefault(job if not done else "every", done) == done, "the search repeats"
        elif end != "failed":
            self._accepted.check_rows(answer)

    def _submit_batch(self, runs: int) -> str:
        return self._expect(f"/batches/{self._accepted.submit(runs)}", "done")

    def _submit_tuning(self) -> str:
        return self._expect(f"/tunings/{ask(self._accepted.url, 'POST', '/tunings', json=TUNING)['id']}", "done")

    def _expect(self, job: str, end: str) -> str:
        self._ends[job] = end
        return job

    def _read_series(self) -> bytes:
        path = f"/runs/{self._run['id']}/series?strategy=lv,passive&encoding=base64"
        answer: dict[str, Any] = ask(self._accepted.url, "GET", path)
        return repr(sorted(answer.items())).encode()


def live(accepted: Accepted, victims: Sequence[Victim], *, lives: int, steps: int) -> None:
    """Go through so many lives of at most so many steps."""
    as_listed = settings(
        max_examples=lives,
        stateful_step_count=steps,
        phases=[Phase.generate],  # real processes repeat nothing to the letter
        suppress_health_check=list(HealthCheck),
    )
    run_state_machine_as_test(cast(type[JobLives], lambda: JobLives(accepted, victims)), settings=as_listed)


def killing(program: Program) -> Victim:
    """Kill -9 the program itself; what it started is left to notice."""

    def kill() -> None:
        if program.running:
            program.kill()

    return kill


def killing_a_worker(program: Program, chance: random.Random) -> Victim:
    """Kill -9 one of the processes that compute for it."""

    def kill() -> None:
        workers = [each for each in program.children() if _is_forked(each)]
        if workers:
            with contextlib.suppress(psutil.NoSuchProcess):
                chance.choice(workers).kill()

    return kill


def _is_forked(process: psutil.Process) -> bool:
    with contextlib.suppress(psutil.NoSuchProcess):
        return FORK_SERVER in " ".join(process.cmdline())  # a worker, or what forks them
    return False


def ending(api: Api) -> Victim:
    """End it in order: it waits neither for a computation nor for a client that never sends the rest of its request."""

    def ask_for_ever() -> None:
        with contextlib.suppress(httpx.TransportError):  # the service ends before it answers
            request("POST", f"{api.url}/api/v1/runs", json={"scenario": ENDLESS, "strategies": ["lv"]}, timeout=3600)

    def end() -> None:
        api.wait_until_ready()
        threading.Thread(target=ask_for_ever, daemon=True).start()
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", api.port)) as connection:
            connection.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n\r\n{")
            api.terminate()

    return end


def pausing(program: Program, chance: random.Random, longest: float) -> Victim:
    """Stop the program (SIGSTOP) for up to so many seconds, and wake it into a world that has moved on."""

    def pause() -> None:
        if not program.running:
            return
        pid = program.pid
        os.kill(pid, signal.SIGSTOP)

        def wake() -> None:
            with contextlib.suppress(ProcessLookupError):  # it was killed meanwhile
                os.kill(pid, signal.SIGCONT)

        threading.Timer(chance.uniform(1, longest), wake).start()

    return pause


def silencing(forwarder: Forwarder, direction: Direction, chance: random.Random, longest: float) -> Victim:
    """Have the database's connections swallow what is sent in that direction, for up to so many seconds."""

    def swallow() -> None:
        with forwarder.blocked(direction):
            time.sleep(chance.uniform(1, longest))

    return lambda: threading.Thread(target=swallow, daemon=True).start()
