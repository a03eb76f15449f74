"""A cart that is drawn over a yard by somebody who walks before it: the moving nodes of docs/pictures/cart.toml.

    cart.py OUT.glb
"""
import json
import math
import struct
import sys

SECONDS, KEYS = 10.0, 121
STEP_S = 0.9       # of one foot, from one print to its next
WHEEL_M = 0.3

binary = bytearray()
views, accessors, meshes, materials, nodes = [], [], [], [], []


def accessor(kind, values, component=5126):
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
    flat = [v for value in values for v in (value if width > 1 else (value,))]
    while len(binary) % 4:
        binary.append(0)
    views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": 4 * len(flat)})
    binary.extend(struct.pack(f"<{len(flat)}{'f' if component == 5126 else 'I'}", *flat))
    one = {"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind}
    if width == 3 or kind == "SCALAR":
        columns = list(zip(*values)) if width > 1 else [values]
        one["min"], one["max"] = [min(c) for c in columns], [max(c) for c in columns]
    accessors.append(one)
    return len(accessors) - 1


def material(name, color, roughness):
    materials.append({"name": name, "pbrMetallicRoughness": {
        "baseColorFactor": [*color, 1.0], "roughnessFactor": roughness, "metallicFactor": 0.0}})
    return len(materials) - 1


def mesh(name, shapes, material_index):
    """Of (points, normals, triangles)."""
    points, normals, triangles = [], [], []
    for p, n, t in shapes:
        triangles += [i + len(points) for i in t]
        points += p
        normals += n
    meshes.append({"name": name, "primitives": [{
        "attributes": {"POSITION": accessor("VEC3", points), "NORMAL": accessor("VEC3", normals)},
        "indices": accessor("SCALAR", triangles, 5125), "material": material_index}]})
    return len(meshes) - 1


def box(low, high):
    points, normals, triangles = [], [], []
    for axis in range(3):
        for side in (0, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(points)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0.0] * 3
                p[axis], p[u], p[v] = (low, high)[side][axis], (low, high)[a][u], (low, high)[b][v]
                points.append(p)
                normals.append([(2 * side - 1) * (k == axis) for k in range(3)])
            order = (0, 1, 2, 0, 2, 3) if side else (0, 2, 1, 0, 3, 2)
            triangles += [first + i for i in order]
    return points, normals, triangles


def round_thing(radii, middle, rings=12, around=20):
    points, normals, triangles = [], [], []
    for i in range(rings + 1):
        a = math.pi * i / rings
        for k in range(around + 1):
            b = 2 * math.pi * k / around
            n = (math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b))
            points.append([middle[j] + radii[j] * n[j] for j in range(3)])
            m = [n[j] / radii[j] for j in range(3)]
            size = math.sqrt(sum(c * c for c in m))
            normals.append([c / size for c in m])
    for i in range(rings):
        for k in range(around):
            a, b = i * (around + 1) + k, (i + 1) * (around + 1) + k
            triangles += [a, a + 1, b, a + 1, b + 1, b]
    return points, normals, triangles


def wheel(width, spokes=8, around=32):
    """About x, its middle at the origin: a rim, a hub and spokes."""
    points, normals, triangles = [], [], []

    def ring(inner, outer):
        for k in range(around):
            a, b = 2 * math.pi * k / around, 2 * math.pi * (k + 1) / around
            corners = [(r, t) for t in (a, b) for r in (inner, outer)]
            p = lambda x, r, t: [x, r * math.cos(t), r * math.sin(t)]
            n = lambda t, s: [0.0, s * math.cos(t), s * math.sin(t)]
            w = width / 2
            quads = [([p(-w, outer, a), p(-w, outer, b), p(w, outer, b), p(w, outer, a)], [n(a, 1), n(b, 1), n(b, 1), n(a, 1)]),
                     ([p(w, inner, a), p(w, inner, b), p(-w, inner, b), p(-w, inner, a)], [n(a, -1), n(b, -1), n(b, -1), n(a, -1)]),
                     ([p(w, inner, a), p(w, outer, a), p(w, outer, b), p(w, inner, b)], [[1, 0, 0]] * 4),
                     ([p(-w, inner, a), p(-w, inner, b), p(-w, outer, b), p(-w, outer, a)], [[-1, 0, 0]] * 4)]
            for q, m in quads:
                first = len(points)
                points.extend(q)
                normals.extend(m)
                triangles.extend(first + i for i in (0, 1, 2, 0, 2, 3))
    ring(WHEEL_M - 0.05, WHEEL_M)
    ring(0.015, 0.05)
    shapes = [(points, normals, triangles)]
    for k in range(spokes):
        t = 2 * math.pi * k / spokes
        p, n, tri = box((-0.012, 0.04, -0.014), (0.012, WHEEL_M - 0.04, 0.014))
        turn = lambda v: [v[0], v[1] * math.cos(t) - v[2] * math.sin(t), v[1] * math.sin(t) + v[2] * math.cos(t)]
        shapes.append(([turn(v) for v in p], [turn(v) for v in n], tri))
    return shapes


def node(name, mesh_index=None, at=None, children=None):
    one = {"name": name}
    if mesh_index is not None:
        one["mesh"] = mesh_index
    if at:
        one["translation"] = at
    if children:
        one["children"] = children
    nodes.append(one)
    return len(nodes) - 1


# ---- the way: from the left past the camera and away -------------------------------------------


def place(s):
    """x, z of metre s of the way."""
    return -5.0 + 0.93 * s + 0.25 * math.sin(0.45 * s), 2.6 - 0.62 * s + 0.9 * math.sin(0.42 * s)


def heading(s):
    (ax, az), (bx, bz) = place(s - 0.05), place(s + 0.05)
    return math.atan2(bx - ax, bz - az)


LENGTH_M = 9.5
lengths = [0.0]
for i in range(2000):
    (ax, az), (bx, bz) = place(i * 0.01), place(i * 0.01 + 0.01)
    lengths.append(lengths[-1] + math.hypot(bx - ax, bz - az))


def parameter(metres):
    i = min(range(len(lengths)), key=lambda k: abs(lengths[k] - metres))
    return i * 0.01


def gone(t):
    return 1.0 + LENGTH_M * t / SECONDS


def along(metres, side=0.0):
    s = parameter(metres)
    x, z = place(s)
    h = heading(s)
    return x + side * math.cos(h), z - side * math.sin(h), h


wood = material("cart wood", (0.30, 0.17, 0.08), 0.7)
iron = material("cart iron", (0.05, 0.05, 0.055), 0.5)
wool = material("coat", (0.30, 0.06, 0.05), 0.9)
skin = material("head", (0.55, 0.34, 0.24), 0.6)
leather = material("boots", (0.08, 0.05, 0.03), 0.5)
ground = material("yard gravel", (0.28, 0.26, 0.23), 0.9)

cart_box = mesh("cart", [box((-0.33, 0.36, -0.6), (0.33, 0.40, 0.6)), box((-0.33, 0.40, -0.6), (-0.30, 0.66, 0.6)),
                         box((0.30, 0.40, -0.6), (0.33, 0.66, 0.6)), box((-0.30, 0.40, -0.6), (0.30, 0.60, -0.57)),
                         box((-0.025, 0.34, 0.6), (0.025, 0.39, 1.45)), box((-0.2, 0.35, 1.42), (0.2, 0.39, 1.46)),
                         box((-0.4, 0.27, -0.4), (0.4, 0.33, -0.36)), box((-0.4, 0.27, 0.36), (0.4, 0.33, 0.4))], wood)
wheels = mesh("wheel", wheel(0.06), iron)
body = mesh("walker", [round_thing((0.24, 0.42, 0.18), (0, 1.12, 0)), box((-0.30, 0.85, -0.06), (-0.22, 1.35, 0.06)),
                       box((0.22, 0.85, -0.06), (0.30, 1.35, 0.06))], wool)
head = mesh("head", [round_thing((0.11, 0.14, 0.12), (0, 1.66, 0))], skin)
boot = mesh("boot", [box((-0.05, 0.0, -0.10), (0.05, 0.10, 0.18)), box((-0.06, 0.10, -0.08), (0.06, 0.75, 0.06))], leather)
plate = mesh("yard", [box((-14, -0.3, -22), (14, 0.0, 8))], ground)
posts = mesh("fence", [s for i in range(9) for s in (
    box((-8 + 2 * i, 0, -9.06), (-7.9 + 2 * i, 1.1, -8.96)),)] +
    [box((-8, 0.45, -8.99), (8.1, 0.55, -8.95)), box((-8, 0.85, -8.99), (8.1, 0.95, -8.95))], wood)

rolling = [node(f"wheel.{i}", wheels, [x, WHEEL_M, z]) for i, (x, z) in enumerate(
    ((-0.42, -0.38), (0.42, -0.38), (-0.42, 0.38), (0.42, 0.38)))]
cart = node("cart", cart_box, None, rolling)
walker = node("walker", body, None, [node("head", head)])
boots = [node("boot.left", boot), node("boot.right", boot)]
roots = [cart, walker, *boots, node("yard", plate), node("fence", posts)]

times = [SECONDS * k / (KEYS - 1) for k in range(KEYS)]
clock = accessor("SCALAR", times)
samplers, channels = [], []


def animate(target, path, values):
    samplers.append({"input": clock, "output": accessor("VEC3" if path == "translation" else "VEC4", values)})
    channels.append({"sampler": len(samplers) - 1, "target": {"node": target, "path": path}})


def turned(h):
    return 0.0, math.sin(h / 2), 0.0, math.cos(h / 2)


def foot(t, phase):
    """Metres gone by a foot and how high it is: half of a step it stands."""
    u = t / STEP_S + phase
    n, f = math.floor(u), u % 1.0
    at = lambda k: gone(max((k - phase) * STEP_S + 0.25 * STEP_S, -3.0))
    if f < 0.5:
        return at(n), 0.0
    v = (f - 0.5) * 2
    v = v * v * (3 - 2 * v)
    return at(n) + (at(n + 1) - at(n)) * v, 0.24 * math.sin(math.pi * v)


for index, extra, path in ((cart, 0.0, None), (walker, 1.55, None)):
    moved = [along(gone(t) + extra) for t in times]
    animate(index, "translation", [(x, 0.0, z) for x, z, _ in moved])
    animate(index, "rotation", [turned(h) for _, _, h in moved])
for index, side, phase in ((boots[0], 0.11, 0.0), (boots[1], -0.11, 0.5)):
    steps = [foot(t, phase) for t in times]
    moved = [along(1.55 + metres, side) for metres, _ in steps]
    animate(index, "translation", [(x, y, z) for (x, z, _), (_, y) in zip(moved, steps)])
    animate(index, "rotation", [turned(h) for _, _, h in moved])
for index in rolling:
    spin = [gone(t) / WHEEL_M for t in times]
    animate(index, "rotation", [(math.sin(a / 2), 0.0, 0.0, math.cos(a / 2)) for a in spin])

document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes, "meshes": meshes,
            "materials": materials, "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": len(binary)}],
            "animations": [{"name": "over the yard", "samplers": samplers, "channels": channels}]}
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
binary += b"\0" * (-len(binary) % 4)
with open(sys.argv[1], "wb") as out:
    out.write(struct.pack("<III", 0x46546C67, 2, 12 + 16 + len(text) + len(binary)))
    out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
    out.write(struct.pack("<II", len(binary), 0x004E4942) + binary)
