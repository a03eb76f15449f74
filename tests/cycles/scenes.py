"""Small scenes whose materials and lights mean the same to any renderer: Lambert, white metals of GGX (all bounces between its facets), glTF's layers.

Each is told once and becomes a glTF file with a scenario for Petrichor (write()) and meshes for Blender
(render_cycles.py). Metres, y up; a camera looks along its own -z. Light in lux, candela and cd/m2.
"""
import json
import math
import pathlib
import shutil
import struct

import layers
from meshes import Mesh, looking, unit

MATT = {"grey": (0.5, 0.5, 0.5), "white": (0.8, 0.8, 0.8), "red": (0.7, 0.15, 0.1),
        "green": (0.15, 0.6, 0.2), "blue": (0.1, 0.2, 0.7)}
METAL = {"metal_01": 0.12, "metal_02": 0.2, "metal_03": 0.3, "metal_05": 0.5, "metal_08": 0.8}


def floor(material, half=12.0):
    return Mesh(material).quad((-half, 0.0, half), (2.0 * half, 0.0, 0.0), (0.0, 0.0, -2.0 * half))


def lambert_sun():
    """Matt boxes and balls under a sharp sun, its light alone."""
    return {
        "meshes": [floor("grey"), Mesh("red").box((-2.4, 0, -1.5), (-0.9, 2.2, 0.0), 0.4),
                   Mesh("white").ball((0.6, 1.0, 0.2), 1.0), Mesh("blue").box((2.0, 0, -1.0), (3.2, 1.2, 0.2), -0.3),
                   Mesh("green").ball((2.5, 0.5, 1.6), 0.5), Mesh("white").box((-1.5, 0, 1.4), (-0.5, 0.6, 2.0), 0.8)],
        "sun": {"lux": 3.0, "towards": unit((0.5, 0.75, 0.45))}, "lamps": [], "sky": 0.0, "bounces": 0,
        "camera": looking((1.5, 3.4, 7.5), (0.4, 0.7, 0.0)), "fov": 0.75}


def ggx_lamps():
    """White metals of five roughnesses over a matt floor, by three lamps and the sun, their light alone."""
    balls = [Mesh(name).ball((-3.2 + 1.6 * i, 0.7, 0.0), 0.7) for i, name in enumerate(METAL)]
    return {
        "meshes": [floor("grey")] + balls + [Mesh("metal_05").box((-1.4, 0, 1.5), (-0.4, 0.7, 2.1), 0.5)],
        "sun": {"lux": 1.5, "towards": unit((-0.4, 0.7, 0.6))},
        "lamps": [((-3.0, 2.6, 2.5), (14.0, 12.0, 9.0)), ((0.5, 3.2, 1.5), (10.0, 10.0, 10.0)), ((3.6, 1.6, 2.8), (6.0, 8.0, 12.0))],
        "sky": 0.0, "bounces": 0, "camera": looking((0.6, 2.6, 7.0), (0.0, 0.6, 0.2)), "fov": 0.8}


def courtyard(sky, sun):
    walls = [Mesh("grey").quad((-3, 0, 3), (6, 0, 0), (0, 0, -6)),
             Mesh("red").quad((-3, 0, 3), (0, 0, -6), (0, 3, 0)), Mesh("green").quad((3, 0, -3), (0, 0, 6), (0, 3, 0)),
             Mesh("white").quad((-3, 0, -3), (6, 0, 0), (0, 3, 0)),
             Mesh("white").box((-1.7, 0, -1.7), (-0.4, 1.7, -0.6), 0.4), Mesh("white").box((0.6, 0, -0.2), (1.7, 0.8, 0.9), -0.3)]
    return {"meshes": walls, "sun": {"lux": sun, "towards": unit((0.35, 0.8, 0.5))} if sun else None, "lamps": [],
            "sky": sky, "bounces": 8, "camera": looking((0.0, 2.6, 7.6), (0.0, 1.2, 0.0)), "fov": 0.62}


def lambert_bounce():
    """A court of coloured walls in the sun: what they send each other counts."""
    return courtyard(0.0, 3.0)


def lambert_sky():
    """The same court under an even sky."""
    return courtyard(1.0, 0.0)


STREET = {"lux": 3.0, "towards": unit((0.35, 0.62, 0.55)), "sky": 0.3, "fov": 0.75, "facets": "GGX"}  # GGX: its reference has one bounce between facets
HELMET = {"lux": 3.0, "towards": unit((0.6, 0.6, 0.7)), "sky": 0.4, "fov": 0.3, "facets": None, "eye": (0.6, 0.55, 1.15), "at": (0.03, 0.5, 0.03)}
LOADED = {"street": STREET, "helmet": HELMET}  # of files, by Blender's own importer
SCENES = {f.__name__: f for f in (lambert_sun, ggx_lamps, lambert_bounce, lambert_sky, layers.layers_sun, layers.layers_even)}
# Light that one surface sends another is solved on patches; light of lamps and sun is exact.
LIMITS = {"lambert_sun": (0.01, 0.03), "ggx_lamps": (0.01, 0.03), "lambert_bounce": (0.05, 0.06), "lambert_sky": (0.05, 0.06),
          "layers_sun": (0.01, 0.033), "layers_even": (0.01, 0.045), "street": (None, 0.076), "helmet": (0.05, 0.042)}
SIZE = (320, 180)


def matrix(axes):
    x, y, z, position = axes
    return [*x, 0.0, *y, 0.0, *z, 0.0, *position, 1.0]


def glb(scene):
    """The scene as a binary glTF file."""
    own = scene.get("materials", {})
    names = list(own) or [*MATT, *METAL]
    materials = [{"name": n, **told} for n, told in own.items()] or [{"name": n, "pbrMetallicRoughness": {"baseColorFactor": [*c, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0}} for n, c in MATT.items()] + [
        {"name": n, "pbrMetallicRoughness": {"baseColorFactor": [1.0] * 4, "metallicFactor": 1.0, "roughnessFactor": r}} for n, r in METAL.items()]
    binary, views, accessors, meshes, nodes, lights = b"", [], [], [], [], []

    def add(data, target, **facts):
        nonlocal binary
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data), "target": target})
        binary += data + b"\0" * (-len(data) % 4)
        accessors.append({"bufferView": len(views) - 1, **facts})
        return len(accessors) - 1

    for mesh in scene["meshes"]:
        count = len(mesh.positions)
        columns = list(zip(*mesh.positions))
        p = add(b"".join(struct.pack("<3f", *x) for x in mesh.positions), 34962, componentType=5126, count=count, type="VEC3",
                min=[min(c) for c in columns], max=[max(c) for c in columns])
        n = add(b"".join(struct.pack("<3f", *x) for x in mesh.normals), 34962, componentType=5126, count=count, type="VEC3")
        attributes = {"POSITION": p, "NORMAL": n}
        if own and mesh.tangents:
            attributes["TANGENT"] = add(b"".join(struct.pack("<4f", *x) for x in mesh.tangents), 34962, componentType=5126, count=count, type="VEC4")
        t = add(b"".join(struct.pack("<3I", *x) for x in mesh.triangles), 34963, componentType=5125, count=3 * len(mesh.triangles), type="SCALAR")
        meshes.append({"primitives": [{"attributes": attributes, "indices": t, "material": names.index(mesh.material)}]})
        nodes.append({"mesh": len(meshes) - 1})
    if scene["sun"]:
        lights.append({"type": "directional", "intensity": scene["sun"]["lux"], "color": [1.0, 1.0, 1.0]})
        towards = scene["sun"]["towards"]
        nodes.append({"matrix": matrix(looking(towards, (0.0, 0.0, 0.0))), "extensions": {"KHR_lights_punctual": {"light": 0}}})
    for position, candela in scene["lamps"]:
        most = max(candela)
        lights.append({"type": "point", "intensity": most, "color": [c / most for c in candela]})
        nodes.append({"translation": list(position), "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})
    nodes.append({"camera": 0, "matrix": matrix(scene["camera"])})
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
                "materials": materials, "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(binary)}],
                "cameras": [{"type": "perspective", "perspective": {"yfov": scene["fov"], "aspectRatio": SIZE[0] / SIZE[1], "znear": 0.05, "zfar": 100.0}}]}
    document["extensionsUsed"] = sorted({e for m in materials for e in m.get("extensions", {})} | ({"KHR_lights_punctual"} if lights else set()))
    if lights:
        document["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def even_sky():
    """A Radiance picture, one everywhere."""
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes((128, 128, 128, 129)) * 32


def scenario(name, scene, samples):
    """What Petrichor is asked for: this light and nothing else."""
    around = scene["sky"] > 0.0 or scene["bounces"] > 0
    alone = "alone" in scene
    lines = ["[scene]", f'file = "{name}.glb"', 'ground = "none"', "[sun]", 'source = "scene"', "[sky]", 'environment = "even.hdr"',
             f"environment_scale = {scene['sky']}", "[fog]", 'mode = "off"', "[weather]", 'keys = [{ time_s = 0.0, temperature_c = 15.0, rainfall = 0.0 }]', "duration_s = 1.0", "[lights]", 'lamps = "on"', f"emissive = {str(not alone).lower()}", "[render]",
             "reflections = false", "dither = false", "lamp_glow = false", "falling = false", "specular_aa = 0.0", "adaptive = 0.0",
             "lamp_shadows = 16", f"image_based_light = {str(around).lower()}", f"ambient_occlusion = {str(around and not alone).lower()}",
             f'indirect = "{"patches" if around and not alone else "ambient"}"', 'probes = "off"', f"draw_sky = {str(scene['sky'] > 0.0 and not alone).lower()}",
             "[output]", f"width = {SIZE[0]}", f"height = {SIZE[1]}", f"samples = {samples}", "frames = 1", "film = false"]
    for matt in [] if "materials" in scene else MATT:
        lines += [f'[materials."{matt}"]', 'lighting_model = "lambert"']
    return "\n".join(lines) + "\n"


def document(data):
    """What a binary glTF file says."""
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def add_sun(told, by):
    """One directional light, in place of all that the file has."""
    told.setdefault("extensions", {})["KHR_lights_punctual"] = {"lights": [{"type": "directional", "intensity": by["lux"], "color": [1.0, 1.0, 1.0]}]}
    told["extensionsUsed"] = sorted({*told.get("extensionsUsed", []), "KHR_lights_punctual"})
    told["nodes"].append({"matrix": matrix(looking(by["towards"], (0.0, 0.0, 0.0))), "extensions": {"KHR_lights_punctual": {"light": 0}}})
    told["scenes"][0]["nodes"].append(len(told["nodes"]) - 1)


def lit_street(data):
    """The demo's street, a glTF file, with one directional light and nothing that glows.

    Its leaves lose the normals of the round thing that they are a part of: Cycles draws what looks away from
    the eye by them black. Both renderers take those of the triangles then.
    """
    size = struct.unpack_from("<I", data, 12)[0]
    told = document(data)
    for material in told["materials"]:
        material.pop("emissiveFactor", None)
        material.pop("emissiveTexture", None)
    leaves = [i for i, m in enumerate(told["materials"]) if m["name"] in ("plants", "grass ground")]
    for primitive in [p for m in told["meshes"] for p in m["primitives"] if p.get("material") in leaves]:
        for attribute in ("NORMAL", "TANGENT"):
            primitive["attributes"].pop(attribute, None)
    for node in told["nodes"]:
        if "KHR_lights_punctual" in node.get("extensions", {}):
            del node["extensions"]
    add_sun(told, STREET)
    text = json.dumps(told).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size:]
    return struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON") + text + rest


def write_street(glb_of_demo, folder, samples=64):
    """The same for the demo's street, all that the renderer has on."""
    folder = pathlib.Path(folder)
    (folder / "street.glb").write_bytes(lit_street(glb_of_demo))
    return write_loaded("street", "street.glb", folder, samples)


def write_helmet(model, folder, samples=64):
    """Khronos' FlightHelmet without its panes (materials that blend), with a sun and a camera."""
    folder = pathlib.Path(folder)
    told = json.loads(pathlib.Path(model).read_text())
    panes = [i for i, m in enumerate(told["materials"]) if m.get("alphaMode") == "BLEND"]
    bare = [i for i, m in enumerate(told["meshes"]) if all(p.get("material") in panes for p in m["primitives"])]
    for node in told["nodes"]:
        if node.get("mesh") in bare:
            del node["mesh"]
    for of_file in told["images"] + told["buffers"]:
        shutil.copyfile(pathlib.Path(model).parent / of_file["uri"], folder / of_file["uri"])
    add_sun(told, HELMET)
    told["cameras"] = [{"type": "perspective", "perspective": {"yfov": HELMET["fov"], "znear": 0.05, "aspectRatio": SIZE[0] / SIZE[1]}}]
    told["nodes"].append({"name": "main", "matrix": matrix(looking(HELMET["eye"], HELMET["at"])), "camera": 0})
    told["scenes"][0]["nodes"].append(len(told["nodes"]) - 1)
    (folder / "helmet.gltf").write_text(json.dumps(told))
    return write_loaded("helmet", "helmet.gltf", folder, samples)


def write_loaded(name, file, folder, samples):
    (folder / "even.hdr").write_bytes(even_sky())
    lines = ["[scene]", f'file = "{file}"', "[sun]", 'source = "scene"', "[sky]", 'environment = "even.hdr"', f"environment_scale = {LOADED[name]['sky']}", "[fog]",
             'mode = "off"', "[weather]", 'keys = [{ time_s = 0.0, temperature_c = 15.0, rainfall = 0.0 }]', "duration_s = 1.0", "[lights]", 'lamps = "off"',
             "[output]", f"width = {SIZE[0]}", f"height = {SIZE[1]}", f"samples = {samples}", "frames = 1", "film = false",
             '[materials."*"]', "diffuse_transmission_factor = 0.0", "occlusion_strength = 0.0"]
    if name == "helmet":
        lines += ["[render]", "adaptive = 0.0"]  # it is measured pixel by pixel: all have all samples
    path = folder / f"{name}.toml"
    path.write_text("\n".join(lines) + "\n")
    return path


def write(name, folder, samples=64):
    """Writes the glTF file, its sky and the scenario; gives the scenario's path."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = SCENES[name]()
    (folder / f"{name}.glb").write_bytes(glb(scene))
    (folder / "even.hdr").write_bytes(even_sky())
    path = folder / f"{name}.toml"
    path.write_text(scenario(name, scene, samples))
    return path
