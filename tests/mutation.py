"""Change the core in 300 places, one at a time, and print which test notices each change: `make mutate`.

MUTATE_SEED chooses the places, MUTATE_PIECE=k/n takes the k-th of n parts of them (docs/explanation/mutation.md).
Everything happens in copies of the repository. As a plugin of pytest this file measures which test reaches which line.
"""

import gc
import json
import os
import re
import resource
import shutil
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import _lru_cache_wrapper, partial
from pathlib import Path
from queue import SimpleQueue
from random import Random
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import coverage
import pytest

ROOT, COUNT, MOST_SURVIVORS = Path(__file__).parents[1], 300, 1 / 15
TESTS = ("unit/test_*.py", "validation/test_*.py", "architecture/test_documentation.py", "client/test_*controllers.py")
# It notices any change of a number and knows nothing of which is right: asked when all others have passed.
GOLDEN = "tests/validation/test_golden.py::test_no_number_changes_without_the_version"
LEFT_OUT = shutil.ignore_patterns(".*", "node_modules", "__pycache__", "*.egg-info", "build")
SWAPS = {"+": "-", "*": "/", "<": "<=", ">": ">=", "==": "!=", "and": "or", "&&": "||", "+=": "-=", "is": "is not"}
SWAPS |= {"min": "max", "minimum": "maximum", "True": "False"}
SWAPS |= {new: old for old, new in SWAPS.items()} | {"**": "*", "%": "*", "not ": ""}
PLACE = re.compile(
    r"(?<= )(?:[-+*/%<>]|[<>=!]=|&&|\|\||[-+]=|and|or|is not|is)(?= )|(?<=\w)\*\*(?=\w)|\bnot (?!in\b)"
    r"|\b(?:(?:min|max)(?:imum)?(?=\()|True|False)\b|(?<![\w.])\d+(?:\.\d*)?(?:e[-+]?\d+)?(?![\w.])"
)
CONDITION = re.compile(r"(?<=if )[^\n]+(?=:\n)|(?<= if )[^\n]+(?= else )")
# Comments and texts, and in Python what people read and what speaks of types.
NO_CODE = {
    ".py": r'"""(?:.|\n)*?"""|f?r?"(?:\\.|[^"\\\n])*"|#[^\n]*|^ *(?:raise|from|import|@)[^\n]*|Annotated\[[^\n]*',
    ".c": r'/\*(?:.|\n)*?\*/|"(?:\\.|[^"\\\n])*"|^#[^\n]*',
}
Place = tuple[str, int, int, str]  # file, first character, end, and what takes their place
_caches = list[Callable[[], None]]()
_coverage, _seconds = coverage.Coverage(data_file=None, include=["*/sim_core/*"]), defaultdict[str, float](float)


def places() -> list[Place]:
    """Return the chosen ones, of a file as many as the root of their number: no table of constants has most.

    Whether a place is chosen follows from the seed and its line: a change elsewhere leaves nearly all as they were.
    """
    keyed = []
    for file in sorted(path for kind in NO_CODE for path in (ROOT / "sim_core").glob(f"**/*{kind}")):
        if re.search(r"setup\.py|kernel/build\.py|/host/", str(file)):  # what installs it, what no test loads
            continue
        source, name = file.read_text(), str(file.relative_to(ROOT))
        code = re.sub(NO_CODE[file.suffix], lambda text: re.sub(r"\S", " ", text[0]), source, flags=re.MULTILINE)
        found = [
            (name, *each.span(), _other(source[slice(*each.span())]))
            for kind in (PLACE, CONDITION)
            for each in kind.finditer(code)
        ]
        alike = Counter[str]()
        for place in found:
            change = f"{os.environ.get('MUTATE_SEED') or 1} {name} {describe(place, source)}"
            alike[change] += 1
            random = Random(f"{change} {alike[change]}")  # noqa: S311  # no secret
            keyed.append((random.random() ** len(found) ** 0.5, place))
    piece, pieces = map(int, (os.environ.get("MUTATE_PIECE") or "1/1").split("/"))
    return [place for _, place in sorted(keyed, reverse=True)[piece - 1 : COUNT : pieces]]


def describe(place: Place, source: str) -> str:
    """Return a place's line before and after."""
    _, first, end, text = place
    line = source.count("\n", 0, first)
    return " -> ".join(each.split("\n")[line].strip() for each in (source, source[:first] + text + source[end:]))


def _other(text: str) -> str:
    if text in SWAPS:
        return SWAPS[text]
    if text.isdigit():
        return str(int(text) + 1)
    try:
        return repr(2 * float(text) or 1.0)
    except ValueError:  # no number, but a condition
        return f"not ({text})"


def run_pytest(copy: Path, *arguments: str, seconds: float = resource.RLIM_INFINITY, **environment: str) -> str | None:
    """Return the first test that fails, or None; one that takes so many seconds of a processor fails too."""
    limit = partial(resource.setrlimit, resource.RLIMIT_CPU, (int(seconds), int(seconds)))
    command = [sys.executable, "-m", "pytest", "-qx", "-p", "no:cacheprovider", "-p", "no:xdist", *arguments]
    at_length = {"THOROUGH": "1", "DRILL_SCENARIOS": "400"}
    settings = {**os.environ, "PYTHONPATH": f"{copy}{os.pathsep}{copy / 'client'}", **at_length, **environment}
    with copy.with_suffix(".log").open("w+") as log:
        code = subprocess.call(command, cwd=copy, env=settings, stdout=log, stderr=log, preexec_fn=limit)
        log.seek(0)
        failed = re.search(r"^(?:FAILED|ERROR) (\S+)", log.read(), re.MULTILINE)
    return None if code == 0 else failed[1] if failed else "a crash, the time limit or an import"


class Copies(SimpleQueue[Path]):
    """Copies of the repository, and which tests reach which line of the core."""

    def __init__(self, folder: Path, pool: ThreadPoolExecutor, number: int) -> None:
        super().__init__()
        for each in range(number):
            shutil.copytree(ROOT, folder / str(each), ignore=LEFT_OUT)
            compile_core(folder / str(each))
            self.put(folder / str(each))
        self.seconds, self.tests = dict[str, float](), defaultdict[str, dict[int, set[str]]](lambda: defaultdict(set))
        files = [file for pattern in TESTS for file in sorted((ROOT / "tests").glob(pattern))]
        for measured in pool.map(self._measure, files):
            self.seconds |= measured["seconds"]
            for name, lines in measured["lines"].items():
                for line, tests in lines.items():
                    self.tests[name][int(line)] |= set(tests)

    def _measure(self, file: Path) -> Any:
        copy = self.get()
        reached = copy.with_suffix(".json")
        failed = run_pytest(copy, "-p", "tests.mutation", str(file.relative_to(ROOT)), REACHED=str(reached))
        self.put(copy)
        if failed:
            print(f"{failed} fails without a change: its file is left out", flush=True)
        return {"seconds": {}, "lines": {}} if failed else json.loads(reached.read_text())

    def of(self, name: str, line: int) -> list[str]:
        """Return the tests that reach a line, the quickest first: of the file where an import runs it, or C."""
        lines = self.tests["sim_core/kernel/library.py" if name.endswith(".c") else name]
        ran = next((lines[at] for at in range(line, 0, -1) if at in lines), {""})
        tests = set().union(*lines.values()) if "" in ran or name.endswith(".c") else ran
        return sorted(tests - {"", GOLDEN}, key=self.seconds.__getitem__)

    def judge(self, place: Place) -> str:
        """Return which test notices a change, `survived` where none does, or `no program` where C does not compile."""
        name, first, end, text = place
        source = (ROOT / name).read_text()
        changed, line = source[:first] + text + source[end:], source.count("\n", 0, first)
        copy = self.get()
        (copy / name).write_text(changed)
        noticed = "no program"
        if name.endswith(".py") or compile_core(copy):
            tests = self.of(name, line + 1)
            seconds = 60 + 3 * sum(self.seconds[each] for each in tests)
            noticed = (tests and run_pytest(copy, *tests, seconds=seconds)) or run_pytest(copy, GOLDEN) or "survived"
        (copy / name).write_text(source)
        if name.endswith(".c"):
            compile_core(copy)
        self.put(copy)
        print(f"{name}:{line + 1} {describe(place, source)} [{noticed}]", flush=True)
        return noticed


def compile_core(copy: Path) -> bool:
    """Compile a copy's C; return whether that can be done."""
    kernel = copy / "sim_core" / "kernel"
    for library in kernel.glob("*.so.1"):  # a process may have it loaded
        library.unlink()
    return subprocess.run([sys.executable, kernel / "build.py", kernel], capture_output=True).returncode == 0


def pytest_configure() -> None:
    """Begin to measure."""
    _coverage.start()


@pytest.hookimpl(tryfirst=True)  # conftest.py hides from `gc` what there is now
def pytest_collection_finish() -> None:
    """Find the core's caches."""
    found = (thing for thing in gc.get_objects() if isinstance(thing, _lru_cache_wrapper))
    _caches.extend(each.cache_clear for each in found if str(each.__module__).startswith("sim_core."))
    if "sim_core.caching" in sys.modules:
        _caches.append(sys.modules["sim_core.caching"].SHARED.clear)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Measure a test function, all its parameters as one, with empty caches: no other one has done its work."""
    for clear in _caches:
        clear()
    test, begin = item.nodeid.partition("[")[0], process_time()
    _coverage.switch_context(test)
    yield
    _coverage.switch_context("")
    _seconds[test] += process_time() - begin


def pytest_sessionfinish() -> None:
    """Write which tests reach which lines of each file, and how long each takes [s]."""
    _coverage.stop()
    data = _coverage.get_data()
    lines = {str(Path(file).relative_to(Path.cwd())): data.contexts_by_lineno(file) for file in data.measured_files()}
    Path(os.environ["REACHED"]).write_text(json.dumps({"seconds": _seconds, "lines": lines}))


def main() -> int:
    """Return the exit code: 0 where at most one change in fifteen survives."""
    number = len(os.sched_getaffinity(0))
    with TemporaryDirectory() as folder, ThreadPoolExecutor(number) as pool:
        noticed = [
            each for each in pool.map(Copies(Path(folder), pool, number).judge, places()) if each != "no program"
        ]
    survived, golden = noticed.count("survived"), noticed.count(GOLDEN)
    print(f"Of {len(noticed)} changes {survived} survive; {golden} are noticed by the stored numbers alone")
    return int(survived > len(noticed) * MOST_SURVIVORS)


if __name__ == "__main__":
    sys.exit(main())
