"""Answers: dicts as the contract has them, with arrays, frames and pictures on top.

Every answer is the whole JSON document, so json.dump(answer) saves it and plenum.verify(answer) takes it. pandas and
matplotlib are imported where they are used.
"""
from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from .documents import plain

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes


class Answer(dict):
    """A JSON document."""

    @property
    def status(self) -> Optional[str]:
        return self.get("status")

    def save(self, path: str) -> None:
        """Writes the document, for plenum verify and the like."""
        with open(path, "w", encoding="utf-8") as file:
            json.dump(plain(self), file, ensure_ascii=False, indent=1)


class Response(Answer):
    """Pressures over time: response/1, or the response of a design."""

    @property
    def t_s(self) -> np.ndarray:
        return np.asarray(self["t_s"], dtype=float)

    @property
    def groups(self) -> list[str]:
        return [group["name"] for group in self["groups"]]

    def pressure_kpa_gauge(self, group: Optional[str] = None) -> np.ndarray:
        """Of a group by name; of the first one without."""
        return self._channel("pressure_kpa_gauge", group)

    def volume_ml(self, group: Optional[str] = None) -> np.ndarray:
        return self._channel("volume_ml", group)

    def _channel(self, channel: str, name: Optional[str]) -> np.ndarray:
        for group in self["groups"]:
            if name is None or group["name"] == name:
                return np.asarray(group[channel], dtype=float)
        raise KeyError(f"no group {name!r}; there are {', '.join(self.groups)}")

    @property
    def frame(self) -> "pd.DataFrame":
        """A row an instant, a column a group, and the source's pressure."""
        import pandas as pd

        columns = {f"{group['name']}_kpa_gauge": group["pressure_kpa_gauge"] for group in self["groups"]}
        source = self.get("source_pressure_kpa_gauge")
        if source is not None and len(source) > 0:
            columns["source_kpa_gauge"] = source
        return pd.DataFrame(columns, index=pd.Index(self["t_s"], name="t_s"), dtype=float)

    def plot(self, ax: Optional["Axes"] = None) -> "Axes":
        """Pressures over time."""
        from . import plots

        return plots.response(self, ax)


class Design(Answer):
    """One design of a list."""

    @property
    def mass_kg(self) -> float:
        return self["totals"]["mass_kg"]

    @property
    def parts(self) -> "pd.DataFrame":
        import pandas as pd

        return pd.DataFrame(self["parts"])

    @property
    def response(self) -> Response:
        return Response(self["response"])

    def plot(self, ax: Optional["Axes"] = None) -> "Axes":
        """Mass by part."""
        from . import plots

        return plots.masses([self], ax)


class Designs(Answer):
    """designs/1: a ranked list or a front, with its proof."""

    @property
    def designs(self) -> list[Design]:
        return [Design(design) for design in self["designs"]]

    @property
    def best(self) -> Optional[Design]:
        return self.designs[0] if self["designs"] else None

    @property
    def proved(self) -> bool:
        """Whether no unlisted design beats the last one listed, or none exists at all."""
        return self["status"] in ("optimal", "infeasible")

    @property
    def frame(self) -> "pd.DataFrame":
        """A row a design: configuration, totals, settings."""
        import pandas as pd

        rows = [
            {"rank": design["rank"], "configuration": design["configuration"], **design["totals"], **design["settings"]}
            for design in self["designs"]
        ]
        return pd.DataFrame(rows).set_index("rank") if rows else pd.DataFrame()

    @property
    def front(self) -> "pd.DataFrame":
        """A row a design of the front, a column an objective; empty without objective.pareto."""
        import pandas as pd

        rows = self.get("front") or []
        return pd.DataFrame([row["objectives"] for row in rows], index=[row["rank"] for row in rows])

    def plot(self, ax: Optional["Axes"] = None) -> "Axes":
        """The front, where the answer is one; otherwise the mass of each design by part."""
        from . import plots

        return plots.front(self, ax) if self.get("front") else plots.masses(self.designs, ax)


class SweepTable(Answer):
    """sweep_table/1: a row for each patch of a sweep."""

    @property
    def frame(self) -> "pd.DataFrame":
        """A row a patch, by its name; first a column for each value that differs, named by its pointer."""
        import pandas as pd

        rows = [
            {"name": row["name"], **dict(zip(self["varied"], row["values"])),
             **{name: value for name, value in row.items() if name not in ("name", "values")}}
            for row in self["rows"]
        ]
        return pd.DataFrame(rows).set_index("name")


class Map(Answer):
    """map_answer/1: times over a grid."""

    @property
    def frame(self) -> "pd.DataFrame":
        """A row a point of the grid; NaN where a time is never reached."""
        import pandas as pd

        return pd.DataFrame(self["rows"]).astype(float)

    def plot(
        self,
        x: str = "source_pressure_ratio",
        y: str = "operating_pressure_ratio",
        value: str = "rise_time_normalised",
        ax: Optional["Axes"] = None,
    ) -> "Axes":
        """One value over two axes of the grid, at the first value of each other axis."""
        from . import plots

        return plots.grid(self.frame, x, y, value, ax)


class Diagnosis(Answer):
    """diagnosis/1: what the model lacks against measured pressures."""

    @property
    def verdict(self) -> str:
        return self["verdict"]

    @property
    def sentence(self) -> str:
        return self["sentence"]

    @property
    def effects(self) -> "pd.DataFrame":
        """A row a parameter of each effect found, with its 95 % interval."""
        import pandas as pd

        rows = [
            {"effect": effect["id"], "parameter": name, "value": found["value"],
             "ci95_low": (found["ci95"] or [None, None])[0], "ci95_high": (found["ci95"] or [None, None])[1]}
            for effect in self["effects"]
            for name, found in effect["parameters"].items()
        ]
        return pd.DataFrame(rows, columns=["effect", "parameter", "value", "ci95_low", "ci95_high"])

    @property
    def candidates(self) -> "pd.DataFrame":
        """The sets of effects that were fitted, in the order of the answer."""
        import pandas as pd

        rows = [
            {"effects": " + ".join(candidate["effects"]) or "none", "delta_bic": candidate["delta_bic"],
             "rms_kpa": candidate["rms_kpa"], "holdout_rms_kpa": candidate["holdout_rms_kpa"]}
            for candidate in self["candidates"]
        ]
        return pd.DataFrame(rows)

    def residuals(self, model: str = "after") -> "pd.DataFrame":
        """Columns run, t_s, measured_kpa, model_kpa, residual_kpa of "declared", "before" or "after"."""
        import pandas as pd

        frames = [
            pd.DataFrame({"run": run["run"], "t_s": run["t_s"], "measured_kpa": run["measured_kpa"],
                          "model_kpa": run[f"{model}_kpa"]})
            for run in self["series"]
        ]
        frame = pd.concat(frames, ignore_index=True).astype({"measured_kpa": float, "model_kpa": float})
        frame["residual_kpa"] = frame["measured_kpa"] - frame["model_kpa"]
        return frame

    def plot(self, ax: Optional["Axes"] = None) -> "Axes":
        """Residuals of the base model and of the one with effects, run by run."""
        from . import plots

        return plots.residuals(self, ax)


class Protocol(Answer):
    """protocol/1: how a part is measured, and how precise that will be."""

    @property
    def steps(self) -> list[str]:
        """What to do, test after test."""
        return [step for test in self["tests"] for step in test["steps"]]

    @property
    def precision(self) -> "pd.DataFrame":
        """A row a number that a test gives, with its uncertainty: relative, one standard deviation."""
        import pandas as pd

        rows = [{"protocol": test["protocol"], **row} for test in self["tests"] for row in test["precision"]]
        return pd.DataFrame(rows)

    @property
    def template(self) -> Optional[dict[str, Any]]:
        """The rig of the first test that is recorded, for diagnose(recording, rig=template)."""
        recorded = (test["recording"] for test in self["tests"] if test["recording"])
        return next((recording["template"] for recording in recorded), None)


class Evaluation(Answer):
    """evaluation_answer/1: how a given design does."""

    @property
    def margins(self) -> "pd.DataFrame":
        import pandas as pd

        return pd.DataFrame(self.get("margins") or [])


class Verification(Answer):
    """verification/1; true where the answer was accepted."""

    def __bool__(self) -> bool:
        return bool(self["accepted"])


KINDS: dict[str, type[Answer]] = {
    "designs/1": Designs,
    "response/1": Response,
    "map_answer/1": Map,
    "sweep_table/1": SweepTable,
    "diagnosis/1": Diagnosis,
    "evaluation_answer/1": Evaluation,
    "verification/1": Verification,
}


def answer_of(document: dict[str, Any]) -> Any:
    """The document as the answer that its schema names."""
    return KINDS.get(document.get("schema", ""), Answer)(document)
