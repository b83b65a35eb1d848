"""A program's writes as recorder.c records them, and what of them a disk has after a power cut.

What was synced is there. Of what was not, any part may be: all, nothing, some writes without earlier ones, or some
sectors of a write. Names of a folder are as its last sync left them, or some of the changes since, in their order.
"""

import os
import struct
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import BinaryIO

import numpy as np

from sim_core.kernel.build import default_compiler

HEAD = struct.Struct("<cIIqQ")
SECTOR = 512  # which a disk writes whole [bytes]
NOTE = "n"  # the kind of what a program notes between


@dataclass(frozen=True, slots=True)
class Record:
    """One call, as recorder.c says."""

    kind: str
    path: str
    other: str
    offset: int
    data: bytes


def note(log: BinaryIO, text: str) -> None:
    """Append a note to a log that is being recorded."""
    data = text.encode()
    log.write(HEAD.pack(NOTE.encode(), 0, 0, 0, len(data)) + data)


def read(log: Path) -> Iterator[Record]:
    """The records of a log."""
    with log.open("rb") as file:
        while head := file.read(HEAD.size):
            kind, path, other, offset, length = HEAD.unpack(head)
            names = file.read(path).decode(), file.read(other).decode()
            yield Record(kind.decode(), *names, offset, file.read(length))


@cache
def recorder(folder: Path) -> Path:
    """The compiled library, in that folder."""
    library = folder / "recorder.so"
    source = Path(__file__).with_name("recorder.c")
    flags = ("-std=gnu11", "-Wall", "-Wextra", "-Werror", "-O1", "-fPIC", "-shared")
    subprocess.run([*default_compiler(), *flags, "-o", library, source, "-ldl", "-lpthread"], check=True)
    return library


def recording(log: Path, folder: Path) -> dict[str, str]:
    """Environment of a program whose writes below the folder are recorded."""
    return {
        **os.environ,
        "LD_PRELOAD": str(recorder(log.parent)),
        "RECORD_LOG": str(log),
        "RECORD_FOLDER": str(folder),
    }


@dataclass(slots=True)
class _File:
    synced: bytearray = field(default_factory=bytearray)
    pending: list[Record] = field(default_factory=list)

    def after_cut(self, fate: str, rng: np.random.Generator) -> bytes:
        content = bytearray(self.synced)
        for each in self.pending:
            if fate == "all" or (fate != "nothing" and rng.random() < 0.5):
                _apply(content, each, torn=rng if fate == "torn" else None)
        return bytes(content)


def _apply(content: bytearray, record: Record, torn: np.random.Generator | None = None) -> None:
    end = record.offset + len(record.data)
    if record.kind == "t":
        del content[end:]
    content.extend(bytes(max(0, end - len(content))))
    for first in range(0, len(record.data), SECTOR):
        if torn is None or torn.random() < 0.5:
            part = record.data[first : first + SECTOR]
            content[record.offset + first : record.offset + first + len(part)] = part


class Disk:
    """What a folder's disk has, call by call."""

    FATES = ("all", "nothing", "some", "torn")  # of what was not synced

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._now: dict[str, _File] = {}
        self._synced: dict[str, _File] = {}
        self._pending: list[tuple[str, _File | None]] = []  # names and what they name from then on

    def apply(self, record: Record) -> None:
        """The next call."""
        path, file = record.path, self._now.get(record.path)
        if record.kind == "s" and file is None:  # a folder
            self._sync_names(path)
        elif record.kind == "s":
            assert file is not None
            for each in file.pending:
                _apply(file.synced, each)
            file.pending.clear()
        elif record.kind == "c" and file is None:
            self._name(path, _File())
        elif record.kind == "c":  # it was there, and is emptied
            self._now[path].pending.append(Record("t", path, "", 0, b""))
        elif record.kind in "wt":
            self._now[path].pending.append(record)
        else:
            if record.kind in "lr":
                self._name(record.other, file)
            if record.kind in "ru":
                self._name(path, None)

    def cut(self, into: Path, rng: np.random.Generator) -> str:
        """Write what is left after a power cut into another folder; what became of what was not synced."""
        fate = self.FATES[rng.integers(len(self.FATES))]
        names = dict(self._synced)
        for name, file in self._pending[: rng.integers(len(self._pending) + 1)]:
            _rename(names, name, file)
        for name, file in names.items():
            path = into / Path(name).relative_to(self._folder)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(file.after_cut(fate, rng))
        return fate

    def _name(self, path: str, file: _File | None) -> None:
        self._pending.append((path, file))
        _rename(self._now, path, file)

    def _sync_names(self, folder: str) -> None:
        synced = [each for each in self._pending if str(Path(each[0]).parent) == folder]
        for name, file in synced:
            _rename(self._synced, name, file)
        self._pending = [each for each in self._pending if each not in synced]


def _rename(names: dict[str, _File], name: str, file: _File | None) -> None:
    if file is None:
        names.pop(name, None)
    else:
        names[name] = file
