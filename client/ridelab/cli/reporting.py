"""Output of commands: notes, JSON, tables, files that are written, and exit codes.

Whatever a command calls may raise `InputError` and `UnavailableError` besides the client's own errors.
"""

import json
import os
import re
import signal
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Timer
from typing import Any

import typer
from rich.cells import cell_len
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from typer.core import TyperGroup

from ridelab.errors import RidelabAPIError, RidelabClientError
from ridelab.files import format_of, save

DIFFERENT = 1
BAD_INPUT = 2
UNAVAILABLE = 3
INTERRUPTED = 130  # 128 + SIGINT, as shells count
BROKEN_PIPE = 141  # 128 + SIGPIPE
TERMINATED = 143  # 128 + SIGTERM

MOMENT = 0.5  # shorter waits show nothing [s]
_TRY_AGAIN = 429
_LOGIN_HELP = (
    "The service answers those with a token, and there was none, or none that it knows: "
    "ridelab --token-file FILE COMMAND, or the variable RIDELAB_TOKEN; its operator gives tokens out"
)
_OPTIONS = {"strategies": "--strategy", "requirements": "--require"}
_PART = re.compile(rf"^({'|'.join(_OPTIONS)})\[\d+\](?:\.\w+)?: ")


class InputError(Exception):
    """A typed word, or a file that was named, cannot be used; `lines` say why, `field: message` for a field."""

    def __init__(self, *lines: str) -> None:
        super().__init__(*lines)
        self.lines = lines


class UnavailableError(Exception):
    """No service can be had; the message says why."""


class Terminated(KeyboardInterrupt):
    """SIGTERM: the command ends as after Ctrl-C, but what a service computes for it goes on."""


class ReportingGroup(TyperGroup):
    """Commands whose expected errors are a line on stderr and an exit code, never a traceback."""

    def invoke(self, ctx: Any) -> Any:
        """Run the command; an error that has been said ends it with its exit code."""
        try:
            result = super().invoke(ctx)
            sys.stdout.flush()
            return result
        except InputError as error:
            raise failed(BAD_INPUT, error.lines) from None
        except RidelabAPIError as error:
            there = error.status >= 500 or error.status == _TRY_AGAIN
            lines = [_LOGIN_HELP] if error.kind == "token-required" else map(_as_typed, error.lines)
            raise failed(UNAVAILABLE if there else BAD_INPUT, lines) from None
        except (RidelabClientError, UnavailableError) as error:
            raise failed(UNAVAILABLE, [str(error)]) from None
        except KeyboardInterrupt as interrupt:  # who has handed in a job, has said what becomes of it
            code = TERMINATED if isinstance(interrupt, Terminated) else INTERRUPTED
            raise failed(code, ["Interrupted: nothing was submitted, no file was written"]) from None
        except BrokenPipeError:
            abandon_output()
            raise typer.Exit(BROKEN_PIPE) from None
        except OSError as error:
            raise failed(BAD_INPUT, [f"{error.filename or 'File'}: {error.strerror or error}"]) from None


def end_on_sigterm() -> None:
    """From now on SIGTERM is raised where the command stands, so that it can say what becomes of its job."""

    def terminate(number: int, frame: object) -> None:
        raise Terminated

    signal.signal(signal.SIGTERM, terminate)


def _as_typed(line: str) -> str:
    """A service's line with the option in place of the request's part: `--strategy: Unknown strategy lq`."""
    return _PART.sub(lambda part: f"{_OPTIONS[part[1]]}: ", line)


def failed(code: int, lines: Iterable[str]) -> typer.Exit:
    """Say it on stderr; the exit to raise."""
    for line in lines:
        typer.echo(line, err=True)
    return typer.Exit(code)


def abandon_output() -> None:
    """Nobody reads standard output any more: what is left in its buffer goes nowhere, without a complaint."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def note(line: str) -> None:
    """A remark beside the result: on stderr, so that the output stays what was asked for."""
    typer.echo(line, err=True)


@contextmanager
def waiting(what: str) -> Iterator[None]:
    """Something that moves on stderr where somebody looks, from `MOMENT` on while one waits."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    status = console.status(what)
    begin = Timer(MOMENT, status.start)
    begin.start()
    try:
        yield
    finally:
        begin.cancel()
        begin.join()
        status.stop()


def print_json(value: Any) -> None:
    """For machines."""
    typer.echo(json.dumps(value, indent=1, ensure_ascii=False))


def say(text: str, value: Any, *, as_json: bool) -> None:
    """A result in words, or the value for machines."""
    print_json(value) if as_json else typer.echo(text)


def print_json_rows(head: dict[str, Any], rows: Iterable[Any]) -> None:
    """An object for machines with a last member `rows`, row by row: there may be more than fit in memory."""
    typer.echo(json.dumps(head, indent=1, ensure_ascii=False).removesuffix("\n}") + ',\n "rows": [', nl=False)
    for index, row in enumerate(rows):
        typer.echo(("," if index else "") + "\n  " + json.dumps(row, ensure_ascii=False), nl=False)
    typer.echo("\n ]\n}")


def folder_of(out: str, option: str) -> None:
    """Refuse a file whose folder does not exist."""
    if not Path(out).parent.is_dir():
        raise InputError(f"{option}: there is no folder {Path(out).parent}")


def check_out(out: str, *, as_json: bool = False) -> None:
    """Refuse, before anything is computed, what could not be written at the end."""
    folder_of(out, "--out")
    if as_json and out == "-":
        raise InputError("--json: the file itself would go to standard output; name another one")


def output_format(out: str, file_format: str | None, *, as_json: bool = False) -> str:
    """The format named, else that of the file's ending; refused here, before anything is computed."""
    check_out(out, as_json=as_json)
    try:
        return format_of(out, file_format)
    except ValueError as error:
        raise InputError(f"{'--format' if file_format or out == '-' else '--out'}: {error}") from None


def deliver(content: Iterable[bytes], out: str, *, as_json: bool = False, **about: Any) -> None:
    """Write the pieces there, `-` is standard output; for machines say its name, size [bytes] and the rest of `about`.

    See `check_out`.
    """
    if out == "-":
        sys.stdout.buffer.writelines(content)
        return
    size = write(content, out)
    if as_json:
        print_json({"file": out, "size": size, **about})


def write(content: Iterable[bytes], file: str | Path) -> int:
    """Write the pieces there, all or none; its size [bytes], which is said in a terminal."""
    size = save(content, file).stat().st_size
    if sys.stderr.isatty():
        note(f"{file}: {size:,} bytes")
    return size


_UNLIMITED = 1000  # columns of a file or a pipe
_GAP = 2  # columns between two of a table's
_WORD = 16  # columns within which a longer word is broken, where there is no room
_IN_NAME = re.compile(r"([._])(?=[a-z])")
_FIGURE = re.compile(r"|-|none| *[-+(]?[\d.].*|- : .*|\(misprint .*|[-+]?inf", re.DOTALL)


_PAPERS = "paper_sag"  # the kind of caution that the paper's own values lead to


def show_cautions(answer: Mapping[str, Any], *, with_the_papers: bool = True) -> None:
    """Print the cautions of an answer about a vehicle or a road, or of a run's comparison, a line each.

    Args:
        answer: The answer or the comparison; an older service gives no cautions.
        with_the_papers: Whether those are printed too that the paper's own values lead to.
    """
    for caution in answer.get("cautions", ()):
        if with_the_papers or caution["kind"] != _PAPERS:
            typer.echo(f"Caution: {caution['text']}")


def show_table(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
    """Print a table: columns of figures end at their right edge, those of words begin at their left.

    Where it is wider than the terminal, a change stands below its value, and names in heads break between their words;
    where that is not enough, the table is wider than the terminal.
    """
    looked_at = sys.stdout.isatty()
    console = Console(width=None if looked_at else _UNLIMITED, markup=False, highlight=False, emoji=False)
    texts = [[shown(cell) for cell in row] for row in rows]
    table = _table(heads, texts)
    if Measurement.get(console, console.options.update(max_width=_UNLIMITED), table).maximum > console.width:
        broken = [_IN_NAME.sub(r"\1\n", head) for head in heads]
        table = _table(broken, [[_narrow(cell) for cell in row] for row in texts], narrow=True)
        least = sum((column.min_width or 0) + _GAP for column in table.columns) - _GAP
        if least > console.width:
            console.size = (_UNLIMITED, console.height)  # the terminal breaks its lines
    with console.capture() as printed:
        console.print(table)
    typer.echo("\n".join(line.rstrip() for line in printed.get().splitlines()))


def _table(heads: Sequence[str], texts: Sequence[Sequence[str]], *, narrow: bool = False) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, _GAP, 0, 0), header_style="bold")
    for column, head in enumerate(heads):
        cells = [row[column] for row in texts]
        figures = all(map(_FIGURE.fullmatch, cells))
        separator = ", " if figures else " "  # figures that are a list break, and words; names in front are copied
        whole = (figures or column == 0) and not any(separator in cell for cell in cells)
        if narrow and whole:
            head = head.replace(" ", "\n")
        pieces = [piece for text in (head, *cells) for piece in (text.splitlines() if whole else text.split())]
        least = max(map(cell_len, pieces), default=1)
        table.add_column(
            head,
            justify="right" if figures else "left",
            overflow="fold",
            no_wrap=whole,
            min_width=least if whole else min(least, _WORD),
        )
    for row in texts:
        table.add_row(*row)
    return table


def _narrow(text: str) -> str:
    if _FIGURE.fullmatch(text):
        return text.replace(" (", "\n(")
    return text if "://" in text else re.sub(r",(?=\w)", ", ", text)


def with_unit(name: str, unit: str) -> str:
    """A column's head: `bump.body_acceleration.peak [m/s^2]`; numbers without a unit stand alone."""
    return name if unit in ("", "1") else f"{name} [{unit}]"


def shown(value: Any, digits: int = 6) -> str:
    """One value, short."""
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "-"}[value]
    if isinstance(value, float | int):
        return f"{value:.{digits}g}"
    if isinstance(value, list):
        return ",".join(shown(item, digits) for item in value)
    return str(value)
