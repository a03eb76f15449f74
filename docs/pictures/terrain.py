"""The land of docs/pictures/terrain.toml: a valley with a lake below mountains that rivers have cut (eroded.py) as glTF, with a
forest, the weights of its four grounds, its colour from afar, and the shadows of clouds.

    terrain.py FOLDER
"""
import json
import math
import random
import struct
import sys
import zlib

from eroded import bed, erode, fractal, noise, smooth
from forest import forest, shaded_ground, woods
from plants import boulder, tuft

SIDE_M = 2400.0
NODES = 241        # a side, of what rivers cut
STEP_M = SIDE_M / (NODES - 1)
CELLS = 440        # a side, of the mesh: finer by the eye
MAP = 768          # texels a side, of the maps
EYE = (-10.0, 985.0)


def png(path, width, height, channels, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


# ---- the land ----------------------------------------------------------------------------------


def valley(x, z):
    """How far from the floor of the valley, metres; negative on it. Its head is round."""
    bend = 120 * math.sin(z / 430 + 0.2) - 20
    width = 175 + 45 * math.sin(z / 210 + 1.0)
    head = max(0.0, -(z + 180.0))
    return math.hypot(abs(x - bend), head) - width


def lake(x, z):
    """Below 0 in the lake, about -1 in its middle."""
    bend = 120 * math.sin(z / 430 + 0.2) - 20
    return math.hypot((x - bend - 20) / 165, (z - 430) / 400) - 1 + 0.3 * (fractal(x / 120, z / 120, 55, 4) - 0.5)


def floor_of(x, z):
    bank = lake(x, z)
    rise = 5.0 + 4.5 * (fractal(x / 110, z / 110, 33, 4) - 0.5) + 0.03 * max(0.0, 170 - z)
    return -4.0 + (rise + 4.0) * smooth(-0.14, 0.16, bank)


def land():
    heights, fixed, uplift = [], bytearray(NODES * NODES), []
    for j in range(NODES):
        for i in range(NODES):
            x, z = i * STEP_M - SIDE_M / 2, j * STEP_M - SIDE_M / 2
            away = valley(x, z)
            edge = min(i, j, NODES - 1 - i, NODES - 1 - j)
            inside = smooth(0.0, 420.0, SIDE_M / 2 - max(abs(x), -z))
            peak = math.exp(-((x + 130) ** 2 + (z + 740) ** 2) / 230.0**2)
            right = math.exp(-((x - 640) ** 2 + (z + 130) ** 2) / 260.0**2)
            range_ = smooth(-40.0, 620.0, away) * (0.42 + 0.58 * smooth(1200.0, -200.0, z))
            uplift.append((2.0 + 12.0 * range_ * (0.35 + 0.65 * inside) + 11.0 * peak + 6.0 * right) *
                          (0.55 + 0.9 * fractal(x / 420, z / 420, 7, 3)))
            if away < 0.0:
                fixed[j * NODES + i] = 1
                heights.append(floor_of(x, z))
            elif edge == 0:
                fixed[j * NODES + i] = 1
                heights.append(60.0)
            else:
                heights.append(12.0 + 170 * smooth(0.0, 500.0, away) * fractal(x / 380, z / 380, 3, 6))
    return erode(heights, fixed, uplift, NODES, STEP_M, SIDE_M, 40, 2.2)


def cubic(a, b, c, d, t):
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))


class Land:
    def __init__(self):
        self.heights, area = land()
        # Fans of gravel and soft feet of the slopes: of what is low, the mean of what is around.
        for _ in range(3):
            h, n = self.heights, NODES
            self.heights = [h[k] if k < n or k >= n * n - n or k % n in (0, n - 1) else
                            h[k] + (0.6 * smooth(190.0, 30.0, h[k]) + 0.12) *
                            (0.25 * (h[k - 1] + h[k + 1] + h[k - n] + h[k + n]) - h[k]) for k in range(n * n)]
        self.wet = [math.log(max(a, 1.0)) for a in area]

    def place(self, x, z):
        u, v = (x + SIDE_M / 2) / STEP_M, (z + SIDE_M / 2) / STEP_M
        i, j = min(max(int(u), 0), NODES - 2), min(max(int(v), 0), NODES - 2)
        return i, j, u - i, v - j

    def smoothed(self, x, z):
        i, j, u, v = self.place(x, z)
        h, last = self.heights, NODES - 1
        a, b, c, d = max(i - 1, 0), i, i + 1, min(i + 2, last)
        rows = []
        for row in (max(j - 1, 0), j, j + 1, min(j + 2, last)):
            k = row * NODES
            rows.append(cubic(h[k + a], h[k + b], h[k + c], h[k + d], u))
        return cubic(*rows, v)

    def wetness(self, x, z):
        i, j, u, v = self.place(x, z)
        w, k = self.wet, j * NODES + i
        return (w[k] * (1 - u) + w[k + 1] * u) * (1 - v) + (w[k + NODES] * (1 - u) + w[k + NODES + 1] * u) * v

    def slope(self, x, z):
        return math.hypot(self.smoothed(x + 5, z) - self.smoothed(x - 5, z),
                          self.smoothed(x, z + 5) - self.smoothed(x, z - 5)) / 10

    def height(self, x, z, cell_m=0.0):
        """What rivers cut, and on what is steep the crags that are finer than their grid. Those that cells of a mesh are too wide
        for are their mean there: they would stand in its rows."""
        h = self.smoothed(x, z)
        steep = smooth(0.35, 1.1, self.slope(x, z))
        crag, share, p, q = 0.0, 1.0, x / 33.0, z / 33.0
        for k in range(4):
            seen = smooth(1.0, 2.4, 33.0 / 2**k / max(cell_m, 1e-3))
            crag += share * (0.65 + seen * (0.35 - 2 * abs(noise(p, q, 61 + k) - 0.5)))
            p, q, share = 1.6 * p - 1.2 * q, 1.2 * p + 1.6 * q, 0.52 * share
        shore = smooth(0.4, 3.0, abs(h))
        return h + 9.0 * steep * (crag - 1.2) + 1.1 * shore * (fractal(x / 17, z / 17, 81, 3) - 0.5)


# ---- glTF --------------------------------------------------------------------------------------


def spacing(low, high, eye, count):
    """Places from low to high, closer by the eye."""
    at, places = low, [low]
    weights = []
    for k in range(count):
        middle = low + (k + 0.5) / count * (high - low)
        weights.append(middle)
    # Widths that grow with the distance, scaled to fit: a few rounds settle where each lies.
    for _ in range(8):
        widths = [1.2 + 0.0052 * abs(w - eye) for w in weights]
        scale = (high - low) / sum(widths)
        at, places = low, [low]
        for k in range(count):
            at += widths[k] * scale
            places.append(at)
            weights[k] = at - 0.5 * widths[k] * scale
    return places


class Glb:
    def __init__(self):
        self.data, self.views, self.accessors, self.meshes, self.nodes = bytearray(), [], [], [], []

    def numbers(self, values, kind):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        packed = struct.pack(f"<{len(values)}{'I' if kind == 'SCALAR' else 'f'}", *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        accessor = {"bufferView": len(self.views) - 1, "componentType": 5125 if kind == "SCALAR" else 5126,
                    "count": len(values) // width, "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(values[k::3]) for k in range(3)]
            accessor["max"] = [max(values[k::3]) for k in range(3)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def mesh(self, parts):
        primitives = [{"attributes": {"POSITION": self.numbers(p, "VEC3"), "NORMAL": self.numbers(n, "VEC3"),
                                      "TEXCOORD_0": self.numbers(t, "VEC2")},
                       "indices": self.numbers(i, "SCALAR"), "material": m} for p, n, t, i, m in parts]
        self.meshes.append({"primitives": primitives})
        return len(self.meshes) - 1

    def write(self, path, materials, images):
        gltf = {"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "scene": 0,
                "scenes": [{"nodes": list(range(len(self.nodes)))}], "nodes": self.nodes, "materials": materials,
                "meshes": self.meshes, "buffers": [{"byteLength": len(self.data)}], "bufferViews": self.views,
                "accessors": self.accessors,
                "images": [{"uri": name} for name in images], "textures": [{"source": k} for k in range(len(images))]}
        text = json.dumps(gltf).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.data)))
            out.write(struct.pack("<I4s", len(text), b"JSON") + text)
            out.write(struct.pack("<I4s", len(self.data), b"BIN\0") + self.data)


def mesh_of(land_):
    n = CELLS + 1
    xs, zs = spacing(-SIDE_M / 2, SIDE_M / 2, EYE[0], CELLS), spacing(-SIDE_M / 2, SIDE_M / 2, EYE[1], CELLS)
    wide = lambda at, k: at[min(k + 1, CELLS)] - at[max(k - 1, 0)]
    h = [[land_.height(x, z, 0.5 * max(wide(xs, i), wide(zs, j))) for i, x in enumerate(xs)] for j, z in enumerate(zs)]
    positions, normals, uvs, indices = [], [], [], []
    for j in range(n):
        for i in range(n):
            a, b, c, d = max(i - 1, 0), min(i + 1, CELLS), max(j - 1, 0), min(j + 1, CELLS)
            sx, sz = (h[j][b] - h[j][a]) / (xs[b] - xs[a]), (h[d][i] - h[c][i]) / (zs[d] - zs[c])
            length = math.sqrt(1 + sx * sx + sz * sz)
            positions += [xs[i], h[j][i], zs[j]]
            normals += [-sx / length, 1 / length, -sz / length]
            uvs += [xs[i] / SIDE_M + 0.5, zs[j] / SIDE_M + 0.5]
    for j in range(CELLS):
        for i in range(CELLS):
            a = j * n + i
            indices += [a, a + n, a + 1, a + 1, a + n, a + n + 1]
    return positions, normals, uvs, indices, 0


def near_eye(land_, draw, count, reach_m, low, high, stands):
    """What is too small to be seen from farther, before the eye, in the places that `stands` says."""
    places = []
    while len(places) < count:
        away, turn = 14 + reach_m * draw.random() ** 1.5, draw.uniform(-0.7, 0.7)
        x, z = EYE[0] + away * math.sin(turn), EYE[1] - away * math.cos(turn)
        h = land_.height(x, z)
        if h < 0.6 or draw.random() > stands(x, z): continue
        size = low * (high / low) ** (draw.random() ** 2)
        places.append((x, h, z, size))
    return places


def glb(folder, land_, trees):
    draw, out = random.Random(5), Glb()
    out.nodes.append({"mesh": out.mesh([mesh_of(land_)]), "name": "land"})
    s = SIDE_M / 2
    out.nodes.append({"mesh": out.mesh([([-s, 0, s, s, 0, s, s, 0, -s, -s, 0, -s], [0, 1, 0] * 4,
                                         [0, 1, 1, 1, 1, 0, 0, 0], [0, 1, 2, 0, 2, 3], 1)]), "name": "lake"})
    patch = lambda x, z: fractal(x / 23, z / 23, 47, 4)
    straw = near_eye(land_, draw, 16000, 170, 0.35, 0.9, lambda x, z: smooth(0.42, 0.60, patch(x, z)))
    green = near_eye(land_, draw, 12000, 140, 0.25, 0.6, lambda x, z: smooth(0.58, 0.40, patch(x, z)))
    stones = near_eye(land_, draw, 260, 520, 0.35, 4.5, lambda x, z: smooth(0.48, 0.66, fractal(x / 55, z / 55, 49, 4)))
    save = lambda name, rows: png(f"{folder}/{name}", len(rows[0]), len(rows), 4, [
        [v for c in row for v in (code(c[0]), code(c[1]), code(c[2]), round(255 * c[3]))] for row in rows])
    spread = woods(trees, EYE, 2, 6, 7, 8, save)
    spread += [([tuft(draw, 13, 3)], straw[0::2]), ([tuft(draw, 11, 3)], straw[1::2]), ([tuft(draw, 12, 4)], green),
               ([boulder(draw, 5)], stones[0::3]), ([boulder(draw, 5)], stones[1::3]), ([boulder(draw, 5)], stones[2::3])]
    for k, (parts, here) in enumerate(spread):
        moves, turns, sizes = [], [], []
        for x, y, z, size in here:
            turn, wide = draw.uniform(0, math.pi), size * draw.uniform(0.85, 1.25)
            moves += [x, y, z]
            turns += [0, math.sin(turn), 0, math.cos(turn)]
            sizes += [wide, size, wide]
        out.nodes.append({"mesh": out.mesh(parts), "name": f"on the land {k}", "extensions": {"EXT_mesh_gpu_instancing": {
            "attributes": {"TRANSLATION": out.numbers(moves, "VEC3"), "ROTATION": out.numbers(turns, "VEC4"),
                           "SCALE": out.numbers(sizes, "VEC3")}}}})
    matt = lambda color, roughness: {"baseColorFactor": [*color, 1], "roughnessFactor": roughness, "metallicFactor": 0}
    leaf = lambda name, color, texture: {"name": name, "alphaMode": "MASK", "alphaCutoff": 0.5, "pbrMetallicRoughness": {
        **matt(color, 0.85), "baseColorTexture": {"index": texture}}}
    out.write(f"{folder}/terrain.glb", [{"name": "land", "pbrMetallicRoughness": matt((1, 1, 1), 0.95)},
                     {"name": "lake", "pbrMetallicRoughness": matt((0.006, 0.012, 0.012), 0.05)},
                     leaf("spruce", (1, 1, 1), 0),
                     {"name": "dry grass", "pbrMetallicRoughness": matt((0.200, 0.145, 0.060), 0.8)},
                     {"name": "green grass", "pbrMetallicRoughness": matt((0.070, 0.088, 0.024), 0.8)},
                     {"name": "boulder", "pbrMetallicRoughness": matt((0.170, 0.162, 0.155), 0.9)},
                     leaf("larch", (1, 1, 1), 1), {"name": "bark", "pbrMetallicRoughness": matt((0.055, 0.042, 0.033), 0.95)},
                     {"name": "far trees", "pbrMetallicRoughness": {**matt((1, 1, 1), 0.85), "baseColorTexture": {"index": 2}}}],
              ["terrain_bough.png", "terrain_larch.png", "terrain_trees.png"])


# ---- its maps ----------------------------------------------------------------------------------

# Linear colours from afar.
MEADOW, DRY, HEATH = (0.056, 0.074, 0.020), (0.165, 0.128, 0.050), (0.092, 0.066, 0.028)
ROCK, PALE_ROCK, WARM_ROCK = (0.085, 0.082, 0.082), (0.190, 0.178, 0.165), (0.150, 0.112, 0.085)
SCREE, MUD, NEEDLES = (0.150, 0.142, 0.132), (0.055, 0.046, 0.034), (0.030, 0.024, 0.015)


def mixed(a, b, t):
    return tuple(p * (1 - t) + q * t for p, q in zip(a, b))


def ground(land_, x, z, h, steep, hollow, below):
    """Weights of grass, rock, gravel and mud at a place, and its colour from afar. below: 0..1, below trees."""
    patch = fractal(x / 75, z / 75, 131, 6)
    fine = fractal(x / 14, z / 14, 151, 3)
    hard = bed(x, h, z, SIDE_M)
    wet = smooth(2.0, 6.0, land_.wetness(x, z))
    rock = smooth(0.78, 1.02, steep + 1.1 * (patch - 0.5) + 0.5 * (hard - 0.5) + 0.0007 * (h - 150))
    scree = smooth(0.52, 0.66, 0.55 * steep + 0.0011 * h + 0.9 * (patch - 0.5) + 0.4 * (fine - 0.5) - 0.05 * hollow)
    gravel = (1 - rock) * max(scree, smooth(0.6, 0.9, wet) * smooth(0.08, 0.2, steep) * smooth(0.35, 0.6, fine))
    shore = smooth(2.2, 0.5, h)
    gravel = max(gravel, (1 - rock) * shore * smooth(0.35, 0.6, fine))
    mud = (1 - rock - gravel) * max(shore, smooth(0.60, 0.70, patch + 0.3 * (fine - 0.5) + 0.1 * wet - 0.1 * steep))
    mud += 0.75 * below * (1 - rock - gravel - mud)
    grass = max(0.0, 1 - rock - gravel - mud)
    dry = smooth(0.36, 0.62, fractal(x / 130, z / 130, 201, 5) + 0.0011 * h - 0.12 * wet - 0.06 * hollow)
    heath = smooth(0.52, 0.64, fractal(x / 95, z / 95, 211, 5) + 0.0004 * h)
    turf = mixed(mixed(MEADOW, DRY, dry), HEATH, 0.8 * heath)
    stone = mixed(mixed(ROCK, PALE_ROCK, smooth(0.36, 0.62, hard)), WARM_ROCK,
                  0.7 * smooth(0.5, 0.7, fractal(x / 160, z / 160 + h / 90, 221, 3)))
    # Water that runs down rock leaves it dark.
    stained = 0.35 * smooth(0.45, 0.7, wet + 0.3 * (fine - 0.5))
    stone = tuple(c * (1 - stained) for c in stone)
    shares = (grass, rock, gravel, mud)
    vary = (0.62 + 0.76 * fractal(x / 9, z / 9, 231, 3)) * (1 + 0.16 * max(-1.0, min(1.0, -hollow)))
    return shares, tuple(vary * (grass * turf[c] + rock * stone[c] + gravel * SCREE[c] + mud * MUD[c]) * (1 - below) +
                         vary * below * NEEDLES[c] for c in range(3))


def code(linear):
    return round(255 * max(0.0, min(1.0, 1.055 * max(linear, 0.0) ** (1 / 2.4) - 0.055)))


def maps(folder, land_, trees):
    step = SIDE_M / MAP
    at = lambda k: (k + 0.5) * step - SIDE_M / 2
    h = [[land_.height(at(i), at(j)) for i in range(MAP)] for j in range(MAP)]
    below = shaded_ground(trees, SIDE_M, MAP)
    control, far = [], []
    for j in range(MAP):
        weights, colors = [], []
        for i in range(MAP):
            a, b, c, d = max(i - 1, 0), min(i + 1, MAP - 1), max(j - 1, 0), min(j + 1, MAP - 1)
            steep = math.hypot((h[j][b] - h[j][a]) / (b - a), (h[d][i] - h[c][i]) / (d - c)) / step
            near = 0.25 * (h[max(j - 4, 0)][i] + h[min(j + 4, MAP - 1)][i] + h[j][max(i - 4, 0)] + h[j][min(i + 4, MAP - 1)])
            shares, color = ground(land_, at(i), at(j), h[j][i], steep, (near - h[j][i]) / 3, below[j * MAP + i])
            weights += [max(0, min(255, round(255 * s))) for s in shares]
            colors += [code(v) for v in color]
        control.append(weights)
        far.append(colors)
    png(f"{folder}/terrain_weights.png", MAP, MAP, 4, control)
    png(f"{folder}/terrain_far.png", MAP, MAP, 3, far)


def clouds(folder):
    """What the sun shines through: fields of cloud with soft edges; the picture repeats."""
    size, cells = 256, 5
    rows = []
    for j in range(size):
        row = []
        for i in range(size):
            total, share = 0.0, 0.5
            for k in range(5):
                n = cells * 2**k
                x, y = (i / size - 0.5) * n, j * n / size
                u, v = math.floor(x), math.floor(y)
                wrap = lambda a, b: noise(a % n, b % n, 301 + k)
                s, t = smooth(0, 1, x - u), smooth(0, 1, y - v)
                total += share * ((wrap(u, v) * (1 - s) + wrap(u + 1, v) * s) * (1 - t) +
                                  (wrap(u, v + 1) * (1 - s) + wrap(u + 1, v + 1) * s) * t)
                share *= 0.5
            row.append(round(255 * (1 - 0.82 * smooth(0.54, 0.63, total))))
        rows.append(row)
    png(f"{folder}/terrain_clouds.png", size, size, 1, rows)


def main():
    land_ = Land()
    trees = forest(land_, lake, EYE, random.Random(5), 9000)
    glb(sys.argv[1], land_, trees)
    maps(sys.argv[1], land_, trees)
    clouds(sys.argv[1])


if __name__ == "__main__":
    main()
