"""A page read as a browser reads it, as far as tests need: its elements, their text, and whether all are closed."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"area", "base", "br", "col", "hr", "img", "input", "link", "meta", "rect", "path", "circle", "line", "polyline"}


@dataclass
class Element:
    """One element; `text` is all of the text inside it, of elements inside it too."""

    tag: str
    attributes: dict[str, str | None]
    text: str = ""
    inside: list["Element"] = field(default_factory=list)

    def all(self, tag: str, **wanted: str) -> Iterator["Element"]:
        """The elements below it with that tag and these attributes; `data_cell` stands for data-cell."""
        for each in self.inside:
            named = {name.replace("_", "-"): value for name, value in wanted.items()}
            if each.tag == tag and all(each.attributes.get(name) == value for name, value in named.items()):
                yield each
            yield from each.all(tag, **wanted)


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.root = Element("", {})
        self.open = [self.root]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert len({name for name, _ in attrs}) == len(attrs), (tag, attrs)
        element = Element(tag, dict(attrs))
        self.open[-1].inside.append(element)
        if tag not in VOID:
            self.open.append(element)

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open[-1].tag == tag, f"</{tag}> inside <{self.open[-1].tag}>"
            self.open.pop()

    def handle_data(self, data: str) -> None:
        for element in self.open:
            element.text += data


def read(page: str) -> Element:
    """The page's root.

    Raises:
        AssertionError: An element is not closed, or closed in another's place, or has an attribute twice.
    """
    reader = _Reader()
    reader.feed(page)
    reader.close()
    assert reader.open == [reader.root], f"<{reader.open[-1].tag}> is not closed"
    return reader.root


def check(root: Element) -> None:
    """What every page of ours keeps to: one h1, no id twice, labels that lead somewhere, nothing from elsewhere."""
    everything = list(_walk(root))
    assert sum(element.tag == "h1" for element in everything) == 1
    ids = [element.attributes["id"] for element in everything if "id" in element.attributes]
    assert len(set(ids)) == len(ids)
    for element in everything:
        for name, value in element.attributes.items():
            assert not name.startswith("on"), f"{name} on <{element.tag}>"
            if name in ("aria-labelledby", "aria-describedby"):
                assert value in ids, value
            if name in ("src", "href", "srcset", "action"):
                assert value is not None
                assert value.startswith("#"), value


def _walk(element: Element) -> Iterator[Element]:
    for each in element.inside:
        yield each
        yield from _walk(each)
