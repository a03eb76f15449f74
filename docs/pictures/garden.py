#!/usr/bin/env python3
"""Writes a garden for a frosty dawn: a lawn with blades, an evergreen, a brick house, trees. garden.py OUT.glb"""
import json
import math
import random
import struct
import sys

from eroded import fractal
from plants import conifer

draw = random.Random(11)


class Part:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def face(self, corners, uvs, normal=None):
        a, b, c = corners[0], corners[1], corners[2]
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        size = math.sqrt(sum(x * x for x in n)) or 1.0
        n = normal or [x / size for x in n]
        first = len(self.positions) // 3
        for corner, uv in zip(corners, uvs):
            self.positions += corner
            self.normals += n
            self.uvs += uv
        for k in range(1, len(corners) - 1):
            self.indices += [first, first + k, first + k + 1]

    def rectangle(self, corner, u, v, tile):
        size_u, size_v = (math.sqrt(sum(x * x for x in w)) / tile for w in (u, v))
        add = lambda p, *ways: [p[k] + sum(w[k] for w in ways) for k in range(3)]
        self.face([corner, add(corner, u), add(corner, u, v), add(corner, v)],
                  [[0, size_v], [size_u, size_v], [size_u, 0], [0, 0]])

    def box(self, low, high, tile):
        x, y, z = ([high[k] - low[k] if k == n else 0 for k in range(3)] for n in range(3))
        add = lambda p, w: [p[k] + w[k] for k in range(3)]
        self.rectangle(add(low, z), x, y, tile)
        self.rectangle(add(low, x), [-w for w in x], y, tile)
        self.rectangle(low, z, y, tile)
        self.rectangle(add(add(low, x), z), [-w for w in z], y, tile)
        self.rectangle(add(add(low, y), z), x, [-w for w in z], tile)


def blades(part, count):
    for _ in range(count):
        x, z = draw.uniform(-3.4, 5.0), draw.uniform(-6.0, 4.6)
        if abs(x + 3.0) < 0.75:
            continue
        height, turn, lean = draw.uniform(0.03, 0.075), draw.uniform(0, 2 * math.pi), draw.uniform(0.1, 0.6)
        c, s, half = math.cos(turn), math.sin(turn), 0.0045
        top = [x + s * lean * height, height, z + c * lean * height]
        up = [0.3 * s, 0.954, 0.3 * c]
        low, other = [x - c * half, 0, z + s * half], [x + c * half, 0, z - s * half]
        # Either way round: of one triangle with two sides the back would look down.
        for corners in ([low, other, top], [other, low, top]):
            part.face(corners, [[x, z], [x, z], [x, z]], up)


def evergreen(bark, needles, x, z):
    sides = 9
    for k in range(sides):
        a, b = 2 * math.pi * k / sides, 2 * math.pi * (k + 1) / sides
        low, high = 0.24, 0.12
        bark.face([[x + low * math.cos(b), 0, z + low * math.sin(b)], [x + low * math.cos(a), 0, z + low * math.sin(a)],
                   [x + high * math.cos(a), 4.5, z + high * math.sin(a)],
                   [x + high * math.cos(b), 4.5, z + high * math.sin(b)]],
                  [[(k + 1) / 6, 4], [k / 6, 4], [k / 6, 0], [(k + 1) / 6, 0]])
    # Tiers of boughs that hang towards their ends.
    for _ in range(5200):
        height = 1.5 + 5.2 * draw.random() ** 1.4
        reach = 2.5 * (1.0 - (height - 1.5) / 5.6)
        way, turn = reach * math.sqrt(draw.uniform(0.06, 1.0)), draw.uniform(0, 2 * math.pi)
        tier = 0.45 * round(height / 0.45)
        at = [x + way * math.cos(turn), tier - 0.16 * way + draw.uniform(-0.07, 0.07), z + way * math.sin(turn)]
        size = draw.uniform(0.10, 0.2)
        along = [math.cos(turn), -0.22 + draw.uniform(-0.2, 0.2), math.sin(turn)]
        across = [-math.sin(turn) + draw.uniform(-0.5, 0.5), draw.uniform(-0.4, 0.4), math.cos(turn)]
        add = lambda f, g: [at[k] + size * (f * along[k] + g * across[k]) for k in range(3)]
        needles.face([add(-1, 0), add(0, -0.4), add(1, 0), add(0, 0.4)], [[0, 0], [1, 0], [1, 1], [0, 1]])


def window(wood, glass, stone, z, low, high, half):
    """Two casements of six panes each in a frame, on a sill, under a lintel."""
    face = -4.0
    wood.box([face, low, z - half], [face + 0.05, high, z - half + 0.07], 1.0)
    wood.box([face, low, z + half - 0.07], [face + 0.05, high, z + half], 1.0)
    wood.box([face, high - 0.08, z - half], [face + 0.05, high, z + half], 1.0)
    wood.box([face, low, z - half], [face + 0.05, low + 0.08, z + half], 1.0)
    wood.box([face, low, z - 0.05], [face + 0.045, high, z + 0.05], 1.0)
    glass.rectangle([face + 0.012, low + 0.06, z + half - 0.05], [0, 0, 0.10 - 2 * half], [0, high - low - 0.12, 0], 1.0)
    for side in (-1, 1):
        middle = z + side * (half + 0.0) / 2
        wood.box([face, low, middle - 0.014], [face + 0.03, high, middle + 0.014], 1.0)
    for k in (1, 2):
        y = low + (high - low) * k / 3
        wood.box([face, y - 0.014, z - half], [face + 0.03, y + 0.014, z + half], 1.0)
    stone.box([face - 0.02, low - 0.09, z - half - 0.1], [face + 0.13, low, z + half + 0.1], 1.0)
    stone.box([face - 0.02, high, z - half - 0.14], [face + 0.025, high + 0.2, z + half + 0.14], 1.0)


def door(wood, leaf, stone, z, high, half):
    """A panelled leaf in a frame, with a light over it, a step and a knob."""
    face = -4.0
    for side in (-1, 1):
        at = z + side * half
        wood.box([face, 0, at - 0.06], [face + 0.07, high + 0.08, at + 0.06], 1.0)
    wood.box([face, high, z - half], [face + 0.07, high + 0.10, z + half], 1.0)
    leaf.box([face, 0.06, z - half], [face + 0.02, high, z + half], 1.0)
    for low, top in ((0.22, 0.82), (0.98, 1.42), (1.54, high - 0.12)):
        for side in (-1, 1):
            middle = z + side * 0.23
            leaf.box([face, low, middle - 0.17], [face + 0.035, top, middle + 0.17], 1.0)
    leaf.box([face, 0.96, z + half - 0.14], [face + 0.08, 1.02, z + half - 0.08], 1.0)
    stone.box([face, -0.05, z - half - 0.15], [face + 0.45, 0.09, z + half + 0.15], 1.0)
    stone.box([face - 0.02, high + 0.10, z - half - 0.2], [face + 0.03, high + 0.32, z + half + 0.2], 1.0)


def house(wall, wood, glass, leaf, stone, roof):
    wall.box([-9.0, 0, -13], [-4.0, 4.6, 4.0], 1.8)
    stone.box([-9.0, 0, -13.03], [-3.97, 0.28, 4.0], 1.0)
    for z in (-9.5, -5.8, -1.2):
        window(wood, glass, stone, z, 1.0, 2.5, 0.62)
    door(wood, leaf, stone, -3.4, 2.1, 0.47)
    # Eaves: a roof of tiles, its boards, a gutter and its pipe.
    roof.rectangle([-3.45, 4.45, 4.4], [0, 0, -17.8], [-3.05, 2.5, 0], 1.0)
    roof.rectangle([-9.55, 4.45, -13.4], [0, 0, 17.8], [3.05, 2.5, 0], 1.0)
    wall.face([[-4.0, 4.6, -13], [-9.0, 4.6, -13], [-6.5, 6.75, -13]], [[0, 0], [2.8, 0], [1.4, 1.2]])
    wood.box([-4.0, 4.38, -13.4], [-3.42, 4.44, 4.4], 1.0)
    wood.box([-3.44, 4.30, -13.4], [-3.34, 4.46, 4.4], 1.0)
    wood.box([-3.98, 0.0, -12.75], [-3.88, 4.4, -12.65], 1.0)


def trees(needles):
    """A row and groves at the end of the lawn."""
    kinds = [conifer(draw, 7, 0)[:4] for _ in range(3)]
    places = []
    while len(places) < 120:
        x, z = draw.uniform(-31, 31), draw.uniform(-57, -6)
        row, side = z < -48 and x > -22, x > 24 and z < -20
        if (row or side) and fractal(x / 13, z / 13, 29, 3) > 0.40:
            places.append((x, z, draw.uniform(2.0, 4.5) if draw.random() < 0.4 else draw.uniform(5, 9.5)))
    for x, z, size in places:
        positions, normals, uvs, indices = kinds[draw.randrange(3)]
        first, wide = len(needles.positions) // 3, size * draw.uniform(1.1, 1.7)
        for k in range(0, len(positions), 3):
            needles.positions += [x + wide * positions[k], size * positions[k + 1] - 0.15, z + wide * positions[k + 2]]
        needles.normals += normals
        needles.uvs += uvs
        needles.indices += [first + i for i in indices]


def main():
    parts = {name: Part() for name in ("lawn", "grass blades", "paving", "brick", "white wood", "window glass",
                                       "bark", "needles", "door leaf", "sill stone", "roof tiles", "far trees")}
    trees(parts["far trees"])
    parts["lawn"].rectangle([-32, 0, 14], [64, 0, 0], [0, 0, -72], 1.0)
    parts["paving"].box([-3.55, -0.1, -12.0], [-2.45, 0.02, 6.0], 2.0)
    blades(parts["grass blades"], 52000)
    evergreen(parts["bark"], parts["needles"], 1.9, -4.2)
    house(parts["brick"], parts["white wood"], parts["window glass"], parts["door leaf"], parts["sill stone"],
          parts["roof tiles"])
    looks = {"lawn": ([1, 1, 1], 0.9), "grass blades": ([0.055, 0.085, 0.022], 0.7), "paving": ([1, 1, 1], 1),
             "brick": ([1, 1, 1], 1), "white wood": ([0.50, 0.48, 0.44], 0.55), "window glass": ([0.02, 0.022, 0.025], 0.06),
             "bark": ([0.11, 0.075, 0.05], 0.95), "needles": ([0.022, 0.04, 0.016], 0.75),
             "door leaf": ([0.022, 0.055, 0.050], 0.4), "sill stone": ([0.30, 0.28, 0.25], 0.85),
             "roof tiles": ([0.10, 0.065, 0.05], 0.8), "far trees": ([0.020, 0.030, 0.016], 0.85)}
    data, views, accessors, primitives, materials = b"", [], [], [], []

    def add(numbers, kind, width):
        nonlocal data
        packed = struct.pack(f"<{len(numbers)}{'I' if kind == 'SCALAR' else 'f'}", *numbers)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed
        accessor = {"bufferView": len(views) - 1, "componentType": 5125 if kind == "SCALAR" else 5126,
                    "count": len(numbers) // width, "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(numbers[k::3]) for k in range(3)]
            accessor["max"] = [max(numbers[k::3]) for k in range(3)]
        accessors.append(accessor)
        return len(accessors) - 1

    for name, part in parts.items():
        color, roughness = looks[name]
        materials.append({"name": name, "doubleSided": name in ("needles", "far trees"),
                          "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "roughnessFactor": roughness,
                                                   "metallicFactor": 0}})
        primitives.append({"material": len(materials) - 1, "indices": add(part.indices, "SCALAR", 1),
                           "attributes": {"POSITION": add(part.positions, "VEC3", 3),
                                          "NORMAL": add(part.normals, "VEC3", 3),
                                          "TEXCOORD_0": add(part.uvs, "VEC2", 2)}})
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": primitives}], "materials": materials, "accessors": accessors,
            "bufferViews": views, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    with open(sys.argv[1], "wb") as out:
        out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)))
        out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        out.write(struct.pack("<II", len(data), 0x004E4942) + data)


if __name__ == "__main__":
    main()
