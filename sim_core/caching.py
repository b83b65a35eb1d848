"""Results shared between runs, kept while they fit: caches bounded by the bytes of the arrays they hold."""

from collections.abc import Callable, Hashable
from contextlib import suppress
from dataclasses import fields, is_dataclass
from functools import cache, wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

import numpy as np
from cachetools import LRUCache
from cachetools.keys import hashkey

P = ParamSpec("P")
T = TypeVar("T")

MEBIBYTE = 1024 * 1024
_OVERHEAD = 1024  # counted for every entry, so that small ones do not pile up without end


def size(value: Any) -> int:
    """Bytes of the arrays in a value: an array, or dataclasses, tuples and dictionaries of such."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    if isinstance(value, tuple):
        return sum(map(size, value))
    names = _field_names(type(value))  # type: ignore[arg-type]  # a class can be hashed
    return sum(map(size, [getattr(value, name) for name in names]))


@cache
def _field_names(kind: Hashable) -> tuple[str, ...]:
    """Fields of a dataclass; of anything else none."""
    return tuple(field.name for field in fields(kind)) if isinstance(kind, type) and is_dataclass(kind) else ()


def cached_up_to(mebibytes: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Keep a pure function's latest results up to so many MiB, arguments counted; a larger one is not kept at all.

    An entry keeps its arguments alive, and their arrays with them, so they count as the result does. Arguments must be
    hashable; results are shared, so nobody may write into them.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        entries: LRUCache[object, tuple[T, object]] = LRUCache(
            mebibytes * MEBIBYTE, getsizeof=lambda entry: size(entry) + _OVERHEAD
        )
        lock = Lock()

        @wraps(function)
        def cached(*args: P.args, **kwargs: P.kwargs) -> T:
            key = hashkey(*args, **kwargs)  # type: ignore[arg-type]  # whatever cannot be hashed fails here
            with lock, suppress(KeyError):
                return entries[key][0]
            result = function(*args, **kwargs)
            with lock, suppress(ValueError):  # larger than the whole cache
                entries[key] = result, (args, tuple(kwargs.values()))
            return result

        return cached

    return decorate
