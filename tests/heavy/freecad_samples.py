# SPDX-License-Identifier: GPL-3.0-or-later
# Run by freecadcmd with FOLDER set: writes freecad.json, for every file of splines 201 places of each edge that
# FreeCAD reads, mm, and lengths and counts of those of the sample that hold lines and arcs as such.
import json
import os

import FreeCAD
import Import
import Part

folder = os.environ["FOLDER"]


def edges_of(name):
    path = os.path.join(folder, name)
    if not name.endswith(".dxf"):
        return Part.read(path).Edges
    document = FreeCAD.newDocument()
    Import.readDXF(path, document.Name)
    document.recompute()
    return [edge for thing in document.Objects if hasattr(thing, "Shape") for edge in thing.Shape.Edges]


def places(edge):
    first, last = edge.ParameterRange
    points = [edge.valueAt(first + (last - first) * i / 200) for i in range(201)]
    return [[p.x, p.y, p.z] for p in points]


found = {"curves": {}, "lengths": {}}
for kind in ("dxf", "igs", "step"):
    for unit in ("mm", "in"):
        for which in ("test", "sample", "dense"):
            found["curves"][f"{which}-{unit}.{kind}"] = [places(edge) for edge in edges_of(f"{which}-{unit}.{kind}")]
        edges = edges_of(f"plain-{unit}.{kind}")
        found["lengths"][f"plain-{unit}.{kind}"] = [sum(edge.Length for edge in edges), len(edges)]
with open(os.path.join(folder, "freecad.json"), "w", encoding="utf-8") as file:
    json.dump(found, file)
