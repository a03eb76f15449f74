#!/usr/bin/env python3
"""Puts a room with a window before the street of the demo, seen from inside: window.py STREET.glb OUT.glb

    petrichor scene demo:street --glb street.glb
"""
import json
import math
import struct
import sys


class Part:
    def __init__(self):
        self.positions, self.normals, self.indices = [], [], []

    def quad(self, corners, normal=None):
        u, v = ([b - a for a, b in zip(corners[0], corners[k])] for k in (1, 3))
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        size = math.sqrt(sum(x * x for x in n)) or 1.0
        first = len(self.positions)
        for k, corner in enumerate(corners):
            self.positions.append(corner)
            self.normals.append(normal[k] if normal else [x / size for x in n])
        self.indices += [first, first + 1, first + 2, first, first + 2, first + 3]

    def box(self, low, high):
        (a, b, c), (x, y, z) = low, high
        self.quad([[a, b, z], [x, b, z], [x, y, z], [a, y, z]])
        self.quad([[x, b, c], [a, b, c], [a, y, c], [x, y, c]])
        self.quad([[x, b, z], [x, b, c], [x, y, c], [x, y, z]])
        self.quad([[a, b, c], [a, b, z], [a, y, z], [a, y, c]])
        self.quad([[a, y, z], [x, y, z], [x, y, c], [a, y, c]])
        self.quad([[a, b, c], [x, b, c], [x, b, z], [a, b, z]])

    def tube(self, points, radius, sides=10):
        """Round a way in the plane of x and y, smooth."""
        rings = []
        for k, (x, y, z) in enumerate(points):
            (a, b, _), (c, d, _) = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
            size = math.hypot(c - a, d - b)
            out = [-(d - b) / size, (c - a) / size]
            turns = [2.0 * math.pi * i / sides for i in range(sides + 1)]
            rings.append([([x + radius * math.cos(t) * out[0], y + radius * math.cos(t) * out[1], z + radius * math.sin(t)],
                           [math.cos(t) * out[0], math.cos(t) * out[1], math.sin(t)]) for t in turns])
        for one, two in zip(rings, rings[1:]):
            for i in range(sides):
                corners = [one[i], one[i + 1], two[i + 1], two[i]]
                self.quad([c[0] for c in corners], [c[1] for c in corners])

    def lathe(self, middle, profile, sides=48):
        """profile: (radius, height) from below to above, smooth."""
        for k in range(sides):
            turns = [2.0 * math.pi * (k + i) / sides for i in (0, 1)]
            for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
                away, up = y1 - y0, r0 - r1
                size = math.hypot(away, up) or 1.0
                corner = lambda r, y, t: [middle[0] + r * math.cos(t), middle[1] + y, middle[2] - r * math.sin(t)]
                normal = lambda t: [away / size * math.cos(t), up / size, -away / size * math.sin(t)]
                self.quad([corner(r0, y0, turns[0]), corner(r0, y0, turns[1]), corner(r1, y1, turns[1]),
                           corner(r1, y1, turns[0])], [normal(turns[0]), normal(turns[1]), normal(turns[1]), normal(turns[0])])


WALL, LOW, HIGH, HALF, FRONT = 5.0, 0.95, 2.35, 1.15, 5.12  # z of the outside, the opening, z of the inside
walls, frame, wood, cup, leaves, pane, book, paper = (Part() for _ in range(8))
walls.box([-3.0, 0.0, WALL], [-HALF, 3.1, FRONT])
walls.box([HALF, 0.0, WALL], [3.0, 3.1, FRONT])
walls.box([-HALF, 0.0, WALL], [HALF, LOW, FRONT])
walls.box([-HALF, HIGH, WALL], [HALF, 3.1, FRONT])
walls.box([-3.0, 3.0, FRONT], [3.0, 3.1, 9.0])
walls.box([-3.0, 0.0, FRONT], [-2.9, 3.1, 9.0])
walls.box([2.9, 0.0, FRONT], [3.0, 3.1, 9.0])
walls.box([-3.0, 0.0, 8.9], [3.0, 3.1, 9.0])
wood.box([-3.0, 0.2, FRONT], [3.0, 0.25, 9.0])
wood.box([-HALF - 0.08, LOW - 0.035, WALL + 0.02], [HALF + 0.08, LOW, FRONT + 0.2])
for low, high in (((-HALF, LOW), (-HALF + 0.06, HIGH)), ((HALF - 0.06, LOW), (HALF, HIGH)), ((-0.035, LOW), (0.035, HIGH)),
                  ((-HALF, LOW), (HALF, LOW + 0.06)), ((-HALF, HIGH - 0.06), (HALF, HIGH)), ((-HALF, 1.9), (HALF, 1.94))):
    frame.box([*low, WALL + 0.03], [*high, WALL + 0.085])
pane.quad([[-HALF, LOW, WALL + 0.05], [HALF, LOW, WALL + 0.05], [HALF, HIGH, WALL + 0.05], [-HALF, HIGH, WALL + 0.05]])
cup.lathe([0.52, LOW, FRONT + 0.1], [(0.0, 0.0), (0.033, 0.0), (0.04, 0.02), (0.041, 0.085), (0.041, 0.09), (0.037, 0.09),
                                     (0.036, 0.02), (0.0, 0.018)])
cup.tube([(0.52 + 0.038 + 0.026 * math.sin(t), LOW + 0.048 - 0.028 * math.cos(t), FRONT + 0.1) for t in
          [math.pi * k / 16 for k in range(17)]], 0.005)
cup.lathe([-0.62, LOW, FRONT + 0.09], [(0.0, 0.0), (0.055, 0.0), (0.075, 0.12), (0.082, 0.12), (0.082, 0.14), (0.07, 0.14), (0.068, 0.12), (0.0, 0.12)])
for k in range(34):
    turn, rise, reach = 2.4 * k, 0.10 + 0.22 * ((k * 0.618) % 1.0), 0.05 + 0.11 * ((k * 0.38) % 1.0)
    c, s = math.cos(turn), math.sin(turn)
    root = [-0.62 + 0.02 * c, LOW + 0.12, FRONT + 0.09 + 0.02 * s]
    tip = [-0.62 + reach * c, LOW + 0.12 + rise, FRONT + 0.09 + 0.7 * reach * s]
    middle = [0.45 * a + 0.55 * b for a, b in zip(root, tip)]
    middle[1] += 0.03
    wide = 0.012 + 0.01 * ((k * 0.73) % 1.0)
    side = [-s * wide, 0.0, c * wide]
    leaves.quad([root, [a + b for a, b in zip(middle, side)], tip, [a - b for a, b in zip(middle, side)]])
book.box([0.15, LOW, FRONT + 0.03], [0.36, LOW + 0.028, FRONT + 0.17])
paper.box([0.158, LOW + 0.004, FRONT + 0.033], [0.363, LOW + 0.024, FRONT + 0.173])
book.box([0.16, LOW + 0.028, FRONT + 0.045], [0.345, LOW + 0.047, FRONT + 0.165])

with open(sys.argv[1], "rb") as file:
    data = file.read()
length = struct.unpack("<I", data[12:16])[0]
gltf = json.loads(data[20:20 + length])
body = bytearray(data[28 + length:])


def material(name, color, roughness, metallic=0.0, **more):
    gltf["materials"].append({"name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [*color, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}, **more})
    return len(gltf["materials"]) - 1


def view(values, kind, component):
    while len(body) % 4:
        body.append(0)
    gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(body), "byteLength": len(values)})
    body.extend(values)
    accessor = {"bufferView": len(gltf["bufferViews"]) - 1, "componentType": component, "type": kind}
    gltf["accessors"].append(accessor)
    return accessor


def add(name, part, number):
    flat = lambda rows: struct.pack(f"<{3 * len(rows)}f", *(x for row in rows for x in row))
    at = view(flat(part.positions), "VEC3", 5126)
    at["count"] = len(part.positions)
    at["min"], at["max"] = ([pick(p[k] for p in part.positions) for k in range(3)] for pick in (min, max))
    position = len(gltf["accessors"]) - 1
    view(flat(part.normals), "VEC3", 5126)["count"] = len(part.normals)
    normal = len(gltf["accessors"]) - 1
    view(struct.pack(f"<{len(part.indices)}I", *part.indices), "SCALAR", 5125)["count"] = len(part.indices)
    gltf["meshes"].append({"name": name, "primitives": [{"attributes": {"POSITION": position, "NORMAL": normal},
                                                         "indices": len(gltf["accessors"]) - 1, "material": number}]})
    gltf["nodes"].append({"name": name, "mesh": len(gltf["meshes"]) - 1})
    gltf["scenes"][0]["nodes"].append(len(gltf["nodes"]) - 1)


add("room", walls, material("room plaster", [0.62, 0.56, 0.47], 0.9))
add("window frame", frame, material("window frame", [0.72, 0.72, 0.68], 0.45))
add("boards", wood, material("boards", [0.30, 0.19, 0.11], 0.5))
add("cup and pot", cup, material("glazed clay", [0.55, 0.20, 0.13], 0.2))
add("leaves", leaves, material("house plant leaves", [0.10, 0.26, 0.07], 0.45, doubleSided=True))
add("book", book, material("book cloth", [0.08, 0.13, 0.24], 0.7))
add("paper", paper, material("paper", [0.80, 0.76, 0.66], 0.9))
add("pane", pane, material("pane", [1.0, 1.0, 1.0], 0.0, doubleSided=True,
                           extensions={"KHR_materials_transmission": {"transmissionFactor": 1.0}}))
gltf.setdefault("extensionsUsed", [])
if "KHR_materials_transmission" not in gltf["extensionsUsed"]:
    gltf["extensionsUsed"].append("KHR_materials_transmission")
gltf["cameras"].append({"name": "window", "type": "perspective", "perspective": {"yfov": 0.95, "znear": 0.05}})
lean = -0.04
gltf["nodes"].append({"name": "window", "camera": len(gltf["cameras"]) - 1, "translation": [0.26, 1.36, 5.95],
                      "rotation": [math.sin(lean), 0.0, 0.0, math.cos(lean)]})
gltf["scenes"][0]["nodes"].append(len(gltf["nodes"]) - 1)
while len(body) % 4:
    body.append(0)
gltf["buffers"][0]["byteLength"] = len(body)
text = json.dumps(gltf).encode()
text += b" " * (-len(text) % 4)
with open(sys.argv[2], "wb") as out:
    out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)))
    out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
    out.write(struct.pack("<II", len(body), 0x004E4942) + body)
