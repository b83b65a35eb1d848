"""What may be None, where a test has seen to it that it is not."""

from typing import TypeVar

T = TypeVar("T")


def there(thing: T | None) -> T:
    """The thing itself."""
    assert thing is not None
    return thing
