"""Results shared between runs, kept while they fit: one cache for all functions, bounded by the bytes of its arrays.

What has a few small arrays of a fixed shape, such as a car's matrices, is kept by `functools.lru_cache` instead.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import fields, is_dataclass
from functools import cache, wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

import numpy as np
from cachetools.keys import hashkey

P = ParamSpec("P")
T = TypeVar("T")

MEBIBYTE = 1024 * 1024
LIMIT = 48 * MEBIBYTE  # of a process: a scenario that somebody edits, under every strategy, several times over
_OVERHEAD = 1024  # counted for every entry, so that small ones do not pile up without end


def buffers(value: Any) -> dict[int, int]:
    """By identity the bytes of each buffer in a value: in arrays, or in dataclasses, tuples and dictionaries of such.

    A view counts as what it shows, of which it keeps all alive.
    """
    found: dict[int, int] = {}
    _collect(value, found)
    return found


def _collect(value: Any, found: dict[int, int]) -> None:
    if isinstance(value, np.ndarray):
        while isinstance(value.base, np.ndarray):
            value = value.base
        found[id(value)] = value.nbytes
    elif isinstance(value, dict):
        for item in value.values():
            _collect(item, found)
    elif isinstance(value, tuple):
        for item in value:
            _collect(item, found)
    else:
        for name in _field_names(type(value)):  # type: ignore[arg-type]  # a class can be hashed
            _collect(getattr(value, name), found)


@cache
def _field_names(kind: Hashable) -> tuple[str, ...]:
    """Fields of a dataclass; of anything else none."""
    return tuple(field.name for field in fields(kind)) if isinstance(kind, type) and is_dataclass(kind) else ()


class Cache:
    """Results of pure functions, the one not used for longest going first; at most so many bytes.

    An entry keeps its arguments alive, and their arrays with them, so they count as its result does; what several
    entries hold counts once.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._entries: OrderedDict[Hashable, tuple[Any, Any, dict[int, int]]] = OrderedDict()
        self._holders: dict[int, int] = {}
        self._lock = Lock()
        self.size = 0

    def cached(self, function: Callable[P, T]) -> Callable[P, T]:
        """Keep its results; arguments must be hashable, and nobody may write into what is shared."""

        @wraps(function)
        def kept(*args: P.args, **kwargs: P.kwargs) -> T:
            key = hashkey(function, *args, **kwargs)  # type: ignore[arg-type]  # whatever cannot be hashed fails here
            with self._lock:
                entry = self._entries.get(key)
                if entry is not None:
                    self._entries.move_to_end(key)
                    result: T = entry[0]
                    return result
            result = function(*args, **kwargs)
            with self._lock:
                self._put(key, result, (args, tuple(kwargs.values())))
            return result

        return kept

    def _put(self, key: Hashable, result: Any, arguments: Any) -> None:
        held = buffers((result, arguments))
        if sum(held.values()) + _OVERHEAD > self._limit or key in self._entries:
            return
        self._entries[key] = result, arguments, held
        self.size += _OVERHEAD
        for buffer, size in held.items():
            holders = self._holders.get(buffer, 0)
            self._holders[buffer] = holders + 1
            self.size += 0 if holders else size
        while self.size > self._limit:
            self._drop()

    def _drop(self) -> None:
        _, (_, _, held) = self._entries.popitem(last=False)
        self.size -= _OVERHEAD
        for buffer, size in held.items():
            self._holders[buffer] -= 1
            if not self._holders[buffer]:
                del self._holders[buffer]
                self.size -= size


SHARED = Cache(LIMIT)
cached = SHARED.cached
