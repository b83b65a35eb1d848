"""Change the core in 300 places, one at a time, and name the changes that no test notices: `make mutate`.

MUTATE_SEED chooses the places, MUTATE_PIECE=k/n takes the k-th of n lots of them.
docs/explanation/mutation.md explains what may remain. Everything happens in copies of the repository.
"""

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager, suppress
from functools import partial
from importlib.util import cache_from_source
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import TypedDict

from tests.mutation.places import Place, choose

ROOT = Path(__file__).parents[2]
COUNT, PROCESSES = 300, len(os.sched_getaffinity(0))
EXPLAINED = ROOT / "docs/explanation/mutation.md"
TESTS = [
    path.relative_to(ROOT) for folder in ("unit", "validation") for path in (ROOT / "tests" / folder).glob("test_*.py")
]
# Formulas of docs/explanation, examples, ranges of fields; what starts sim_core/check_file.py.
TESTS += [Path("tests/architecture/test_documentation.py"), Path("tests/client/test_own_controllers.py")]
# It notices every change of a number and knows nothing of which is right: asked when all others have passed.
STORED_NUMBERS = "tests/validation/test_golden.py::test_no_number_changes_without_the_version"
# Tests that take so much longer than three times what they take without a change have noticed; processor time, of which
# other programs take none [s].
TEST_LIMIT = 60
CALLS_C = "sim_core/kernel/library.py"
LEFT_OUT = shutil.ignore_patterns(".*", "node_modules", "__pycache__", "*.egg-info", "build", "data")


class Measured(TypedDict):
    """What reach.py writes: seconds of each test, and its lines in each file."""

    seconds: dict[str, float]
    lines: dict[str, dict[str, list[int]]]


class Copies:
    """Copies of the repository, each with a library of its own."""

    def __init__(self, folder: Path) -> None:
        self._free = SimpleQueue[Path]()
        for number in range(PROCESSES):
            copy = folder / str(number)
            shutil.copytree(ROOT, copy, ignore=LEFT_OUT)
            shutil.copytree(ROOT / "tests" / "data", copy / "tests" / "data", dirs_exist_ok=True)
            compile_core(copy)
            self._free.put(copy)

    @contextmanager
    def one(self) -> Iterator[Path]:
        """One that nobody else has meanwhile."""
        copy = self._free.get()
        try:
            yield copy
        finally:
            self._free.put(copy)


def compile_core(copy: Path) -> bool:
    """Whether its C compiles."""
    kernel = copy / "sim_core" / "kernel"
    for library in kernel.glob("*.so.1"):  # never written in place: a process may have it loaded
        library.unlink()
    command = [sys.executable, str(kernel / "build.py"), str(kernel)]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def pytest_in(copy: Path, *arguments: str, limit: str = "unlimited", **environment: str) -> tuple[int, str]:
    """Its exit code and what it said, ended after so much processor time [s]; whatever it started is ended."""
    command = ["sh", "-c", f'ulimit -t {limit}; exec "$@"', "sh", sys.executable, "-m", "pytest", "-q", "-x"]
    command += ["-p", "no:cacheprovider", "-p", "no:xdist", *arguments]
    path = f"{copy}{os.pathsep}{copy / 'client'}"
    log = copy.with_suffix(".log")
    with log.open("w") as said:
        process = subprocess.Popen(
            command,
            cwd=copy,
            env={**os.environ, "PYTHONPATH": path, "THOROUGH": "1", **environment},
            stdout=said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = process.wait()
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
    return code, log.read_text(errors="replace")


class Reach:
    """Which tests reach which lines, and how long each takes."""

    def __init__(self, copies: Copies, pool: ThreadPoolExecutor) -> None:
        self.seconds: dict[str, float] = {}
        self._of_line: dict[tuple[str, int], set[str]] = defaultdict(set)
        self._of_file: dict[str, set[str]] = defaultdict(set)
        for measured in pool.map(partial(_measured, copies, _digest()), TESTS):
            self.seconds |= measured["seconds"]
            for test, files in measured["lines"].items():
                for file, lines in files.items():
                    self._of_file[file].add(test)
                    for line in lines:
                        self._of_line[file, line].add(test)

    def tests(self, place: Place, line: int) -> list[str]:
        """Tests of a place's statement, the quickest first; where the import runs it, all, those of its file first."""
        of_file = self._of_file[CALLS_C if place.file.endswith(".c") else place.file]
        lines = range(place.first, line + 1) if place.inside else ()
        of_line = of_file if place.file.endswith(".c") else set().union(*(self._of_line[place.file, n] for n in lines))
        tests = (of_line or set().union(*self._of_file.values())) - {STORED_NUMBERS}
        return sorted(tests, key=lambda test: (test not in of_file, self.seconds[test]))


def _digest() -> str:
    files = [path for folder in ("sim_core", "backend", "tests") for path in sorted((ROOT / folder).rglob("*.[pcjh]*"))]
    content = hashlib.sha256()
    for path in files:
        if path.suffix in (".py", ".c", ".h", ".json") and path.name not in ("__main__.py", "places.py"):
            content.update(str(path.relative_to(ROOT)).encode() + path.read_bytes())
    return content.hexdigest()[:16]


def _measured(copies: Copies, digest: str, file: Path) -> Measured:
    stored = ROOT / ".cache" / "mutate" / digest / f"{file.stem}.json"
    if not stored.exists():
        stored.parent.mkdir(parents=True, exist_ok=True)
        with copies.one() as copy:
            code, said = pytest_in(copy, "-p", "tests.mutation.reach", str(file), REACH=str(stored.with_suffix(".new")))
        if code:
            raise RuntimeError(f"{file} fails without a change:\n{said}")
        stored.with_suffix(".new").rename(stored)
    measured: Measured = json.loads(stored.read_text())
    return measured


def noticed(copies: Copies, reach: Reach, place: Place) -> str | None:
    """The test that notices a change; None where none does, `no program` where C does not compile."""
    source = (ROOT / place.file).read_bytes()
    with copies.one() as copy:
        file = copy / place.file
        libraries = {path: path.read_bytes() for path in (copy / "sim_core" / "kernel").glob("*.so.1")}
        try:
            file.write_bytes(place.changed(source))
            if file.suffix == ".c" and not compile_core(copy):
                return "no program"
            for tests in (reach.tests(place, place.line(source)), [STORED_NUMBERS]):
                Path(cache_from_source(str(file))).unlink(missing_ok=True)  # of another change in the same second
                usual = sum(reach.seconds[test] for test in tests)
                code, said = pytest_in(copy, *tests, limit=f"{TEST_LIMIT + 3 * usual:.0f}")
                if code:
                    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", said, re.MULTILINE)
                    return failed[1] if failed else "a crash, the time limit or a failed import"
            return None
        finally:
            file.write_bytes(source)
            Path(cache_from_source(str(file))).unlink(missing_ok=True)
            for path, content in libraries.items():
                path.unlink(missing_ok=True)
                path.write_bytes(content)


def main() -> int:
    """The exit code: 0 where at most one change in twenty goes unnoticed, and each of these is explained."""
    seed = int(os.environ.get("MUTATE_SEED") or 1)
    piece, pieces = map(int, (os.environ.get("MUTATE_PIECE") or "1/1").split("/"))
    places = [place for place in choose(COUNT, seed) if int(place.lot * pieces) == piece - 1]
    explained, counts = EXPLAINED.read_text(), dict.fromkeys(("noticed", "stored numbers", "survived", "no program"), 0)
    unexplained = 0
    with TemporaryDirectory() as folder, ThreadPoolExecutor(PROCESSES) as pool:
        copies = Copies(Path(folder))
        reach = Reach(copies, pool)
        begin = perf_counter()
        running = {pool.submit(noticed, copies, reach, place): place for place in places}
        for future in as_completed(running):
            place, by = running[future], future.result()
            source = (ROOT / place.file).read_bytes()
            change = place.describe(source)
            result = "survived" if by is None else by if by == "no program" else "noticed"
            result = "stored numbers" if by == STORED_NUMBERS else result
            counts[result] += 1
            unexplained += result == "survived" and f"{place.file}: {change}" not in explained
            print(f"{result} {place.file}:{place.line(source)} {change}", f"[{by}]" if by else "", flush=True)
    each = (perf_counter() - begin) / len(places)
    print(f"{counts}, {unexplained} of the survivors not explained in docs/explanation/mutation.md; {each:.1f} s each")
    return int(unexplained > 0 or counts["survived"] > len(places) // 20)


if __name__ == "__main__":
    sys.exit(main())
