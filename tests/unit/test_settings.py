"""Settings that belong together: a database with its password in a file, Dask with its certificates."""

from pathlib import Path

import pytest

from backend.settings import Settings, SettingsError

URL = "postgresql+psycopg://ridelab@database/ridelab"


@pytest.fixture
def files(tmp_path: Path) -> dict[str, str]:
    """The variables of TLS, each with a file that exists."""
    names = {"CA": tmp_path / "ca.pem", "CERT": tmp_path / "cert.pem", "KEY": tmp_path / "key.pem"}
    for path in names.values():
        path.write_text("PEM")
    return {f"RIDELAB_DASK_TLS_{name}_FILE": str(path) for name, path in names.items()}


def test_the_password_of_the_database_comes_from_a_file(tmp_path: Path) -> None:
    secret = tmp_path / "password"
    secret.write_text("s/e:c@r%t \n")
    settings = Settings.from_environment(
        {"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": str(secret), "PATH": "/bin"}
    )
    assert settings.store_url == "postgresql+psycopg://ridelab:s%2Fe%3Ac%40r%25t @database/ridelab"
    assert "s/e" not in repr(settings)
    secret.write_text("another")
    assert ":another@" in settings.store_url, "read again: secrets are changed under a running service's feet"


@pytest.mark.parametrize(
    ("variables", "named"),
    [
        ({"RIDELAB_DATABASE_PASSWORD_FILE": "/dev/null"}, "RIDELAB_DATABASE_URL"),
        ({"RIDELAB_DATABASE_URL": URL, "RIDELAB_DATABASE_PASSWORD_FILE": "/absent"}, "RIDELAB_DATABASE_PASSWORD_FILE"),
        ({"RIDELAB_DATABASE_URL": "user:secret@host"}, "RIDELAB_DATABASE_URL"),
        ({"RIDELAB_ALLOWED_HOSTS": "https://lab.example.com"}, "RIDELAB_ALLOWED_HOSTS"),
        ({"RIDELAB_ALLOWED_HOSTS": "lab.example.com:8000"}, "RIDELAB_ALLOWED_HOSTS"),
        ({"RIDELAB_DASK_SCHEDULER": "tls://scheduler:8786"}, "RIDELAB_DASK_TLS_KEY_FILE"),
        ({"RIDELAB_DASK_TLS_CA_FILE": "/dev/null"}, "RIDELAB_DASK_TLS_CERT_FILE"),
    ],
)
def test_settings_that_do_not_fit_together_are_named(variables: dict[str, str], named: str) -> None:
    with pytest.raises(SettingsError, match=named) as caught:
        Settings.from_environment(variables)
    assert "secret" not in str(caught.value)


def test_tls_takes_three_readable_files_and_an_address_that_says_so(files: dict[str, str]) -> None:
    scheduler = {"RIDELAB_DASK_SCHEDULER": "tls://scheduler:8786"}
    assert Settings.from_environment(scheduler | files).dask_tls_ca_file == Path(files["RIDELAB_DASK_TLS_CA_FILE"])
    for name in files:
        with pytest.raises(SettingsError, match=f"{name} not set"):
            Settings.from_environment(scheduler | {key: value for key, value in files.items() if key != name})
        with pytest.raises(SettingsError, match=f"{name} names a file that cannot be read"):
            Settings.from_environment(scheduler | files | {name: "/absent.pem"})
    with pytest.raises(SettingsError, match="RIDELAB_DASK_SCHEDULER has to start with tls://"):
        Settings.from_environment({"RIDELAB_DASK_SCHEDULER": "tcp://scheduler:8786"} | files)
