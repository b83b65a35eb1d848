"""Results shared between runs: one least-recently-used cache for all functions, bounded by the bytes of its arrays.

Results with a few small arrays of a fixed shape, such as a car's matrices, have a cache for each function
(`small_cached`). Nobody can write into a cached array.
"""

from collections.abc import Callable, Hashable, Iterable
from functools import cache, lru_cache, partial, wraps
from operator import itemgetter
from threading import Lock
from typing import Any, ParamSpec, TypeVar

import cachetools
import numpy as np
from cachetools.keys import hashkey
from numpy.typing import NDArray

P = ParamSpec("P")
T = TypeVar("T")

_Entries = cachetools.LRUCache[Hashable, tuple[Any, int]]  # results with what they count [bytes]

MEBIBYTE = 1024 * 1024
MAX_BYTES = 28 * MEBIBYTE  # of a process: a scenario that somebody edits, under every strategy, several times over
_PLAIN = {float, int, str}  # which hold no array
_ENTRY_OVERHEAD = 1024  # so that the number of small entries is bounded too [bytes]


@cache
def _fields(kind: type) -> tuple[str, ...]:
    return tuple(getattr(kind, "__dataclass_fields__", ()))


def arrays(value: Any) -> list[NDArray[Any]]:
    """Return the arrays in a value, in its dataclasses, tuples and dictionaries, and those that they are views of."""
    collected: list[NDArray[Any]] = []
    parts = [value]
    for part in parts:  # which grow meanwhile
        if isinstance(part, np.ndarray):
            while part is not None:  # between a strided view and its array stands an object of NumPy's with a base too
                if isinstance(part, np.ndarray):
                    collected.append(part)
                part = getattr(part, "base", None)
        elif isinstance(part, dict):
            parts += part.values()
        elif isinstance(part, tuple):
            parts += part
        else:
            values = [getattr(part, name) for name in _fields(part.__class__)]
            parts += [each for each in values if each.__class__ not in _PLAIN]
    return collected


def _make_read_only(arrays: Iterable[NDArray[Any]]) -> None:
    for array in arrays:
        if array.flags.writeable:  # asking takes a tenth of the time that setting does
            array.flags.writeable = False


def small_cached(entries: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Cache the last few results of a pure function, whose arrays are small; nobody can write into them.

    Args:
        entries: How many results.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @lru_cache(maxsize=entries)
        @wraps(function)
        def read_only(*args: P.args, **kwargs: P.kwargs) -> T:
            result = function(*args, **kwargs)
            _make_read_only(arrays(result))
            return result

        return read_only  # type: ignore[return-value]  # its arguments are hashable

    return decorate


class Cache:
    """Least-recently-used cache of the results of pure functions, of at most so many bytes.

    An entry counts what its function made: arrays of its arguments are those of earlier entries.
    """

    def __init__(self, max_bytes: int) -> None:
        self._entries: cachetools.LRUCache[Hashable, tuple[Any, int]] = cachetools.LRUCache(
            max_bytes, getsizeof=itemgetter(1)
        )
        self._lock = Lock()

    def cached(self, function: Callable[P, T]) -> Callable[P, T]:
        """Cache a function's results; arguments are hashable, and nobody can write into arrays of either any more."""

        @cachetools.cached(self._entries, key=partial(hashkey, function), lock=self._lock)
        def sized(*args: P.args, **kwargs: P.kwargs) -> tuple[T, int]:
            result = function(*args, **kwargs)
            arguments, results = arrays((args, tuple(kwargs.values()))), arrays(result)
            _make_read_only([*arguments, *results])
            own = {id(array): array.nbytes for array in results if not hasattr(array.base, "base")}  # no view
            return result, _ENTRY_OVERHEAD + sum(own[each] for each in own.keys() - set(map(id, arguments)))

        @wraps(function)
        def lookup(*args: P.args, **kwargs: P.kwargs) -> T:
            return sized(*args, **kwargs)[0]

        return lookup

    @property
    def size(self) -> int:
        """Return how much is cached [bytes]."""
        return int(self._entries.currsize)

    def results(self) -> list[Any]:
        """Return all that is cached."""
        with self._lock:
            return [result for result, _ in self._entries.values()]

    def clear(self) -> None:
        """Forget everything."""
        with self._lock:
            self._entries.clear()


SHARED = Cache(MAX_BYTES)
cached = SHARED.cached
