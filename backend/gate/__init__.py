"""The gate: who may have how much computed, sent and stored at once."""

from backend.gate.gate import Gate

__all__ = ["Gate"]
