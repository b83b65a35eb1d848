"""The paper's reproduction, computed once and kept: what every test of the paper page would else compute anew.

`rows()` is what a service stores for the page by its default readings, without preview and by the favourable ones, on
20 roads. It lies in `.cache/` under a digest of everything its numbers depend on, so it is computed again after any
change of that. A service under test takes it into its database, before it starts or while it runs:

    store_in(store)                                          # a `backend.store.Store` of this process
    store_in_database(f"sqlite:///{folder}/ridelab.sqlite")  # of another one; made where there is none yet

Tests ask for the fixture `reproduction` (tests/servers/fixtures.py), which gives `store_in_database`.
"""

import hashlib
import platform
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import orjson
from filelock import FileLock

from backend.paper import work
from backend.paper.service import stored_rows
from backend.store import Store, StoredResult
from sim_core import __version__ as CORE_VERSION
from sim_core.study import paper
from sim_core.study.interpretations import DEFAULT, FAVOURABLE, Interpretation
from tests.servers.process import ROOT

FOLDER = ROOT / ".cache"
SOURCES = (
    "sim_core",
    "backend/__init__.py",
    "backend/hil",
    "backend/paper/__init__.py",
    "backend/paper/work.py",
    "tests/servers/reproduction.py",
)
WAIT = 240.0  # for another test process that computes it [s]

ROADS = range(1, paper.SEEDS + 1)


def readings(interpretation: Interpretation = DEFAULT, **single: str) -> dict[str, str]:
    """What the runs under these readings are computed from: where their RMS are taken changes no run."""
    return {name: choice for name, choice in (interpretation.choices | single).items() if name != paper.WINDOW}


PARTS: tuple[tuple[Callable[..., list[Any]], tuple[Any, ...]], ...] = (
    (work.simulated_values, (readings(),)),
    (work.simulated_values, (readings(preview="none"),)),
    (work.simulated_values, (readings(FAVOURABLE),)),
    (work.ecu_values, (readings(),)),
    (work.ecu_values, (readings(preview="none"),)),
    (work.ecu_values, (readings(FAVOURABLE),)),
    (work.combinations, ()),
    (work.peaks_over_speed, ()),
)


def rows() -> list[StoredResult]:
    """What a service stores for the page; computed where no test process of this checkout has done so yet."""
    path = FOLDER / f"reproduction-{digest()}.json"
    FOLDER.mkdir(exist_ok=True)
    with FileLock(FOLDER / "reproduction.lock", timeout=WAIT):
        if not path.exists():
            for old in FOLDER.glob("reproduction-*"):
                old.unlink()
            beside = path.with_suffix(".part")
            beside.write_bytes(orjson.dumps(computed(), option=orjson.OPT_SERIALIZE_NUMPY))
            beside.replace(path)
    kept = orjson.loads(path.read_bytes())
    return [
        stored_rows(function, given, ROADS, part["rows"], part["compute_ms"])
        for (function, given), part in zip(PARTS, kept, strict=True)
    ]


def computed() -> list[dict[str, Any]]:
    """Each part's rows, and how long they took [ms]."""
    parts = []
    for function, given in PARTS:
        begin = time.perf_counter()
        found = function(*given, ROADS)
        parts.append({"rows": found, "compute_ms": 1000 * (time.perf_counter() - begin)})
    return parts


def store_in(store: Store, *, ecu: bool = True) -> None:
    """Put it where this store's service looks for it; what is there stays.

    Args:
        store: Of the service.
        ecu: With hardware in the loop, which a service without a C compiler has never computed.
    """
    for item in rows():
        if ecu or item.strategy != "paper.ecu_values":
            store.runs.save_result(item, CORE_VERSION)


def store_in_database(url: str, *, ecu: bool = True) -> None:
    """The same for a database of that SQLAlchemy URL, brought up to the newest schema."""
    store = Store(url)
    try:
        store.migrate()
        store_in(store, ecu=ecu)
    finally:
        store.close()


def digest(root: Path = ROOT, sources: Iterable[str] = SOURCES) -> str:
    """Of all the numbers depend on: sources, installed packages, Python and machine."""
    found = hashlib.sha256(repr([sys.version, platform.machine(), packages(sys.path)]).encode())
    for path in files(root, sources):
        found.update(f"{path.relative_to(root)}\0".encode() + hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()[:24]


def files(root: Path, sources: Iterable[str]) -> list[Path]:
    """Every file named or below a folder named, but for what Python compiled."""
    below = [path for name in sources for path in (root / name, *(root / name).rglob("*"))]
    return sorted(path for path in below if path.is_file() and "__pycache__" not in path.parts)


def packages(places: Sequence[str]) -> list[str]:
    """Names and versions of what is installed in these folders."""
    return sorted({path.name for place in places for path in Path(place).glob("*.dist-info")})
