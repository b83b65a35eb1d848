"""A plugin of pytest: which lines of the core each test reaches, as JSON in the file that REACH names.

Every test begins with empty caches: none has its work done by the one before it.
"""

import gc
import json
import os
from collections import defaultdict
from collections.abc import Iterator
from functools import _lru_cache_wrapper
from pathlib import Path
from time import process_time

import coverage
import pytest

CORE = Path("sim_core").resolve()
_coverage = coverage.Coverage(data_file=None, source=[str(CORE)])
_coverage.start()
_seconds: dict[str, float] = defaultdict(float)
_caches: list["_lru_cache_wrapper[object]"] = []


def pytest_collection_finish() -> None:
    """Find the caches."""
    found = (thing for thing in gc.get_objects() if isinstance(thing, _lru_cache_wrapper))
    _caches.extend(cache for cache in found if str(cache.__module__).startswith("sim_core."))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """A context for each test function, for all its parameters."""
    from sim_core.caching import SHARED  # not before the coverage has begun

    SHARED.clear()
    for cache in _caches:
        cache.cache_clear()
    test, begin = item.nodeid.partition("[")[0], process_time()
    _coverage.switch_context(test)
    try:
        return (yield)
    finally:
        _coverage.switch_context("")
        _seconds[test] += process_time() - begin


def pytest_sessionfinish() -> None:
    """Write it."""
    _coverage.stop()
    data = _coverage.get_data()
    lines: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
    for file in data.measured_files():
        for line, tests in data.contexts_by_lineno(file).items():
            for test in filter(None, tests):
                lines[test][str(Path(file).relative_to(CORE.parent))].append(line)
    Path(os.environ["REACH"]).write_text(json.dumps({"seconds": _seconds, "lines": lines}))
