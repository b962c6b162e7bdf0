# SPDX-License-Identifier: GPL-3.0-or-later
"""Test curves of every kind as curve JSON, and B-splines evaluated by their definition: what judges are held against.

  exact_curves.py write FILE.json         writes the test curves
"""
import json
import math
import sys


def basis(knots, degree, u):
    """N of Cox and de Boor for every control point, degree by degree; the end of the domain belongs to its last span."""
    span = max(i for i in range(degree, len(knots) - degree - 1) if knots[i] <= u and knots[i] < knots[i + 1])
    values = {span: 1.0}
    for p in range(1, degree + 1):
        higher = {}
        for i in range(span - p, span + 1):
            value = 0.0
            if i in values and knots[i + p] > knots[i]:
                value += (u - knots[i]) / (knots[i + p] - knots[i]) * values[i]
            if i + 1 in values and knots[i + p + 1] > knots[i + 1]:
                value += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) * values[i + 1]
            higher[i] = value
        values = higher
    return values


def evaluate_at(piece, u):
    """Place of a piece of curve JSON at a parameter of its domain, mm."""
    points = piece["control_points_mm"]
    weights = piece.get("weights") or [1.0] * len(points)
    x = y = w = 0.0
    for i, n in basis(piece["knots"], piece["degree"], u).items():
        n *= weights[i]
        x, y, w = x + n * points[i][0], y + n * points[i][1], w + n
    return x / w, y / w


def domain(piece):
    return piece["knots"][piece["degree"]], piece["knots"][-piece["degree"] - 1]


def samples(piece, count=200, part=None):
    """Places at equal fractions of the domain, or of a part of it."""
    first, last = part or domain(piece)
    return [evaluate_at(piece, last if i == count else first + (last - first) * i / count) for i in range(count + 1)]


def smooth_parts(piece):
    """The domain, cut where a knot is repeated as often as the degree, and the curve may turn."""
    first, last = domain(piece)
    knots = piece["knots"]
    cuts = sorted({k for k in knots if first < k < last and knots.count(k) >= piece["degree"]})
    ends = [first, *cuts, last]
    return list(zip(ends, ends[1:]))


def pieces_of(path):
    with open(path, encoding="utf-8") as file:
        return [piece for curve in json.load(file)["curves"] for piece in curve["pieces"]]


def clamped(degree, inner, end):
    return [0.0] * (degree + 1) + [float(k) for k in inner] + [float(end)] * (degree + 1)


def shapes():
    """The curves: one span, knots of multiplicity 1 and 3, a Bezier chain, a loop that closes smoothly, one of three
    corners, a straight line of degree 5, numbers near 0 and of 10 m, and every degree from 1 to 7."""
    yield False, [(5, clamped(5, [], 30), [(10, 10), (16, 18), (24, 22), (30, 20), (36, 12), (45, 15)])]
    yield False, [(5, clamped(5, [10, 20, 20, 20, 35], 50),
                   [(5, 40), (9, 48), (16, 55), (25, 52), (33, 45), (40, 41), (48, 44), (55, 50), (61, 49), (66, 44), (70, 40)])]
    yield False, [(5, clamped(5, [20] * 5, 40),
                   [(5, 60), (9, 64), (13, 66), (17, 66), (21, 64), (25, 60), (29, 56), (33, 54), (37, 56), (41, 60), (45, 70)])]
    a = 4.0 * math.tan(math.pi / 8) / 3.0  # a round loop of four cubics
    ring = [(1, 0), (1, a), (a, 1), (0, 1), (-a, 1), (-1, a), (-1, 0), (-1, -a), (-a, -1), (0, -1), (a, -1), (1, -a), (1, 0)]
    yield True, [(3, clamped(3, [25] * 3 + [50] * 3 + [75] * 3, 100), [(80 + 18 * x, 30 + 12 * y) for x, y in ring])]
    corners = [(110, 10), (150, 14), (128, 40)]
    loop = []
    for i, p in enumerate(corners):
        q = corners[(i + 1) % 3]
        normal = (-(q[1] - p[1]) * 0.12, (q[0] - p[0]) * 0.12)
        loop.append((5, clamped(5, [], 40), [(p[0] + (q[0] - p[0]) * k / 5 + normal[0] * k * (5 - k) / 6,
                                              p[1] + (q[1] - p[1]) * k / 5 + normal[1] * k * (5 - k) / 6) for k in range(6)]))
    yield True, loop
    yield False, [(5, clamped(5, [], 41), [(10 + 8 * k, 80 + 2 * k) for k in range(6)])]
    yield False, [(5, clamped(5, [], 10001), [(1e-17, 90.0), (2000.0, 90.0 + 1e-17), (4000.0, 400.0), (6000.0, 500.0),
                                               (8000.0, 300.0), (10000.0, 90.0)])]
    for degree in range(1, 8):
        yield False, [(degree, clamped(degree, [], 30),
                       [(10 + 30 * k / degree, 100 + 10 * degree + 4 * math.sin(2.0 * k)) for k in range(degree + 1)])]


def write(path):
    curves = []
    for number, (closed, pieces) in enumerate(shapes(), 1):
        entry = {"id": f"curve-{number}", "closed": closed, "pieces": []}
        for degree, knots, points in pieces:
            points = [[float(x), float(y)] for x, y in points]
            if closed and len(pieces) == 1:
                points[-1] = points[0]
            entry["pieces"].append({"degree": degree, "knots": knots, "control_points_px": points,
                                    "control_points_mm": points})
        if closed and len(pieces) > 1:
            for before, behind in zip(entry["pieces"], entry["pieces"][1:] + entry["pieces"][:1]):
                before["control_points_mm"][-1] = list(behind["control_points_mm"][0])
        curves.append(entry)
    document = {"format": "batten-curves", "version": 1,
                "image": {"width": 2000, "height": 2000, "dpi": None, "sha256": "0" * 64},
                "mm_per_px": 1.0, "curves": curves}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(document, file, indent=1)


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] != "write":
        sys.exit(__doc__)
    write(sys.argv[2])
