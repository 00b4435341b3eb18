"""The CSV files of the seed: rows as dictionaries, and whether a cell has a source."""
import csv
import pathlib

DATA = pathlib.Path(__file__).parent.parent / "data"
NOT_PARTS = {"rates"}


def families():
    return sorted(p.stem for p in DATA.glob("*.csv") if p.stem not in NOT_PARTS)


def read(family):
    with open(DATA / f"{family}.csv", newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        rows = [dict(row) for row in reader]
        return list(reader.fieldnames), rows


def write(family, header, rows):
    with open(DATA / f"{family}.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, header, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def number(row, field):
    return float(row[field]) if row.get(field) else None


def is_known(row, field):
    """A number with a source, not one of a rule."""
    return bool(row.get(field)) and row[field + ".provenance"] != "estimated"


def curve(row):
    return [tuple(float(x) for x in point.split(":")) for point in row["curve"].split(";")]


def predict_into(row, field, value, sigma, source):
    """A number of a law; a number with a source stays."""
    if is_known(row, field):
        return
    row[field] = f"{value:.3g}"
    row[field + ".provenance"] = "estimated"
    row[field + ".source"] = source
    row[field + ".uncertainty"] = f"{min(max(sigma, 0.01), 1.0):.2g}"
