"""What the composed drill shares: a checkout of umask 027, the images built of it, the service started once."""

import time
from collections.abc import Iterator

import pytest

from tests.compose.engine import Composed, checked_out, running, stand_ins


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Composed:
    """The service of a checkout, whose images are built."""
    folder = checked_out(tmp_path_factory.mktemp("checkout"))
    site = Composed(folder, **stand_ins(folder))
    begun = time.monotonic()
    site.compose("build")
    print(f"\nimages built in {time.monotonic() - begun:.0f} s")
    return site


@pytest.fixture(scope="session")
def service(built: Composed) -> Iterator[Composed]:
    """It, started anew on empty volumes."""
    with running(built):
        print(f"\nhealthy in {built.up():.1f} s")
        yield built
