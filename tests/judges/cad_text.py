# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of IGES and STEP files by parsers that share nothing with the program, written from the standards' own field lists
(IGES 5.3 entities 126, 110, 100; ISO 10303-21 and -42). Every curve becomes 201 places in mm, evaluated by definition."""
import math
import re

import exact_curves

MM_PER_INCH = 25.4
COUNT = 200


def spline(degree, knots, points, weights):
    piece = {"degree": degree, "knots": knots, "control_points_mm": points, "weights": weights}
    return exact_curves.samples(piece, COUNT)


def line(a, b):
    return [(a[0] + (b[0] - a[0]) * i / COUNT, a[1] + (b[1] - a[1]) * i / COUNT) for i in range(COUNT + 1)]


def arc(centre, radius, first, sweep):
    angles = (first + sweep * i / COUNT for i in range(COUNT + 1))
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def turn(first, last):
    """Counter-clockwise from one angle to another; a whole turn if they are the same."""
    sweep = (last - first) % (2 * math.pi)
    return sweep if sweep > 1e-9 else 2 * math.pi


def scaled(places, mm):
    return [(mm * x, mm * y) for x, y in places]


# IGES ----------------------------------------------------------------------------------------------------------------


def iges_fields(text, separator=",", end=";"):
    """Fields of a record; a Hollerith string n H ... may hold separators."""
    fields, at = [], 0
    while True:
        hollerith = re.compile(r" *(\d+)H").match(text, at)
        if hollerith:
            length = int(hollerith.group(1))
            value, at = text[hollerith.end():hollerith.end() + length], hollerith.end() + length
        else:
            start = at
            while text[at] not in separator + end:
                at += 1
            value = text[start:at].strip()
        fields.append(value)
        if text[at] == end:
            return fields
        at += 1


def iges_real(text):
    return float(text.replace("D", "E"))


def iges_curve(kind, p):
    if kind == 110:
        x = [iges_real(v) for v in p[1:7]]
        assert x[2] == x[5] == 0
        return line(x[0:2], x[3:5])
    if kind == 100:
        z, cx, cy, x1, y1, x2, y2 = (iges_real(v) for v in p[1:8])
        assert z == 0
        first = math.atan2(y1 - cy, x1 - cx)
        return arc((cx, cy), math.hypot(x1 - cx, y1 - cy), first, turn(first, math.atan2(y2 - cy, x2 - cx)))
    upper, degree = int(p[1]), int(p[2])
    assert p[3] == "1" and p[6] == "0", "planar and not periodic"
    at = 7
    knots = [iges_real(v) for v in p[at:at + upper + degree + 2]]
    at += len(knots)
    weights = [iges_real(v) for v in p[at:at + upper + 1]]
    at += len(weights)
    flat = [iges_real(v) for v in p[at:at + 3 * (upper + 1)]]
    assert not any(flat[2::3])
    first, last, *normal = (iges_real(v) for v in p[at + len(flat):at + len(flat) + 5])
    assert (first, last) == (knots[degree], knots[-degree - 1]) and normal == [0, 0, 1]
    return spline(degree, knots, list(zip(flat[0::3], flat[1::3])), weights)


def iges_curves(path):
    with open(path, encoding="latin-1", newline="") as file:
        lines = file.read().splitlines()
    assert all(len(entry) == 80 for entry in lines), "records of 80 columns"
    section = {letter: [entry for entry in lines if entry[72] == letter] for letter in "SGDPT"}
    head = "".join(entry[:72] for entry in section["G"])
    assert head.startswith((",,", "1H,,1H;,")), "the usual delimiters"
    mm = {"1": MM_PER_INCH, "2": 1.0}[iges_fields(head.replace("1H,,1H;,", ",,", 1))[13]]
    curves = []
    directory = ["".join(section["D"][i:i + 2]) for i in range(0, len(section["D"]), 2)]
    for entry in directory:
        kind = int(entry[0:8])
        if kind not in (100, 110, 126):
            continue
        assert int(entry[48:56].strip() or 0) == 0, "no matrix"
        first, count = int(entry[8:16]), int(entry[80 + 24:80 + 32])
        record = "".join(data[:64] for data in section["P"][first - 1:first - 1 + count])
        curves.append(scaled(iges_curve(kind, iges_fields(record)), mm))
    return mm, curves


# STEP ----------------------------------------------------------------------------------------------------------------

TOKEN = re.compile(r"'(?:[^']|'')*'|#\d+|\.[A-Z_0-9]+\.|[-+]?\d[-+.\dE]*|[A-Z_][A-Z_0-9]*|[(),$*]")


def step_values(tokens):
    """The list up to the next closing parenthesis: names with their arguments as (name, list)."""
    values = []
    for token in tokens:
        if token == ")":
            return values
        if token == "(":
            inner = step_values(tokens)
            if values and isinstance(values[-1], str) and re.fullmatch(r"[A-Z_][A-Z_0-9]*", values[-1]):
                values[-1] = (values[-1], inner)
            else:
                values.append(inner)
        elif token != ",":
            values.append(token)
    return values


def step_entities(path):
    with open(path, encoding="ascii") as file:
        text = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S)
    assert not re.search(r"[0-9.]e[-+]?\d", text), "a lower-case exponent"
    entities = {}
    for number, body in re.findall(r"(#\d+)\s*=\s*((?:'(?:[^']|'')*'|[^';])*);", text):
        values = step_values(iter(TOKEN.findall(body)))
        # One type, or several that make one entity.
        entities[number] = dict([values[0]] if isinstance(values[0], tuple) else values[0])
    return entities


class Step:
    def __init__(self, path):
        self.entities = step_entities(path)

    def point(self, reference):
        x, y, z = (float(v) for v in self.entities[reference]["CARTESIAN_POINT"][1])
        assert z == 0
        return x, y

    def frame(self, reference):
        _, origin, axis, way = self.entities[reference]["AXIS2_PLACEMENT_3D"]
        normal = [float(v) for v in self.entities[axis]["DIRECTION"][1]]
        x = [float(v) for v in self.entities[way]["DIRECTION"][1]]
        assert normal == [0, 0, 1]
        return self.point(origin), math.atan2(x[1], x[0])

    def spline(self, entity):
        if "B_SPLINE_CURVE" in entity:
            degree, points, *_ = entity["B_SPLINE_CURVE"]
            counts, values, _ = entity["B_SPLINE_CURVE_WITH_KNOTS"]
            weights = [float(w) for w in entity["RATIONAL_B_SPLINE_CURVE"][0]]
        else:
            _, degree, points, _, closed, _, counts, values, _ = entity["B_SPLINE_CURVE_WITH_KNOTS"]
            assert closed == ".F."
            weights = [1.0] * len(points)
        knots = [float(value) for count, value in zip(counts, values) for _ in range(int(count))]
        return spline(int(degree), knots, [self.point(p) for p in points], weights)

    def circle(self, entity, first=0.0, last=2 * math.pi):
        _, place, radius = entity["CIRCLE"]
        centre, start = self.frame(place)
        return arc(centre, float(radius), start + first, turn(first, last))

    def trimmed(self, entity):
        _, basis, first, last, agrees, _ = entity["TRIMMED_CURVE"]
        whole = self.entities[basis]
        assert agrees == ".T."
        parameter = [[v[1][0] for v in trim if isinstance(v, tuple) and v[0] == "PARAMETER_VALUE"] for trim in (first, last)]
        ends = [float(p[0]) for p in parameter]
        if "CIRCLE" in whole:
            return self.circle(whole, *ends)
        _, start, vector = whole["LINE"]
        _, way, length = self.entities[vector]["VECTOR"]
        x, y, _ = (float(v) for v in self.entities[way]["DIRECTION"][1])
        at = self.point(start)
        a, b = ((at[0] + t * float(length) * x, at[1] + t * float(length) * y) for t in ends)
        return line(a, b)

    def curve(self, entity):
        if "TRIMMED_CURVE" in entity:
            return self.trimmed(entity)
        if "CIRCLE" in entity:
            return self.circle(entity)
        return self.spline(entity)


def step_curves(path):
    step = Step(path)
    inch = any("CONVERSION_BASED_UNIT" in e and e["CONVERSION_BASED_UNIT"][0] == "'INCH'" for e in step.entities.values())
    mm = MM_PER_INCH if inch else 1.0
    sets = [e["GEOMETRIC_CURVE_SET"][1] for e in step.entities.values() if "GEOMETRIC_CURVE_SET" in e]
    assert len(sets) == 1
    return mm, [scaled(step.curve(step.entities[number]), mm) for number in sets[0]]
