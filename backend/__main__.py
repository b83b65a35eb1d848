"""`python -m backend`: serve the dashboard and the API; and what the command `ridelab` leaves to an installed server.

Worker processes import this module too when they are spawned, so it imports the web stack only when it serves.
"""

import argparse
import errno
import gc
import json
import logging
import os
import signal
import socket
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fastapi import FastAPI

    from backend.settings import Settings

OWN_NAMES = "localhost,*.localhost,127.0.0.1,::1"  # of this machine
AT_HOME = "; its data are in {}, which a volume with a name keeps; links to localhost open on this machine alone"
INTERRUPTED, TERMINATED = 130, 143  # exit codes after Ctrl-C and SIGTERM, as shells give them
DEADLINE = 9.0  # an ordered end takes at most so long [s]; SIGTERM promises ten


def main(arguments: list[str] | None = None) -> int:
    """Serve until SIGTERM or SIGINT; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m backend", description="Serve Ridelab's dashboard and API.")
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default %(default)s)")
    parser.add_argument(
        "--port", type=_port, default=8000, help="port to listen on, 0 for a free one (default %(default)s)"
    )
    parser.add_argument("--data-dir", help="where the database lives (default data, or RIDELAB_DATA_DIR)")
    parser.add_argument(
        "--explain-limits", action="store_true", help="print what clients may have open at once, and end"
    )
    # What `ridelab` asks for; people find it there.
    for switch in ("--say-where", "--open", "--or-free-port", "--until-input-ends", "--force", "--json"):
        parser.add_argument(switch, action="store_true", help=argparse.SUPPRESS)
    for file in ("--back-up", "--drive"):
        parser.add_argument(file, type=Path, help=argparse.SUPPRESS)
    parser.epilog = "Further settings are environment variables RIDELAB_*; see docs/how-to/operations.md."
    options = parser.parse_args(arguments)

    from backend.command_error import CommandError

    commands = {"drive": _drive, "back_up": _back_up, "explain_limits": _explain_limits}
    command = next((each for name, each in commands.items() if getattr(options, name)), None)
    try:
        if command is not None:
            return command(options)
        if options.until_input_ends:
            threading.Thread(target=_end_with_the_input, daemon=True).start()
        ending = _Ending()
        signal.signal(signal.SIGTERM, ending)
        settings = _serving(_settings(options), options.host)
        settings.data_dir.mkdir(parents=True, exist_ok=True)
        listener = listen(options.host, options.port, or_free=options.or_free_port)
        app = _application(settings)
    except (CommandError, OSError) as error:
        print(("" if command else "Ridelab does not start: ") + _reason(error), file=sys.stderr)
        return 2
    except KeyboardInterrupt:  # a start may wait for a lock on the database
        return INTERRUPTED

    from backend import logs
    from backend.settings import removed_in

    logs.configure(settings.log_level)
    if removed := removed_in(os.environ):
        logging.getLogger("backend").warning(removed)
    return _serve(app, settings, listener, options, ending)


class _Ending:
    """Define what SIGTERM does before the server handles it, and when the server hands it on after its end.

    The kernel has no default action for process 1, as which a container starts a service.
    """

    def __init__(self) -> None:
        self.in_order = False

    def __call__(self, sig: int, _: object) -> None:
        """End at once; do nothing after a server that has ended in order, whose exit code is 0."""
        if not self.in_order:
            signal.signal(sig, signal.SIG_DFL)
            signal.raise_signal(sig)
            os._exit(TERMINATED)


def _say(text: str, value: Any, *, as_json: bool) -> None:
    """An answer in words, or the value for machines."""
    print(json.dumps(value, indent=1, default=str) if as_json else text, flush=True)


def _reason(error: Exception) -> str:
    return f"{error.filename}: {error.strerror}" if isinstance(error, OSError) and error.filename else str(error)


def _settings(options: argparse.Namespace) -> "Settings":
    from backend.settings import Settings

    return Settings.from_environment(os.environ, data_dir=options.data_dir)


def _serving(settings: "Settings", host: str) -> "Settings":
    """Return the settings of a service that listens there: on loopback it answers to this machine's own names.

    Else a page elsewhere could have a name of its own point to this machine, and use the service by it.
    """
    if settings.hosts or host not in ("localhost", "127.0.0.1", "::1"):
        return settings
    return settings.model_copy(update={"allowed_hosts": OWN_NAMES})


def _is_in_container_for_one(settings: "Settings", host: str) -> bool:
    """Check whether it listens to everybody and answers to its own names alone, as the image does by itself."""
    to_everybody = host in ("0.0.0.0", "::")  # noqa: S104 - compared, nothing is opened
    return to_everybody and bool(settings.hosts) and settings.hosts <= set(OWN_NAMES.split(","))


def _end_with_the_input() -> None:
    """A command that started this service holds the other end of its input: however it ends, the input ends with it."""
    while os.read(0, 4096):
        pass
    os.kill(os.getpid(), signal.SIGTERM)


def _explain_limits(options: argparse.Namespace) -> int:
    from backend.gate import Gate, explained

    limits = Gate(_settings(options)).limits()
    _say(explained(limits), limits, as_json=options.json)
    return 0


def _back_up(options: argparse.Namespace) -> int:
    from dataclasses import asdict

    from backend.db.backup import back_up

    file = options.back_up
    copy = back_up(_settings(options), file, overwrite=options.force)
    waited = f"writes waited {copy.seconds:.2f} s at most"
    text = f"{file}: {copy.size / 1e6:.1f} MB, a copy of {copy.database}; {waited}"
    _say(text, {"file": file, **asdict(copy)}, as_json=options.json)
    return 0


def _drive(options: argparse.Namespace) -> int:
    """A built ECU program drives the scenario on standard input."""
    from dataclasses import asdict

    from pydantic import ValidationError

    from backend.command_error import CommandError
    from backend.ecu.program import driven
    from sim_core.errors import RidelabError
    from sim_core.scenario import Scenario

    try:
        drive = driven(Scenario.model_validate_json(sys.stdin.buffer.read()), options.drive)
    except (RidelabError, ValidationError) as error:
        raise CommandError(str(error)) from None
    _say("\n".join(drive.lines()), asdict(drive), as_json=options.json)
    return 0


def _application(settings: "Settings") -> "FastAPI":
    """The application; its workers import the core while this process imports the web stack and opens the database.

    Raises:
        CommandError: The database cannot be used.
    """
    from backend.compute.workers import RESERVED, Workers
    from backend.runs import WARM_UP

    workers = Workers(settings.workers, timeout=settings.run_timeout, warm_up=WARM_UP, reserved=RESERVED)
    workers.begin()
    gc.disable()  # what is imported stays: to look for garbage in it takes a tenth of the start

    from sqlalchemy.exc import SQLAlchemyError

    from backend.app import create_app
    from backend.command_error import CommandError
    from backend.compute import memory

    memory.return_freed_memory()
    try:
        app = create_app(settings, workers)
        app.state.services.store.migrate()
    except (SQLAlchemyError, ImportError) as error:
        raise CommandError(str(error)) from None
    finally:
        gc.freeze()
        gc.enable()
    return app


def listen(host: str, port: int, *, or_free: bool = False) -> socket.socket:
    """A listening socket: taken before anything else starts, so that a port in use is said at once.

    Args:
        host: Name or address.
        port: 0 is a free one.
        or_free: Take a free one where somebody has that port.

    Raises:
        OSError: The port cannot be had.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    # IPPROTO_TCP, or asyncio does not recognise TCP, leaves Nagle's algorithm on, and each answer takes 40 ms more.
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()  # two that are only bound may have one port
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRINUSE and or_free:
            return listen(host, 0)
        remedy = "; --port names another one, as does make run PORT=" if error.errno == errno.EADDRINUSE else ""
        raise OSError(f"{host} port {port}: {error.strerror}{remedy}") from None
    return listener


def _serve(
    app: "FastAPI", settings: "Settings", listener: socket.socket, options: argparse.Namespace, ending: _Ending
) -> int:
    import asyncio
    import webbrowser

    import uvicorn

    from backend.http.server import raise_file_limit, server_config

    raise_file_limit()

    class RidelabServer(uvicorn.Server):
        """Says where it listens, and ends in time whatever hangs."""

        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            await super().startup(sockets)
            if self.started:
                self._announcing = asyncio.create_task(self._announce())

        async def _announce(self) -> None:
            """Print the address, once a worker is warm; until then /readyz says so to whoever asks."""
            await app.state.services.workers.wait_until_warm()
            at_home = _is_in_container_for_one(settings, options.host)
            host = "localhost" if at_home else options.host
            address = f"http://{f'[{host}]' if ':' in host else host}:{listener.getsockname()[1]}"
            where = f"\nIts data are in {settings.shown_store}\nCtrl-C ends it" * options.say_where
            where += AT_HOME.format(settings.shown_store) * at_home
            said = {"address": address, "data_dir": settings.data_dir.absolute()}
            _say(f"Ridelab is at {address}{where}", said, as_json=options.json)
            if options.open:
                await asyncio.to_thread(webbrowser.open, address)

        def handle_exit(self, sig: int, frame: object) -> None:
            ending.in_order = True
            timer = threading.Timer(DEADLINE, os._exit, (1,))
            timer.daemon = True
            timer.start()
            super().handle_exit(sig, frame)  # type: ignore[arg-type]  # uvicorn wants FrameType

    server = RidelabServer(server_config(app, settings))
    try:
        server.run(sockets=[listener])
    except KeyboardInterrupt:  # uvicorn ended in order, then hands the signal on
        return INTERRUPTED
    return 0 if server.started else 1


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text) <= 65535):
        raise argparse.ArgumentTypeError("a number from 0 to 65535")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
