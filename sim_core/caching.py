"""Results shared between runs, kept while they fit: caches bounded by the bytes of the arrays they hold."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from threading import RLock
from typing import Any, ParamSpec, TypeVar

import numpy as np
from cachetools import LRUCache, cached
from cachetools.keys import hashkey

P = ParamSpec("P")
T = TypeVar("T")

MEBIBYTE = 1024 * 1024
_OVERHEAD = 1024  # counted for every entry, so that small ones do not pile up without end


def size(value: object) -> int:
    """Bytes of the arrays in a value: an array, or dataclasses, tuples and dictionaries of such."""
    if isinstance(value, np.ndarray):
        return value.nbytes
    if is_dataclass(value):
        return sum(size(getattr(value, field.name)) for field in fields(value))
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    return sum(map(size, value)) if isinstance(value, tuple) else 0


def cached_up_to(mebibytes: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Keep a pure function's latest results up to so many MiB; a larger one is not kept at all.

    Arguments must be hashable; results are shared, so nobody may write into them.
    """
    cache: LRUCache[object, Any] = LRUCache(mebibytes * MEBIBYTE, getsizeof=lambda value: size(value) + _OVERHEAD)
    return cached(cache, key=hashkey, lock=RLock())
