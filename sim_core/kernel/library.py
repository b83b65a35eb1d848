"""The library that kernel/build.py makes of the C, loaded once, and its functions with the arguments they take."""

import ctypes
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from sim_core.kernel import build

INT, DOUBLE, NAME = ctypes.c_int, ctypes.c_double, ctypes.c_char_p
_BYTE = ctypes.c_char.from_buffer
_CONTIGUOUS, _ALIGNED, _WRITEABLE = 0x1, 0x100, 0x400  # bits of `numpy.ndarray.flags`
_NOT_BUILT = (
    "The core's C is not compiled, or not from these sources: install Ridelab with `make setup` or from its wheel"
)


class Array:
    """The type of an argument: a C-contiguous, aligned array of the machine's own numbers.

    `numpy.ctypeslib.ndpointer` checks the same and takes thrice the time, which a run of 3 ms would notice.

    Args:
        shape: Its shape, or
        ndim: How many dimensions it has; any without either.
        dtype: Of its numbers.
        written: Whether C writes into it.
    """

    def __init__(
        self, *shape: int, ndim: int | None = None, dtype: type[np.generic] = np.float64, written: bool = False
    ) -> None:
        self._shape, self._ndim, self._dtype = shape, ndim, np.dtype(dtype)
        self._flags = _CONTIGUOUS | _ALIGNED | (_WRITEABLE if written else 0)

    def from_param(self, value: Any) -> Any:
        """Return a pointer to the array's data; `ctypes` calls it for each argument.

        Raises:
            TypeError: It is no such array.
        """
        if not isinstance(value, np.ndarray) or value.dtype != self._dtype:
            raise TypeError(f"C takes an array of {self._dtype} here")
        if (self._shape and value.shape != self._shape) or value.ndim != (self._ndim or value.ndim):
            raise TypeError(f"C takes an array of {self._shape or self._ndim} here, not of {value.shape}")
        flags = value.flags.num
        if flags & self._flags != self._flags:
            raise TypeError("C takes contiguous, aligned arrays, and writes into writeable ones")
        if flags & _WRITEABLE and value.size:  # a third of the time that `ctypes.data` takes
            return ctypes.byref(_BYTE(value.data))
        return ctypes.c_void_p(value.ctypes.data)


def load(file: Path, expected: str | None) -> ctypes.CDLL:
    """Return the library.

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


def text_of(name: str) -> str:
    """Return a text that the library states."""
    function = _LIBRARY[f"ridelab_{name}"]
    function.restype = NAME
    text: str = function().decode()
    return text


def size_of(name: str) -> int:
    """Return a size that arrays have to have: how many numbers a struct of C has, or what else the library states."""
    size: int = _LIBRARY[f"ridelab_size_of_{name}"]()
    return size


_LIBRARY = load(build.best(), build.digest() if build.SOURCES else None)
DIGEST = text_of("digest")  # SHA-256 of the C and of the flags it was compiled with


class CStruct:
    """What C has made of arrays, for many calls; it keeps them alive."""

    def __init__(self, memory: Any, values: tuple[Any, ...]) -> None:
        self._as_parameter_ = memory
        self._values = values

    @staticmethod
    def from_param(value: Any) -> Any:
        """Return the value itself; `ctypes` calls this for each argument.

        Raises:
            TypeError: It is no such thing.
        """
        if not isinstance(value, CStruct):
            raise TypeError("C takes here what it has prepared")
        return value


class Optional(CStruct):
    """The type of an argument that may be None."""

    @staticmethod
    def from_param(value: Any) -> Any:
        """Return the value itself; None is C's NULL."""
        return None if value is None else CStruct.from_param(value)


class Function:
    """A function of the library: whatever it is called with is checked against its arguments' types.

    Args:
        name: Its name without `ridelab_`.
        arguments: Their types.
        result: Its type.
    """

    def __init__(self, name: str, *arguments: Any, result: type | None = None) -> None:
        self._arguments = arguments
        self._checked, self._unchecked = _LIBRARY[f"ridelab_{name}"], _LIBRARY[f"ridelab_{name}"]
        self._checked.argtypes = arguments
        self._checked.restype = self._unchecked.restype = result

    def __call__(self, *values: Any) -> Any:
        """Call it.

        Raises:
            ctypes.ArgumentError: An argument is of another type, shape or order, or cannot be written.
        """
        return self._checked(*values)

    def bind(self, *values: Any) -> Callable[..., Any]:
        """Return the function of its last arguments, integers all, for many calls; the first ones are checked here.

        Args:
            values: The first arguments, whose arrays are kept alive.

        Raises:
            TypeError: An argument is of another type, shape or order, or cannot be written.
        """
        first = zip(self._arguments, values, strict=False)
        bound = partial(self._unchecked, *[kind.from_param(value) for kind, value in first])
        bound.values = values  # type: ignore[attr-defined]  # it takes any attribute
        return bound

    def prepare(self, *values: Any) -> CStruct:
        """Return what the function makes of these arguments, in memory that it takes before them.

        Raises:
            TypeError: An argument is of another type, shape or order, or cannot be written.
        """
        memory = ctypes.create_string_buffer(size_of("prepared"))
        arguments = [kind.from_param(value) for kind, value in zip(self._arguments, values, strict=True)]
        self._unchecked(memory, *arguments)
        return CStruct(memory, values)


def require(agreed: bool, what: str) -> None:
    """Refuse arrays that do not fit each other before C gets them.

    Raises:
        ValueError: They were not `agreed`; the message is `what` has to be.
    """
    if not agreed:
        raise ValueError(what)
