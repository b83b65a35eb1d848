"""Containers of a real engine: `docker` and `docker compose` as commands, the service in them over HTTP."""

import contextlib
import json
import os
import shutil
import signal
import ssl
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import httpx
import yaml

from tests.servers.process import ROOT

PROJECT = "ridelab-drill"
SERVICES = ("proxy", "api", "scheduler", "worker", "database")
PORTS = {"PORT": "8061", "TLS_PORT": "8461"}
SWEEP = {"road.bump.height": [0.02, 0.15], "vehicle.body_mass": [1000, 1500]}
ANY_CERTIFICATE = ssl.create_default_context()  # the proxy has one that signed itself
ANY_CERTIFICATE.check_hostname, ANY_CERTIFICATE.verify_mode = False, ssl.CERT_NONE
LONGEST_COMMAND = 1800.0  # a build [s]


def docker(
    *words: str, check: bool = True, folder: Path | None = None, environment: Mapping[str, str] | None = None
) -> str:
    """Return what a command prints."""
    done = subprocess.run(
        ["docker", *words],
        capture_output=True,
        text=True,
        timeout=LONGEST_COMMAND,
        check=False,
        cwd=folder,
        env={**os.environ, **(environment or {})},
    )
    assert not check or done.returncode == 0, (words, done.stdout[-3000:], done.stderr[-3000:])
    return done.stdout.strip()


def wait(condition: Callable[[], object], what: str, limit: float = 180, pause: float = 0.3) -> float:
    """Return after how many seconds it held."""
    begun = time.monotonic()
    while time.monotonic() < begun + limit:
        with contextlib.suppress(AssertionError, httpx.HTTPError, ValueError, KeyError):
            if condition():
                return time.monotonic() - begun
        time.sleep(pause)  # before it is looked at again
    raise TimeoutError(what)


class Site:
    """A service by its address."""

    def __init__(self, url: str) -> None:
        self.url = url

    def request(self, method: str, path: str, **options: Any) -> httpx.Response:
        """Return the answer, whatever its status; `path` may be a whole address."""
        address = path if "://" in path else f"{self.url}{path}"
        return httpx.request(method, address, timeout=120, verify=ANY_CERTIFICATE, **options)

    def attempt(self, method: str, path: str, body: Any = None) -> int:
        """Return the status of the answer; 0 where there is none."""
        try:
            return self.request(method, path, json=body).status_code
        except httpx.TransportError:
            return 0

    def ask(self, method: str, path: str, body: Any = None, **options: Any) -> Any:
        """Return the JSON of an answer of the API, which has to be fine."""
        answer = self.request(method, f"/api/v1{path}", json=body, **options)
        assert answer.is_success, (path, answer.status_code, answer.text[:500])
        return answer.json()

    def run(self, *strategies: str, seed: int = 1) -> Any:
        """Return a run of the default scenario on that road."""
        return self.ask("POST", "/runs", {"scenario": {"road": {"seed": seed}}, "strategies": strategies})

    def batch(self, samples: int, *strategies: str) -> str:
        """Submit a new batch; return its id."""
        sweep = {"latin_hypercube": {"ranges": SWEEP, "samples": samples, "seed": time.time_ns() % 2**31}}
        body = {"scenario": {}, "strategies": strategies or ("lv",), "sweep": sweep}
        key = {"Idempotency-Key": str(time.time_ns())}
        return str(self.ask("POST", "/batches", body, headers=key)["id"])

    def progress(self, batch: str) -> Any:
        """Return how the batch stands."""
        return self.ask("GET", f"/batches/{batch}")

    def assert_complete(self, batch: str, runs: int) -> None:
        """Wait for the batch's end: each run is there, once, and none failed."""
        wait(lambda: self.progress(batch)["state"] in ("done", "failed"), "the batch ends", 600)
        end = self.progress(batch)
        assert (end["state"], end["done"], end["failed"]) == ("done", runs, 0), end
        table = self.request("GET", f"/api/v1/batches/{batch}/results?format=csv").text
        assert len(table.strip().splitlines()) == runs + 1


class Composed(Site):
    """docker-compose.yml of a folder, as a project of its own."""

    def __init__(self, folder: Path, **environment: str) -> None:
        super().__init__(f"http://localhost:{PORTS['PORT']}")
        self.secure = Site(f"https://localhost:{PORTS['TLS_PORT']}")
        self.folder = folder
        self.variables = {**os.environ, "COMPOSE_PROJECT_NAME": PROJECT, **PORTS, **environment}

    def compose(self, *words: str, check: bool = True, **variables: str) -> str:
        """Return what a command of Compose prints with these variables."""
        return docker("compose", *words, check=check, folder=self.folder, environment=self.variables | variables)

    def up(self, *words: str) -> float:
        """Start what is not running; return after how many seconds all are healthy."""
        begun = time.monotonic()
        self.compose("up", "--detach", "--wait", *words)
        if "database" not in words:  # alone
            wait(lambda: self.request("GET", "/readyz").status_code == 200, "the proxy has a replica", 30)
        return time.monotonic() - begun

    def containers(self, *services: str) -> list[str]:
        """Return the names of these services' containers, of all where none is named."""
        names = docker("ps", "-a", "--filter", f"label=com.docker.compose.project={PROJECT}", "--format", "{{.Names}}")
        return sorted(name for name in names.split() if not services or name.split("-")[-2] in services)

    def sql(self, query: str) -> list[str]:
        """Return the rows of an answer of the service's own role."""
        command = ("exec", "-T", "database", "psql", "-U", "ridelab", "-At", "-c", query)
        return self.compose(*command).splitlines()

    def leader(self) -> str | None:
        """Return the replica that drives the jobs: one of its connections has the lock."""
        rows = set(
            self.sql(
                "select host(client_addr) from pg_locks join pg_stat_activity using (pid) "
                "where locktype = 'advisory' and granted"
            )
        )
        for name in self.containers("api"):
            if rows & {each["IPAddress"] for each in inspect(name)["NetworkSettings"]["Networks"].values()}:
                return name
        return None

    def one_of(self, part: str) -> str:
        """Return a container of that service, or the `leader`."""
        if part == "leader":
            wait(self.leader, "somebody leads", 60)
            return str(self.leader())
        return self.containers(part)[0]

    def kill(self, name: str) -> None:
        """Kill -9 the first process of a container, as the kernel would: the engine itself starts it again."""
        os.kill(inspect(name)["State"]["Pid"], signal.SIGKILL)

    def healthy(self) -> bool:
        """Check whether all containers are."""
        lines = self.compose("ps", "-a", "--format", "{{.Health}} {{.State}}").splitlines()
        return bool(lines) and set(lines) == {"healthy running"}


def inspect(name: str) -> Any:
    """Return what the engine says of a container or an image."""
    return json.loads(docker("inspect", name))[0]


def volumes() -> set[str]:
    """Return the names of all volumes."""
    return set(docker("volume", "ls", "--quiet").split())


def checked_out(folder: Path) -> Path:
    """Return the folder with the repository's files as a clone has them whose owner's umask is 027."""
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():  # not one that is just being removed
            (folder / name).parent.mkdir(mode=0o750, parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, folder / name)
            (folder / name).chmod(0o750 if os.access(ROOT / name, os.X_OK) else 0o640)
    subprocess.run(["backend/deploy/secrets.sh"], cwd=folder, capture_output=True, check=True)
    return folder


def stand_ins(folder: Path) -> dict[str, str]:
    """Make the base images that `DRILL_BASES` stands for; return what a build then needs to know.

    `DRILL_BASES/bases.sh FOLDER` tags images with the names in that folder's Dockerfile and docker-compose.yml.
    """
    bases = os.environ.get("DRILL_BASES")
    if not bases:
        return {}
    done = subprocess.run([Path(bases, "bases.sh"), folder], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    services = yaml.safe_load((folder / "docker-compose.yml").read_text())["services"]
    builds = [name for name, service in services.items() if "build" in service]
    extra = {"services": {name: {"build": {"network": "host"}} for name in builds}}
    (folder / "stand-ins.json").write_text(json.dumps(extra))
    return {"COMPOSE_FILE": "docker-compose.yml:stand-ins.json"}


@contextlib.contextmanager
def running(site: Composed) -> Iterator[Composed]:
    """Yield the service, of which nothing is there before and after; its log is in `compose.log` of its folder."""
    site.compose("down", "--volumes", "--timeout", "15")
    try:
        yield site
    finally:
        (site.folder / "compose.log").write_text(site.compose("logs", "--no-color", check=False))
        site.compose("down", "--volumes", "--timeout", "15", check=False)
        print(f"its log is {site.folder}/compose.log")
