"""Results shared between runs: one least-recently-used cache for all functions, bounded by the bytes of its arrays.

Results with a few small arrays of a fixed shape, such as a car's matrices, are cached by `functools.lru_cache`.
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
MAX_BYTES = 48 * MEBIBYTE  # of a process: a scenario that somebody edits, under every strategy, several times over
_ENTRY_OVERHEAD = 1024  # so that the number of small entries is bounded too [bytes]


def buffers(value: Any) -> dict[int, int]:
    """Bytes of each buffer in a value, by its identity: in arrays, and in dataclasses, tuples and dictionaries of such.

    A view counts as its whole base array, which it keeps alive.
    """
    sizes: dict[int, int] = {}
    _collect(value, sizes)
    return sizes


def _collect(value: Any, sizes: dict[int, int]) -> None:
    if isinstance(value, np.ndarray):
        while isinstance(value.base, np.ndarray):
            value = value.base
        sizes[id(value)] = value.nbytes
    elif isinstance(value, dict):
        for item in value.values():
            _collect(item, sizes)
    elif isinstance(value, tuple):
        for item in value:
            _collect(item, sizes)
    else:
        for name in _field_names(type(value)):  # type: ignore[arg-type]  # a class can be hashed
            _collect(getattr(value, name), sizes)


@cache
def _field_names(kind: Hashable) -> tuple[str, ...]:
    """Fields of a dataclass; of anything else none."""
    return tuple(field.name for field in fields(kind)) if isinstance(kind, type) and is_dataclass(kind) else ()


class Cache:
    """Least-recently-used cache of the results of pure functions, of at most so many bytes.

    An entry keeps its arguments alive, and their arrays with them, so they count as its result does; what several
    entries hold counts once.
    """

    def __init__(self, max_bytes: int) -> None:
        self._max_bytes = max_bytes
        self._entries: OrderedDict[Hashable, tuple[Any, Any, dict[int, int]]] = OrderedDict()
        self._references: dict[int, int] = {}
        self._lock = Lock()
        self.size = 0

    def cached(self, function: Callable[P, T]) -> Callable[P, T]:
        """Cache its results; arguments must be hashable, and nobody may write into what is shared."""

        @wraps(function)
        def lookup(*args: P.args, **kwargs: P.kwargs) -> T:
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

        return lookup

    def _put(self, key: Hashable, result: Any, arguments: Any) -> None:
        held = buffers((result, arguments))
        if sum(held.values()) + _ENTRY_OVERHEAD > self._max_bytes or key in self._entries:
            return
        self._entries[key] = result, arguments, held
        self.size += _ENTRY_OVERHEAD
        for buffer, size in held.items():
            references = self._references.get(buffer, 0)
            self._references[buffer] = references + 1
            self.size += 0 if references else size
        while self.size > self._max_bytes:
            self._evict()

    def _evict(self) -> None:
        _, (_, _, held) = self._entries.popitem(last=False)
        self.size -= _ENTRY_OVERHEAD
        for buffer, size in held.items():
            self._references[buffer] -= 1
            if not self._references[buffer]:
                del self._references[buffer]
                self.size -= size


SHARED = Cache(MAX_BYTES)
cached = SHARED.cached
