"""Waiting for a batch and taking its table, so that Ctrl-C loses nothing that is finished."""

import shlex
from dataclasses import dataclass
from pathlib import Path

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from backend.cli import output
from backend.cli.reporting import INTERRUPTED, note, terminal
from backend.client import Batch, RidelabClientError
from backend.client.address import without_login


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Where a batch's table is wanted.

    Attributes:
        out: The file, `-` for standard output, None for nowhere.
        file_format: `csv`, `parquet` or `json`; empty where it is wanted nowhere.
        named: Whether the format was named beside the file.
        server: The service's address; None for a private one.
        data_dir: Where a private one keeps its database, if that was said.
    """

    out: str | None
    file_format: str = ""
    named: bool = False
    server: str | None = None
    data_dir: Path | None = None

    def command(self, batch: Batch) -> str:
        """The command that writes it later."""
        options = ["--format", self.file_format] if self.named else []
        if self.server is not None:
            options += ["--server", without_login(self.server)]
        elif self.data_dir is not None:
            options += ["--data-dir", str(self.data_dir)]
        return shlex.join(["ridelab", "export", batch.id, "--out", self.out or "FILE", *options])


def take(batch: Batch, table: Table, *, ours: bool) -> None:
    """Wait for it with a progress bar and write its table.

    Ctrl-C cancels a batch that is `ours`, and what is finished is written; another's goes on without us.

    Raises:
        typer.Exit: It was ended by Ctrl-C, and what became of it has been said.
        OSError: The file cannot be written.
        RidelabClientError: The service refused, or does not answer.
    """
    try:
        _follow(batch)
        _write(batch, table)
    except KeyboardInterrupt:
        if ours:
            raise interrupted(batch, table) from None
        note(f"Stopped waiting; the batch goes on. For its rows: {table.command(batch)} --wait")
        raise typer.Exit(INTERRUPTED) from None


def interrupted(batch: Batch, table: Table) -> typer.Exit:
    """Cancel what is left of it, write what is finished or say how to get it; the exit to raise."""
    try:
        if not batch.finished:
            batch.cancel()
            word = "Cancelled" if batch.state == "cancelled" else "Interrupted"
            note(f"{word}; {batch.done} of {batch.total} runs are finished and stay stored: batch {batch.id}")
            if _write(batch, table):
                return typer.Exit(INTERRUPTED)
    except KeyboardInterrupt:
        note("Interrupted again")
    except (RidelabClientError, OSError) as error:
        note(str(error))
    note(f"For its rows: {table.command(batch)}")
    return typer.Exit(INTERRUPTED)


def _write(batch: Batch, table: Table) -> bool:
    """Write every row where that is wanted; says whether it is."""
    if table.out is None:
        return False
    output.deliver(batch.content(table.file_format), table.out)
    if batch.state == "cancelled" and table.out != "-":
        note(f"{table.out} has all {batch.total} rows, those that never ran with the status cancelled")
    return True


def _follow(batch: Batch) -> None:
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[failed]}"),
        TimeRemainingColumn(),
    )
    console = terminal()
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task(batch.state, total=batch.total, failed="")

        def show(batch: Batch) -> None:
            failed = f"{batch.failed} failed" if batch.failed else ""
            bar.update(task, description=batch.state, completed=batch.done + batch.failed, failed=failed)

        batch.wait(show)
