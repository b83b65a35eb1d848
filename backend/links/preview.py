"""The preview of a link in a chat program: a title and a description with the main numbers, in the page's head."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from html import escape

from backend.json_types import JsonObject
from backend.runs.reports.keys import inside
from sim_core.catalogue import BUMP, METRICS, PAPER_SIGNALS, PEAK, SIGNALS, WHOLE, metric_key
from sim_core.strategies import label_of

SIGNALS_SHOWN = PAPER_SIGNALS[:2]
FIELDS_SHOWN = 4
GENERIC_TITLE = "There is no such link"
GENERIC_DESCRIPTION = "A what-if laboratory for active suspension over bumps."


@dataclass(frozen=True, slots=True, kw_only=True)
class Preview:
    """Title and description, plain text."""

    title: str = GENERIC_TITLE
    description: str = GENERIC_DESCRIPTION


def of_run(run: JsonObject, view: JsonObject, computed_at: datetime) -> Preview:
    """Return the preview of a link to a run.

    Args:
        run: As `Run` or `RoadsRun`, its scenario today's.
        view: As `LinkView`: the title names what it shows and compares.
        computed_at: When it was computed.
    """
    entries = {name: entry for name, entry in run["strategies"].items() if entry["status"] == "ok"}
    main, baseline = _compared(list(entries), view)
    window = BUMP if run["scenario"]["road"]["bump"]["height"] else WHOLE
    phrases = [
        text
        for signal in SIGNALS_SHOWN
        if main is not None and (text := _phrase(entries[main], entries.get(baseline or ""), window, signal))
    ]
    where = " on the bump" if window == BUMP else ""
    who = label_of(main or "") + ("" if baseline is None else f" against {inside(label_of(baseline))}")
    title = f"{who}: {phrases[0]}{where}" if phrases else "A stored run"
    facts = ", ".join(phrases)
    return Preview(
        title=title,
        description="; ".join(
            [
                *([f"{who}: {facts}{where}"] if facts else []),
                *([f"mean of {run['roads']} roads"] if "roads" in run else []),
                *_drive(run["scenario"]),
                _stamp(run["core_version"], computed_at),
            ]
        ),
    )


def of_batch(batch: JsonObject, computed_at: datetime) -> Preview:
    """Return the preview of a link to a batch.

    Args:
        batch: As `Batch`; one that is not planned yet has no total and no fields.
        computed_at: When it was computed.
    """
    if batch["total"] is None:
        title = "A sweep"
    else:
        fields = [_field(field) for field in batch["fields"]]
        swept = " × ".join(fields[:FIELDS_SHOWN]) + (" × …" if len(fields) > FIELDS_SHOWN else "")
        count = f"{batch['total']:,}".replace(",", " ")
        title = f"{count} runs over {swept}"
    who = ", ".join(label_of(name) for name in batch["strategies"])
    failures = [f"{batch['failed']} failed"] if batch["failed"] else []
    state = [] if batch["state"] == "done" else [batch["state"]]
    stamp = _stamp(batch["core_version"], computed_at)
    return Preview(title=title, description="; ".join([f"{title}: {who}", *state, *failures, stamp]))


def page(index: str, preview: Preview, *, shared: bool = True) -> str:
    """Return the dashboard's page with that head instead of its own title and description.

    Args:
        index: The built `index.html`.
        preview: What to say, escaped here.
        shared: Whether chat programs get a card; False for a page that is not there.
    """
    title, description = escape(f"{preview.title} · Ridelab"), escape(preview.description)
    tags = [f"<title>{title}</title>", f'<meta name="description" content="{description}">']
    if shared:
        tags += [
            f'<meta property="og:title" content="{title}">',
            f'<meta property="og:description" content="{description}">',
            '<meta property="og:type" content="website">',
            '<meta property="og:site_name" content="Ridelab">',
            '<meta name="twitter:card" content="summary">',
        ]
    tags.append('<meta name="robots" content="noindex">')
    bare = re.sub(r'<title>.*?</title>\s*|<meta\s+name="description"[^>]*>\s*', "", index, flags=re.DOTALL)
    head, end, rest = bare.partition("</head>")
    return "\n".join([head.rstrip(), *(f"    {tag}" for tag in tags), f"  {end}{rest}"])


def _compared(names: Sequence[str], view: JsonObject) -> tuple[str | None, str | None]:
    """Return the strategy that the title names and the one it is compared with, among those that succeeded."""
    baseline = view.get("baseline") or "passive"
    shown = [name for name in view.get("strategies") or names if name in names]
    visible = [name for name in shown if name not in (view.get("hidden") or [])] or shown or list(names)
    main = next((name for name in visible if name != baseline), visible[0] if visible else None)
    return main, baseline if baseline in names and baseline != main else None


def _phrase(entry: JsonObject, against: JsonObject | None, window: str, signal: str) -> str | None:
    """`45 % less peak body acceleration`, or the peak itself where there is nothing to compare it with."""
    quantity = SIGNALS[signal]
    what = f"peak {quantity.label.lower()}"
    value = _peak(entry, window, signal)
    reference = _peak(against, window, signal) if against is not None else None
    if value is None:
        return None
    if not reference:
        return f"{what} {value:.3g} {quantity.unit.replace('^2', '²')}"
    change = round(100 * (value / reference - 1))
    if change == 0:
        return f"the same {what}"
    return f"{abs(change)} % {'less' if change < 0 else 'more'} {what}"


def _peak(entry: JsonObject, window: str, signal: str) -> float | None:
    """Return the peak in a summary, which an older core may have written with other names."""
    value = METRICS[metric_key(window, signal, PEAK)].of(entry)
    if isinstance(value, Mapping):
        value = value["mean"]
    return value if isinstance(value, int | float) else None


def _field(field: Mapping[str, str]) -> str:
    """Return a swept field's title, with its part where the title alone is ambiguous: `bump height`, `target speed`."""
    part, title = ("", *field["name"].split("."))[-2].replace("_", " "), field["title"].lower()
    return title if part in title else f"{part} {title}"


def _drive(scenario: JsonObject) -> list[str]:
    road, speed = scenario["road"], scenario["speed"]
    bump, measured = road["bump"], road["profile"] is not None
    height, width = bump["height"], f"{bump['width']:g} m"
    kind = "kerb" if bump["shape"] == "kerb" else "bump" if height > 0 else "pothole"
    several = f"{bump['count']} × " if bump["count"] > 1 else ""
    obstacle = f"{several}{kind} {_length(abs(height))} m × {width}" if height else "" if measured else "no bump"
    shown = ", ".join(filter(None, ["measured road" if measured else "", obstacle]))
    return [f"{shown}, {speed['initial_speed_kmh']:g} → {speed['target_speed_kmh']:g} km/h"]


def _length(value: float) -> str:
    """Return a length with two decimals, or three where they are needed."""
    text = f"{value:.3f}"
    return text.removesuffix("0")


def _stamp(core_version: str, computed_at: datetime) -> str:
    return f"Ridelab core {core_version}, {computed_at:%Y-%m-%d}"
