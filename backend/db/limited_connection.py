"""A connection to PostgreSQL whose answers are waited for only so long, whatever the network does meanwhile."""

import time
from typing import Any, Self

import psycopg
from psycopg.abc import RV, PQGen

CONNECT_TIMEOUT = 5  # [s]
SLOW = 0.5  # a failure to connect that took longer is as one of a server that does not answer [s]
# To a statement of an ordinary transaction. The server's own limit is less, so that it speaks first where it can [s].
ANSWER_TIMEOUT = 8.0


class NoAnswerError(psycopg.OperationalError):
    """The server has not answered in time: it hangs, or the network swallows what is sent."""

    silent = True


class LimitedConnection(psycopg.Connection[Any]):
    """Closes itself where an answer does not come in time.

    Attributes:
        answer_timeout: For which one is waited for [s].
    """

    answer_timeout = ANSWER_TIMEOUT

    @classmethod
    def connect(cls, *args: Any, **kwargs: Any) -> Self:
        """As psycopg's.

        Raises:
            NoAnswerError: The server did not answer within `CONNECT_TIMEOUT`, or it took long to find that there is
                none: the name of a container that is away, say.
        """
        begun = time.monotonic()
        try:
            return super().connect(*args, connect_timeout=CONNECT_TIMEOUT, **kwargs)
        except psycopg.errors.ConnectionTimeout:
            raise NoAnswerError(f"The server has not taken a connection within {CONNECT_TIMEOUT} s") from None
        except psycopg.OperationalError as error:
            if time.monotonic() < begun + SLOW:
                raise
            raise NoAnswerError(str(error)) from None

    def wait(self, gen: PQGen[RV], interval: float = 0.1, timeout: float | None = None) -> RV:
        """As psycopg's, which everything that waits for the server goes through.

        Raises:
            NoAnswerError: It did not answer within `answer_timeout`.
        """
        limit = self.answer_timeout if timeout is None else timeout
        begun = time.monotonic()
        try:
            return super().wait(gen, interval, limit)
        except psycopg.OperationalError:
            if time.monotonic() < begun + limit:
                raise
            self.pgconn.finish()  # what it does with the statement is unknown, and so is what comes next
            raise NoAnswerError(f"The server has not answered within {limit:g} s") from None
