#!/usr/bin/env python3
"""Writes a garden for a frosty dawn: a lawn with blades, an evergreen, a brick house. garden.py OUT.glb"""
import json
import math
import random
import struct
import sys

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
        part.face([[x - c * half, 0, z + s * half], [x + c * half, 0, z - s * half], top],
                  [[x, z], [x, z], [x, z]], up)


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


def house(wall, wood, glass):
    wall.box([-9.0, 0, -13], [-4.0, 4.6, 4.0], 1.8)
    for z in (-9.5, -5.8, -1.2):
        wood.box([-4.02, 1.0, z - 0.62], [-3.95, 2.5, z + 0.62], 1.0)
        glass.rectangle([-3.945, 1.08, z + 0.54], [0, 0, -1.08], [0, 1.34, 0], 1.0)
        wood.box([-3.95, 1.08, z - 0.03], [-3.93, 2.42, z + 0.03], 1.0)
    wood.box([-4.02, 0, -3.9], [-3.95, 2.15, -2.9], 1.0)


def main():
    parts = {name: Part() for name in ("lawn", "grass blades", "paving", "brick", "door wood", "window glass",
                                       "bark", "needles")}
    parts["lawn"].rectangle([-20, 0, 14], [40, 0, 0], [0, 0, -44], 1.0)
    parts["paving"].box([-3.55, -0.1, -12.0], [-2.45, 0.02, 6.0], 2.0)
    blades(parts["grass blades"], 52000)
    evergreen(parts["bark"], parts["needles"], 1.9, -4.2)
    house(parts["brick"], parts["door wood"], parts["window glass"])
    looks = {"lawn": ([1, 1, 1], 0.9), "grass blades": ([0.055, 0.085, 0.022], 0.7), "paving": ([1, 1, 1], 1),
             "brick": ([1, 1, 1], 1), "door wood": ([0.55, 0.53, 0.48], 0.6), "window glass": ([0.02, 0.022, 0.025], 0.06),
             "bark": ([0.11, 0.075, 0.05], 0.95), "needles": ([0.022, 0.04, 0.016], 0.75)}
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
        materials.append({"name": name, "doubleSided": name in ("grass blades", "needles"),
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
