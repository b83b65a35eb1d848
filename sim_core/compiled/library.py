"""The library that setup.py builds from this folder's C files, loaded once for all who call into it."""

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

ADDRESS, INT, DOUBLE = ctypes.c_void_p, ctypes.c_int, ctypes.c_double
_BYTE, _KINDS = ctypes.c_char.from_buffer, "di"  # NumPy's letters for float64 and int
_FILE = Path(__file__).with_name("libridelab.so.1")  # no Python module, so not called like one
_NOT_BUILT = (
    "The core's C is not compiled, or not from these sources: install Ridelab with `make setup` or from its wheel"
)


def load(file: Path) -> ctypes.CDLL:
    """The library.

    Raises:
        ImportError: It is not there, or another machine's.
    """
    try:
        return ctypes.CDLL(str(file))
    except OSError as error:
        raise ImportError(_NOT_BUILT) from error


_LIBRARY = load(_FILE)


def function(name: str, *arguments: type, result: type | None = None) -> Callable[..., Any]:
    """A function of the library, by its name there without `ridelab_`, with these types of arguments and result.

    Raises:
        ImportError: The library has none: it is older or newer than what asks for it.
    """
    try:
        loaded = _LIBRARY[f"ridelab_{name}"]
    except AttributeError:
        raise ImportError(_NOT_BUILT) from None
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
