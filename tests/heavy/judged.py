#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds what other programs read of the exports against the curves, one row of the table a call.

  judged.py ezdxf|parser|freecad|rhino|gdal|npm|paths|size|inkscape|tables FOLDER

Curves that a program reads as such are compared at 201 places, approximations at as many by their distance, chords by their
length. The truth is the curve JSON, evaluated by definition. Ends with 1 at a wrong row."""
import csv
import functools
import json
import math
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
JUDGES = os.path.join(HERE, "..", "judges")
sys.path.insert(0, JUDGES)
import cad_text  # noqa: E402
import drawn_paths  # noqa: E402
import exact_curves  # noqa: E402

SETS = ("test", "sample", "dense")
UNITS = (("mm", 1.0), ("in", 25.4))
EXACT_MM = 1e-9
KERNEL_MM = 1e-6   # of FreeCAD's DXF reader, which rounds knots
PATH_MM, CUBIC_MM, CHORD_MM = 0.002, 0.005, 0.01  # what SVG and PDF, cubics and the polylines of CNC are allowed
CAIRO_MM = 0.002   # what goes through cairo is rounded by that much
DENSE_MM = 2e-4    # of the dense polyline that stands for a curve where distances are measured
DIGITS = 5e-6      # of the size, of what is printed with six digits
CHORDS = 2e-3      # of the length: chords are shorter than the curve; a wrong unit is off by 25.4
POINTS_PER_MM = 72 / 25.4
failed = False


def row(judge, name, what, ok):
    global failed
    failed = failed or not ok
    print(f"{judge:<12} {name:<18} {what}{'' if ok else '   WRONG'}")


@functools.lru_cache
def truth(folder, which, count=200):
    return [exact_curves.samples(piece, count) for piece in exact_curves.pieces_of(f"{folder}/{which}.json")]


def apart(one, other):
    """Largest distance of two lists of places, whichever way round."""
    return min(max(math.dist(p[:2], q[:2]) for p, q in zip(one, way)) for way in (other, other[::-1]))


def compare(judge, name, found, true, allowed):
    if len(found) != len(true):
        return row(judge, name, f"{len(found)} curves for {len(true)}", False)
    largest = max(min(apart(curve, other) for other in found) for curve in true)
    flat = all(len(p) < 3 or p[2] == 0 for curve in found for p in curve)
    row(judge, name, f"{len(found)} curves, largest difference {largest:.1e} mm", largest <= allowed and flat)


def as_cubics(places):
    """A dense polyline as paths are."""
    return [(a, a, b, b) for a, b in zip(places, places[1:])]


def near(judge, name, pieces, true, allowed, count=None):
    """Curves of the file, each a part of a true one, by their distance from those; and the true ones' length."""
    dense = [p for curve in true for p in as_cubics(curve)]
    cells = {}
    size = 0.25
    for cubic in dense:
        for x in range(int(min(p[0] for p in cubic) // size), int(max(p[0] for p in cubic) // size) + 1):
            for y in range(int(min(p[1] for p in cubic) // size), int(max(p[1] for p in cubic) // size) + 1):
                cells.setdefault((x, y), []).append(cubic)
    worst = 0.0
    for places in pieces:
        for p in places:
            at = (int(p[0] // size), int(p[1] // size))
            close = [c for x in (-1, 0, 1) for y in (-1, 0, 1) for c in cells.get((at[0] + x, at[1] + y), [])]
            worst = max(worst, min((chord_distance(p, c[0], c[3]) for c in close), default=math.inf))
    length = sum(math.dist(a, b) for run in pieces for a, b in zip(run, run[1:]))
    whole = sum(math.dist(a, b) for run in true for a, b in zip(run, run[1:]))
    row(judge, name, f"{len(pieces)} entities, largest distance {worst:.4f} mm, allowed {allowed + DENSE_MM:.4f} mm",
        worst <= allowed + DENSE_MM and abs(length / whole - 1) < 1e-3 and (count is None or count == len(pieces)))


def chord_distance(p, a, b):
    d = (b[0] - a[0], b[1] - a[1])
    square = d[0] * d[0] + d[1] * d[1]
    t = 0.0 if square == 0 else min(1.0, max(0.0, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / square))
    return math.hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1])


def sample_length(folder):
    true = truth(folder, "sample", 2000)
    return sum(math.dist(a, b) for run in true for a, b in zip(run, run[1:])), len(true)


def lengths(judge, folder, found, allowed):
    length, count = sample_length(folder)
    for name, (total, seen) in found.items():
        one = name.startswith(("laser", "cnc")) or seen == count
        row(judge, name, f"{total:.4f} mm in {seen}, true {length:.4f} mm in {count}", abs(total / length - 1) <= allowed and one)


def ezdxf_read(path, mm):
    out = subprocess.run(["/usr/bin/python3", os.path.join(JUDGES, "ezdxf_samples.py"), path],
                         capture_output=True, text=True, check=True).stdout.splitlines()
    found = []
    for line in out[1:]:
        words = line.split()
        if words[0].isalpha():
            found.append([])
        else:
            found[-1].append((mm * float(words[0]), mm * float(words[1])))
    return out[0].split()[1], out[0].split()[3], found


def ezdxf(folder):
    for which in SETS:
        true = truth(folder, which)
        for unit, mm in UNITS:
            units, errors, found = ezdxf_read(f"{folder}/{which}-{unit}.dxf", mm)
            compare("ezdxf", f"{which}-{unit}.dxf", found, true, EXACT_MM)
            row("ezdxf", f"{which}-{unit}.dxf", f"unit {units}, {errors} errors", units == {"mm": "4", "in": "1"}[unit] and errors == "0")
    for name, allowed in (("laser", CUBIC_MM), ("cnc", CHORD_MM)):
        _, errors, found = ezdxf_read(f"{folder}/{name}.dxf", 1.0)
        near("ezdxf", f"{name}.dxf", found, truth(folder, "sample", 4000), allowed)
        row("ezdxf", f"{name}.dxf", f"{errors} errors", errors == "0")


def parser(folder):
    for which in SETS:
        true = truth(folder, which)
        for unit, mm in UNITS:
            for ending, read in (("igs", cad_text.iges_curves), ("step", cad_text.step_curves)):
                name = f"{which}-{unit}.{ending}"
                stated, found = read(f"{folder}/{name}")
                compare("own parser", name, found, true, EXACT_MM)
                if stated != mm:
                    row("own parser", name, f"unit of {stated} mm", False)
    for ending, read in (("igs", cad_text.iges_curves), ("step", cad_text.step_curves)):
        _, found = read(f"{folder}/plain-mm.{ending}")
        near("own parser", f"plain-mm.{ending}", found, truth(folder, "sample", 4000), 0.0, len(truth(folder, "sample", 2)))
        _, found = read(f"{folder}/cubic.{ending}")
        near("own parser", f"cubic.{ending}", found, truth(folder, "sample", 4000), CUBIC_MM)
        _, found = read(f"{folder}/bezier.{ending}")
        near("own parser", f"bezier.{ending}", found, truth(folder, "sample", 4000), 0.0)


def freecad(folder):
    with open(f"{folder}/freecad.json", encoding="utf-8") as file:
        seen = json.load(file)
    for which in SETS:
        pieces = exact_curves.pieces_of(f"{folder}/{which}.json")
        # Its reader of IGES makes an edge of every part between corners.
        parts = [exact_curves.samples(piece, 200, part) for piece in pieces for part in exact_curves.smooth_parts(piece)]
        for name, found in seen["curves"].items():
            if name.startswith(which):
                true = parts if name.endswith("igs") else truth(folder, which)
                compare("FreeCAD", name, found, true, KERNEL_MM if name.endswith("dxf") else EXACT_MM)
    lengths("FreeCAD", folder, seen["lengths"], 1e-6)


def rhino(folder):
    with open(f"{folder}/rhino.txt", encoding="utf-8") as file:
        seen = {os.path.basename(entry["path"]): entry for entry in map(json.loads, file)}
    for which in SETS:
        true = truth(folder, which)
        for unit, mm in UNITS:
            entry = seen[f"{which}-{unit}.3dm"]
            found = [[(mm * p[0], mm * p[1], p[2]) for p in curve["places"]] for curve in entry["curves"]]
            compare("rhino3dm", f"{which}-{unit}.3dm", found, true, EXACT_MM)
            degrees = [piece["degree"] for piece in exact_curves.pieces_of(f"{folder}/{which}.json")]
            whole = (all(c["valid"] and c["name"] and c["layer"] for c in entry["curves"]) and
                     [c["degree"] for c in entry["curves"]] == degrees and len({c["id"] for c in entry["curves"]}) == len(degrees))
            row("rhino3dm", f"{which}-{unit}.3dm", f"unit {entry['unit']}, all valid, named, on layers, of their degree",
                whole and entry["unit"] == unit)


def gdal(folder):
    found = {}
    for name in ("plain-mm", "plain-in", "laser", "cnc"):
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


def page_of(folder, name):
    with open(f"{folder}/{name}", encoding="utf-8") as file:
        head = file.read(4000)
    return [float(re.search(rf'\b{side}="([0-9.]+)mm"', head).group(1)) for side in ("width", "height")]


def paths(folder):
    """What SVG and PDF draw: the text of the SVG itself, and both as cairo and Poppler read them."""
    for which in SETS:
        true = truth(folder, which)
        with open(f"{folder}/{which}.svg", encoding="utf-8") as file:
            origin = re.search(r'origin-mm="([^"]+)"', file.read())
        left, bottom = (float(n) for n in origin.group(1).split(",")) if origin else (0.0, 0.0)
        width, height = page_of(folder, f"{which}.svg")
        for judge, name, file, allowed in (
                ("own parser", f"{which}.svg", f"{which}.svg", PATH_MM),
                ("rsvg", f"{which}.svg", f"{which}-by-rsvg.svg", PATH_MM + CAIRO_MM),
                ("Poppler", f"{which}.pdf", f"{which}-by-poppler.svg", PATH_MM + CAIRO_MM)):
            mm = width / drawn_paths.width_of(f"{folder}/{file}")
            cubics = [[tuple((left + mm * p[0], bottom + height - mm * p[1]) for p in c) for c in path]
                      for path in drawn_paths.paths_of(f"{folder}/{file}")]
            every = [c for path in cubics for c in path]
            worst = max(drawn_paths.farthest(curve, every) for curve in true)
            exact = sum(math.dist(a, b) for run in truth(folder, which, 2000) for a, b in zip(run, run[1:]))
            drawn = sum(drawn_paths.length(path) for path in cubics)
            row(judge, name, f"{len(cubics)} paths, largest distance {worst:.4f} mm, allowed {allowed:.3f} mm",
                worst <= allowed + 1e-6 and abs(drawn / exact - 1) < 1e-4)


def size(folder):
    for which in SETS:
        width, height = page_of(folder, f"{which}.svg")
        for judge, name, pdf in (("rsvg", f"{which}.svg", f"{which}-by-rsvg.pdf"), ("pdfinfo", f"{which}.pdf", f"{which}.pdf")):
            text = subprocess.run(["pdfinfo", f"{folder}/{pdf}"], capture_output=True, text=True, check=True).stdout
            # A PDF of more than 14400 points has larger units, which pdfinfo passes over.
            with open(f"{folder}/{pdf}", "rb") as file:
                unit = re.search(rb"/UserUnit ([0-9.]+)", file.read())
            points = POINTS_PER_MM / (float(unit.group(1)) if unit else 1.0)
            w, h = (float(n) / points for n in re.search(r"Page size: *([0-9.]+) x ([0-9.]+)", text).groups())
            row(judge, name, f"page {w:.3f} x {h:.3f} mm, true {width:.3f} x {height:.3f} mm",
                abs(w - width) < 0.01 + DIGITS * width and abs(h - height) < 0.01 + DIGITS * height)


def inkscape(folder):
    """Its boxes hold the stroke as well."""
    for which in SETS:
        inkscape_boxes(folder, which)


def inkscape_boxes(folder, which):
    curves = [[exact_curves.samples(piece, 1000) for piece in curve["pieces"]]
              for curve in json.load(open(f"{folder}/{which}.json", encoding="utf-8"))["curves"]]
    with open(f"{folder}/{which}.svg", encoding="utf-8") as file:
        text = file.read()
    stroke = float(re.search(r'stroke-width="([0-9.]+)"', text).group(1))
    out = subprocess.run(["inkscape", "--query-all", f"{folder}/{which}.svg"], capture_output=True, text=True, check=True).stdout
    boxes = {line.split(",")[0]: [float(n) / 96 * 25.4 for n in line.split(",")[1:]] for line in out.splitlines() if "," in line}
    names = re.findall(r'<path id="([^"]+)"', text)
    largest, seen, allowed = 0.0, 0, 0.005
    for name, pieces in zip(names, curves):
        places = [p for piece in pieces for p in piece]
        true = [max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1)]
        if name not in boxes:
            continue
        seen += 1
        allowed = max(allowed, DIGITS * max(true))
        # A box of a line that ends is larger by half the stroke at most, by none at least.
        over = [boxes[name][2 + k] - true[k] for k in (0, 1)]
        largest = max(largest, max(max(-o, o - stroke) for o in over))
    row("Inkscape", f"{which}.svg", f"{seen} curves, boxes off by at most {max(largest, 0.0):.4f} mm", seen == len(curves) and largest <= allowed)


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return rows[0], rows[1:]


def tables(folder):
    """CSV by the distance of its rows, polynomials at the places of the curves."""
    for which in SETS:
        pieces = exact_curves.pieces_of(f"{folder}/{which}.json")
        for unit, mm in UNITS:
            polynomials(folder, which, unit, mm, pieces)
            places(folder, which, unit, mm)


def polynomials(folder, which, unit, mm, pieces):
    names, rows = table(f"{folder}/{which}-{unit}.poly.csv")
    degree = (len(names) - 5) // 2 - 1
    spans = {}
    for entry in rows:
        spans.setdefault((entry[0], entry[1]), []).append([float(v) if v else 0.0 for v in entry[3:]])
    found = []
    for own in spans.values():
        end, places = own[-1][1], []
        for i in range(201):
            u = own[0][0] + (end - own[0][0]) * i / 200
            span = next((s for s in own if u <= s[1]), own[-1])
            t = u - span[0]
            x, y = (sum(span[2 + k * (degree + 1) + j] * t ** j for j in range(degree + 1)) for k in (0, 1))
            places.append((mm * x, mm * y))
        found.append(places)
    # Arcs have no polynomials: those that stand for them are as near as the numbers hold, at other parameters.
    if any(piece.get("weights") for piece in pieces):
        return near("own parser", f"{which}-{unit}.poly.csv", found, truth(folder, which, 4000), 0.0, len(pieces))
    compare("own parser", f"{which}-{unit}.poly.csv", found, [exact_curves.samples(piece) for piece in pieces], EXACT_MM)


def places(folder, which, unit, mm):
    names, rows = table(f"{folder}/{which}-{unit}.csv")
    runs, wrong = {}, 0.0
    for entry in rows:
        runs.setdefault((entry[0], entry[1]), []).append([float(v) if v else None for v in entry[2:]])
    for run in runs.values():
        for s, x, y, tangent, kappa, radius in run:
            if radius is not None:
                wrong = max(wrong, abs(kappa * radius - 1))
        for a, b in zip(run, run[1:]):
            # Between two rows the curve is as an arc of their curvature: its chord runs half way between their directions.
            wrong = max(wrong, (math.dist(a[1:3], b[1:3]) - (b[0] - a[0])) / max(b[0] - a[0], 1e-9))
    pieces = [[(mm * r[1], mm * r[2]) for r in run] for run in runs.values()]
    true = truth(folder, which, 4000)
    ok = names[2:] == [f"s_{unit}", f"x_{unit}", f"y_{unit}", "tangent_deg", f"kappa_per_{unit}", f"radius_{unit}"]
    near("own parser", f"{which}-{unit}.csv", pieces, true, 0.0, len(true))
    if not ok or wrong > 1e-9:
        row("own parser", f"{which}-{unit}.csv", f"columns {names}, rows off by {wrong}", False)


{"ezdxf": ezdxf, "parser": parser, "freecad": freecad, "rhino": rhino, "gdal": gdal, "npm": npm, "paths": paths, "size": size,
 "inkscape": inkscape, "tables": tables}[sys.argv[1]](sys.argv[2])
sys.exit(failed)
