"""An FMU's zip, unpacked once."""

import os
import stat
import sys
import zipfile
import zlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from hashlib import sha256
from io import BytesIO
from pathlib import Path, PurePosixPath
from platform import machine
from tempfile import TemporaryDirectory, gettempdir

from sim_core.errors import RefusedError, RidelabError
from sim_core.fmi.description import Description, read_description

FOLDER = "XDG_CACHE_HOME"  # the variable that names where they are unpacked (freedesktop.org's base directories)
MOST_FILES, MOST_BYTES = 20_000, 500_000_000  # that an FMU unpacks to
_NO_PROGRAMS = getattr(os, "ST_NOEXEC", 0)  # of a file system, where there is such a thing
_SYSTEMS = {"linux": ("linux", ".so"), "win32": ("windows", ".dll"), "darwin": ("darwin", ".dylib")}
_user: Callable[[], int] = getattr(os, "getuid", int)  # Windows has no numbers of users
_OLD_NAMES = {
    "x86_64-linux": "linux64",
    "x86_64-windows": "win64",
    "x86_64-darwin": "darwin64",
    "aarch64-darwin": "darwin64",
}


def unpack(content: bytes) -> tuple[Description, Path, Path]:
    """Return what an FMU says of itself, its folder, and its library for this machine.

    Raises:
        RidelabError: It is no FMU that can be driven here; the message says why.
    """
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            _check(archive)
            description = read_description(archive.read("modelDescription.xml"))
            library = _library(description, archive.namelist())
            folder = _store() / sha256(content).hexdigest()
            needed = _needed(archive, library)
            if not _is_whole(folder, needed):
                with TemporaryDirectory(dir=folder.parent) as beside:
                    archive.extractall(Path(beside) / "fmu", needed)
                    with suppress(OSError):  # there is none
                        folder.rename(Path(beside) / "damaged")
                    with suppress(OSError):  # another process was first
                        (Path(beside) / "fmu").rename(folder)
    except KeyError:
        raise RefusedError("It has no modelDescription.xml") from None
    except (zipfile.BadZipFile, zlib.error, RuntimeError, NotImplementedError, EOFError) as error:
        raise RefusedError(f"It is no zip that can be read: {error}") from None
    except OSError as error:
        raise RidelabError(f"It cannot be unpacked: {error.strerror}") from None
    return description, folder, folder / library


def _check(archive: zipfile.ZipFile) -> None:
    entries = archive.infolist()
    if len(entries) > MOST_FILES or sum(entry.file_size for entry in entries) > MOST_BYTES:
        raise RefusedError(f"It unpacks to more than {MOST_FILES} files or {MOST_BYTES // 10**6} MB")
    for entry in entries:
        path = PurePosixPath(entry.filename)
        if path.is_absolute() or ".." in path.parts or "\\" in entry.orig_filename or ":" in entry.filename:
            raise RefusedError("A file in its zip has a path that leads out of it")


def _needed(archive: zipfile.ZipFile, library: str) -> list[zipfile.ZipInfo]:
    """Return what a run reads: the description, the resources, and the binaries of this machine."""
    places = ("modelDescription.xml", "resources/", f"{library.rpartition('/')[0]}/")
    return [entry for entry in archive.infolist() if entry.filename.startswith(places)]


def _is_whole(folder: Path, entries: Sequence[zipfile.ZipInfo]) -> bool:
    """Check whether all files are there as they were packed; code that the disk changed would compute other numbers."""
    try:
        return all(
            zlib.crc32((folder / entry.filename).read_bytes()) == entry.CRC for entry in entries if not entry.is_dir()
        )
    except OSError:
        return False


def _library(description: Description, names: list[str]) -> str:
    system, ending = _SYSTEMS.get(sys.platform, (sys.platform, ".so"))
    processor = {"amd64": "x86_64", "arm64": "aarch64"}.get(machine().lower(), machine().lower())
    platform = f"{processor}-{system}"
    if description.version == 2:
        platform = _OLD_NAMES.get(platform, platform)
    library = f"binaries/{platform}/{description.identifier}{ending}"
    if library not in names:
        there = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name.count("/") > 1})
        raise RidelabError(f"It has no binary for {platform}; there is {', '.join(there) or 'none at all'}")
    return library


def _store() -> Path:
    """Return where FMUs are unpacked, each once: a folder that nobody else may write to, and whose programs may run.

    Raises:
        RidelabError: There is no such folder.
    """
    path = Path(os.environ.get(FOLDER) or gettempdir()) / f"ridelab-fmu-{_user()}"
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    if _NO_PROGRAMS and os.statvfs(path).f_flag & _NO_PROGRAMS:
        raise RidelabError(f"Nothing in the folder {path} may be run (noexec): name another one in {FOLDER}")
    status = path.lstat()
    shared = os.name == "posix" and (status.st_uid != _user() or stat.S_IMODE(status.st_mode) & 0o022)
    if shared or not stat.S_ISDIR(status.st_mode):
        raise RidelabError(f"The folder {path} for unpacked FMUs is somebody else's")
    return path
