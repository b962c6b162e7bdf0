#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds what other programs read of the exports against the curves, one row of the table a call.

  judged.py ezdxf|freecad|gdal|npm|size|inkscape FOLDER

Curves that a program reads as such are compared at 201 places, chords by their length. Ends with 1 at a wrong row."""
import csv
import json
import math
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "judges"))
import exact_curves  # noqa: E402

EXACT_MM = 1e-9
KERNEL_MM = 1e-6   # of FreeCAD's DXF reader, which rounds knots
CHORDS = 2e-3      # of the length: chords are shorter than the curve; a wrong unit is off by 25.4
POINTS_PER_MM = 72 / 25.4
failed = False


def row(judge, name, what, ok):
    global failed
    failed = failed or not ok
    print(f"{judge:<12} {name:<14} {what}{'' if ok else '   WRONG'}")


def truth(folder):
    return [exact_curves.samples(piece) for piece in exact_curves.pieces_of(f"{folder}/test.json")]


def apart(one, other):
    """Largest distance of two lists of places, whichever way round."""
    return min(max(math.dist(p[:2], q[:2]) for p, q in zip(one, way)) for way in (other, other[::-1]))


def compare(judge, name, found, true, allowed):
    if len(found) != len(true):
        return row(judge, name, f"{len(found)} curves for {len(true)}", False)
    largest = max(min(apart(curve, other) for other in found) for curve in true)
    flat = all(len(p) < 3 or p[2] == 0 for curve in found for p in curve)
    row(judge, name, f"{len(found)} curves, largest difference {largest:.1e} mm", largest <= allowed and flat)


def sample_length(folder):
    last = {}
    with open(f"{folder}/cad-mm.csv", encoding="utf-8") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        next(rows)
        for entry in rows:
            last[entry[1]] = float(entry[2])
    return sum(last.values()), len(last)


def lengths(judge, folder, found, allowed):
    length, count = sample_length(folder)
    for name, (total, seen) in found.items():
        one = name.startswith(("laser", "cnc")) or seen == count
        row(judge, name, f"{total:.4f} mm in {seen}, true {length:.4f} mm in {count}", abs(total / length - 1) <= allowed and one)


def ezdxf(folder):
    true = truth(folder)
    for unit, mm in (("mm", 1.0), ("in", 25.4)):
        out = subprocess.run(["/usr/bin/python3", os.path.join(HERE, "..", "judges", "ezdxf_samples.py"),
                              f"{folder}/test-{unit}.dxf"], capture_output=True, text=True, check=True).stdout.splitlines()
        units, errors = out[0].split()[1], out[0].split()[3]
        found = []
        for line in out[1:]:
            words = line.split()
            if words[0].isalpha():
                found.append([])
            else:
                found[-1].append((mm * float(words[0]), mm * float(words[1])))
        compare("ezdxf", f"test-{unit}.dxf", found, true, EXACT_MM)
        row("ezdxf", f"test-{unit}.dxf", f"unit {units}, {errors} errors", units == {"mm": "4", "in": "1"}[unit] and errors == "0")


def freecad(folder):
    true = truth(folder)
    with open(f"{folder}/freecad.json", encoding="utf-8") as file:
        seen = json.load(file)
    for name, found in seen["curves"].items():
        compare("FreeCAD", name, found, true, KERNEL_MM if name.endswith("dxf") else EXACT_MM)
    lengths("FreeCAD", folder, seen["lengths"], 1e-6)


def gdal(folder):
    found = {}
    for name in ("cad-mm", "cad-in", "laser", "cnc"):
        total = 0.0
        with open(f"{folder}/{name}.geojson", encoding="utf-8") as file:
            features = json.load(file)["features"]
        for feature in features:
            geometry = feature["geometry"]
            many = geometry["type"] in ("MultiLineString", "Polygon")
            for line in geometry["coordinates"] if many else [geometry["coordinates"]]:
                total += sum(math.dist(a[:2], b[:2]) for a, b in zip(line, line[1:]))
        found[f"{name}.dxf"] = (total * (25.4 if name.endswith("in") else 1.0), len(features))
    lengths("GDAL", folder, found, CHORDS)


def npm(folder):
    found = {}
    with open(f"{folder}/npm.txt", encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["RESULT"]:
                found[f"{words[1]}.dxf"] = (float(words[2]) * (25.4 if words[1].endswith("in") else 1.0), int(words[3]))
    if not found:
        row("npm dxf", "", "read nothing", False)
    lengths("npm dxf", folder, found, CHORDS)


def size(folder):
    with open(f"{folder}/drawing.svg", encoding="utf-8") as file:
        head = file.read(4000)
    width, height = (float(re.search(rf'\b{name}="([0-9.]+)mm"', head).group(1)) for name in ("width", "height"))
    for name in ("svg.pdf", "drawing.pdf"):
        text = subprocess.run(["pdfinfo", f"{folder}/{name}"], capture_output=True, text=True, check=True).stdout
        w, h = (float(n) / POINTS_PER_MM for n in re.search(r"Page size: *([0-9.]+) x ([0-9.]+)", text).groups())
        judge = "rsvg" if name == "svg.pdf" else "pdfinfo"
        row(judge, "drawing." + ("svg" if judge == "rsvg" else "pdf"), f"page {w:.3f} x {h:.3f} mm, true {width:.3f} x {height:.3f} mm",
            abs(w - width) < 0.01 and abs(h - height) < 0.01)


def inkscape(folder):
    """Its boxes hold the stroke as well."""
    curves = [[exact_curves.samples(piece, 1000) for piece in curve["pieces"]]
              for curve in json.load(open(f"{folder}/test.json", encoding="utf-8"))["curves"]]
    with open(f"{folder}/test.svg", encoding="utf-8") as file:
        text = file.read()
    stroke = float(re.search(r'stroke-width="([0-9.]+)"', text).group(1))
    out = subprocess.run(["inkscape", "--query-all", f"{folder}/test.svg"], capture_output=True, text=True, check=True).stdout
    boxes = {line.split(",")[0]: [float(n) / 96 * 25.4 for n in line.split(",")[1:]] for line in out.splitlines() if "," in line}
    names = re.findall(r'<path id="([^"]+)"', text)
    largest, seen = 0.0, 0
    for name, pieces in zip(names, curves):
        places = [p for piece in pieces for p in piece]
        true = [max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1)]
        if name not in boxes:
            continue
        seen += 1
        # A box of a line that ends is larger by half the stroke at most, by none at least.
        over = [boxes[name][2 + k] - true[k] for k in (0, 1)]
        largest = max(largest, max(max(-o, o - stroke) for o in over))
    row("Inkscape", "test.svg", f"{seen} curves, boxes off by at most {max(largest, 0.0):.4f} mm", seen == len(curves) and largest <= 0.005)


{"ezdxf": ezdxf, "freecad": freecad, "gdal": gdal, "npm": npm, "size": size, "inkscape": inkscape}[sys.argv[1]](sys.argv[2])
sys.exit(failed)
