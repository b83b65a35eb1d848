"""docker-compose.yml as plain processes: its commands and environments, with this machine's addresses and files."""

import re
import sys
from pathlib import Path
from typing import Any

import yaml
from sqlalchemy import make_url

from tests.servers.haproxy import Proxy
from tests.servers.postgres import Postgres
from tests.servers.process import ROOT, Ends, Program, reserved_port, wait_until
from tests.servers.programs import make_secrets

COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
VARIABLE = re.compile(r"\$\{(\w+):-([^{}]*)\}")  # with its default, which has no other variable inside


class Topology(Ends):
    """Proxy, two replicas of the API, PostgreSQL, a Dask scheduler and two workers; whatever dies is started again."""

    def __init__(self, folder: Path, postgres: Postgres, *, port: int | None = None, **variables: str) -> None:
        self.folder = folder
        self._database_port = port or postgres.port  # at which the replicas ask it
        self.database = postgres.new_database()
        self._variables = variables
        self._scheduler_port = reserved_port()
        self._secrets()
        self.scheduler = self._start("scheduler")
        self.workers = [self._start("worker", number) for number in (1, 2)]
        self._ports = [reserved_port(), reserved_port()]
        self.replicas = [self._start("api", number) for number in (1, 2)]
        self.proxy = Proxy(folder, [f"127.0.0.1:{port}" for port in self._ports])

    @property
    def url(self) -> str:
        """Where the proxy serves."""
        return self.proxy.url

    @property
    def programs(self) -> list[Program]:
        """All of it but the database."""
        return [self.proxy, *self.replicas, *self.workers, self.scheduler]

    def replica_url(self, number: int) -> str:
        """One replica's own address, past the proxy."""
        return f"http://127.0.0.1:{self._ports[number]}"

    def wait_until_ready(self) -> None:
        """Wait until the proxy has a ready replica."""
        wait_until(lambda: self.proxy.answers("/readyz"), "a replica gets ready")

    def end(self) -> None:
        """End everything, whatever became of it."""
        for program in self.programs:
            program.end()

    def _secrets(self) -> None:
        url = make_url(self.database)
        self._passwordless = f"{url.drivername}://{url.username}@{url.host}:{self._database_port}/{url.database}"
        (self.folder / "secrets").mkdir()
        (self.folder / "secrets/database_password").write_text(f"{url.password}\n")
        make_secrets(self.folder / "secrets")

    def _start(self, service: str, number: int = 1) -> Program:
        content = COMPOSE["services"][service]
        words = [self._here(word) for word in content.get("command", self._image_command())]
        set_here = {name: value for name, value in content["environment"].items() if value is not None}  # else by .env
        environment = {name: self._here(value) for name, value in set_here.items()}
        words[0] = sys.executable
        if words[2] == "dask":
            words.append("--host=127.0.0.1")  # a container's network is its own, this machine's is not
        name = f"{service}-{number}"
        if service == "api":
            words[words.index("0.0.0.0")] = "127.0.0.1"  # noqa: S104 - what a container listens on
            words[words.index("8000")] = str(self._ports[number - 1])
            environment |= {"RIDELAB_DATABASE_URL": self._passwordless, "RIDELAB_DATA_DIR": str(self.folder / name)}
        return Program(name, words, folder=self.folder, environment=environment | self._variables, restart=True)

    def _here(self, value: str) -> str:
        """A word of the compose file as it is on this machine."""
        here = {f"/run/secrets/{name}": str(self.folder / item["file"]) for name, item in COMPOSE["secrets"].items()}
        here |= {
            "/app/": f"{ROOT}/",
            "/controllers": f"{self.folder}/controllers",
            "/fmu": f"{self.folder}/fmu",
            "/tmp/": f"{self.folder}/",  # noqa: S108 - a container's
            "scheduler:8786": f"127.0.0.1:{self._scheduler_port}",
            "--port=8786": f"--port={self._scheduler_port}",
            "127.0.0.1:8787": "127.0.0.1:0",
        }
        while VARIABLE.search(value):
            value = VARIABLE.sub(lambda match: self._variables.get(match[1], match[2]), value)
        return re.sub("|".join(map(re.escape, here)), lambda match: here[match[0]], value)

    def _image_command(self) -> Any:
        text = (ROOT / "Dockerfile").read_text()
        (command,) = re.findall(r"^CMD (\[.*\])$", text, re.MULTILINE)
        return yaml.safe_load(command)
