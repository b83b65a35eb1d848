"""The library that setup.py builds from this folder's C files, loaded once for all who call into it."""

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from sim_core.kernel import build

ADDRESS, INT, SIZE, DOUBLE = ctypes.c_void_p, ctypes.c_int, ctypes.c_ssize_t, ctypes.c_double
_BYTE, _KINDS = ctypes.c_char.from_buffer, "di"  # NumPy's letters for float64 and int
_FILE = Path(__file__).with_name("libridelab.so.1")  # no Python module, so not called like one
_NOT_BUILT = (
    "The core's C is not compiled, or not from these sources: install Ridelab with `make setup` or from its wheel"
)


def load(file: Path, expected: str | None) -> ctypes.CDLL:
    """The library.

    Args:
        file: The library.
        expected: Digest of what it has to be compiled from; None where the sources are not here.

    Raises:
        ImportError: It is not there, another machine's, or compiled from other sources: its functions may then take
            other arguments.
    """
    try:
        library = ctypes.CDLL(str(file))
        digest = library.ridelab_digest
    except (OSError, AttributeError) as error:
        raise ImportError(_NOT_BUILT) from error
    digest.restype = ctypes.c_char_p
    if expected is not None and digest() != expected.encode():
        raise ImportError(_NOT_BUILT)
    return library


_LIBRARY = load(_FILE, build.digest() if build.SOURCES else None)
DIGEST: str = _LIBRARY.ridelab_digest().decode()  # SHA-256 of the C and of the flags it was compiled with


def function(name: str, *arguments: type, result: type | None = None) -> Callable[..., Any]:
    """A function of the library, by its name there without `ridelab_`, with these types of arguments and result."""
    loaded = _LIBRARY[f"ridelab_{name}"]
    loaded.argtypes, loaded.restype = arguments, result
    return loaded


def address(array: NDArray[Any]) -> int:
    """Where C finds an array's numbers; whoever passes it on keeps the array alive.

    Raises:
        ValueError: They do not follow one another, or are neither float64 nor C's int.
    """
    if not array.flags.c_contiguous or array.dtype.char not in _KINDS:
        raise ValueError("C reads contiguous arrays of float64 or int")
    if array.flags.writeable and array.size:
        return ctypes.addressof(_BYTE(array.data))  # a third of the time that `ctypes.data` takes
    return int(array.ctypes.data)
