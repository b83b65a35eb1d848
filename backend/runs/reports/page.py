"""One HTML file: a filled template with its style, its scripts and its security policy.

Every script is in the file and named in the policy by its hash; nothing else runs, and nothing is loaded from anywhere.
The policy is in the file too, for whoever opens a saved copy.
"""

import asyncio
import base64
import gzip
import hashlib
import re
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import orjson
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from backend.runs.reports.keys import inside
from backend.runs.reports.thinning import thinned
from backend.settings import BUILT_PAGE
from sim_core.catalogue import STATISTICS, WINDOWS
from sim_core.comparison import numbers
from sim_core.strategies import label_of

TEMPLATES = Path(__file__).parent / "templates"
PLOTLY = BUILT_PAGE / "report" / "plotly.js"  # with the traces that the lab draws; made with the page
COST = 0.1  # of a report [s of one core]
COMPRESSION = 1  # the same as the service's other answers
# One thread: a report is mostly compressing, which leaves the event loop alone; the next one waits.
_thread = ThreadPoolExecutor(1, thread_name_prefix="report")


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """A report as it is sent: `content` in that `encoding` (None as it is), under that content security policy."""

    content: bytes
    encoding: str | None
    policy: str

    @property
    def headers(self) -> dict[str, str]:
        """The response headers of the report."""
        encoded = {} if self.encoding is None else {"Content-Encoding": self.encoding}
        # A document that may be shown in no frame says so in a header; in a document's own head it would be ignored.
        return {
            "Content-Security-Policy": f"{self.policy}; frame-ancestors 'none'",
            "Vary": "Accept-Encoding",
            **encoded,
        }


async def in_thread(make: Callable[[], Report]) -> Report:
    """The report from `make`, in a thread beside the event loop, one at a time."""
    return await asyncio.get_running_loop().run_in_executor(_thread, make)


def render(template: str, values: Mapping[str, Any], figures: Mapping[str, Any], *, compressed: bool) -> Report:
    """Fill a template.

    Args:
        template: Its file name.
        values: What it shows; text, escaped there.
        figures: Plotly figures by name, thinned here; without any the file has no script.
        compressed: Whether whoever asked takes gzip.
    """
    text = (
        _environment()
        .get_template(template)
        .render(
            **values,
            policy=policy(bool(figures)),
            style=Markup(_file("report.css")),  # noqa: S704  # our own file
            scripts=[Markup(script) for script in scripts()] if figures else [],  # noqa: S704  # our own, and plotly's
            data=_data(thinned(figures)) if figures else None,
        )
    )
    content = text.encode()
    if not compressed:
        return Report(content=content, encoding=None, policy=policy(bool(figures)))
    return Report(content=gzip.compress(content, COMPRESSION, mtime=0), encoding="gzip", policy=policy(bool(figures)))


@cache
def scripts() -> tuple[str, str]:
    """Plotly and the drawing script, as text between script tags."""
    return PLOTLY.read_text(encoding="utf-8"), _file("report.js")


@cache
def policy(drawing: bool) -> str:
    """The content security policy of a report, with figures or without any script.

    Styles are inline in what plotly draws, as on every page of the service.
    """
    hashes = [base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts()]
    allowed = " ".join(f"'sha256-{each}'" for each in hashes) if drawing else "'none'"
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {allowed}",
            "style-src 'unsafe-inline'",
            "img-src data:",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )


def marked(text: str) -> Markup:
    """Text with `backticks` around code, as HTML."""
    pieces = text.split("`")
    return Markup("").join(
        Markup("<code>{}</code>").format(piece) if index % 2 else piece for index, piece in enumerate(pieces)
    )


def minus_signs(text: str) -> str:
    """Text whose negative numbers have a real minus sign."""
    return re.sub(r"(?<![\w-])-(?=\d)", "−", text)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    of_numbers = (numbers.significant, numbers.exact, numbers.percent, numbers.pretty_unit, numbers.printed)
    environment.filters |= {each.__name__: each for each in (*of_numbers, marked, minus_signs, inside)}
    environment.filters["label"] = label_of
    environment.filters["quantity"] = lambda key: (STATISTICS | WINDOWS)[key].label
    return environment


@cache
def _file(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def _data(figures: Mapping[str, Any]) -> Markup:
    """JSON for a script element: nothing in it ends the element."""
    return Markup(orjson.dumps(figures).decode().replace("<", "\\u003c"))  # noqa: S704  # JSON without any "<"
