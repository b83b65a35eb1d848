"""Services a command works with: those at an address, or a private one that ends with the command."""

import importlib.util
import inspect
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import cached_property
from pathlib import Path
from typing import IO, Any, NoReturn

import typer

from ridelab import __version__
from ridelab.cli.in_process import InProcess
from ridelab.cli.names import Names
from ridelab.cli.options import Controllers, DataDir, Server
from ridelab.cli.reporting import InputError, UnavailableError, note, waiting
from ridelab.client import Ridelab
from ridelab.errors import RidelabAPIError, RidelabClientError, RidelabConnectionError
from ridelab.http import without_login

START = 90.0  # the private service gets so long to start [s]; it takes one or two
END = 15.0  # and so long to end; the service itself promises ten
_CONTROLLERS = "RIDELAB_CONTROLLERS"
_ADDRESS = re.compile(r"^Ridelab is at (http://\S+)$", re.MULTILINE)


def server_command(*arguments: str, data_dir: Path | None = None) -> list[str]:
    """The command line of `python -m backend`, which only an installed server has."""
    core = core_folder()
    if core is None or not (core / "backend" / "__main__.py").is_file():  # another `backend` may be anybody's
        raise UnavailableError(
            "Ridelab's server is not installed here: `pip install` takes the files of its wheels by their paths, "
            f"ridelab_server-{__version__}-….whl and ridelab_core-{__version__}-….whl for this platform, `make setup` "
            "installs it in the folder of the sources; with --server or RIDELAB_SERVER most commands work with a "
            "service elsewhere"
        )
    where = str(data_dir or default_data_dir())
    return [sys.executable, "-P", "-m", "backend", *arguments, "--data-dir", where]


def server_environment() -> dict[str, str]:
    """The environment in which Python imports the server beside this core, whatever the current folder holds."""
    paths = [str(core_folder() or ""), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in paths if path)}


def check_core() -> None:
    """Refuse where the core is not installed."""
    if core_folder() is None:
        raise UnavailableError(
            "Ridelab's core is not installed here: `pip install` takes the file of its wheel by its path, "
            f"ridelab_core-{__version__}-….whl for this platform, or ./sim_core in the folder of the sources"
        )


def core_folder() -> Path | None:
    """Return the folder of the core, and of the server beside it if there is one; None without a core."""
    spec = importlib.util.find_spec("sim_core")
    return None if spec is None or spec.origin is None else Path(spec.origin).parents[1]


def default_data_dir() -> Path:
    """Return where the server keeps its data by default: ./data if that is there, else the system's folder for data."""
    here = Path("data")
    if here.is_dir():
        return here
    if sys.platform == "win32":
        folder = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        folder = Path.home() / "Library" / "Application Support"
    else:
        folder = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    return folder / "ridelab"


def end_as_server(*arguments: str, content: bytes = b"", data_dir: Path | None = None, as_json: bool) -> NoReturn:
    """Run the server's own command, which reads that content, and end as it ends."""
    command = server_command(*arguments, *["--json"] * as_json, data_dir=data_dir)
    run = subprocess.run(command, env=server_environment(), input=content, check=False)  # noqa: S603  # no shell
    raise typer.Exit(run.returncode)


class Services(ExitStack):
    """Connections, opened when first needed and closed together; a context manager.

    Args:
        server: Address of the service to work with; None starts a private one.
        data_dir: Where a private one keeps its database; None is its own default.
        controllers: Files with controllers of one's own, for a private one.
    """

    def __init__(self, server: str | None, data_dir: Path | None, controllers: Sequence[Path] = ()) -> None:
        super().__init__()
        self.server = server
        self.data_dir = data_dir
        self.controllers = controllers
        self.opened: dict[str | None, Ridelab] = {}  # None is the private one
        self.doing = "Waiting for the service"  # said while an answer takes long

    @property
    def private(self) -> bool:
        """Check whether the service ends with the command."""
        return self.server is None

    @cached_property
    def names(self) -> Names:
        """The service's fields, strategies, presets and signals by name."""
        return Names.of(self.quick)

    @cached_property
    def quick(self) -> Ridelab:
        """For names, and runs that need not be stored: this process where nobody names a service or its data.

        A controller of one's own has a process of its own, which a service gives it.
        """
        from importlib.metadata import entry_points  # as the core finds them, which is imported then too

        own = self.controllers or os.environ.get(_CONTROLLERS) or entry_points(group="ridelab.controllers")
        in_process = self.private and self.data_dir is None and not own and core_folder() is not None
        return InProcess(self.at) if in_process else self.at()

    @property
    def options(self) -> list[str]:
        """The options that name the same service in another command."""
        if self.server is not None:
            return ["--server", without_login(self.server)]
        return [] if self.data_dir is None else ["--data-dir", str(self.data_dir)]

    def place_of(self, run_id: str) -> str:
        """A run's address; of a private service, which ends with the command, what shows it."""
        if self.private:
            return f"run {run_id}; {shlex.join(['ridelab', 'open', run_id, *self.options])} shows it"
        return f"{self.at().address}/r/{run_id}"

    def at(self, server: str | None = None) -> Ridelab:
        """The client of the service there; None is the one the command works with."""
        address = server or self.server
        if server is not None and self.server is not None and server == without_login(self.server).rstrip("/"):
            address = self.server  # messages show addresses without their login
        if address not in self.opened:
            url = address if address is not None else self.enter_context(private(self.data_dir, self.controllers))
            token = None if address is not None and address == self.server else ""  # nobody else is told it
            try:
                self.opened[address] = self.enter_context(Ridelab(url, token=token))
                self.opened[address]._http.meanwhile = lambda: waiting(self.doing)
            except ValueError as error:
                raise InputError(f"--server or RIDELAB_SERVER: {error}") from None
        return self.opened[address]


def with_services(command: Callable[..., None], *, drives: bool) -> Callable[..., None]:
    """A command as typer takes it: `services`, its first argument, comes from options that name a service.

    Args:
        command: The command.
        drives: Whether it drives strategies, of one's own too.
    """

    def run(server: Server = None, data_dir: DataDir = None, controller: Controllers = None, **arguments: Any) -> None:
        if server is not None and controller:
            raise InputError(
                "--controller: a service runs only the files that its operator named; leave out --server and "
                "RIDELAB_SERVER, or set RIDELAB_CONTROLLERS where the service is started"
            )
        with Services(server, data_dir, controller or ()) as services:
            command(services, **arguments)

    own = list(inspect.signature(command).parameters.values())[1:]
    named = list(inspect.signature(run).parameters.values())[: 3 if drives else 2]
    parameters = [each.replace(kind=inspect.Parameter.KEYWORD_ONLY) for each in (*own, *named)]
    run.__doc__ = command.__doc__
    run.__annotations__ = {each.name: each.annotation for each in parameters}
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]  # what inspect.signature reads first
    return run


@contextmanager
def private(data_dir: Path | None, controllers: Sequence[Path] = ()) -> Iterator[str]:
    """A service on a free port of this machine, ended with the block; gives its address."""
    environment = server_environment()
    named = [*map(str, controllers), environment.get(_CONTROLLERS, "")]
    if controllers:
        environment[_CONTROLLERS] = os.pathsep.join(filter(None, named))
    environment.pop("RIDELAB_TOKENS_FILE", None)  # it answers this command alone
    with tempfile.TemporaryFile() as log:
        process = subprocess.Popen(  # noqa: S603  # our own module and a path, no shell
            server_command("--port", "0", "--until-input-ends", data_dir=data_dir),
            stdin=subprocess.PIPE,  # it ends with this pipe, and so with this process, however that ends
            stdout=log,
            stderr=log,
            env=environment,
            start_new_session=True,  # Ctrl-C is the command's: it may still need the service to cancel
        )
        try:
            yield _wait(process, log)
        except RidelabClientError as error:
            if _is_in_log(error):
                with tempfile.NamedTemporaryFile(prefix="ridelab-", suffix=".log", delete=False) as saved:
                    saved.write(_read(log))
                note(f"The private service's log is in {saved.name}")
            raise
        finally:
            if process.stdin is not None:
                process.stdin.close()
            try:
                process.wait(END)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _is_in_log(error: RidelabClientError) -> bool:
    """Check whether the service's log says more."""
    failed = isinstance(error, RidelabAPIError) and error.status >= 500
    return failed or isinstance(error, RidelabConnectionError) or "service's log" in str(error)


def _wait(process: subprocess.Popen[bytes], log: IO[bytes]) -> str:
    """The address the service prints once it serves."""
    end = time.monotonic() + START
    with waiting("Starting a private service"):
        while time.monotonic() < end:
            ended = process.poll() is not None
            text = _read(log).decode(errors="replace")
            address = _ADDRESS.search(text)
            if address is not None:
                return address[1]
            if ended:  # it says why to people, or in its last log entry
                lines = [line for line in text.splitlines() if line.strip()]
                plain = [line for line in lines if not line.startswith("{")]
                raise UnavailableError("\n".join(plain or lines[-1:]) or "The private service ended without a word")
            time.sleep(0.02)  # the log is a file, which nothing can wait on
    raise UnavailableError(f"The private service did not start within {START:.0f} s")


def _read(log: IO[bytes]) -> bytes:
    """All of it, whatever the process that writes it has its place at."""
    return os.pread(log.fileno(), os.fstat(log.fileno()).st_size, 0)
