"""All of the stored reproduction of the paper is what this core computes."""

from tests.api.test_reproduction import expect_same


def test_every_row() -> None:
    expect_same(1)
