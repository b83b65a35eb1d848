"""`ridelab backup`: a copy of the database, whether or not a service uses it."""

import os
from pathlib import Path
from typing import Annotated

import typer

from backend.cli import options
from backend.cli.reporting import InputError


def backup(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Where to write the copy.")],
    force: Annotated[bool, typer.Option("--force", help="Replace a file that is there already.")] = False,
    data_dir: options.DatabaseDir = None,
) -> None:
    """Copy the SQLite database to a file, while a service uses it or while none does.

    The copy is a whole database. Nothing is written meanwhile: new runs are refused with Retry-After, batches wait.
    """
    from backend.backup import BackupError, back_up  # SQLAlchemy, which no other command needs
    from backend.settings import Settings, SettingsError

    try:
        settings = Settings.from_environment(os.environ, data_dir=data_dir)
        copy = back_up(settings, file, overwrite=force)
    except (SettingsError, BackupError) as error:
        raise InputError(str(error)) from None
    size = copy.size / 1e6
    typer.echo(f"{file}: {size:.1f} MB, a copy of {copy.database}; writes waited {copy.seconds:.2f} s")
