"""Settings of the service: defaults, overridden by `RIDELAB_*` environment variables and the command line."""

import os
import re
from collections.abc import Mapping
from difflib import get_close_matches
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, ValidationInfo, field_validator, model_validator

from backend.command_error import CommandError
from backend.setting_types import Hosts, NewFolder, Proxies, SchedulerAddress, TokensFile, items

PREFIX = "RIDELAB_"
CLIENT_VARIABLES = {"RIDELAB_SERVER", "RIDELAB_TOKEN"}  # of the command line; a service starts all the same
MEBIBYTE = 1024 * 1024
MAX_BODY_BYTES = MEBIBYTE  # of a request's body in JSON
MAX_BATCH_RUNS = 100_000  # of one job
MAX_UNFINISHED_JOBS = 1000  # of one kind, waiting or running
# What earlier releases had: the log names such a variable, and docs/how-to/operations.md what there is instead.
REMOVED = frozenset(
    f"RIDELAB_{name}"
    for name in [
        "MAX_CONNECTIONS",
        "MAX_CLIENT_CONNECTIONS",
        "MAX_BODY_BYTES",
        "MAX_BATCH_RUNS",
        "MAX_UNFINISHED_BATCHES",
        "FRONTEND_DIR",
        "LOG_FORMAT",
        "MAX_STREAMS",
        "MAX_CLIENT_STREAMS",
        "MAX_QUEUED_COST",
        "MAX_WAIT",
        "BODY_TIMEOUT",
        "HEAD_TIMEOUT",
        "ECU_DIR",
    ]
)
_PACKAGE = Path(__file__).parent
# In the installed distribution or in a checkout.
BUILT_PAGE, BUILT_MANUAL = (
    _PACKAGE / name if (_PACKAGE / name).is_dir() else _PACKAGE.parent / checkout
    for name, checkout in (("page", "frontend/dist"), ("manual", "build/manual"))
)


def _default_workers() -> int:
    """At least two, so that a crash leaves a warm one; at most four, one person's slider fills no more."""
    return max(2, min(4, os.cpu_count() or 1))


class Settings(BaseModel):
    """Everything an operator may change; the variable's name is `RIDELAB_` and the field's in capitals.

    Attributes:
        data_dir: Where the SQLite database lives.
        database_url: SQLAlchemy URL; without one SQLite in data_dir.
        database_password_file: File with the database's password, so that the URL needs none.
        workers: Warm worker processes.
        run_timeout: One worker task may take this long [s].
        controllers: Files and folders with controllers of one's own, separated like PATH: each file is run, as code
            that you trust.
        controller_timeout: One run of such a controller may take this long [s]; less than RUN_TIMEOUT.
        max_request_cost: Greatest estimated cost of one request [s of one core].
        max_client_requests: Requests one client may have open, waiting for their turn or handled; then 429.
        batch_workers: Processes for batches where no Dask scheduler is named.
        max_batch_cost: Greatest estimated cost of one batch [s of one core]; beyond it 422.
        dask_scheduler: Address of a Dask scheduler; without one this machine's processes compute the batches.
        dask_tls_ca_file: Certificate authority of the Dask cluster (PEM).
        dask_tls_cert_file: This service's certificate for Dask (PEM).
        dask_tls_key_file: Its key (PEM).
        forwarded_allow_ips: Proxies whose X-Forwarded-For names the client: addresses, networks, or *.
        allowed_hosts: Names the service answers to, with commas; *.example.com is all below it, * any; none is any,
            and this machine's own names where it listens on loopback.
        tokens_file: File with a name and a token a line: then the API answers those with a token only.
        one_user: One person uses this service: without tokens, whoever reaches it lists links, roads and recordings
            and takes them back.
        log_level: Least level that is logged.
        retention_days: Jobs and results older than this are removed [days]; none are where it is not set.
        retention_bytes: The oldest jobs and results are removed where all take more than this [bytes].
        spool_bytes: Answers too long for memory, in files in data_dir until they are read [bytes]; then 429 or 503.
        series_cache_bytes: Memory for results and their time histories.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    data_dir: NewFolder = Path("data")
    database_url: str | None = None
    database_password_file: Path | None = None
    workers: int = Field(default_factory=_default_workers, ge=1, le=64)
    run_timeout: float = Field(90, gt=0, le=3600)
    controllers: str | None = None
    controller_timeout: float = Field(20, gt=0, le=3600)
    max_request_cost: float = Field(30, gt=0)
    max_client_requests: int = Field(256, ge=1)
    batch_workers: int = Field(default_factory=lambda: os.cpu_count() or 1, ge=1, le=256)
    max_batch_cost: float = Field(100000, gt=0)
    dask_scheduler: SchedulerAddress | None = None
    dask_tls_ca_file: Path | None = None
    dask_tls_cert_file: Path | None = None
    dask_tls_key_file: Path | None = None
    forwarded_allow_ips: Proxies = ""
    allowed_hosts: Hosts = ""
    tokens_file: TokensFile | None = None
    one_user: bool = False
    log_level: Literal["debug", "info", "warning", "error"] = "info"
    retention_days: float | None = Field(None, gt=0)
    retention_bytes: int | None = Field(None, ge=MEBIBYTE)
    spool_bytes: int = Field(4096 * MEBIBYTE, ge=64 * MEBIBYTE)
    series_cache_bytes: int = Field(256 * MEBIBYTE, ge=0)

    @classmethod
    def from_environment(cls, environment: Mapping[str, str], **overrides: object) -> Self:
        """Settings from `RIDELAB_*` variables; `overrides` that are not None win.

        Raises:
            CommandError: A variable's value does not fit, or no setting has its name; the message names the variable
                and the limit.
        """
        values: dict[str, object] = {
            name.removeprefix(PREFIX).lower(): value
            for name, value in environment.items()
            if name.startswith(PREFIX) and name not in CLIENT_VARIABLES and name not in REMOVED
        }
        values |= {name: value for name, value in overrides.items() if value is not None}
        try:
            return cls.model_validate(values)
        except ValidationError as error:
            reasons = [
                _reason(item["loc"], _unknown(item["loc"][0]) if item["type"] == "extra_forbidden" else item["msg"])
                for item in error.errors(include_url=False)
            ]
            raise CommandError("; ".join(reasons)) from None

    @field_validator("*", mode="before")
    @classmethod
    def _check_not_empty(cls, value: Any, field: ValidationInfo) -> Any:
        """An empty variable is no value; as a path it would be the working directory."""
        if value == "" and cls.model_fields[str(field.field_name)].default != "":
            raise ValueError("it is empty; leave it out for the default")
        return value

    @model_validator(mode="after")
    def _check_timeouts(self) -> Self:
        if self.controllers is not None and self.controller_timeout >= self.run_timeout:
            raise ValueError(f"{_variable('controller_timeout')} has to be less than {_variable('run_timeout')}")
        return self

    @model_validator(mode="after")
    def _check_dask(self) -> Self:
        """A scheduler's address needs Dask; TLS needs its three files, and they go together."""
        if self.dask_scheduler is not None and find_spec("distributed") is None:
            raise ValueError(f"{_variable('dask_scheduler')} needs Dask: pip install distributed")
        names = ("dask_tls_ca_file", "dask_tls_cert_file", "dask_tls_key_file")
        files: dict[str, Path | None] = {name: getattr(self, name) for name in names}
        encrypted = self.dask_scheduler is not None and self.dask_scheduler.startswith("tls://")
        if encrypted or any(files.values()):
            missing = [_variable(name) for name, path in files.items() if path is None]
            if missing:
                raise ValueError(f"TLS to Dask needs three files; {' and '.join(missing)} not set")
            if not encrypted:
                raise ValueError(f"{_variable('dask_scheduler')} has to start with tls:// where TLS files are named")
        for name, path in files.items():
            _check_readable(name, path)
        if encrypted:
            _check_certificates(files)
        return self

    @field_validator("database_url")
    @classmethod
    def _name_driver(cls, url: str | None) -> str | None:
        """A URL as other programs write it is of PostgreSQL by our driver."""
        return url and re.sub(r"^postgres(ql)?://", "postgresql+psycopg://", url)

    @model_validator(mode="after")
    def _check_database(self) -> Self:
        """The URL is one of a kind we know, and a password has somewhere to go."""
        if self.database_url is None:
            if self.database_password_file is not None:
                raise ValueError(f"{_variable('database_password_file')} needs {_variable('database_url')}")
            return self
        from sqlalchemy import make_url  # only where it is needed: workers are spawned before the service has it
        from sqlalchemy.exc import ArgumentError

        try:
            url = make_url(self.database_url)
        except (ArgumentError, ValueError):
            raise ValueError(f"{_variable('database_url')} is not an SQLAlchemy URL") from None
        if url.get_backend_name() not in ("sqlite", "postgresql") or not url.database or url.database == ":memory:":
            raise ValueError(f"{_variable('database_url')} names neither a database of PostgreSQL nor a file of SQLite")
        _check_readable("database_password_file", self.database_password_file)
        return self

    @property
    def hosts(self) -> frozenset[str]:
        """Return what `allowed_hosts` lists."""
        return frozenset(items(self.allowed_hosts))

    @property
    def shown_store(self) -> str:
        """Return where the data are, for people: the folder, or the database's URL without its password."""
        if self.database_url is None:
            return str(self.data_dir.absolute())
        from sqlalchemy import make_url

        return make_url(self.database_url).render_as_string(hide_password=True)

    @property
    def store_url(self) -> str:
        """The database's SQLAlchemy URL, its password included."""
        if self.database_url is None:
            return f"sqlite:///{(self.data_dir / 'ridelab.sqlite').absolute()}"
        if self.database_password_file is None:
            return self.database_url
        from sqlalchemy import make_url

        password = self.database_password_file.read_text(encoding="utf-8").rstrip("\r\n")
        return make_url(self.database_url).set(password=password).render_as_string(hide_password=False)


def removed_in(environment: Mapping[str, str]) -> str | None:
    """Return the one line that names the removed settings in an environment; None where it has none."""
    there = ", ".join(sorted(REMOVED & environment.keys()))
    what = (
        "have no effect since 0.5.0, and the next release refuses them; docs/how-to/operations.md has what is instead"
    )
    return f"{there} {what}" if there else None


def _variable(field: str) -> str:
    return f"{PREFIX}{field.upper()}"


def _check_readable(field: str, path: Path | None) -> None:
    try:
        if path is not None:
            path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        raise ValueError(f"{_variable(field)} names a file that cannot be read: {path}") from None


def _check_certificates(files: Mapping[str, Path | None]) -> None:
    import ssl  # as make_url above

    authority, certificate, key = (str(path) for path in files.values())
    try:
        ssl.create_default_context(cafile=authority).load_cert_chain(certificate, key)
    except ssl.SSLError:
        names = ", ".join(_variable(name) for name in files)
        raise ValueError(f"{names}: they are no authority, certificate and key in PEM that belong together") from None


def _unknown(name: int | str) -> str:
    similar = [_variable(field) for field in get_close_matches(str(name), Settings.model_fields)]
    perhaps = f", perhaps {' or '.join(similar)}" if similar else ""
    return f"there is no such setting{perhaps}; docs/how-to/operations.md lists all"


def _reason(location: tuple[int | str, ...], message: str) -> str:
    """Return what is wrong with a variable; an error of several names them itself."""
    message = message.removeprefix("Value error, ")
    return f"{_variable(str(location[0]))}: {message}" if location else message
