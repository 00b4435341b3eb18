"""SciPy on the base instances that `rivals` chose: milp (HiGHS) with monotone cuts, and
differential evolution with integrality.

usage: rivals_scipy.py LIBRARY FILE TIME_LIMIT_S      (appends to FILE)
"""

import ctypes
import math
import sys
import time

import numpy as np
import scipy
from scipy.optimize import Bounds, LinearConstraint, differential_evolution, milp
from scipy.sparse import csr_matrix

FAMILIES = 5
POPSIZE, GENERATIONS = 20, 300


class Base:
    """The instance behind the library's flat interface."""

    def __init__(self, library, seed, size):
        self.lib, self.size = library, size
        library.base_open.restype = ctypes.c_void_p
        library.base_open.argtypes = [ctypes.c_ulong, ctypes.c_ulong, ctypes.c_int]
        for name in ("base_rise", "base_fall"):
            getattr(library, name).restype = ctypes.c_double
        for name in ("base_row", "base_cut"):
            getattr(library, name).restype = ctypes.c_long
        self.handle = ctypes.c_void_p(library.base_open(seed + 1, seed, size))
        n = FAMILIES * size
        self.mass, self.stands = np.zeros(n), np.zeros(n)
        library.base_columns(self.handle, self._doubles(self.mass), self._doubles(self.stands))
        self.columns, self.values = np.zeros(n, dtype=np.int32), np.zeros(n)

    @staticmethod
    def _doubles(array):
        return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))

    def _row(self, function, *arguments):
        low, high = ctypes.c_double(), ctypes.c_double()
        count = function(self.handle, *arguments, ctypes.byref(low), ctypes.byref(high),
                         self.columns.ctypes.data_as(ctypes.POINTER(ctypes.c_int)),
                         self._doubles(self.values))
        return self.columns[:count].copy(), self.values[:count].copy(), low.value, high.value

    def rows(self):
        return [self._row(self.lib.base_row, i) for i in range(self.lib.base_rows(self.handle))]

    def cut(self, rise, lifted, choice):
        return self._row(self.lib.base_cut, int(rise), int(lifted), self._choice(choice))

    @staticmethod
    def _choice(choice):
        return (ctypes.c_int * FAMILIES)(*(int(i) for i in choice))

    def rise(self, choice):
        return self.lib.base_rise(self.handle, self._choice(choice))

    def fall(self, choice):
        return self.lib.base_fall(self.handle, self._choice(choice))

    def linear_ok(self, choice):
        return bool(self.lib.base_linear_ok(self.handle, self._choice(choice)))

    def feasible(self, choice):
        return self.linear_ok(choice) and self.fall(choice) <= 1 and self.rise(choice) <= 1

    def total(self, choice):
        return sum(self.mass[f * self.size + int(i)] for f, i in enumerate(choice))


def solve_milp(base, time_limit_s, lifted):
    start = time.process_time()
    rows, rounds = base.rows(), 0
    while True:
        left = time_limit_s - (time.process_time() - start)
        if left <= 0:
            return None, False, left, f"{rounds} rounds"
        rounds += 1
        starts = np.concatenate([[0], np.cumsum([len(r[0]) for r in rows])])
        matrix = csr_matrix((np.concatenate([r[1] for r in rows]),
                             np.concatenate([r[0] for r in rows]), starts),
                            shape=(len(rows), len(base.mass)))
        result = milp(base.mass, integrality=np.ones(len(base.mass)),
                      bounds=Bounds(0, base.stands),
                      constraints=LinearConstraint(matrix, [r[2] for r in rows],
                                                   [r[3] for r in rows]),
                      options={"time_limit": left, "mip_rel_gap": 0})
        if result.status != 0:
            return None, False, time.process_time() - start, f"{rounds} rounds, {result.message}"
        choice = result.x.reshape(FAMILIES, base.size).argmax(axis=1)
        falls, rises = base.fall(choice) <= 1, base.rise(choice) <= 1
        if falls and rises:
            return choice, True, time.process_time() - start, f"{rounds} rounds"
        rows += [base.cut(rise, lifted, choice) for rise, ok in ((False, falls), (True, rises)) if not ok]


def solve_evolution(base, seed):
    order = [np.argsort(base.mass[f * base.size:(f + 1) * base.size]) for f in range(FAMILIES)]
    start = time.process_time()
    best = [math.inf, None, 0.0]

    def penalised(x):
        choice = [order[f][int(round(i))] for f, i in enumerate(x)]
        missed = 0.0 if base.linear_ok(choice) else 1.0
        missed += min(10, max(0, base.fall(choice) - 1)) + min(10, max(0, base.rise(choice) - 1))
        total = base.total(choice)
        if missed == 0 and total < best[0]:
            best[:] = total, choice, time.process_time() - start
        return total + (1e3 * (1 + missed) if missed else 0)

    differential_evolution(penalised, [(0, base.size - 1)] * FAMILIES, integrality=[True] * FAMILIES,
                           popsize=POPSIZE, maxiter=GENERATIONS, tol=0, polish=False, seed=seed)
    return best[1], False, best[2], ""


def highs(lifted):
    cuts = "all that are no better than the best still too slow" if lifted else "all it dominates"
    return (f"HiGHS (SciPy milp), {'lifted' if lifted else 'monotone'} cuts",
            f"binaries of choices; a combination that is too slow is cut off with {cuts}, "
            "round by round",
            f"SciPy {scipy.__version__}, mip_rel_gap 0",
            lambda base, seed, limit: solve_milp(base, limit, lifted))


RIVALS = [
    highs(lifted=False),
    highs(lifted=True),
    ("SciPy differential evolution",
     "five whole numbers, parts by mass; mass and a penalty, exact rise and fall",
     f"integrality, popsize {POPSIZE}, maxiter {GENERATIONS}, best1bin, no polish",
     lambda base, seed, limit: solve_evolution(base, seed)),
]


def main():
    library = ctypes.CDLL(sys.argv[1])
    with open(sys.argv[2]) as file:
        runs = [line.rstrip("\n").split("\t") for line in file]
    instances = [(int(r[2]), int(r[3])) for r in runs if r[0] == "run" and r[1] == "plenum"]
    with open(sys.argv[2], "a") as file:
        for name, formulation, options, solve in RIVALS:
            file.write(f"rival\t{name}\t{formulation}\t{options}\n")
            for size, seed in instances:
                print(f"{size} parts, number {seed}: {name}", file=sys.stderr)
                base = Base(library, seed, size)
                start = time.process_time()
                choice, claimed, find_s, note = solve(base, seed, float(sys.argv[3]))
                total_s = time.process_time() - start
                feasible = choice is not None and base.feasible(choice)
                mass = base.total(choice) if choice is not None else math.nan
                file.write(f"run\t{name}\t{size}\t{seed}\t{int(claimed)}\t{int(feasible)}\t"
                           f"{mass:.12g}\t{find_s:.6g}\t{total_s:.6g}\t{note}\n")
                file.flush()
                library.base_close(base.handle)


main()
