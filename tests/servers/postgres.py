"""A real PostgreSQL of our own: its files in a new folder, a port of its own, gone afterwards."""

import contextlib
import itertools
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from urllib.parse import quote

import psutil
import psycopg

from tests.servers.process import HANG_TIMEOUT, reserved_port
from tests.servers.programs import find, unprivileged

USER = "ridelab"
PASSWORD = "p@ss/wörd:1"  # noqa: S105 - with everything a URL has to escape
# Nothing here outlives a power cut: a killed server loses nothing without fsync, and starts much faster.
SETTINGS = {"fsync": "off", "full_page_writes": "off", "max_connections": "200", "unix_socket_directories": ""}


class Postgres:
    """A server that a test may stop, start and kill; the port stays the same."""

    def __init__(self) -> None:
        # Not in pytest's folder: that one only root may enter, and PostgreSQL does not run as root.
        self.folder = Path(tempfile.mkdtemp(prefix="ridelab-postgres-"))
        self.port = reserved_port()
        self._as_user = unprivileged("postgres")
        self._process: subprocess.Popen[bytes] | None = None
        self._names = (f"test_{number}" for number in itertools.count())
        if self._as_user:
            os.chown(self.folder, self._as_user["user"], self._as_user["group"])
        self._initialise()

    @property
    def running(self) -> bool:
        """Whether the server's first process lives."""
        return self._process is not None and self._process.poll() is None

    @property
    def log(self) -> str:
        """The server's log so far."""
        return (self.folder / "log").read_text(errors="replace")

    def start(self) -> None:
        """Start, and wait until it answers; nothing where it runs already."""
        if self.running:
            return
        options = [f"-c{name}={value}" for name, value in SETTINGS.items()]
        command = [program("postgres"), "-D", str(self.folder / "data"), "-h127.0.0.1", f"-p{self.port}", *options]
        with (self.folder / "log").open("ab") as log:
            self._process = subprocess.Popen(command, cwd=self.folder, stdout=log, stderr=log, **self._as_user)
        end = time.monotonic() + HANG_TIMEOUT
        while time.monotonic() < end and self._process.poll() is None:
            try:
                self._connect().close()
            except psycopg.OperationalError:
                time.sleep(0.05)
            else:
                return
        raise RuntimeError(f"PostgreSQL did not start:\n{self.log[-3000:]}")

    def stop(self) -> None:
        """End it in order; open connections are closed."""
        if self._process is not None:
            self._process.send_signal(signal.SIGINT)
            self._process.wait(HANG_TIMEOUT)
            self._process = None

    def kill(self) -> None:
        """Kill -9 every process of it at once."""
        if self._process is not None:
            first = psutil.Process(self._process.pid)
            first.suspend()  # it starts no other meanwhile
            family = [first, *first.children(recursive=True)]
            for process in family:
                with contextlib.suppress(psutil.NoSuchProcess):
                    process.kill()
            self._process.wait()
            psutil.wait_procs(family[1:], timeout=HANG_TIMEOUT)  # one that still dies holds the memory they share
            self._process = None

    def new_database(self, template: str | None = None) -> str:
        """The SQLAlchemy URL of a new database; starts the server where somebody left it stopped.

        Args:
            template: The name of one that it shall be a copy of, which nobody is connected to; None for an empty one.
        """
        self.start()
        name = next(self._names)
        self.execute(f"CREATE DATABASE {name}" + (f" TEMPLATE {template}" if template else ""))
        return self.url(name)

    def url(self, name: str) -> str:
        """The SQLAlchemy URL of that database."""
        return url(self.port, name)

    def execute(self, statement: str) -> list[tuple[object, ...]]:
        """Run one statement as the administrator, outside a transaction; what it returns, if anything."""
        with self._connect() as connection:
            cursor = connection.execute(statement.encode())
            return cursor.fetchall() if cursor.description else []

    def remove(self) -> None:
        """Kill it and delete its files."""
        self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _connect(self) -> psycopg.Connection[tuple[object, ...]]:
        return psycopg.connect(
            host="127.0.0.1",
            port=self.port,
            user=USER,
            password=PASSWORD,
            dbname="postgres",
            connect_timeout=int(HANG_TIMEOUT),
            autocommit=True,
        )

    def _initialise(self) -> None:
        secret = self.folder / "password"
        secret.write_text(PASSWORD)
        secret.chmod(0o644)
        options = [f"--username={USER}", f"--pwfile={secret}", "--auth=scram-sha-256", "--encoding=UTF8", "--locale=C"]
        command = [program("initdb"), f"--pgdata={self.folder / 'data'}", "--no-sync", *options]
        done = subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, timeout=HANG_TIMEOUT, check=False, **self._as_user
        )
        if done.returncode != 0:
            raise RuntimeError(f"initdb failed:\n{done.stdout}{done.stderr}")


def url(port: int, name: str) -> str:
    """The SQLAlchemy URL of a database at that port of this machine."""
    return f"postgresql+psycopg://{USER}:{quote(PASSWORD, safe='')}@127.0.0.1:{port}/{name}"


def program(name: str) -> str:
    """The path of one of PostgreSQL's programs."""
    return find(name, package="postgresql", folders="usr/lib/postgresql/*/bin")
