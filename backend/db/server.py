"""PostgreSQL's own needs: time limits on both sides, so that nobody waits for a server, or a client, that is gone."""

import secrets
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event
from sqlalchemy.exc import DBAPIError, OperationalError, SQLAlchemyError

APPLICATION = "ridelab-"  # a service's connections have this and a random part as their name
# Who waits for the answer to a large transaction and hears nothing for so long ends the connection [s, s, 1].
KEEPALIVES = {"keepalives_idle": 8, "keepalives_interval": 3, "keepalives_count": 3}
DEADLOCK = "40P01"  # a SQLSTATE
LARGE_TIMEOUT = 3600.0  # for an answer to a statement of a large transaction [s]
# The server's: a statement of an ordinary transaction, and a pause within one, may take so long. What a transaction
# of a client that hangs has locked is free again after that [ms].
SERVER_LIMITS = {"statement_timeout": 7000, "idle_in_transaction_session_timeout": 30_000}


class ReadOnlyError(SQLAlchemyError):
    """The PostgreSQL server is a standby, or set to be read only."""


class SilentServerError(OperationalError):
    """The PostgreSQL server did not answer one that was asked before."""

    def __init__(self) -> None:
        super().__init__(None, None, TimeoutError("the server does not answer"))


def server_engine(url: URL) -> Engine:
    """Connections to a server. A transaction with the option `large` may take as long as it needs."""
    own = {**KEEPALIVES, "application_name": f"{APPLICATION}{secrets.token_hex(8)}"}
    engine = create_engine(url, pool_pre_ping=True, connect_args=own)
    event.listen(engine, "do_connect", _connect)
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    event.listen(engine, "checkin", _check_in)
    return engine


def is_silent(error: DBAPIError) -> bool:
    """Check whether a server that should have answered did not."""
    return getattr(error.orig, "silent", False)


def is_deadlock(error: DBAPIError) -> bool:
    """Check whether the server rolled the transaction back, as it and another one waited for each other."""
    return getattr(error.orig, "sqlstate", None) == DEADLOCK


def _connect(_dialect: Any, _record: Any, arguments: list[Any], named: dict[str, Any]) -> Any:
    from backend.db.limited_connection import LimitedConnection  # only where there is a server: a tenth of a second

    return LimitedConnection.connect(*arguments, **named)


def _set_up(connection: Any, _: object) -> None:
    with connection.cursor() as cursor:
        cursor.execute("; ".join(f"SET {name} = {value}" for name, value in SERVER_LIMITS.items()))
    connection.commit()


def _begin(connection: Connection) -> None:
    if connection.get_execution_options().get("large"):
        driver: Any = connection.connection.dbapi_connection
        driver.answer_timeout = LARGE_TIMEOUT
        connection.exec_driver_sql("SET LOCAL statement_timeout = 0")


def _check_in(connection: Any, _: object) -> None:
    if connection is not None:
        vars(connection).pop("answer_timeout", None)  # of a large transaction
