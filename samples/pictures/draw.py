#!/usr/bin/env python3
"""Draws the pictures of the harbour: sea.png and water.jpg, or small ones like them, for tests.

    ./draw.py                    sea.png and water.jpg, here
    ./draw.py DIRECTORY WIDTH    the same there, so many pixels wide

Nothing but Python's own library is needed, and the same bytes come out everywhere.
"""
import math
import os
import struct
import sys
import zlib

HORIZON = 0.4  # of the height of sea.png, from its lower edge


def mixed(a, b, t):
    t = min(max(t, 0.0), 1.0)
    return tuple(round(p + (q - p) * t) for p, q in zip(a, b))


def sea(u, v):
    """The evening over the sea: u from the left, v from below, both from 0 to 1."""
    if v >= HORIZON:
        t = (v - HORIZON) / (1 - HORIZON)
        color = mixed((255, 214, 150), (244, 143, 120), t / 0.35) if t < 0.35 else \
            mixed((244, 143, 120), (92, 110, 168), (t - 0.35) / 0.65)
        # The sun stands a little above the horizon; clouds are level streaks.
        if math.hypot((u - 0.5) * 1.6, v - HORIZON - 0.09) < 0.06:
            color = (255, 244, 214)
        elif math.sin(38 * t + 1.5 * math.sin(6 * u)) > 0.93 and t > 0.25:
            color = mixed(color, (255, 226, 205), 0.6)
        return color
    t = (HORIZON - v) / HORIZON
    color = mixed((86, 140, 168), (18, 62, 98), t)
    # The way of the sun on the water, and waves that grow towards the eye.
    if abs(u - 0.5) < 0.03 + 0.06 * t and math.sin(150 * math.sqrt(t) + 9 * u) > 0.2:
        return mixed((255, 222, 164), color, 0.25 + 0.5 * t)
    if math.sin(90 * math.sqrt(t + 0.02) + 14 * math.sin(5 * u + 20 * t)) > 0.86:
        return mixed(color, (190, 222, 232), 0.45)
    return color


def water(u, v):
    """Water of the harbour from above."""
    wave = math.sin(21 * u + 3 * math.sin(9 * v)) + math.sin(27 * v + 4 * math.sin(7 * u))
    return mixed((104, 168, 190), (160, 208, 216), 0.5 + 0.25 * wave)


def rows(paint, width, height):
    for y in range(height):
        yield [paint((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)]


def png(paint, width, height):
    """RGB, without filters."""
    pixels = list(rows(paint, width, height))
    raw = b"".join(b"\0" + bytes(c for pixel in row for c in pixel) for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


ZIGZAG = sorted(range(64), key=lambda i: (i // 8 + i % 8, i // 8 if (i // 8 + i % 8) % 2 else i % 8))
# The tables of ITU-T T.81, annex K, for brightness; colours take the same.
QUANTA = [16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55, 14, 13, 16, 24, 40, 57, 69, 56, 14, 17,
          22, 29, 51, 87, 80, 62, 18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92, 49, 64, 78,
          87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99]
DC = ([0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0], list(range(12)))
AC = ([0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 125], bytes.fromhex(
    "01020300041105122131410613516107227114328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435"
    "363738393a434445464748494a535455565758595a636465666768696a737475767778797a838485868788898a92939495969798"
    "999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4"
    "f5f6f7f8f9fa"))


def codes(table):
    code, at, found = 0, 0, {}
    for length, count in enumerate(table[0], 1):
        for _ in range(count):
            found[table[1][at]] = (code, length)
            code, at = code + 1, at + 1
        code <<= 1
    return found


def jpeg(paint, width, height):
    """Baseline, three components, none of them coarser than the others."""
    pixels = list(rows(paint, width, height))
    cosines = [[math.cos((2 * x + 1) * u * math.pi / 16) * (math.sqrt(0.5) if u == 0 else 1) / 2 for x in range(8)]
               for u in range(8)]
    bits, dc, ac = [], codes(DC), codes(AC)

    def put(code, length):
        bits.append(format(code, "b").zfill(length)[-length:] if length else "")

    def put_value(value):
        size = abs(value).bit_length()
        if size:
            put(value if value > 0 else value + (1 << size) - 1, size)

    last = [0, 0, 0]
    for by in range(0, height, 8):
        for bx in range(0, width, 8):
            block = [pixels[min(by + i // 8, height - 1)][min(bx + i % 8, width - 1)] for i in range(64)]
            for part in range(3):
                weights = ((0.299, 0.587, 0.114), (-0.168736, -0.331264, 0.5), (0.5, -0.418688, -0.081312))[part]
                shift = 128 if part == 0 else 0
                value = [sum(w * c for w, c in zip(weights, p)) - shift for p in block]
                half = [[sum(cosines[u][x] * value[8 * y + x] for x in range(8)) for u in range(8)] for y in range(8)]
                found = [round(round(sum(cosines[v][y] * half[y][u] for y in range(8)), 6) / QUANTA[8 * v + u])
                         for v in range(8) for u in range(8)]
                found = [found[i] for i in ZIGZAG]
                step = found[0] - last[part]
                last[part] = found[0]
                put(*dc[abs(step).bit_length()])
                put_value(step)
                run = 0
                end = max((i for i in range(1, 64) if found[i]), default=0)
                for one in found[1:end + 1]:
                    if one == 0:
                        run += 1
                        continue
                    while run > 15:
                        put(*ac[0xF0])
                        run -= 16
                    put(*ac[16 * run + abs(one).bit_length()])
                    put_value(one)
                    run = 0
                if end < 63:
                    put(*ac[0])
    text = "".join(bits)
    text += "1" * (-len(text) % 8)
    data = int(text, 2).to_bytes(len(text) // 8, "big").replace(b"\xff", b"\xff\0")

    def segment(marker, body):
        return bytes([0xFF, marker]) + struct.pack(">H", len(body) + 2) + body

    parts = b"".join(bytes([i, 0x11, 0]) for i in (1, 2, 3))
    return (b"\xff\xd8" + segment(0xE0, b"JFIF\0\1\1\0\0\1\0\1\0\0")
            + segment(0xDB, b"\0" + bytes(QUANTA[i] for i in ZIGZAG))
            + segment(0xC0, struct.pack(">BHHB", 8, height, width, 3) + parts)
            + segment(0xC4, b"\0" + bytes(DC[0]) + bytes(DC[1])) + segment(0xC4, b"\x10" + bytes(AC[0]) + AC[1])
            + segment(0xDA, b"\3\1\0\2\0\3\0\0\x3f\0") + data + b"\xff\xd9")


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    width = int(sys.argv[2]) if len(sys.argv) > 2 else 960
    for name, data in (("sea.png", png(sea, width, width * 5 // 8)), ("water.jpg", jpeg(water, width, width * 5 // 8))):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)


main()
