"""Why this force, here? What a controller saw and decided at one control step of a run."""

from sim_core.instant.instant import Instant, instant

__all__ = ["Instant", "instant"]
