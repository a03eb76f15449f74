"""Textures of docs/pictures/decals.toml: worn road paint, a poster, and cracks with their height.

    decals.py FOLDER
"""
import math
import struct
import sys
import zlib


def png(path, width, height, texel):
    rows = b"".join(
        b"\0" + b"".join(bytes(max(0, min(255, round(255 * c))) for c in texel(x, y)) for x in range(width))
        for y in range(height)
    )

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def hashed(x, y, seed):
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed):
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    low = hashed(i, j, seed) * (1 - u) + hashed(i + 1, j, seed) * u
    high = hashed(i, j + 1, seed) * (1 - u) + hashed(i + 1, j + 1, seed) * u
    return low * (1 - v) + high * v


def fbm(x, y, seed):
    return sum(noise(x * 2**k, y * 2**k, seed + k) * 0.5 ** (k + 1) for k in range(5))


def smooth(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def arrow(x, y):
    u, v = (x + 0.5) / 256 - 0.5, (y + 0.5) / 512
    head = smooth(0.0, 0.012, 0.40 * (v - 0.04) / 0.34 - abs(u)) * smooth(0.0, 0.01, 0.38 - v)
    shaft = smooth(0.0, 0.012, 0.11 - abs(u)) * smooth(0.0, 0.01, v - 0.36) * smooth(0.0, 0.01, 0.97 - v)
    worn = smooth(0.30, 0.52, fbm(u * 9, v * 18, 3)) * (0.75 + 0.25 * fbm(u * 60, v * 120, 9))
    white = 0.86 + 0.1 * fbm(u * 20, v * 40, 5)
    return white, white, 0.95 * white, max(head, shaft) * worn


def poster(x, y):
    u, v = (x + 0.5) / 256, (y + 0.5) / 384
    paper = 0.93 - 0.1 * fbm(u * 6, v * 9, 21)
    color = [paper, 0.96 * paper, 0.86 * paper]
    sun = math.hypot(u - 0.5, 1.5 * (v - 0.36))
    if sun < 0.27:
        color = [0.82, 0.27 + 0.5 * (v - 0.1), 0.12]
    hill = 0.62 + 0.06 * math.sin(7 * u) + 0.03 * math.sin(19 * u + 1)
    if v > hill and v < 0.84:
        color = [0.10, 0.22 + 0.12 * (v - hill), 0.30]
    if 0.88 < v < 0.93 and 0.12 < u < 0.88 and hashed(int(u * 26), 0, 7) > 0.2 and (u * 26) % 1 < 0.72:
        color = [0.12, 0.12, 0.14]
    fold = 1 - 0.12 * smooth(0.012, 0.0, abs(v - 0.5)) - 0.10 * smooth(0.010, 0.0, abs(u - 0.5))
    edge = min(u, 1 - u, 1.5 * v, 1.5 * (1 - v))
    torn = smooth(0.0, 0.012, edge - 0.03 * fbm(u * 14, v * 20, 33))
    return color[0] * fold, color[1] * fold, color[2] * fold, torn


def patch(x, y):
    """A mended place in the road: tar with a sunken middle; its height is in the alpha of patch_height."""
    u, v = (x + 0.5) / 256 - 0.5, (y + 0.5) / 256 - 0.5
    inside = 0.40 + 0.07 * (fbm(u * 8 + 4, v * 8 + 4, 41) - 0.5) - max(abs(u), abs(v))
    grain = 0.10 + 0.09 * hashed(x // 2, y // 2, 55) + 0.05 * fbm(u * 20, v * 20, 56)
    return grain, grain, 1.05 * grain, smooth(0.0, 0.02, inside)


def patch_height(x, y):
    u, v = (x + 0.5) / 256 - 0.5, (y + 0.5) / 256 - 0.5
    bowl = 1 - 0.9 * smooth(0.40, 0.05, math.hypot(u, v)) * (0.6 + 0.8 * fbm(u * 5 + 9, v * 5 + 9, 61))
    h = bowl - 0.06 * hashed(x // 2, y // 2, 55)
    return h, h, h, 1


folder = sys.argv[1]
png(folder + "/arrow.png", 256, 512, arrow)
png(folder + "/poster.png", 256, 384, poster)
png(folder + "/patch.png", 256, 256, patch)
png(folder + "/patch_height.png", 256, 256, patch_height)
