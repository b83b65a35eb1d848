"""FMUs over HTTP; tests/unit/test_fmu.py holds what is inside to our own runs."""

import io
import zipfile

from ridelab import Ridelab
from tests.api.conftest import Service

SCENARIO = {"road": {"length": 20, "bump": {"start": 10}}}


def test_the_client_gets_an_fmu_with_its_sources_and_its_scenario(service: Service) -> None:
    with Ridelab(str(service.base_url)) as ridelab:
        content = ridelab.fmu(SCENARIO, of="vehicle", version="3.0", platforms=["linux64"])
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = archive.namelist()
        assert b"Apache License" in archive.read("documentation/licenses/license.txt")
    assert "binaries/x86_64-linux/ridelab_vehicle.so" in names
    assert {"modelDescription.xml", "sources/car.c", "sources/buildDescription.xml", "resources/scenario.json"} <= {
        *names
    }
