# SPDX-License-Identifier: GPL-3.0-or-later
# Run by freecadcmd with FOLDER set: prints name, length in mm and count of the edges that FreeCAD reads of each file.
import os

import FreeCAD
import Import
import Part

folder = os.environ["FOLDER"]
for name in ("cad-mm.dxf", "cad-in.dxf", "cad-mm.igs", "cad-in.igs", "cad-mm.step", "cad-in.step"):
    path = os.path.join(folder, name)
    if name.endswith(".dxf"):
        document = FreeCAD.newDocument()
        Import.readDXF(path, document.Name)
        document.recompute()
        edges = [edge for thing in document.Objects if hasattr(thing, "Shape") for edge in thing.Shape.Edges]
    else:
        edges = Part.read(path).Edges
    print("RESULT", name, repr(sum(edge.Length for edge in edges)), len(edges), flush=True)
