"""A measured road: its heights, packed, under an id that is their digest; `sim_core.road.survey` makes them."""

import base64
import hashlib
import zlib
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray

PER_METRE = 100  # heights
SPACING = 1 / PER_METRE  # between heights [m]: the grid of `sim_core.road.profile`
RESOLUTION = 1e-6  # of a height [m]
ID_LENGTH = 22
ID_PATTERN = f"^[A-Za-z0-9][A-Za-z0-9_-]{{{ID_LENGTH - 1}}}$"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Packed:
    """Measured numbers under an id that is their digest: equal ids, equal numbers.

    Attributes:
        id: Digest of the numbers, `packed_id`.
        samples: How many there are of each signal.
        content: The numbers, packed.
    """

    id: str
    samples: int
    content: bytes

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self.id == other.id

    def __hash__(self) -> int:
        return hash(self.id)


def packed_id(plain: bytes) -> str:
    """Return the id of numbers as plain bytes: text that may stand in addresses and scenarios (`ID_PATTERN`)."""
    return base64.urlsafe_b64encode(hashlib.sha256(plain).digest()).decode().lstrip("-_")[:ID_LENGTH]


class MeasuredRoad(Packed):
    """Heights from x = 0 on, `SPACING` apart."""

    __slots__ = ()

    @property
    def length(self) -> float:
        """Return the distance from the first height to the last [m]."""
        return (self.samples - 1) / PER_METRE

    @classmethod
    def of(cls, heights: FloatArray) -> "MeasuredRoad":
        """Return the road of these heights (samples,) [m], to a micrometre."""
        steps = np.diff(np.round(heights / RESOLUTION).astype("<i4"), prepend=np.int32(0))
        plain = steps.astype("<i4").tobytes()
        return cls(id=packed_id(b"ridelab road 1\n" + plain), samples=len(heights), content=zlib.compress(plain))

    def heights(self) -> FloatArray:
        """Return the heights (samples,) [m]."""
        steps = np.frombuffer(zlib.decompress(self.content), dtype="<i4")
        return np.asarray(steps.cumsum(dtype=np.int64) * RESOLUTION)
