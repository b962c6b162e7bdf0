# SPDX-License-Identifier: GPL-3.0-or-later
"""An archive of drawings, made from nothing: make_pages.py FOLDER COUNT [without-slow]

Pages of three sizes (PGM), each with one to four rings and filled ovals of ink on noisy paper, different on each page; among them, evenly
spread, empty ones (1 in 20), damaged ones (1 in 40), one that would take too long, and one whose output cannot be written.
Writes FOLDER/pages.jsonl as well. Same pages for the same count.
"""
import json
import math
import os
import random
import sys

SIZES = ((320, 240), (480, 360), (640, 480))


def noise_table(level, spread):
    return bytes(min(255, max(0, level + (b * (2 * spread + 1) >> 8) - spread)) for b in range(256))


PAPER, INK = noise_table(236, 6), noise_table(45, 8)


def draw(path, size, shapes, rng):
    """`shapes`: (cx, cy, rx, ry, width), an oval of ink; with a width only its border, so wide."""
    width, height = size
    rows = []
    for y in range(height):
        row = bytearray(rng.randbytes(width).translate(PAPER))
        for cx, cy, rx, ry, border in shapes:
            v = (y + 0.5 - cy) / ry
            if abs(v) >= 1:
                continue
            half = rx * math.sqrt(1 - v * v)
            spans = [(cx - half, cx + half)]
            inner_ry, inner_rx = ry - border, rx - border
            if border and inner_ry > 0 and abs(y + 0.5 - cy) < inner_ry:
                hole = inner_rx * math.sqrt(1 - ((y + 0.5 - cy) / inner_ry) ** 2)
                spans = [(cx - half, cx - hole), (cx + hole, cx + half)]
            for a, b in spans:
                a, b = max(0, round(a)), min(width, round(b))
                if b > a:
                    row[a:b] = rng.randbytes(b - a).translate(INK)
        rows.append(bytes(row))
    with open(path, "wb") as out:
        out.write(b"P5 %d %d 255\n" % (width, height) + b"".join(rows))


def draw_ragged(path, size, count, rng):
    """Bands of ink from top to bottom whose borders wander from row to row: many turns, nothing smooth."""
    width, height = size
    borders = [width * (i + share) / count for i in range(count) for share in (0.3, 0.7)]
    rows = []
    for _ in range(height):
        row = bytearray(rng.randbytes(width).translate(PAPER))
        borders = [x + rng.choice((-2, -1, 0, 1, 2)) for x in borders]
        for a, b in zip(borders[::2], borders[1::2]):
            a, b = max(0, round(a)), min(width, round(b))
            if b > a:
                row[a:b] = rng.randbytes(b - a).translate(INK)
        rows.append(bytes(row))
    with open(path, "wb") as out:
        out.write(b"P5 %d %d 255\n" % (width, height) + b"".join(rows))


def some_shapes(size, count, rng):
    """Ovals side by side, none of which touches another."""
    width, height = size
    columns = math.ceil(math.sqrt(count * width / height))
    lines = math.ceil(count / columns)
    w, h = width / columns, height / lines
    return [((i % columns + 0.5) * w, (i // columns + 0.5) * h, rng.uniform(0.25, 0.42) * w, rng.uniform(0.25, 0.42) * h,
             rng.choice((0, 5, 6, 8))) for i in range(count)]


def main():
    folder, count = sys.argv[1], int(sys.argv[2])
    os.makedirs(os.path.join(folder, "scans"), exist_ok=True)
    os.makedirs(os.path.join(folder, "curves"), exist_ok=True)
    lines = []
    for i in range(count):
        rng = random.Random(i)
        size = SIZES[i % len(SIZES)]
        scan = os.path.join("scans", "p%04d.pgm" % i)
        out = os.path.join("curves", "p%04d" % i)
        page = {"scan": scan, "outputs": [out + ".svg", out + ".json"], "dpi": 300}
        target = os.path.join(folder, scan)
        if i == count // 2 and "without-slow" not in sys.argv:
            draw_ragged(target, (6000, 8000), 110, rng)
        elif i % 40 == 13:  # cut off in the middle
            draw(target, size, some_shapes(size, 3, rng), rng)
            os.truncate(target, os.path.getsize(target) // 2)
        else:
            draw(target, size, [] if i % 20 == 7 else some_shapes(size, rng.randint(1, 4), rng), rng)
        if i == count // 3:
            page["outputs"] = [os.path.join("no-such-folder", "p%04d.svg" % i)]
        if i % 5 == 0:
            page["set"] = {"fairing.mode": "tolerance", "fairing.tolerance": 0.1}
        lines.append(json.dumps(page))
    with open(os.path.join(folder, "pages.jsonl"), "w") as out:
        out.write("\n".join(lines) + "\n")


main()
