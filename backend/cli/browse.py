"""`ridelab open`: a result in the browser."""

import contextlib
import signal
import webbrowser
from typing import Annotated

import typer

from backend.cli import fields, options, targets
from backend.cli.reporting import note
from backend.cli.services import Services


def open_(
    target: Annotated[
        str, typer.Argument(metavar="RESULT", help="Scenario, preset, run id, batch id, link, or address of one.")
    ] = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    only_print: Annotated[bool, typer.Option("--print", help="Print the address, start no browser.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Open a result in the browser, and print its address.

    A scenario is run first. Without --server the private service stays until Ctrl-C, so that the page can work.
    """
    with Services(server, data_dir) as services:
        address = _address(target, changes or [], options.listed(strategy), services)
        typer.echo(address)
        if not only_print:
            webbrowser.open(address)
        if services.started:
            with contextlib.suppress(KeyboardInterrupt):  # which may come as soon as it is said
                note("Serving until Ctrl-C")
                signal.pause()


def _address(target: str, changes: list[str], strategies: list[str], services: Services) -> str:
    from sim_core.strategies import STRATEGIES

    found = targets.find(target, services)
    if found.ridelab is not None and not changes and not strategies:
        if found.slug is not None:
            return f"{found.ridelab.address}/s/{found.slug}"
        if found.batch is not None:
            return found.ridelab.link(found.batch).url
        if found.run is not None:
            return f"{found.ridelab.address}/r/{found.run.id}"
    ridelab = found.ridelab or services.at()
    names = strategies or targets.strategies_of(found) or list(STRATEGIES)
    run = ridelab.run(fields.changed(found.scenario, changes), names)
    return f"{ridelab.address}/r/{run.id}"
