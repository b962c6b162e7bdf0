# SPDX-License-Identifier: GPL-3.0-or-later
"""One page of 1000 x 700 px with four waves and a ring of ink on noisy paper that falls off: line_page.py FILE.pgm. Always the same."""
import math
import random
import sys

WIDTH, HEIGHT = 1000, 700
rng = random.Random(1)
ink = [bytearray(WIDTH) for _ in range(HEIGHT)]


def stamp(x, y, radius):
    for j in range(max(0, int(y - radius - 1)), min(HEIGHT, int(y + radius + 2))):
        for i in range(max(0, int(x - radius - 1)), min(WIDTH, int(x + radius + 2))):
            share = min(1.0, max(0.0, radius + 0.5 - math.hypot(i + 0.5 - x, j + 0.5 - y)))
            ink[j][i] = max(ink[j][i], int(255 * share))


for k in range(4):
    for s in range(1500):
        t = s / 1500
        stamp(60 + 880 * t, 90 + 130 * k + (20 + 8 * k) * math.sin(1.7 * k + (5 + k) * t), 2.5 + k)
for s in range(1200):
    a = 2 * math.pi * s / 1200
    stamp(500 + 160 * math.cos(a), 600 + 60 * math.sin(a), 3.0)

with open(sys.argv[1], "wb") as out:
    out.write(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT))
    for row in ink:
        noise = rng.randbytes(2 * WIDTH)
        out.write(bytes(
            min(255, max(0, round(245 - 55 * x / WIDTH - (215 - 55 * x / WIDTH) * row[x] / 255 + (noise[x] + noise[WIDTH + x] - 255) / 26)))
            for x in range(WIDTH)))
