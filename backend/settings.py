"""Settings of the service: defaults, overridden by `RIDELAB_*` environment variables and the command line."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError

PREFIX = "RIDELAB_"
MEBIBYTE = 1024 * 1024


class SettingsError(ValueError):
    """A setting has an unusable value; the message names the variable and the limit."""


def _default_workers() -> int:
    """At least two, so that a crash leaves a warm one; at most four, one person's slider fills no more."""
    return max(2, min(4, os.cpu_count() or 1))


class Settings(BaseModel):
    """Everything an operator may change; the variable's name is `RIDELAB_` and the field's in capitals."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    data_dir: Path = Field(Path("data"), description="Where the SQLite database lives.")
    database_url: str | None = Field(None, description="SQLAlchemy URL; without one SQLite in data_dir.")
    frontend_dir: Path = Field(
        Path(__file__).parent.parent / "frontend" / "dist", description="The built frontend and the API page's assets."
    )
    workers: int = Field(default_factory=_default_workers, ge=1, le=64, description="Warm worker processes.")
    run_timeout: float = Field(90, gt=0, le=3600, description="One worker task may take this long [s].")
    max_request_cost: float = Field(30, gt=0, description="Greatest estimated cost of one request [s of one core].")
    max_queued_cost: float = Field(
        120, gt=0, description="Estimated cost [s of one core] accepted at once; beyond it 503."
    )
    max_client_requests: int = Field(64, ge=1, description="Computing requests one client may have open; then 429.")
    max_body_bytes: int = Field(MEBIBYTE, ge=1024, description="Longest request body.")
    series_cache_bytes: int = Field(256 * MEBIBYTE, ge=0, description="Memory for time histories.")

    @classmethod
    def from_environment(cls, environment: Mapping[str, str], **overrides: object) -> Self:
        """Settings from `RIDELAB_*` variables; `overrides` that are not None win.

        Raises:
            SettingsError: A variable's value does not fit, or no setting has its name.
        """
        values: dict[str, object] = {
            name.removeprefix(PREFIX).lower(): value for name, value in environment.items() if name.startswith(PREFIX)
        }
        values |= {name: value for name, value in overrides.items() if value is not None}
        try:
            return cls.model_validate(values)
        except ValidationError as error:
            reasons = [f"{PREFIX}{str(item['loc'][0]).upper()}: {item['msg']}" for item in error.errors()]
            raise SettingsError("; ".join(reasons)) from None

    @property
    def store_url(self) -> str:
        """The database's SQLAlchemy URL."""
        return self.database_url or f"sqlite:///{(self.data_dir / 'ridelab.sqlite').absolute()}"
