"""Pictures of answers by matplotlib; each draws on `ax`, or on new axes, and gives the axes back."""
from __future__ import annotations

from typing import TYPE_CHECKING, Optional, Sequence

import numpy as np

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from .answers import Design, Designs, Diagnosis, Response

LABELS = {
    "mass_kg": "mass in kg",
    "volume_l": "volume in L",
    "cost_eur": "cost in €",
    "energy_wh": "energy in Wh",
}


def _axes(ax: Optional["Axes"]) -> "Axes":
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(layout="constrained")[1]


def response(answer: "Response", ax: Optional["Axes"] = None) -> "Axes":
    ax = _axes(ax)
    frame = answer.frame
    for name in frame.columns:
        style = "--" if name == "source_kpa_gauge" else "-"
        ax.plot(frame.index, frame[name], style, label=name.removesuffix("_kpa_gauge"))
    ax.set_xlabel("time in s")
    ax.set_ylabel("pressure in kPa gauge")
    ax.legend()
    return ax


def masses(designs: Sequence["Design"], ax: Optional["Axes"] = None) -> "Axes":
    """A stacked bar a design: the mass of its parts by family."""
    ax = _axes(ax)
    families: list[str] = []
    for design in designs:
        families += [part["family"] for part in design["parts"] if part["family"] not in families]
    ranks = [str(design["rank"]) for design in designs]
    left = np.zeros(len(designs))
    for family in families:
        of_family = np.array(
            [sum(part["mass_kg"] for part in design["parts"] if part["family"] == family) for design in designs]
        )
        ax.barh(ranks, of_family, left=left, label=family)
        left += of_family
    ax.invert_yaxis()
    ax.set_xlabel("mass in kg")
    ax.set_ylabel("rank")
    if families:
        ax.legend()
    return ax


def front(answer: "Designs", ax: Optional["Axes"] = None) -> "Axes":
    """The first two objectives of a front against each other, steps between the designs."""
    ax = _axes(ax)
    frame = answer.front
    x, y = frame.columns[:2]
    frame = frame.sort_values(x)
    ax.step(frame[x], frame[y], where="post", alpha=0.4)
    ax.plot(frame[x], frame[y], "o")
    for rank, row in frame.iterrows():
        ax.annotate(str(rank), (row[x], row[y]), textcoords="offset points", xytext=(4, 4))
    ax.set_xlabel(LABELS.get(x, x))
    ax.set_ylabel(LABELS.get(y, y))
    return ax


def grid(frame: "pd.DataFrame", x: str, y: str, value: str, ax: Optional["Axes"] = None) -> "Axes":
    axes_of_grid = [name for name in frame.columns if not name.endswith("_normalised") or name in (x, y)]
    others = [name for name in axes_of_grid if name not in (x, y)]
    kept = frame
    for name in others:
        first = frame[name].iloc[0]
        kept = kept[(kept[name] == first) | (kept[name].isna() & np.isnan(first))]
    ax = _axes(ax)
    table = kept.pivot_table(index=y, columns=x, values=value, aggfunc="first", dropna=False)
    if table.shape[0] < 2 or table.shape[1] < 2:  # a line
        along, across = (x, y) if table.shape[1] >= table.shape[0] else (y, x)
        ax.plot(kept[along], kept[value], "o-")
        ax.set_xlabel(along.replace("_", " "))
        ax.set_ylabel(value.replace("_", " "))
        return ax
    mesh = ax.pcolormesh(table.columns, table.index, np.ma.masked_invalid(table.to_numpy(float)), shading="nearest")
    ax.figure.colorbar(mesh, ax=ax, label=value.replace("_", " "))
    ax.set_xlabel(x.replace("_", " "))
    ax.set_ylabel(y.replace("_", " "))
    return ax


def residuals(answer: "Diagnosis", ax: Optional["Axes"] = None) -> "Axes":
    """Measured less computed pressure, the runs one after another."""
    ax = _axes(ax)
    for model, label in (("before", "base model, refitted"), ("after", "with effects")):
        start_s, shown = 0.0, label
        for _, run in answer.residuals(model).groupby("run", sort=False):
            line = ax.plot(start_s + run["t_s"] - run["t_s"].iloc[0], run["residual_kpa"], lw=0.7, label=shown,
                           color="C0" if model == "before" else "C1")
            start_s += run["t_s"].iloc[-1] - run["t_s"].iloc[0]
            shown = "_" + line[0].get_label()  # named once
    ax.axhspan(-answer["noise_kpa"], answer["noise_kpa"], color="grey", alpha=0.2, label="noise (one σ)")
    ax.set_xlabel("time in s, runs one after another")
    ax.set_ylabel("measured less computed pressure in kPa")
    ax.set_title(answer["sentence"], fontsize="medium", wrap=True)
    ax.legend()
    return ax
