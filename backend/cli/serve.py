"""`ridelab serve`: the dashboard and the API."""

import os
import sys
from typing import Annotated

import typer

from backend.cli.options import DataDir
from backend.cli.services import child_environment


def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on, 0 for a free one.", min=0, max=65535)] = 8000,
    data_dir: DataDir = None,
) -> None:
    """Serve the dashboard and the API until Ctrl-C or SIGTERM.

    The same as python -m backend; more settings are RIDELAB_* variables (docs/operations.md).
    """
    options = ["--host", host, "--port", str(port), *([] if data_dir is None else ["--data-dir", str(data_dir)])]
    # The service takes this process's place: signals reach it, and what it spawns never passes through this command.
    os.execve(sys.executable, [sys.executable, "-P", "-m", "backend", *options], child_environment())  # noqa: S606
