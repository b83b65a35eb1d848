"""`ridelab serve`, `demo`, `backup` and `open`: what is installed here, and results in the browser."""

import contextlib
import os
import signal
import sys
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from ridelab.cli import fields, options, targets
from ridelab.cli.reporting import note, print_json, say
from ridelab.cli.run import run
from ridelab.cli.service import Services, check_core, end_as_server, server_command, server_environment

_WHERE = f"Where the database is [default: {options.DATA_FOLDER}]."
_PORT = "Port to listen on, 0 for a free one [default: 8000, a free one where that is taken]."
_RESULT = "Scenario, preset, run id, batch id, link, or address of one."
_DEMO = "lv", "lqr", "passive"
DatabaseDir = Annotated[Path | None, options.option("DIR", _WHERE, envvar="RIDELAB_DATA_DIR", parser=options.folder)]


def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int | None, options.option("N", _PORT, min=0, max=65535)] = None,
    data_dir: DatabaseDir = None,
    open_page: Annotated[
        bool, typer.Option("--open/--no-open", help="Open the page in the browser, where there is a screen.")
    ] = True,
    explain_limits: Annotated[
        bool, options.flag("Print what clients may have open at once, and end.", "--explain-limits")
    ] = False,
    as_json: options.AsJson = False,
) -> None:
    """Serve the dashboard and the API until Ctrl-C or SIGTERM.

    As python -m backend does, on a free port where 8000 is taken; more settings are RIDELAB_* variables
    (docs/how-to/operations.md).
    """
    flags = ["--say-where"] + ["--explain-limits"] * explain_limits + ["--open"] * (open_page and _has_screen())
    flags += ["--json"] * as_json + (["--or-free-port"] if port is None else ["--port", str(port)])
    command = server_command("--host", host, *flags, data_dir=data_dir)
    # The service takes this process's place: signals reach it, and what it spawns never passes through this command.
    os.execve(sys.executable, command, server_environment())  # noqa: S606  # no shell is wanted


def _has_screen() -> bool:
    """Check whether somebody looks at a terminal of a machine with a screen, whose browser can be opened."""
    screen = sys.platform in ("darwin", "win32") or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY")))
    return sys.stdout.isatty() and screen


def demo(as_json: options.AsJson = False) -> None:
    """Play the paper's comparison in the terminal: LV control, LQR and the passive car; no service needed."""
    check_core()
    with Services(None, None) as services:
        if as_json:
            print_json(services.quick.run({}, _DEMO).answer["strategies"])
        else:
            typer.echo("A car at 50 km/h, a bump 0.1 m high and 4 m long, computed here.\n")
            run(services, strategy=list(_DEMO))
    note("ridelab serve opens the laboratory in a browser")


def backup(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Where to write the copy.")],
    force: Annotated[bool, options.flag("Replace a file that is there already.", "--force")] = False,
    data_dir: DatabaseDir = None,
    as_json: options.AsJson = False,
) -> None:
    """Copy the SQLite database to a file, while a service uses it or while none does.

    The copy is a whole database. Nothing is written meanwhile: new runs are refused with Retry-After, batches wait.
    """
    end_as_server("--back-up", str(file), *["--force"] * force, data_dir=data_dir, as_json=as_json)


def open_(
    services: Services,
    target: Annotated[str, typer.Argument(metavar="RESULT", help=_RESULT)] = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    only_print: Annotated[bool, options.flag("Print the address, start no browser.", "--print")] = False,
    as_json: options.AsJson = False,
) -> None:
    """Open a result in the browser, and print its address.

    A scenario is run first. Without --server the private service stays until Ctrl-C, so that the page can work.
    """
    address = _address(target, changes or [], options.listed(strategy), services)
    say(address, {"address": address}, as_json=as_json)
    if not only_print:
        webbrowser.open(address)
    if None in services.opened:
        with contextlib.suppress(KeyboardInterrupt):  # which may come as soon as it is said
            note("Serving until Ctrl-C")
            signal.pause()


def _address(target: str, changes: list[str], strategies: list[str], services: Services) -> str:
    source = targets.find(target, services)
    if source.ridelab is not None and not changes and not strategies:
        if source.slug is not None:
            return f"{source.ridelab.address}/s/{source.slug}"
        if source.batch is not None:
            return source.ridelab.link(source.batch).url
        if source.run is not None:
            return f"{source.ridelab.address}/r/{source.run.id}"
    ridelab = source.ridelab or services.at()
    names = strategies or source.strategies or list(services.names.strategies)
    run = ridelab.run(fields.changed(source.scenario, changes, services), names)
    return f"{ridelab.address}/r/{run.id}"
