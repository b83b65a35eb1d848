"""Columns as migrations write them: short, and never changed."""

from typing import Any

from sqlalchemy import Column, Integer, String
from sqlalchemy.schema import SchemaItem


def required(**columns: Any) -> list[Column[Any]]:
    """Columns that always have a value, by name their types."""
    return [Column(name, kind, nullable=False) for name, kind in columns.items()]


def optional(**columns: Any) -> list[Column[Any]]:
    """Columns that may be empty, by name their types."""
    return [Column(name, kind) for name, kind in columns.items()]


def key(name: str, length: int, *foreign: SchemaItem) -> Column[str]:
    """A text that is the key, or the first part of it."""
    return Column(name, String(length), *foreign, primary_key=True)


def position(name: str) -> Column[int]:
    """A number that is the second part of a key."""
    return Column(name, Integer(), primary_key=True, autoincrement=False)
