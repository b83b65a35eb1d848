"""Places of the core where one operator, constant or condition can be changed, in Python and in C."""

import ast
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from runpy import run_path

CORE = Path(__file__).parents[2] / "sim_core"
_NOT_THE_CORE = {"setup.py", "kernel/build.py"}  # what installs it
_OPERATORS: dict[type[ast.AST], tuple[str, str]] = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.Mod: ("%", "*"),
    ast.Pow: ("**", "*"),
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.And: ("and", "or"),
    ast.Or: ("or", "and"),
    ast.USub: ("-", "+"),
    ast.Not: ("not", ""),
}
_EXTREMES = {"min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum"}
_OF_C = {"+": "-", "-": "+", "*": "/", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
_OF_C |= {"&&": "||", "||": "&&", "+=": "-=", "-=": "+="}
_NO_CODE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|^#[^\n]*', re.DOTALL | re.MULTILINE)
_TOKEN = re.compile(r"(?<= )(?:[-+*/<>]|<=|>=|==|!=|&&|\|\||[-+]=)(?= )|(?<![\w.])\d+(?:\.\d*)?(?:e[-+]?\d+)?(?![\w.])")
# What people read, and what speaks of types; offsets within an f-string are not those of the file.
_SKIPPED = (ast.JoinedStr, ast.Raise, ast.Import, ast.ImportFrom)
_SKIPPED_FIELDS = {"annotation", "returns", "decorator_list"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """One change: the bytes from `start` to `end` of a file become `text`.

    Attributes:
        file: Below the repository.
        first: First line of the statement that it is in, which may begin above it.
        inside: Whether a function runs it, not the import alone.
        lot: A number from 0 to 1 that is its own while its line stays as it is: it says in which piece it is.
    """

    file: str
    start: int
    end: int
    text: bytes
    first: int
    inside: bool
    lot: float = 0.0

    def changed(self, source: bytes) -> bytes:
        """The file with the change."""
        return source[: self.start] + self.text + source[self.end :]

    def line(self, source: bytes) -> int:
        """Its line, from 1."""
        return source.count(b"\n", 0, self.start) + 1

    def describe(self, source: bytes) -> str:
        """Line before and after."""
        changed, line = self.changed(source), self.line(source) - 1
        return " -> ".join(text.decode().split("\n")[line].strip() for text in (source, changed))


def choose(count: int, seed: int) -> list[Place]:
    """So many places: a file has as many as the root of its number of them, so that no table of constants has most.

    Whether a place is chosen follows from the seed and its line: a change elsewhere leaves nearly all as they were.
    """
    keyed = list[tuple[float, Place]]()
    sources = run_path(str(CORE / "kernel" / "build.py"))["SOURCES"]
    python = [path for path in sorted(CORE.rglob("*.py")) if str(path.relative_to(CORE)) not in _NOT_THE_CORE]
    for path in [*python, *sources]:
        source, file = path.read_bytes(), str(path.relative_to(CORE.parent))
        places = list(_in_python(file, source) if path.suffix == ".py" else _in_c(file, source.decode()))
        alike = Counter[str]()
        for place in places:
            name = f"{seed} {file} {place.describe(source)}"
            alike[name] += 1
            random = Random(f"{name} {alike[name]}")  # noqa: S311  # no secret
            keyed.append((random.random() ** (len(places) ** 0.5), replace(place, lot=random.random())))
    return [place for _, place in sorted(keyed, key=lambda pair: -pair[0])[:count]]


def _other_number(value: float) -> str:
    return repr(value + 1 if isinstance(value, int) else 2 * value or 1.0)


def _in_c(file: str, source: str) -> Iterator[Place]:
    code = _NO_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)
    for token in _TOKEN.finditer(code):
        old = token[0]
        new = _OF_C.get(old) or _other_number(int(old) if old.isdigit() else float(old))
        start, end = (len(source[:index].encode()) for index in token.span())
        line = source.count("\n", 0, token.start()) + 1
        yield Place(file=file, start=start, end=end, text=new.encode(), first=line, inside=True)


def _in_python(file: str, source: bytes) -> Iterator[Place]:
    lines = [0]
    for line in source.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))

    def begin(node: ast.expr) -> int:
        return lines[node.lineno - 1] + node.col_offset

    def end(node: ast.expr) -> int:
        return lines[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)

    def changes(node: ast.AST) -> Iterator[tuple[int, int, str]]:
        """First byte, last byte, and what takes their place."""
        between: list[tuple[int, int, ast.AST]] = []
        if isinstance(node, ast.BinOp):
            between = [(end(node.left), begin(node.right), node.op)]
        elif isinstance(node, ast.BoolOp):
            between = [(end(node.values[0]), begin(node.values[1]), node.op)]
        elif isinstance(node, ast.Compare):
            operands = [node.left, *node.comparators]
            between = [(end(operands[i]), begin(operands[i + 1]), op) for i, op in enumerate(node.ops)]
        elif isinstance(node, ast.UnaryOp):
            between = [(begin(node), begin(node.operand), node.op)]
        elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            other = str(not node.value) if isinstance(node.value, bool) else _other_number(node.value)
            yield begin(node), end(node), other
        elif isinstance(node, ast.If | ast.IfExp):
            yield begin(node.test), end(node.test), f"not ({source[begin(node.test) : end(node.test)].decode()})"
        elif isinstance(node, ast.Call):
            name = source[begin(node.func) : end(node.func)].decode().rpartition(".")[2]
            if name in _EXTREMES:
                yield end(node.func) - len(name), end(node.func), _EXTREMES[name]
        for first, last, operator in between:
            old, new = _OPERATORS.get(type(operator), ("", ""))
            if old and (at := source.find(old.encode(), first, last)) >= 0:
                yield at, at + len(old), new

    def visit(node: ast.AST, statement: int, inside: bool) -> Iterator[Place]:
        if isinstance(node, _SKIPPED):
            return
        if isinstance(node, ast.stmt):
            statement = node.lineno
        inside = inside or isinstance(node, ast.FunctionDef | ast.Lambda)
        for first, last, text in changes(node):
            yield Place(file=file, start=first, end=last, text=text.encode(), first=statement, inside=inside)
        for name, value in ast.iter_fields(node):
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST) and name not in _SKIPPED_FIELDS:
                    yield from visit(child, statement, inside)

    yield from visit(ast.parse(source), 1, inside=False)
