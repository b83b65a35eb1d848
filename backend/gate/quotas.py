"""The table of quotas: what may be open at once, by whom, and which work takes of it.

docs/how-to/operations.md shows it.
"""

import math
from collections.abc import Mapping

from backend.gate.quota import Quota
from backend.settings import Settings

MEBIBYTE = 1024 * 1024


def quotas(settings: Settings) -> dict[str, Quota]:
    """Each quota by its name."""
    requests = settings.max_client_requests
    return {
        "requests": Quota(
            what="requests",
            taken_by="1: every request that may compute or reads much; planning, summaries, the paper's page",
            per_client=requests,
        ),
        "computing": Quota(
            what="computing requests",
            taken_by="1: what is not stored and is computed, drawn or rendered; a download, until all of it was sent",
            per_client=requests,
        ),
        "cost": Quota(
            what="computing",
            taken_by="the estimate of what `computing` counts",
            unit="s of one core",
            total=settings.max_queued_cost,
            fair=True,
        ),
        "background_cost": Quota(
            what="planning and summarising",
            taken_by="the estimate of plans, trial runs and summaries of batches; a road file: 1",
            unit="s of one core",
            total=settings.max_queued_cost,
            fair=True,
        ),
        "reports": Quota(what="reports", taken_by="1: a report, which one thread makes", per_client=2),
        "controller": Quota(
            what="controller reports or real-time drives",
            taken_by="1: a controller's report or drive by the clock, which wants a core to itself",
            per_client=1,
            total=1,
        ),
        "road_files": Quota(what="road files", taken_by="1: a measured road being read", per_client=1, total=2),
        "bodies": Quota(
            what="long request bodies",
            taken_by="1 for each 4 MiB begun: a body over 64 KiB, from its first byte to the answer",
            per_client=4,
            total=16,
        ),
        "streams": Quota(
            what="event streams",
            taken_by="1: a job's events",
            per_client=settings.max_client_streams,
            total=settings.max_streams,
        ),
        "long_answers": Quota(
            what="long answers", taken_by="1: an answer over 4 MiB, a file until it is read", per_client=48, total=128
        ),
        "long_answer_bytes": Quota(
            what="space for long answers",
            taken_by="the expected length of that file",
            unit="bytes",
            total=settings.spool_bytes,
            fair=True,
        ),
        "pinned_bytes": Quota(
            what="pinned time histories",
            taken_by="the length of a link's time histories while they are read",
            unit="bytes",
            total=64 * MEBIBYTE,
            fair=True,
        ),
    }


def explained(table: Mapping[str, Quota]) -> str:
    """The quotas as a table in Markdown."""
    lines = ["| quota | taken by | one client (429) | all together (503) |", "|---|---|---|---|"]
    for name, quota in table.items():
        total = _amount(quota.total, quota.unit)
        if quota.fair:
            total = f"{total} before a client's turn is over (429 by its own)"
        lines.append(f"| `{name}` | {quota.taken_by} | {_amount(quota.per_client, quota.unit)} | {total} |")
    return "\n".join(lines)


def _amount(amount: float, unit: str) -> str:
    if math.isinf(amount):
        return ""
    if unit == "bytes":
        return f"{amount / MEBIBYTE:g} MiB"
    return f"{amount:g} {unit}".rstrip()
