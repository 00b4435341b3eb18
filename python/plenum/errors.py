"""What goes wrong, as exceptions."""
from __future__ import annotations

from typing import Iterable


class Error(Exception):
    """Base of all exceptions of plenum."""


class InputError(Error, ValueError):
    """A document cannot be used: where and why.

    errors: pairs of a JSON pointer ("/duty/frequency_hz") and what is wrong there and allowed;
    pointer and message are those of the first one.
    """

    def __init__(self, errors: Iterable[tuple[str, str]]):
        self.errors = [(str(pointer), str(message)) for pointer, message in errors]
        self.pointer, self.message = self.errors[0] if self.errors else ("", "")
        super().__init__("\n".join(f"{pointer or 'document'}: {message}" for pointer, message in self.errors))

    def __reduce__(self):
        return type(self), (self.errors,)


class CatalogueError(Error):
    """A catalogue cannot be read or written."""


class ServiceError(Error):
    """A service cannot be reached, or refuses; `status` is that of HTTP, None without an answer."""

    def __init__(self, message: str, status: int | None = None):
        self.status = status
        super().__init__(message)
