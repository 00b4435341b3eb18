"""Prints rise.csv as a table. usage: rise_table.py DIR"""

import csv
import sys

COLUMNS = ("method", "tolerance", "max error", "median error", "us/rig", "rigs/s per core",
           "time / closed form", "time / simulator", "time / batch simulator")


def main(directory):
    with open(f"{directory}/rise.csv", newline="") as file:
        rows = list(csv.DictReader(file, delimiter=";"))
    seconds = {row["method"]: float(row["seconds_per_rig"]) for row in rows}

    def ratio(row, ours):
        return f"{seconds[row['method']] / seconds[ours]:.3g}" if ours in seconds else "-"

    cells = [COLUMNS] + [
        (row["method"],
         f"{float(row['tolerance']):.1e}" if row["tolerance"] else "-",
         f"{float(row['error_max']):.1e}",
         f"{float(row['error_median']):.1e}",
         f"{1e6 * seconds[row['method']]:.4g}",
         f"{1.0 / seconds[row['method']]:,.0f}",
         ratio(row, "plenum closed form"),
         ratio(row, "plenum simulator"),
         ratio(row, "plenum simulator, batch")) for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(COLUMNS))]
    cells.insert(1, ["-" * widths[0]] + ["-" * (width - 1) + ":" for width in widths[1:]])
    print("Rise from ambient to 95 % of the operating gauge pressure, each method with the loosest "
          "tolerance whose largest error is 1e-6 or less")
    for name, *numbers in cells:
        padded = [name.ljust(widths[0])] + [
            number.rjust(width) for number, width in zip(numbers, widths[1:])]
        print("| " + " | ".join(padded) + " |")


if __name__ == "__main__":
    main(sys.argv[1])
