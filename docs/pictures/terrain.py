"""The land of docs/pictures/terrain.toml: a valley as glTF, the weights of its four grounds, its colour from afar.

    terrain.py FOLDER
"""
import json
import math
import struct
import sys
import zlib

SIDE_M = 1000.0
CELLS = 320
MAP = 512


def png(path, width, height, channels, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def hashed(x, y, seed):
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed):
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * u * (u * (6 * u - 15) + 10), v * v * v * (v * (6 * v - 15) + 10)
    low = hashed(i, j, seed) * (1 - u) + hashed(i + 1, j, seed) * u
    high = hashed(i, j + 1, seed) * (1 - u) + hashed(i + 1, j + 1, seed) * u
    return low * (1 - v) + high * v


def smooth(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def ridges(x, y, seed, octaves):
    total, share, weight = 0.0, 0.5, 1.0
    for k in range(octaves):
        ridge = 1 - abs(2 * noise(x * 2**k, y * 2**k, seed + k) - 1)
        ridge *= ridge * weight
        weight = min(1.0, 1.6 * ridge)
        total += ridge * share
        share *= 0.5
    return total


def height(x, z):
    """Metres, at x, z in metres from the middle: a valley along z, which turns, between two ranges."""
    u, v = x / SIDE_M, z / SIDE_M
    bend = 0.05 * math.sin(6.0 * v + 0.6)
    across = abs(u - bend)
    sides = smooth(0.03, 0.42, across)
    head = smooth(0.12, -0.40, v)
    peaks = ridges(2.9 * u + 3.1, 2.9 * v + 5.2, 11, 8)
    rolling = sum(noise(9 * u * 2**k, 9 * v * 2**k, 71 + k) * 0.5**k for k in range(5)) / 2
    return 7 * rolling + 60 * across * across + sides * (15 + 120 * peaks) + head * (30 + 330 * peaks)


def land():
    n = CELLS + 1
    step = SIDE_M / CELLS
    heights = [[height(i * step - SIDE_M / 2, j * step - SIDE_M / 2) for i in range(n)] for j in range(n)]

    def slope(i, j):
        left, right = heights[j][max(i - 1, 0)], heights[j][min(i + 1, CELLS)]
        back, front = heights[max(j - 1, 0)][i], heights[min(j + 1, CELLS)][i]
        return (right - left) / (2 * step), (front - back) / (2 * step)

    return heights, slope


def glb(path, heights, slope):
    n, step = CELLS + 1, SIDE_M / CELLS
    positions, normals, uvs, indices = bytearray(), bytearray(), bytearray(), bytearray()
    for j in range(n):
        for i in range(n):
            sx, sz = slope(i, j)
            length = math.sqrt(1 + sx * sx + sz * sz)
            positions += struct.pack("<3f", i * step - SIDE_M / 2, heights[j][i], j * step - SIDE_M / 2)
            normals += struct.pack("<3f", -sx / length, 1 / length, -sz / length)
            uvs += struct.pack("<2f", i / CELLS, j / CELLS)
    for j in range(CELLS):
        for i in range(CELLS):
            a = j * n + i
            indices += struct.pack("<6I", a, a + n, a + 1, a + 1, a + n, a + n + 1)
    low = min(map(min, heights))
    high = max(map(max, heights))
    blobs = [bytes(positions), bytes(normals), bytes(uvs), bytes(indices)]
    starts = [sum(len(b) for b in blobs[:k]) for k in range(4)]
    count = n * n
    gltf = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "land"}],
        "materials": [{"name": "land"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
        "buffers": [{"byteLength": sum(map(len, blobs))}],
        "bufferViews": [{"buffer": 0, "byteOffset": s, "byteLength": len(b)} for s, b in zip(starts, blobs)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3",
             "min": [-SIDE_M / 2, low, -SIDE_M / 2], "max": [SIDE_M / 2, high, SIDE_M / 2]},
            {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": count, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5125, "count": len(blobs[3]) // 4, "type": "SCALAR"},
        ],
    }
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(blobs)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body)


# Linear colours of the four from afar: grass, rock, gravel, mud.
FAR = [(0.040, 0.064, 0.018), (0.088, 0.085, 0.081), (0.122, 0.114, 0.102), (0.080, 0.062, 0.044)]


def weights(i, j, heights, slope):
    x, z = i * CELLS / (MAP - 1), j * CELLS / (MAP - 1)
    ci, cj = min(int(x), CELLS - 1), min(int(z), CELLS - 1)
    u, v = x - ci, z - cj
    at = lambda f: (f(ci, cj) * (1 - u) + f(ci + 1, cj) * u) * (1 - v) + (f(ci, cj + 1) * (1 - u) + f(ci + 1, cj + 1) * u) * v
    h = at(lambda a, b: heights[b][a])
    steep = at(lambda a, b: math.hypot(*slope(a, b)))
    patch = sum(noise(x / 9 * 2**k, z / 9 * 2**k, 131 + k) * 0.5 ** (k + 1) for k in range(6))
    rock = smooth(0.72, 0.95, steep + 0.8 * (patch - 0.5))
    gravel = (1 - rock) * smooth(0.50, 0.66, steep + 0.9 * (patch - 0.5))
    gravel = max(gravel, (1 - rock) * smooth(95, 135, h + 60 * (patch - 0.5)))
    mud = (1 - rock - gravel) * smooth(0.60, 0.68, patch - 0.002 * h)
    return [1 - rock - gravel - mud, rock, gravel, mud]


def code(linear):
    return round(255 * max(0.0, min(1.0, 1.055 * linear ** (1 / 2.4) - 0.055)))


def main():
    folder = sys.argv[1]
    heights, slope = land()
    glb(f"{folder}/terrain.glb", heights, slope)
    control, far = [], []
    for j in range(MAP):
        row, colors = [], []
        for i in range(MAP):
            w = weights(i, j, heights, slope)
            row += [max(0, min(255, round(255 * c))) for c in w]
            vary = 0.55 + 0.9 * sum(noise(i / 16 * 2**k, j / 16 * 2**k, 201 + k) * 0.5 ** (k + 1) for k in range(5))
            colors += [code(vary * sum(w[k] * FAR[k][c] for k in range(4))) for c in range(3)]
        control.append(row)
        far.append(colors)
    png(f"{folder}/terrain_weights.png", MAP, MAP, 4, control)
    png(f"{folder}/terrain_far.png", MAP, MAP, 3, far)


main()
