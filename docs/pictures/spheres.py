#!/usr/bin/env python3
"""Writes a scene of one ball for each lighting model under four lamps: spheres.py OUT.glb"""
import json
import math
import struct
import sys

WEATHER = "PETRICHOR_materials_weather"
RED = (0.5, 0.1, 0.08)
SKIN = (0.75, 0.5, 0.4)


def material(name, color, roughness, metallic=0, extensions=None, **own):
    result = {"name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [*color, 1], "roughnessFactor": roughness, "metallicFactor": metallic}}
    extensions = dict(extensions or {})
    if own:
        extensions[WEATHER] = own
    if extensions:
        result["extensions"] = extensions
    return result


# Rows of five, the back one first.
BALLS = [
    material("standard", RED, 0.35),
    material("standard, rough", RED, 0.9),
    material("lambert", RED, 0.5, lightingModel="lambert"),
    material("metal", (0.9, 0.7, 0.35), 0.3, 1),
    material("clear coat", (0.1, 0.02, 0.02), 0.5, extensions={"KHR_materials_clearcoat": {
        "clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.05}}),
    material("sheen", (0.05, 0.05, 0.2), 0.9, extensions={"KHR_materials_sheen": {
        "sheenColorFactor": [0.4, 0.4, 0.9], "sheenRoughnessFactor": 0.4}}),
    material("anisotropic metal", (0.75, 0.75, 0.75), 0.3, 1,
             extensions={"KHR_materials_anisotropy": {"anisotropyStrength": 0.9}}),
    material("skin", SKIN, 0.45, lightingModel="skin", skinCurvature=0.5, translucency=0.3,
             translucencyColor=[1, 0.4, 0.25], translucencyScale=1, translucencyPower=2),
    material("the same, standard", SKIN, 0.45),
    material("hair", (0.35, 0.2, 0.1), 0.4, lightingModel="hair"),
    material("velvet", (0.1, 0.01, 0.03), 1, scatterColor=[0.52, 0.13, 0.28], scatterBias=0.2, scatterPower=2),
    material("wax", (0.6, 0.7, 0.3), 0.5, translucency=0.5, translucencyScale=2, translucencyPower=2),
    material("lwrp", RED, 0.35, lightingModel="lwrp"),
    material("lux", RED, 0.35, lightingModel="lux"),
    material("burley", RED, 0.9, lightingModel="burley"),
]


class Glb:
    def __init__(self):
        self.bytes = b""
        self.views = []
        self.accessors = []

    def add(self, numbers, kind, count, limits=False):
        data = struct.pack(f"<{len(numbers)}{'I' if kind == 'SCALAR' else 'f'}", *numbers)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        accessor = {"bufferView": len(self.views) - 1, "componentType": 5125 if kind == "SCALAR" else 5126,
                    "count": len(numbers) // count, "type": kind}
        if limits:
            accessor["min"] = [min(numbers[k::3]) for k in range(3)]
            accessor["max"] = [max(numbers[k::3]) for k in range(3)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def primitive(self, positions, normals, uvs, tangents, indices):
        return {"attributes": {"POSITION": self.add(positions, "VEC3", 3, True),
                               "NORMAL": self.add(normals, "VEC3", 3), "TEXCOORD_0": self.add(uvs, "VEC2", 2),
                               "TANGENT": self.add(tangents, "VEC4", 4)},
                "indices": self.add(indices, "SCALAR", 1)}


def ball(glb, radius=0.45, rows=48, columns=64):
    positions, normals, uvs, tangents, indices = [], [], [], [], []
    for i in range(rows + 1):
        for j in range(columns + 1):
            a, b = math.pi * i / rows, 2 * math.pi * j / columns
            n = (math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b))
            positions += [radius * x for x in n]
            normals += n
            uvs += [j / columns, i / rows]
            tangents += [-math.sin(b), 0, math.cos(b), 1]
    for i in range(rows):
        for j in range(columns):
            a = i * (columns + 1) + j
            b = a + columns + 1
            indices += [a, a + 1, b, b, a + 1, b + 1]
    return glb.primitive(positions, normals, uvs, tangents, indices)


def floor(glb, half=12):
    return glb.primitive([-half, 0, half, half, 0, half, half, 0, -half, -half, 0, -half], [0, 1, 0] * 4,
                         [0, 0, 1, 0, 1, 1, 0, 1], [1, 0, 0, 1] * 4, [0, 1, 2, 0, 2, 3])


def turned(x, y, z, w):
    size = math.sqrt(x * x + y * y + z * z + w * w)
    return [x / size, y / size, z / size, w / size]


def lamp(number, translation, rotation=(0, 0, 0, 1)):
    return {"translation": translation, "rotation": turned(*rotation),
            "extensions": {"KHR_lights_punctual": {"light": number}}}


def main():
    glb = Glb()
    ground, round_one = floor(glb), ball(glb)
    materials = [material("floor", (0.35, 0.35, 0.35), 0.55), *BALLS]
    meshes = [{"primitives": [{**ground, "material": 0}]}]
    nodes = [{"mesh": 0}]
    for i in range(len(BALLS)):
        meshes.append({"primitives": [{**round_one, "material": i + 1}]})
        nodes.append({"mesh": i + 1, "translation": [(i % 5 - 2) * 1.15, 0.45, (i // 5 - 1) * 1.3]})
    shape = "PETRICHOR_lights_shape"
    lights = [
        {"name": "tube", "type": "point", "intensity": 120, "color": [1, 0.9, 0.75],
         "extensions": {shape: {"radius": 0.05, "length": 2.5}}},
        {"name": "panel", "type": "spot", "intensity": 160, "color": [0.7, 0.85, 1],
         "spot": {"outerConeAngle": 1.2}, "extensions": {shape: {"width": 1.2, "height": 0.8}}},
        {"name": "bulb", "type": "point", "intensity": 60, "color": [1, 0.6, 0.3],
         "extensions": {shape: {"radius": 0.15}}},
        {"name": "fill", "type": "point", "intensity": 90, "extensions": {shape: {"specular": 0}}},
    ]
    nodes += [lamp(0, [0, 2.2, -2.6], (0, 0, 1, 1)), lamp(1, [-3.2, 2.2, 1.5], (-0.26, -0.5, -0.16, 0.8)),
              lamp(2, [2.6, 1.4, 1.2]), lamp(3, [-1.5, 3.5, 6]),
              {"camera": 0, "translation": [0, 4.2, 5.8], "rotation": turned(-0.31, 0, 0, 0.951)}]
    tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
            "nodes": nodes, "meshes": meshes, "materials": materials, "accessors": glb.accessors,
            "bufferViews": glb.views, "buffers": [{"byteLength": len(glb.bytes)}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.58, "znear": 0.05}}],
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_sheen",
                               "KHR_materials_anisotropy", WEATHER, shape],
            "extensions": {"KHR_lights_punctual": {"lights": lights}}}
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    data = glb.bytes + b"\0" * (-len(glb.bytes) % 4)
    with open(sys.argv[1], "wb") as out:
        out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)))
        out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        out.write(struct.pack("<II", len(data), 0x4E4942) + data)


main()
