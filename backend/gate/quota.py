"""A quota: how much of one thing one client and all together may have open; and the fair share of several clients."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from backend.errors import BusyError, TemporaryError, TooManyRequestsError


@dataclass(frozen=True, slots=True, kw_only=True)
class Quota:
    """How much of one thing may be open at once.

    Attributes:
        what: The thing, in refusals.
        taken_by: The work that takes of it, and how much.
        unit: Of the amounts; empty where things are counted.
        per_client: Of one client.
        total: Of all clients.
        fair: `total` is compared with the client's `fair_share` in place of the sum: a greedy client fills its share
            alone, and where nothing is open a request may be as large as it is.
    """

    what: str
    taken_by: str
    unit: str = ""
    per_client: float = math.inf
    total: float = math.inf
    fair: bool = False

    def refusal(self, amounts: Mapping[str, float], client: str, more: float) -> TemporaryError | None:
        """Why the client may not have so much more, where so much is open by client; None where it may."""
        if amounts.get(client, 0.0) + more > self.per_client:
            return TooManyRequestsError(f"At most {self.per_client:g} {self.what} of one client may be open at once.")
        if not self.fair:
            over = sum(amounts.values()) + more > self.total
            return BusyError(f"The service is full: too many {self.what} are open.") if over else None
        if not amounts or fair_share(amounts, client, more) <= self.total:
            return None
        others = {other: each for other, each in amounts.items() if other != client}
        if fair_share(others, client, more) <= self.total:
            return TooManyRequestsError(f"This client has used its share: too much {self.what} of its own is open.")
        return BusyError(f"The service is full: too much {self.what} is open.")


def fair_share(amounts: Mapping[str, float], client: str, more: float) -> float:
    """What comes before a client is through with so much more, where clients take turns.

    All it has itself, and of each other client's amount no more than that: nobody waits for the rest of a larger one.
    """
    own = amounts.get(client, 0.0) + more
    return own + sum(min(own, amount) for other, amount in amounts.items() if other != client)
