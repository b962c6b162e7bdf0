#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what a judge read of the exports with the CSV of the same run: the sum of all lengths in mm.
Usage: lengths.py geojson|freecad|npm FOLDER. Chords of a reader are shorter than the curve: 0.2 % are allowed, a wrong unit
is off by a factor of 25.4. Kernels that read curves as such are held to a millionth."""
import csv
import json
import math
import sys

MM = {"mm": 1.0, "in": 25.4}


def true_length(folder):
    last = {}
    with open(f"{folder}/cad-mm.csv", encoding="utf-8") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        next(rows)
        for row in rows:
            last[row[1]] = float(row[2])
    return sum(last.values()), len(last)


def geojson_length(path):
    total = 0.0
    with open(path, encoding="utf-8") as file:
        features = json.load(file)["features"]
    for feature in features:
        geometry = feature["geometry"]
        kind = geometry["type"]
        lines = geometry["coordinates"] if kind in ("MultiLineString", "Polygon") else [geometry["coordinates"]]
        for line in lines:
            total += sum(math.dist(a[:2], b[:2]) for a, b in zip(line, line[1:]))
    return total, len(features)


def main():
    kind, folder = sys.argv[1:]
    length, count = true_length(folder)
    seen = {}
    if kind == "geojson":
        for name in ("cad-mm", "cad-in", "laser", "cnc"):
            total, found = geojson_length(f"{folder}/{name}.geojson")
            seen[name] = (total * (25.4 if name.endswith("in") else 1.0), found)
    else:
        # lines "RESULT name length count"; FreeCAD gives mm, npm dxf the unit of the file
        with open(f"{folder}/{'freecad.log' if kind == 'freecad' else 'npm.txt'}", encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if words[:1] == ["RESULT"]:
                    factor = 25.4 if kind == "npm" and "-in" in words[1] else 1.0
                    seen[words[1]] = (float(words[2]) * factor, int(words[3]))
    exact = kind == "freecad"
    wrong = not seen
    parts = []
    for name, (total, found) in seen.items():
        allowed = 1e-6 if exact else 2e-3
        ok = abs(total / length - 1) <= allowed and (name in ("laser", "cnc") or found == count)
        wrong = wrong or not ok
        parts.append(f"{name} {total:.4f} mm in {found}{'' if ok else ' WRONG'}")
    print(f"true {length:.4f} mm in {count}; " + "; ".join(parts))
    sys.exit(wrong)


main()
