#!/usr/bin/env python3
"""Makes the pictures of tests/data/flip and their differences by LDR-FLIP, as VALUES.tsv.

The differences are computed a second time, independently of renderer/reference/flip.cpp: by sums over whole
two-dimensional filters, from Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
It takes a minute. Usage: tests/tools/make_flip_pictures.py tests/data/flip
"""
import math
import pathlib
import struct
import sys
import zlib


def write_png(path, picture):
    height, width = len(picture), len(picture[0])
    rows = b"".join(b"\0" + bytes(v for pixel in row for v in pixel) for row in picture)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                     chunk(b"IEND", b""))


class Noise:
    """Linear congruential generator, so that every version of Python makes the same pictures."""

    def __init__(self):
        self.state = 12345

    def upto(self, n):
        self.state = (self.state * 1103515245 + 12345) % (1 << 31)
        return (self.state >> 8) % n


def shadow(width, height, shift):
    """Tiles in two colours under a slanted shadow."""
    tiles = ((200, 120, 80), (90, 130, 190))
    picture = []
    for y in range(height):
        row = []
        for x in range(width):
            colour = tiles[(x // 8 + y // 8) % 2]
            dark = 10 + shift < x + y // 3 < 26 + shift
            row.append(tuple(int(v * 0.35) for v in colour) if dark else colour)
        picture.append(row)
    return picture


def gradient(width, height, amplitude, noise):
    return [[tuple(max(0, min(255, v + (noise.upto(2 * amplitude + 1) - amplitude if amplitude else 0)))
                   for v in (6 * x, 255 - 6 * x, 8 * y)) for x in range(width)] for y in range(height)]


# Chromaticities of sRGB and of D65.
PRIMARIES, WHITE_XY = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06)), (0.3127, 0.3290)


def inverse(m):
    """Inverse of a 3 x 3 matrix by Gauss-Jordan."""
    a = [list(m[i]) + [float(i == k) for k in range(3)] for i in range(3)]
    for i in range(3):
        pivot = max(range(i, 3), key=lambda k: abs(a[k][i]))
        a[i], a[pivot] = a[pivot], a[i]
        a[i] = [v / a[i][i] for v in a[i]]
        for k in range(3):
            if k != i:
                a[k] = [v - a[k][i] * w for v, w in zip(a[k], a[i])]
    return [row[3:] for row in a]


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


WHITE = [WHITE_XY[0] / WHITE_XY[1], 1.0, (1 - sum(WHITE_XY)) / WHITE_XY[1]]
COLUMNS = [[p[0] / p[1], 1.0, (1 - sum(p)) / p[1]] for p in PRIMARIES]
BY_ROWS = [[COLUMNS[k][i] for k in range(3)] for i in range(3)]
SCALE = times(inverse(BY_ROWS), WHITE)
XYZ_FROM_RGB = [[v * s for v, s in zip(row, SCALE)] for row in BY_ROWS]
RGB_FROM_XYZ = inverse(XYZ_FROM_RGB)


def linear(v):
    v /= 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def opponent(rgb):
    x, y, z = (v / w for v, w in zip(times(XYZ_FROM_RGB, [linear(v) for v in rgb]), WHITE))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def hunt_lab(rgb):
    def f(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t * (29 / 6) ** 2 / 3 + 4 / 29

    x, y, z = (f(v / w) for v, w in zip(times(XYZ_FROM_RGB, rgb), WHITE))
    lightness = 116 * y - 16
    return lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)


def hyab(a, b):
    return abs(a[0] - b[0]) + math.sqrt((a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2)


def kernel(radius, value):
    return {(x, y): value(x, y) for x in range(-radius, radius + 1) for y in range(-radius, radius + 1)}


def normalised(weights):
    positive = sum(w for w in weights.values() if w > 0)
    negative = -sum(w for w in weights.values() if w < 0)
    return {k: w / (positive if w > 0 else negative or 1) for k, w in weights.items()}


def convolved(plane, weights):
    height, width = len(plane), len(plane[0])
    items = list(weights.items())
    return [[sum(w * plane[min(max(y + dy, 0), height - 1)][min(max(x + dx, 0), width - 1)] for (dx, dy), w in items)
             for x in range(width)] for y in range(height)]


SENSITIVITY = (((1, 0.0047), (0, 1e-5)), ((1, 0.0053), (0, 1e-5)), ((34.1, 0.04), (13.5, 0.025)))


def seen(picture, ppd):
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi ** 2)) * ppd)
    planes = [[[opponent(p)[c] for p in row] for row in picture] for c in range(3)]
    filtered = []
    for plane, gaussians in zip(planes, SENSITIVITY):
        weights = kernel(radius, lambda x, y: sum(
            a * math.sqrt(math.pi / b) * math.exp(-math.pi ** 2 * (x * x + y * y) / ppd ** 2 / b)
            for a, b in gaussians))
        filtered.append(convolved(plane, normalised(weights)))
    colours = [[hunt_lab([min(max(v, 0), 1) for v in times(RGB_FROM_XYZ, [
        ((y + 16) / 116 + cx / 500) * WHITE[0], (y + 16) / 116 * WHITE[1], ((y + 16) / 116 - cz / 200) * WHITE[2]])])
                for y, cx, cz in zip(*rows)] for rows in zip(*filtered)]
    deviation = 0.5 * 0.082 * ppd
    radius = math.ceil(3 * deviation)
    grey = [[(v + 16) / 116 for v in row] for row in planes[0]]

    def bell(x, y):
        return math.exp(-(x * x + y * y) / (2 * deviation ** 2))

    features = []
    for value in (lambda x: -x, lambda x: x * x / deviation ** 2 - 1):
        across = convolved(grey, normalised(kernel(radius, lambda x, y: value(x) * bell(x, y))))
        down = convolved(grey, normalised(kernel(radius, lambda x, y: value(y) * bell(x, y))))
        features.append([[math.hypot(a, b) for a, b in zip(*rows)] for rows in zip(across, down)])
    return colours, features


def flip(a, b, ppd):
    colours_a, features_a = seen(a, ppd)
    colours_b, features_b = seen(b, ppd)
    largest = hyab(hunt_lab((0, 1, 0)), hunt_lab((0, 0, 1))) ** 0.7
    values = []
    for y in range(len(a)):
        for x in range(len(a[0])):
            e = hyab(colours_a[y][x], colours_b[y][x]) ** 0.7
            knee = 0.4 * largest
            colour = e * 0.95 / knee if e < knee else 0.95 + (e - knee) / (largest - knee) * 0.05
            feature = max(abs(f[y][x] - g[y][x]) for f, g in zip(features_a, features_b))
            values.append(colour ** (1 - (feature / math.sqrt(2)) ** 0.5))
    return sum(values) / len(values), max(values)


def main():
    folder = pathlib.Path(sys.argv[1])
    noise = Noise()
    pairs = {
        "shadow": (shadow(48, 32, 0), shadow(48, 32, 3)),
        "noise": (gradient(40, 30, 0, noise), gradient(40, 30, 40, noise)),
        "tall": (shadow(12, 80, 0), gradient(12, 80, 20, noise)),  # several bands of rows
        "tiny": (gradient(5, 3, 0, noise), gradient(5, 3, 90, noise)),  # smaller than the filters
    }
    lines = ["a\tb\tpixels_per_degree\tmean\tmax\n"]
    for name, (a, b) in pairs.items():
        write_png(folder / f"{name}_a.png", a)
        write_png(folder / f"{name}_b.png", b)
        for ppd in (67.0206, 25):
            mean, largest = flip(a, b, ppd)
            lines.append(f"{name}_a.png\t{name}_b.png\t{ppd}\t{mean:.8f}\t{largest:.8f}\n")
    (folder / "VALUES.tsv").write_text("".join(lines))


if __name__ == "__main__":
    main()
