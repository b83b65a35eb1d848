"""docs/explanation/nearest.md shows what `make nearest` prints; UPDATE_DOCS=1 writes it there."""

import os
import re
import sys
from pathlib import Path

import pytest

from benchmarks import nearest

PAGE = Path(__file__).parents[2] / "docs/explanation/nearest.md"
BLOCK = re.compile(r"(?<=^```text\n).*?(?=^```$)", re.DOTALL | re.MULTILINE)


@pytest.mark.timeout(1800)
def test_the_page_shows_what_is_printed(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Each block of the page is the part of the output that begins as it does."""
    monkeypatch.setattr(sys, "argv", ["nearest"])
    nearest.main()
    parts = [f"{part}\n" for part in capsys.readouterr().out.strip("\n").split("\n\n")]

    def part_of(block: re.Match[str]) -> str:
        begin = block[0].partition("\n")[0][:18]
        (part,) = (each for each in parts if each.startswith(begin))
        return part

    page = PAGE.read_text(encoding="utf-8")
    assert len(BLOCK.findall(page)) == len(parts)
    written = BLOCK.sub(part_of, page)
    if os.environ.get("UPDATE_DOCS"):
        PAGE.write_text(written, encoding="utf-8")
    assert written == page or os.environ.get("UPDATE_DOCS")
