"""A frame of a GLB by Blender, timed, for `petrichor bench --compare`:

    blender -b --factory-startup -noaudio --python blender.py -- ENGINE SCENE.glb WIDTH HEIGHT REPEAT OUT.png REPORT.json

ENGINE is CYCLES or BLENDER_EEVEE: one sample, no bounces, shadows, adaptive sampling, denoising or tone mapping. The
picture is that of one more frame, which is not timed and has 64 samples where one is only noise (CYCLES).
"""
import json
import os
import sys
import time

import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer asks for it by a name that new versions lack

engine, glb, width, height, repeat, picture, report = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb)
scene = bpy.context.scene
for light in bpy.data.lights:
    light.energy *= 683.0  # the importer divides by it: light is of watts here
    light.use_shadow = False
    if hasattr(light, "cycles"):
        light.cycles.cast_shadow = False
    if light.type != "SUN":
        light.shadow_soft_size = 0.0
    else:
        light.angle = 0.0
if not scene.camera:
    scene.camera = next(thing for thing in bpy.data.objects if thing.type == "CAMERA")
scene.world = bpy.data.worlds.new("black")
scene.world.color = (0.0, 0.0, 0.0)
render = scene.render
render.engine = engine
render.resolution_x, render.resolution_y, render.resolution_percentage = int(width), int(height), 100
render.film_transparent = False
scene.view_settings.view_transform = "Standard"
scene.cycles.device, scene.cycles.seed = "CPU", 1
scene.cycles.max_bounces = 0
scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
scene.eevee.taa_render_samples = 1
scene.eevee.use_gtao = scene.eevee.use_ssr = scene.eevee.use_bloom = False
render.image_settings.file_format = "PNG"
render.use_persistent_data = True
render.filepath = picture

cpu, wall = [], []
scene.cycles.samples = 1
for turn in range(int(repeat) + 1):  # the first compiles and uploads
    before, clock = os.times(), time.monotonic()
    bpy.ops.render.render()
    after = os.times()
    if turn:
        cpu.append(1e3 * (after.user + after.system - before.user - before.system))
        wall.append(1e3 * (time.monotonic() - clock))
scene.cycles.samples = 64
render.use_persistent_data = False
bpy.ops.render.render(write_still=True)
with open(report, "w") as out:
    json.dump({"version": bpy.app.version_string, "cpu_ms": cpu, "wall_ms": wall}, out)
