"""Renders a scene of scenes.py with Cycles, inside Blender:

    blender -b --factory-startup -noaudio --python render_cycles.py -- NAME OUT.exr [SAMPLES [FILE [LIGHT]]]

FILE: the glTF file of the street or of the helmet; LIGHT: sun or sky, alone.
"""
import json
import math
import pathlib
import sys

import bpy
import mathutils

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import layers  # noqa: E402
import scenes  # noqa: E402

name, out, *rest = sys.argv[sys.argv.index("--") + 1:]
light = rest[2] if len(rest) > 2 else None
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def placed(thing, axes):
    x, y, z, p = axes
    thing.matrix_world = mathutils.Matrix([[x[i], y[i], z[i], p[i]] for i in range(3)] + [[0, 0, 0, 1]])


def material(called):
    made = bpy.data.materials.new(called)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    if called in scenes.MATT:
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (*scenes.MATT[called], 1.0)
        shader.inputs["Roughness"].default_value = 0.0
    else:
        shader = tree.nodes.new("ShaderNodeBsdfGlossy")
        shader.distribution = "MULTI_GGX"
        shader.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        shader.inputs["Roughness"].default_value = scenes.METAL[called]
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return made


def of_lobes(called, lobes, data, lamps):
    """A sum of lobes, each times its colour at every corner (layers.py), and those colours; `lamps`: what lights it has no size."""
    made = bpy.data.materials.new(called)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    total = None
    corners = [layers.Seen(p, n) for p, n in zip(*data)]
    colors = []

    def give(values, socket):
        """Numbers of every corner to a node."""
        told = tree.nodes.new("ShaderNodeAttribute")
        told.attribute_name = f"lobe{len(colors)}"
        colors.append(values)
        tree.links.new(told.outputs["Color"], socket)

    def and_also(shader):
        nonlocal total
        if total:
            both = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(total.outputs[0], both.inputs[0])
            tree.links.new(shader.outputs[0], both.inputs[1])
            shader = both
        total = shader

    for (kind, *how), color, left in lobes:
        if kind == "absorb":
            shader = tree.nodes.new("ShaderNodeVolumeAbsorption")
            shader.inputs["Density"].default_value, shader.inputs["Color"].default_value = how[0], (*how[1], 1.0)
            tree.links.new(shader.outputs[0], output.inputs["Volume"])
            continue
        shares, above = [color(g) for g in corners], [left(g) for g in corners]
        if kind == "ggx" and how[0] > 0.0 and lamps:
            many, roots, parts = layers.walks(how[1], shares, above)
            alike = all(max(row) - min(row) < 1.0e-6 for row in shares)
            for channel in [None] if alike else range(3):
                shown = range(3) if alike else [channel]
                root = [tuple(row[c] if c in shown else 0.0 for c in range(3)) for row in roots]
                part = [(row[shown[0]],) * 3 for row in parts]
                for _ in range(many):
                    shader, mixed = facets(tree, how[0], *how[2:]), tree.nodes.new("ShaderNodeMixShader")
                    give(root, shader.inputs["Color"])
                    give(part, mixed.inputs["Fac"])
                    tree.links.new(shader.outputs[0], mixed.inputs[2])
                    and_also(mixed)
            continue
        if kind == "ggx":
            shader = facets(tree, how[0], *how[2:])
        elif kind == "bent":
            shader = tree.nodes.new("ShaderNodeBsdfRefraction")
            shader.distribution = "GGX"
            shader.inputs["IOR"].default_value, shader.inputs["Roughness"].default_value = how
        else:
            shader = tree.nodes.new({"clear": "ShaderNodeBsdfTransparent", "diffuse": "ShaderNodeBsdfDiffuse", "through": "ShaderNodeBsdfTranslucent", "glow": "ShaderNodeEmission"}[kind])
        give([layers.times(c, a) for c, a in zip(shares, above)], shader.inputs["Color"])
        and_also(shader)
    tree.links.new(total.outputs[0], output.inputs["Surface"])
    return made, colors


def facets(tree, roughness, *stretch):
    if stretch:
        return stretched(tree, roughness, *stretch)
    shader = tree.nodes.new("ShaderNodeBsdfGlossy")
    shader.distribution = "MULTI_GGX"
    shader.inputs["Roughness"].default_value = roughness
    return shader


def stretched(tree, roughness, strength, turn):
    """KHR_materials_anisotropy in the words of Blender, whose two widths have the same product for any anisotropy."""
    across = roughness * roughness
    along = across + (1.0 - across) * strength * strength
    shader = tree.nodes.new("ShaderNodeBsdfAnisotropic")
    shader.distribution = "MULTI_GGX"
    shader.inputs["Roughness"].default_value = (along * across) ** 0.25
    shader.inputs["Anisotropy"].default_value = (across / along) ** 0.5 - 1.0
    shader.inputs["Rotation"].default_value = turn / (2.0 * math.pi)
    tangent = tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type, tangent.axis = "RADIAL", "Y"
    tree.links.new(tangent.outputs[0], shader.inputs["Tangent"])
    return shader


def build(told):
    materials = {}
    of_layers = {name: lobes for name, _, lobes in told.get("lobes", [])}
    for number, mesh in enumerate(told["meshes"]):
        data = bpy.data.meshes.new(f"mesh{number}")
        data.from_pydata(mesh.positions, [], mesh.triangles)
        data.use_auto_smooth = True
        data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
        data.normals_split_custom_set_from_vertices(mesh.normals)
        if mesh.material in of_layers:
            made, colors = of_lobes(mesh.material, of_layers[mesh.material], (mesh.positions, mesh.normals), told["sun"] is not None)
            for lobe, of_corners in enumerate(colors):
                kept = data.attributes.new(f"lobe{lobe}", "FLOAT_COLOR", "POINT")
                kept.data.foreach_set("color", [x for c in of_corners for x in (*c, 1.0)])
            data.materials.append(made)
        else:
            data.materials.append(materials.setdefault(mesh.material, None) or material(mesh.material))
            materials[mesh.material] = data.materials[0]
        thing = bpy.data.objects.new(data.name, data)
        scene.collection.objects.link(thing)
        if "alone" in told:  # lights nothing, hides nothing; stripes are seen through panes
            thing.visible_diffuse = thing.visible_glossy = thing.visible_shadow = False
    if told["sun"]:
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = told["sun"]["lux"], 0.0
        thing = bpy.data.objects.new("sun", sun)
        scene.collection.objects.link(thing)
        placed(thing, scenes.looking(told["sun"]["towards"], (0.0, 0.0, 0.0)))
    for position, candela in told["lamps"]:
        lamp = bpy.data.lights.new("lamp", "POINT")
        most = max(candela)
        lamp.energy, lamp.color, lamp.shadow_soft_size = 4.0 * math.pi * most, [c / most for c in candela], 0.0
        thing = bpy.data.objects.new("lamp", lamp)
        thing.location = position
        scene.collection.objects.link(thing)
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle_y, camera.clip_start = "VERTICAL", told["fov"], 0.05
    eye = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(eye)
    placed(eye, told["camera"])
    scene.camera = eye


def grazing():
    """What Schlick's law has beside the reflectance at normal incidence, in the mean over the lobe: of the cosine to the eye and the roughness."""
    import numpy
    size, many = 48, 4096
    table = numpy.zeros((size, size, 4), numpy.float32)
    turn = 2.0 * numpy.pi * numpy.modf(numpy.arange(many) * 0.6180339887)[0]
    part = (numpy.arange(many) + 0.5) / many
    for row in range(size):
        alpha = max((row + 0.5) / size, 0.03) ** 2
        nh = numpy.sqrt((1.0 - part) / (1.0 + (alpha * alpha - 1.0) * part))  # facets as many as there are of each slope
        side = numpy.sqrt(1.0 - nh * nh)
        for column in range(size):
            nv = (column + 0.5) / size
            vh = nh * nv + side * numpy.cos(turn) * numpy.sqrt(1.0 - nv * nv)
            nl = 2.0 * vh * nh - nv
            seen = (vh > 0.0) & (nl > 0.0)
            nl, vh, up = nl[seen], vh[seen], nh[seen]
            leans = [numpy.sqrt(alpha * alpha + (1.0 - alpha * alpha) * c * c) for c in (nv, nl)]
            weight = nl * vh / (up * (nv * leans[1] + nl * leans[0]))
            table[row, column] = (weight * (1.0 - vh) ** 5).sum() / weight.sum()
    image = bpy.data.images.new("grazing", size, size, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(table.ravel())
    image.pack()
    return image


def by_schlick(tree, metal, mirrored, light, links):
    """The film of a dielectric and metal with Schlick's Fresnel, as glTF has it; Principled has that of a dielectric, of which rough facets
    mirror a fifth more at 45 degrees. An even sky: in the mean over the lobe. The sun: as for the half vector between it and the camera."""
    film, whole = tree.nodes.new("ShaderNodeBsdfGlossy"), tree.nodes.new("ShaderNodeBsdfGlossy")
    film.distribution = whole.distribution = "MULTI_GGX"
    links("Normal", film.inputs["Normal"], whole.inputs["Normal"])
    links("Roughness", film.inputs["Roughness"], whole.inputs["Roughness"])
    if light == "sun":
        eye = [a - b for a, b in zip(scenes.HELMET["eye"], scenes.HELMET["at"])]
        half = layers.unit([a + b for a, b in zip(layers.unit(eye), scenes.HELMET["towards"])])
        edge = (1.0 - sum(a * b for a, b in zip(half, scenes.HELMET["towards"]))) ** 5
        shown = mirrored + (1.0 - mirrored) * edge
        # Cycles squares what goes on between facets (layers.walks()).
        _, roots, parts = layers.walks((mirrored + (1.0 - mirrored) / 21.0,), [(shown,)], [1.0])
        film.inputs["Color"].default_value = (*roots[0] * 3, 1.0)
        share = tree.nodes.new("ShaderNodeMixShader")
        share.inputs["Fac"].default_value = parts[0][0]
        tree.links.new(film.outputs[0], share.inputs[2])
        links("Base Color", whole.inputs["Color"])
        return share, whole
    # Of the cosine between what is mapped as normal and the eye.
    place, texture, geometry = tree.nodes.new("ShaderNodeCombineXYZ"), tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeNewGeometry")
    facing = tree.nodes.new("ShaderNodeVectorMath")
    facing.operation = "DOT_PRODUCT"
    tree.links.new(geometry.outputs["Incoming"], facing.inputs[0])
    tree.links.new(geometry.outputs["Normal"], facing.inputs[1])
    links("Normal", facing.inputs[1])
    tree.links.new(facing.outputs["Value"], place.inputs["X"])
    links("Roughness", place.inputs["Y"])
    texture.image, texture.extension = bpy.data.images.get("grazing") or grazing(), "EXTEND"
    tree.links.new(place.outputs[0], texture.inputs["Vector"])
    for lobe in (film, whole):
        mix = tree.nodes.new("ShaderNodeMixRGB")
        mix.inputs["Color1"].default_value = (mirrored, mirrored, mirrored, 1.0)
        mix.inputs["Color2"].default_value = (1.0, 1.0, 1.0, 1.0)
        if lobe is whole:
            links("Base Color", mix.inputs["Color1"])
        tree.links.new(texture.outputs["Color"], mix.inputs["Fac"])
        tree.links.new(mix.outputs[0], lobe.inputs["Color"])
    return film, whole


def as_gltf_says(material, told, facets, light):
    """glTF's own mix: Lambert under GGX, of which a share is mirrored and the rest scattered, and metal.

    Blender's importer makes one Principled shader, whose diffuse lobe is Burley's and has all of the base colour
    beside the highlight, so that more is sent back than comes in; of KHR_materials_specular it takes nothing over.
    light: "sun" or "sky", where that is all there is; then the Fresnel is glTF's, too.
    """
    tree = material.node_tree
    metal = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    mirrored = 0.04 * told.get("extensions", {}).get("KHR_materials_specular", {}).get("specularFactor", 1.0)
    output = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")

    def give(name, *sockets):
        """What the importer feeds a socket, to others too."""
        source = metal.inputs[name]
        for socket in sockets:
            if source.is_linked:
                tree.links.new(source.links[0].from_socket, socket)
            elif source.type != "VECTOR":
                socket.default_value = source.default_value[:len(socket.default_value)] if source.type == "RGBA" else source.default_value

    left = tree.nodes.new("ShaderNodeVectorMath")
    left.operation = "SCALE"
    left.inputs["Scale"].default_value = 1.0 - mirrored
    matt = tree.nodes.new("ShaderNodeBsdfDiffuse")
    if light:
        film, whole = by_schlick(tree, metal, mirrored, light, give)
    else:
        film, whole = tree.nodes.new("ShaderNodeBsdfPrincipled"), metal
        metal.distribution = film.distribution = facets
        film.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
        film.inputs["Specular"].default_value = mirrored / 0.08
    both = tree.nodes.new("ShaderNodeAddShader")
    mixed = tree.nodes.new("ShaderNodeMixShader")
    give("Base Color", left.inputs[0])
    give("Normal", matt.inputs["Normal"])
    if not light:
        give("Normal", film.inputs["Normal"])
        give("Roughness", film.inputs["Roughness"])
    give("Metallic", mixed.inputs["Fac"])
    for link in [k for k in tree.links if k.to_socket == metal.inputs["Metallic"]]:
        tree.links.remove(link)
    metal.inputs["Metallic"].default_value = 1.0
    for source, target in ((left.outputs[0], matt.inputs["Color"]), (matt.outputs[0], both.inputs[0]), (film.outputs[0], both.inputs[1]),
                           (both.outputs[0], mixed.inputs[1]), (whole.outputs[0], mixed.inputs[2]), (mixed.outputs[0], output.inputs["Surface"])):
        tree.links.new(source, target)


def load(path, by, light):
    """By Blender's own importer, whose z is up; of its lights none is kept."""
    import numpy
    numpy.bool = bool  # which it asks for by a name that is gone
    bpy.ops.import_scene.gltf(filepath=path)
    for thing in [o for o in bpy.data.objects if o.type == "LIGHT"]:
        bpy.data.objects.remove(thing)
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = by["lux"] if light != "sky" else 0.0, 0.0
    thing = bpy.data.objects.new("sun", sun)
    scene.collection.objects.link(thing)
    x, y, z = by["towards"]
    placed(thing, scenes.looking((x, -z, y), (0.0, 0.0, 0.0)))
    data = pathlib.Path(path).read_bytes()
    for told in (scenes.document(data) if path.endswith(".glb") else json.loads(data))["materials"]:
        if told["name"] in bpy.data.materials:
            as_gltf_says(bpy.data.materials[told["name"]], told, by["facets"], light)
    scene.camera = next(o for o in bpy.data.objects if o.type == "CAMERA" and o.name.startswith("main"))
    scene.camera.data.sensor_fit, scene.camera.data.angle_y = "VERTICAL", by["fov"]


if name in scenes.LOADED:
    sky, bounces = scenes.LOADED[name]["sky"], 8
    load(rest[1], scenes.LOADED[name], light)
    if light == "sun":
        sky = 0.0
else:
    told = scenes.SCENES[name]()
    sky, bounces = told["sky"], told["bounces"]
    build(told)
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = sky
if name == "layers_even":
    scene.world.cycles_visibility.camera = False
render, cycles = scene.render, scene.cycles
render.engine = "CYCLES"
render.resolution_x, render.resolution_y = scenes.SIZE
render.resolution_percentage = 100
render.film_transparent = False
cycles.device, cycles.seed = "CPU", 1
cycles.samples = int(rest[0]) if rest else 256
cycles.use_adaptive_sampling = cycles.use_denoising = False
cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
if name == "layers_even":  # through a pane and no farther
    cycles.max_bounces = cycles.transmission_bounces = 1
cycles.sample_clamp_indirect = 0.0
cycles.blur_glossy = 0.0
# What rough stone mirrors onto other surfaces is a tenth to a fifth of the light between them.
cycles.caustics_reflective, cycles.caustics_refractive = True, False
cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
scene.view_settings.view_transform = "Standard"
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
render.image_settings.exr_codec = "ZIP"
render.filepath = out
bpy.ops.render.render(write_still=True)
