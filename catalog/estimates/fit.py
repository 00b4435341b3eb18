"""Power laws y = a · x1^b1 · x2^b2 …, fitted on logarithms; a series of parts counts once.

The error of a law is that of its predictions for a series that it has not seen: the standard
deviation of the logarithms when each series in turn is left out, so a relative one.
"""
import math


class Point:
    def __init__(self, part, series, x, y):
        self.part, self.series = part, series
        self.x, self.y = x, y  # x: a tuple of positive numbers and of flags (0 or 1)


def distinct(points):
    """Variants of a series with the same numbers are one observation."""
    seen = {}
    for point in points:
        seen.setdefault((point.series, point.x, point.y), point)
    return list(seen.values())


def solve(matrix, right):
    """Gauss with pivots, for the few unknowns of a law."""
    n = len(right)
    rows = [matrix[i][:] + [right[i]] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if abs(rows[i][i]) < 1e-12:
            return None
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            for j in range(i, n + 1):
                rows[k][j] -= factor * rows[i][j]
    result = [0.0] * n
    for i in reversed(range(n)):
        rest = sum(rows[i][j] * result[j] for j in range(i + 1, n))
        result[i] = (rows[i][n] - rest) / rows[i][i]
    return result


class Law:
    """`slopes`: fixed exponents by place, else fitted. Flags enter as factors."""

    def __init__(self, points, flags=(), fixed=None):
        self.points = distinct(points)
        self.flags, self.fixed = set(flags), fixed or {}
        self.coefficients = self._fit(self.points)
        self.left_out = {}
        errors = {}
        for series in sorted({p.series for p in self.points}):
            rest = [p for p in self.points if p.series != series]
            without = self._fit(rest) if rest else None
            if without is None:
                continue
            for point in self.points:
                if point.series == series:
                    value = math.exp(self._log(without, point.x))
                    self.left_out[id(point)] = value
                    errors.setdefault(series, []).append(math.log(point.y / value))
        squares = [sum(e * e for e in group) / len(group) for group in errors.values()]
        self.series = len({p.series for p in self.points})
        self.sigma = math.sqrt(sum(squares) / len(squares)) if squares else 1.0

    def _terms(self, x):
        return [v if i in self.flags else math.log(v) for i, v in enumerate(x)]

    def _fit(self, points):
        free = [i for i in range(len(points[0].x)) if i not in self.fixed]
        sizes = {}
        for point in points:
            sizes[point.series] = sizes.get(point.series, 0) + 1
        n = len(free) + 1
        matrix, right = [[0.0] * n for _ in range(n)], [0.0] * n
        for point in points:
            terms = self._terms(point.x)
            row = [1.0] + [terms[i] for i in free]
            y = math.log(point.y) - sum(s * terms[i] for i, s in self.fixed.items())
            weight = 1.0 / sizes[point.series]
            for i in range(n):
                right[i] += weight * row[i] * y
                for j in range(n):
                    matrix[i][j] += weight * row[i] * row[j]
        found = solve(matrix, right)
        if found is None:
            return None
        slopes = dict(zip(free, found[1:])) | self.fixed
        return [found[0]] + [slopes[i] for i in range(len(points[0].x))]

    def _log(self, coefficients, x):
        return coefficients[0] + sum(c * t for c, t in zip(coefficients[1:], self._terms(x)))

    def predict(self, x):
        return math.exp(self._log(self.coefficients, x))

    def formula(self, names, unit):
        text = f"{math.exp(self.coefficients[0]):.3g} {unit}"
        for i, (slope, name) in enumerate(zip(self.coefficients[1:], names)):
            if i in self.flags:
                text += f", x {math.exp(slope):.3g} if {name}"
            else:
                text += f" · ({name})^{slope:.3g}"
        return text
