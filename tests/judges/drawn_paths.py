# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubic paths as SVG draws them, and how far a place lies from them. Lengths in user units of the file."""
import math
import re
import xml.etree.ElementTree as xml

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def matrix_of(text):
    """SVG's transform as (a, b, c, d, e, f); only matrix() and translate() are known."""
    result = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    for name, numbers in re.findall(r"(\w+)\(([^)]*)\)", text or ""):
        v = [float(n) for n in re.findall(NUMBER, numbers)]
        m = {"matrix": lambda: v, "translate": lambda: [1, 0, 0, 1, v[0], v[1] if len(v) > 1 else 0],
             "scale": lambda: [v[0], 0, 0, v[-1], 0, 0]}[name]()
        result = times(result, m)
    return result


def times(m, n):
    return (m[0] * n[0] + m[2] * n[1], m[1] * n[0] + m[3] * n[1], m[0] * n[2] + m[2] * n[3], m[1] * n[2] + m[3] * n[3],
            m[0] * n[4] + m[2] * n[5] + m[4], m[1] * n[4] + m[3] * n[5] + m[5])


def moved(m, p):
    return m[0] * p[0] + m[2] * p[1] + m[4], m[1] * p[0] + m[3] * p[1] + m[5]


def cubics_of(data):
    """Four points for every cubic; lines are cubics, too. Absolute M, L, C, Z."""
    cubics, pen, start = [], (0.0, 0.0), (0.0, 0.0)
    straight = lambda a, b: (a, tuple(a[i] + (b[i] - a[i]) / 3 for i in (0, 1)), tuple(b[i] - (b[i] - a[i]) / 3 for i in (0, 1)), b)
    for command, numbers in re.findall(r"([A-Za-z])([^A-Za-z]*(?:[eE][-+]?\d[^A-Za-z]*)*)", data):
        v = [float(n) for n in re.findall(NUMBER, numbers)]
        points = list(zip(v[0::2], v[1::2]))
        if command == "M":
            pen = start = points[0]
            points = points[1:]
        if command in "ML":
            for p in points:
                cubics.append(straight(pen, p))
                pen = p
        elif command == "C":
            for i in range(0, len(points), 3):
                cubics.append((pen, *points[i:i + 3]))
                pen = points[i + 2]
        elif command in "Zz":
            if math.dist(pen, start) > 1e-9:
                cubics.append(straight(pen, start))
            pen = start
        else:
            raise ValueError(f"path command {command}")
    return cubics


def paths_of(path):
    """The stroked paths of an SVG file: cubics of each in user units of the outermost element, transforms carried out."""
    found = []

    def walk(element, m):
        tag = element.tag.rpartition("}")[2]
        if tag in ("metadata", "defs", "clipPath"):
            return
        m = times(m, matrix_of(element.get("transform")))
        if tag == "path" and element.get("stroke", "x") != "none" and "stroke:none" not in element.get("style", ""):
            cubics = cubics_of(element.get("d"))
            if cubics:
                found.append([tuple(moved(m, p) for p in cubic) for cubic in cubics])
        for child in element:
            walk(child, m)

    walk(xml.parse(path).getroot(), (1.0, 0.0, 0.0, 1.0, 0.0, 0.0))
    return found


def width_of(path):
    """In user units."""
    root = xml.parse(path).getroot()
    return float(root.get("viewBox").split()[2])


def at(c, t):
    s = 1 - t
    w = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
    return sum(w[i] * c[i][0] for i in range(4)), sum(w[i] * c[i][1] for i in range(4))


def outside(p, c):
    """Distance from the box of a cubic's points; the cubic is no nearer."""
    return math.hypot(*(max(min(q[k] for q in c) - p[k], 0.0, p[k] - max(q[k] for q in c)) for k in (0, 1)))


def distance_to_cubic(p, c):
    steps = 12
    near = min(range(steps + 1), key=lambda i: math.dist(p, at(c, i / steps)))
    a, b = max(0.0, (near - 1) / steps), min(1.0, (near + 1) / steps)
    for _ in range(40):
        one, two = a + 0.382 * (b - a), a + 0.618 * (b - a)
        if math.dist(p, at(c, one)) < math.dist(p, at(c, two)):
            b = two
        else:
            a = one
    return math.dist(p, at(c, (a + b) / 2))


def farthest(places, cubics):
    """Largest distance of the places from the path."""
    worst = 0.0
    for p in places:
        best = math.inf
        for least, c in sorted((outside(p, c), c) for c in cubics):
            if least >= best:
                break
            best = min(best, distance_to_cubic(p, c))
        worst = max(worst, best)
    return worst


def length(cubics):
    places = [[at(c, i / 64) for i in range(65)] for c in cubics]
    return sum(math.dist(a, b) for run in places for a, b in zip(run, run[1:]))
