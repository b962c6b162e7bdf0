# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the screen that Xvfb -fbdir keeps (an X window dump, 32 bits a pixel) as a PNG file.

    frame_to_png.py Xvfb_screen0 OUT.png

Ends with 1 if the screen shows one colour only.
"""
import struct
import sys
import zlib

data = open(sys.argv[1], "rb").read()
head = struct.unpack(">25I", data[:100])
header_size, width, height, bytes_per_line, colours = head[0], head[4], head[5], head[12], head[19]
start = header_size + 12 * colours
rows = []
for y in range(height):
    row = data[start + y * bytes_per_line : start + y * bytes_per_line + 4 * width]
    rgb = bytearray(3 * width)
    rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
    rows.append(b"\0" + bytes(rgb))
if len({row for row in rows}) == 1:
    sys.exit("The screen is empty.")


def chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


with open(sys.argv[2], "wb") as out:
    out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
    out.write(chunk(b"IDAT", zlib.compress(b"".join(rows), 6)) + chunk(b"IEND", b""))
