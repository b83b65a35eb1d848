"""Facts about the repository itself: sizes, locks, links, targets."""

import re
import subprocess
from pathlib import Path

import check_jsonschema
import pytest

import sim_core

ROOT = Path(__file__).parents[2]
TARGET = re.compile(r"\bmake ([a-z][a-z-]*)")
LINK = re.compile(r"(?<!!)\[[^\]\n]+\]\(([^)\s]+)\)")
IMAGE = re.compile(r"!\[[^\]\n]*\]\(([^)\s]+)\)")
# A path from the root of the repository; after a colon it is another commit's.
NAMED = re.compile(
    r"(?<![\w/.:])(?:sim_core|backend|client|frontend|tests|benchmarks|docs)/[\w./-]+\.(?:py|c|h|md|tsx?)\b"
)


def tracked(*patterns: str) -> list[Path]:
    """Files git knows, committed or about to be, that match; outside a checkout (a source archive) all of them."""
    run = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if run.returncode == 0:
        return [ROOT / name for name in run.stdout.splitlines() if (ROOT / name).is_file()]
    return [path for pattern in patterns for path in ROOT.rglob(pattern) if ".venv" not in path.parts]


def test_no_source_file_is_over_400_lines() -> None:
    """Past that a concept is missing (docs/style: about 300). Generated files say so in their name."""
    sources = [path for path in tracked("*.py", "*.ts", "*.tsx", "*.css") if ".gen." not in path.name]
    assert len(sources) > 20
    long = {str(path.relative_to(ROOT)): n for path in sources if (n := len(path.read_text().splitlines())) > 400}
    assert not long


def test_no_symbolic_link_is_in_the_repository() -> None:
    """One in the place of frontend/dist once replaced the page that was built there."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False).stdout
    assert [name for name in names.split("\0") if name and (ROOT / name).is_symlink()] == []


def pages() -> list[Path]:
    """Every page written for people."""
    return [path for path in tracked("*.md") if "node_modules" not in path.parts]


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_links_to_files_and_headings_resolve(page: Path) -> None:
    text = page.read_text()
    for link in LINK.findall(text) + IMAGE.findall(text):
        if "://" in link or link.startswith(("mailto:", "/?")):  # the lab's own page
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), f"{page.name}: {link}"
        if anchor and target.suffix == ".md":
            assert anchor in headings(target), f"{page.name}: {link}"


def test_files_that_code_and_comments_name_exist() -> None:
    named = {name for path in tracked("*.py", "*.[ch]", "*.ts", "*.tsx") for name in NAMED.findall(path.read_text())}
    assert len(named) > 50
    assert sorted(name for name in named if not (ROOT / name).exists()) == []


def headings(page: Path) -> set[str]:
    """The anchors a Markdown page's headings get."""
    lines = [line.lstrip("#").strip().lower() for line in page.read_text().splitlines() if re.match(r"#{1,6} ", line)]
    return {re.sub(r"[^\w\- ]", "", line).replace(" ", "-") for line in lines}


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_every_make_target_named_exists(page: Path) -> None:
    makefiles = [place / "Makefile" for place in (ROOT, page.parent) if (place / "Makefile").exists()]
    targets = {name for file in makefiles for name in re.findall(r"^([a-z][a-z-]*):", file.read_text(), re.MULTILINE)}
    code = "\n".join(re.findall(r"```.*?```|`[^`\n]+`", page.read_text(), re.DOTALL))
    assert set(TARGET.findall(code)) <= targets


def test_the_index_of_decisions_has_each_with_its_date_and_status() -> None:
    folder = ROOT / "docs/decisions"
    index = (folder / "README.md").read_text()
    for page in folder.glob("0*.md"):
        title, empty, dated, *_ = page.read_text().splitlines()
        date, status = dated.split(" · ")
        assert not empty
        number, name = title.removeprefix("# ").split(" ", 1)
        assert f"| [{number}]({page.name}) | {name} | {date} | {status} |" in index


@pytest.mark.parametrize(
    ("schema", "pattern"),
    [
        ("vendor.citation-file-format", "CITATION.cff"),
        ("vendor.github-workflows", ".github/workflows/*.yml"),
        ("vendor.github-issue-forms", ".github/ISSUE_TEMPLATE/[!c]*.yml"),
        ("vendor.github-issue-config", ".github/ISSUE_TEMPLATE/config.yml"),
        ("vendor.dependabot", ".github/dependabot.yml"),
    ],
)
def test_files_for_other_programs_are_what_their_schema_asks(
    schema: str, pattern: str, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(path) for path in ROOT.glob(pattern)]
    assert files
    code = check_jsonschema.main(["--builtin-schema", schema, *files], standalone_mode=False)
    assert code == 0, capsys.readouterr().out


def test_citation_and_changelog_have_this_version_and_its_day() -> None:
    releases = re.findall(r"^## \[([\d.]+)\] - (\S+)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    version, day = releases[0]
    assert version == sim_core.__version__
    assert f"\nversion: {version}\ndate-released: {day}\n" in (ROOT / "CITATION.cff").read_text()
