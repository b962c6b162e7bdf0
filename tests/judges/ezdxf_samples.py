#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a DXF by ezdxf and prints what it finds: units and errors of the audit, then for every entity its kind, degree and
201 places at equal fractions of its parameter (of a polyline those of its chords and arcs), all numbers with 17 digits. Usage: ezdxf_samples.py FILE.dxf"""
import math
import sys

from ezdxf import recover


def places(entity):
    kind = entity.dxftype()
    if kind == "SPLINE":
        tool = entity.construction_tool()
        knots = list(entity.knots)
        first, last = knots[0], knots[-1]
        return [tool.point(first + (last - first) * i / 200) for i in range(201)]
    if kind == "LINE":
        a, b = entity.dxf.start, entity.dxf.end
        return [a + (b - a) * (i / 200) for i in range(201)]
    if kind in ("ARC", "CIRCLE"):
        start = math.radians(entity.dxf.start_angle) if kind == "ARC" else 0.0
        end = math.radians(entity.dxf.end_angle) if kind == "ARC" else 2 * math.pi
        sweep = (end - start) % (2 * math.pi) or 2 * math.pi
        c, r = entity.dxf.center, entity.dxf.radius
        angles = (start + sweep * i / 200 for i in range(201))
        return [c + type(c)(r * math.cos(a), r * math.sin(a), 0) for a in angles]
    if kind == "POLYLINE":
        return [p for part in joined(entity) for p in part]
    return []


def joined(polyline):
    """Places of its chords and arcs in its order; an arc that turns to the right is given the other way round."""
    at = polyline.vertices[0].dxf.location
    for part in polyline.virtual_entities():
        run = places(part)
        if run[-1].distance(at) < run[0].distance(at):
            run.reverse()
        at = run[-1]
        yield run


def main():
    document, auditor = recover.readfile(sys.argv[1])
    print("units", document.header.get("$INSUNITS", 0), "errors", len(auditor.errors))
    for entity in document.modelspace():
        degree = entity.dxf.degree if entity.dxftype() == "SPLINE" else 0
        found = places(entity)
        print(entity.dxftype(), degree, len(found))
        for p in found:
            print(repr(p[0]), repr(p[1]))


main()
