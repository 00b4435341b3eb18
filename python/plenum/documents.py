"""Documents of the contract from what people have: dicts, files, arrays and frames."""
from __future__ import annotations

import json
import math
import os
import pathlib
from typing import Any, Mapping, Union

import numpy as np

from .errors import InputError

Source = Union[Mapping[str, Any], str, "os.PathLike[str]"]


def plain(value: Any) -> Any:
    """The value with lists in place of arrays and columns, and None in place of a missing number (NaN)."""
    if isinstance(value, Mapping):
        return {str(name): plain(member) for name, member in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(member) for member in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    if hasattr(value, "tolist"):  # arrays of NumPy, columns of pandas
        return plain(value.tolist())
    if isinstance(value, float) and math.isnan(value):
        return None
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def encode(document: Any) -> str:
    """JSON text of a document."""
    try:  # most hold only what JSON has
        return json.dumps(document, allow_nan=False, ensure_ascii=False)
    except (TypeError, ValueError):
        pass
    try:
        return json.dumps(plain(document), allow_nan=False, ensure_ascii=False)
    except (TypeError, ValueError) as error:
        raise InputError([("", f"cannot be written as JSON: {error}")]) from error


def read_bytes(path: str | os.PathLike[str]) -> bytes:
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise InputError([("", f"{os.fspath(path)}: cannot be read: {error}")]) from error


def read_text(path: str | os.PathLike[str]) -> str:
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError([("", f"{os.fspath(path)}: cannot be read: {error}")]) from error


def text_of(source: Source) -> str:
    """JSON text of a document, or of the file at a path."""
    if isinstance(source, (str, os.PathLike)):
        return read_text(source)
    if isinstance(source, Mapping):
        return encode(source)
    raise InputError([("", f"must be a dict or the path of a JSON file, not {type(source).__name__}")])


def document_of(source: Source) -> dict[str, Any]:
    """The document as a dict of its own."""
    try:
        document = json.loads(text_of(source))
    except json.JSONDecodeError as error:
        raise InputError([("", f"is not JSON: {error}")]) from error
    if not isinstance(document, dict):
        raise InputError([("", "must be a JSON object")])
    return document
