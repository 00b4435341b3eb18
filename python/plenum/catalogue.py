"""The catalogue of parts."""
from __future__ import annotations

import getpass
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

from . import _core
from .documents import Source, document_of, encode, read_text, text_of
from .errors import InputError

if TYPE_CHECKING:
    import pandas as pd


def locate(path: Union[None, str, "os.PathLike[str]"] = None) -> str:
    """The catalogue that a computation takes which names none: see docs/reference/commands.md."""
    seed = pathlib.Path(__file__).with_name("catalog.db")  # of a wheel
    return _core.locate_catalogue(os.fspath(path) if path is not None else "", str(seed) if seed.exists() else "")


def frame_of(parts: list[dict[str, Any]]) -> "pd.DataFrame":
    """A row a part by id, a column a field that any of them has; lists and sources are left out."""
    import pandas as pd

    rows = [{name: value for name, value in part.items() if not isinstance(value, (dict, list))} for part in parts]
    return pd.DataFrame(rows).set_index("id") if rows else pd.DataFrame()


class Catalogue:
    """A catalogue by path; without one that which plenum finds by itself."""

    def __init__(self, path: Union[None, str, "os.PathLike[str]"] = None):
        self.path = locate(path)

    def __repr__(self) -> str:
        return f"Catalogue({self.path!r})"

    def parts(self, family: Optional[str] = None) -> "pd.DataFrame":
        """The parts of a family, or all."""
        return frame_of(self.documents(family))

    def documents(self, family: Optional[str] = None) -> list[dict[str, Any]]:
        """The same with every field, and the source of every number."""
        return json.loads(_core.parts(self.path, family))

    def __getitem__(self, part_id: str) -> dict[str, Any]:
        for part in self.documents():
            if part["id"] == part_id:
                return part
        raise KeyError(part_id)

    def __contains__(self, part_id: object) -> bool:
        return any(part["id"] == part_id for part in self.documents())

    def __len__(self) -> int:
        return len(self.documents())

    @property
    def families(self) -> list[dict[str, Any]]:
        """The families with their fields, ranges and meanings."""
        return json.loads(_core.families())["families"]

    @property
    def revision(self) -> dict[str, Any]:
        """The newest revision: number, hash, at, who, what."""
        return json.loads(_core.head(self.path))

    def add(self, part: Source, *, replace: bool = False) -> dict[str, Any]:
        """Adds a part; gives the revision. replace: a part with its id may be there."""
        return json.loads(_core.add_part(self.path, text_of(part), replace, getpass.getuser()))

    def remove(self, part_id: str) -> dict[str, Any]:
        return json.loads(_core.remove_part(self.path, part_id, getpass.getuser()))

    def import_table(self, family: str, table: Union["pd.DataFrame", str, "os.PathLike[str]"], *,
                     dry_run: bool = False) -> dict[str, list[str]]:
        """Adds and replaces the parts of a frame or CSV file, all or none; gives the ids added, replaced, unchanged.

        Columns are found by name, alias and unit (docs/reference/tables.md); a frame's index `id` is a column, too.
        """
        if isinstance(table, (str, os.PathLike)):
            text = read_text(table)
        else:
            text = table.to_csv(index=table.index.name == "id")
        return json.loads(_core.import_table(self.path, family, text, dry_run, getpass.getuser()))

    def save_model(self, name: str, diagnosis: Source) -> dict[str, Any]:
        """Keeps the revised model of a diagnosis for designs ("model": name)."""
        document: Mapping[str, Any] = document_of(diagnosis)
        model = document.get("revision", document if document.get("schema") == "model/1" else None)
        if model is None:
            raise InputError([("/revision", "the diagnosis settled on no model")])
        return json.loads(_core.save_model(self.path, name, encode(model), getpass.getuser()))

    def save_part(self, part_id: str, diagnosis: Source, *, specimen: str = "", anyway: bool = False
                  ) -> dict[str, Any]:
        """Writes the numbers of a part that a diagnosis found, as a revision; gives what was written, and what was
        refused and why.

        specimen: the piece of the type that was tested. anyway: numbers that contradict what is known are written, too.
        """
        return json.loads(_core.save_part(self.path, part_id, text_of(diagnosis), specimen, anyway, getpass.getuser()))

    def write_measured(self, part_id: str, readings: Mapping[str, Union[str, float]], uncertainty: Union[str, float], *,
                       how: str = "", specimen: str = "", anyway: bool = False) -> dict[str, Any]:
        """The same of numbers that were read by hand: write_measured("my-pump", {"mass_kg": "25.3 g"}, "0.5 %").

        uncertainty: relative, one standard deviation, of all. how: in words, by what they were read.
        """
        texts = [f"{field}={value}" for field, value in readings.items()]
        return json.loads(_core.write_measured(self.path, part_id, texts, str(uncertainty), how, specimen, anyway,
                                               getpass.getuser()))

    @property
    def models(self) -> list[dict[str, Any]]:
        """Saved models: name, version, at, who, hash, model."""
        return json.loads(_core.models(self.path))
