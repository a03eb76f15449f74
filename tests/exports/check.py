#!/usr/bin/env python3
"""Opens what common tools export, and holds the picture of each file against that of the file they read:

    check.py PETRICHOR SCENE.gltf [NAME ...] [--tools FOLDER] [--keep FOLDER] [--size 384x216]

SCENE is a glTF with textures (FlightHelmet is the one whose numbers docs/gltf.md has). FOLDER holds node_modules with
@gltf-transform/cli, gltfpack, gltf-pipeline, obj2gltf and fbx2gltf; Blender and assimp are taken from the path. What is
not there is named and left out. Fails where a picture has less than the PSNR that its row asks for: how far apart files
are that say the same is not a matter of taste, of those that go through OBJ or FBX the materials are the tool's.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

SAME, ROUNDED, PACKED, OWN = 60.0, 45.0, 40.0, 0.0  # dB
BLENDER = """
import numpy
for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in numpy.__dict__: setattr(numpy, name, kind)  # what Blender 3.4 asks of an older numpy
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=SCENE)
bpy.ops.export_scene.gltf(filepath=OUT + "/blender.glb", export_format="GLB")
bpy.ops.export_scene.gltf(filepath=OUT + "/blender_separate/scene.gltf", export_format="GLTF_SEPARATE")
bpy.ops.export_scene.gltf(filepath=OUT + "/blender_embedded.gltf", export_format="GLTF_EMBEDDED")
bpy.ops.export_scene.gltf(filepath=OUT + "/blender_jpeg.glb", export_format="GLB", export_image_format="JPEG",
                          export_tangents=True)
bpy.ops.export_scene.obj(filepath=OUT + "/scene.obj", path_mode="COPY")
bpy.ops.export_scene.fbx(filepath=OUT + "/scene.fbx", path_mode="COPY", embed_textures=True)
"""


def rows(scene, out, tools):
    """(name, command or None for what Blender wrote, file, dB)"""
    binaries = tools / "node_modules/.bin"
    transform, pack = binaries / "gltf-transform", binaries / "gltfpack"
    for operation, least in (("copy", SAME), ("dedup", SAME), ("join", SAME), ("partition", SAME), ("sparse", SAME),
                             ("weld", SAME), ("prune", SAME), ("tangents", ROUNDED), ("quantize", PACKED),
                             ("draco", PACKED), ("meshopt", PACKED), ("webp", PACKED), ("optimize", PACKED)):
        file = out / f"transform_{operation}.glb"
        yield f"glTF-Transform {operation}", [transform, operation, scene, file], file, least
    for name, options, least in (("", [], PACKED), (" -cc", ["-cc"], PACKED), (" -noq", ["-noq"], ROUNDED),
                                 (" -kn -km -ke", ["-kn", "-km", "-ke"], PACKED)):
        file = out / f"gltfpack{name.replace(' ', '')}.glb"
        yield f"gltfpack{name}", [pack, "-i", scene, "-o", file, *options], file, least
    file = out / "pipeline_draco.glb"
    yield "gltf-pipeline -d", [binaries / "gltf-pipeline", "-i", scene, "-o", file, "-d"], file, PACKED
    for name, least in (("blender.glb", ROUNDED), ("blender_separate/scene.gltf", ROUNDED),
                        ("blender_embedded.gltf", ROUNDED), ("blender_jpeg.glb", PACKED)):
        yield f"Blender {name}", None, out / name, least
    file = out / "obj2gltf.glb"
    yield "Blender OBJ, obj2gltf", [binaries / "obj2gltf", "-i", out / "scene.obj", "-o", file], file, OWN
    file = out / "fbx2gltf.glb"
    fbx = tools / "node_modules/fbx2gltf/bin/Linux/FBX2glTF"
    yield "Blender FBX, FBX2glTF", [fbx, "-b", "--pbr-metallic-roughness", "-i", out / "scene.fbx", "-o", file], file, OWN
    for kind in ("obj", "fbx"):
        file = out / f"assimp_{kind}.glb"
        yield f"Blender {kind.upper()}, assimp", ["assimp", "export", out / f"scene.{kind}", file, "-fglb2"], file, OWN


def quiet(command):
    try:
        return subprocess.run([str(c) for c in command], capture_output=True, text=True)
    except OSError:
        return None


def picture(petrichor, scene, folder, size):
    done = quiet([petrichor, "render", scene, "--count", "1", "--size", size, "--samples", "4", "--no-exr", "--no-film",
                  "-o", folder])
    if done is None or done.returncode != 0:
        return None, (done.stderr.strip().splitlines() or ["?"])[0] if done else "does not start"
    said = [line for line in done.stderr.splitlines() if line.startswith("warn")]
    return next(folder.glob("frame_*.png")), "; ".join(said)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("petrichor")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--tools", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--size", default="384x216")
    asked = parser.parse_args()
    out = asked.keep or pathlib.Path(tempfile.mkdtemp())
    (out / "blender_separate").mkdir(parents=True, exist_ok=True)
    scene = asked.scene.resolve()
    if shutil.which("blender"):  # Debian's needs the python of the system first in the path
        script = out / "export.py"
        script.write_text(f"SCENE, OUT = {str(scene)!r}, {str(out.resolve())!r}\n" + BLENDER)
        quiet(["blender", "-b", "--factory-startup", "-P", script])
    reference, trouble = picture(asked.petrichor, scene, out / "pictures/reference", asked.size)
    if reference is None:
        sys.exit(f"{scene}: {trouble}")
    failed, opened = [], 0
    print(f"{'exported by':34} {'PSNR dB':>8} {'FLIP':>7}  said")
    for name, command, file, least in rows(scene, out.resolve(), asked.tools.resolve()):
        if asked.names and not any(n.lower() in name.lower() for n in asked.names):
            continue
        if command is not None and (quiet(command) is None or not file.exists()) or not file.exists():
            print(f"{name:34} not made: its tool is not installed, or failed")
            continue
        shown, said = picture(asked.petrichor, file, out / "pictures" / file.stem, asked.size)
        if shown is None:
            failed.append(name)
            print(f"{name:34} NOT OPENED: {said}")
            continue
        opened += 1
        told = json.loads(quiet([asked.petrichor, "texture", "compare", reference, shown, "--json"]).stdout)
        psnr = told["psnr_db"] if told["psnr_db"] is not None else float("inf")
        short = psnr < least
        failed += [name] * short
        print(f"{name:34} {psnr:8.1f} {told['flip']['mean']:7.4f}  {said}{' BELOW ' + str(least) if short else ''}", flush=True)
    print(f"{opened} opened, {len(failed)} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
