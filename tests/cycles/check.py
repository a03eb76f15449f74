"""Compares Petrichor with Cycles on the scenes of scenes.py:

    check.py PETRICHOR [NAME ...] [--keep FOLDER] [--samples N]   fails where a limit is passed
    check.py PETRICHOR [NAME ...] --accept [SAMPLES]              renders the references anew (needs blender)

References (NAME.exr, half float) lie beside this file. Relative errors are of the sum of red, green and
blue where the reference has light; FLIP is of both pictures as a display would show them.
"""
import argparse
import hashlib
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

import layers
import scenes

HERE = pathlib.Path(__file__).resolve().parent
# Of the street that the reference shows: its textures and shapes change as the demo does.
SHOWN = HERE / "street.sha256"
HELMET = pathlib.Path(os.environ.get("PETRICHOR_ASSETS", "")) / "models/FlightHelmet/FlightHelmet.gltf"


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def as_floats(petrichor, picture, folder):
    """A picture as a DDS file: what is before its numbers, and those: four a pixel, row after row."""
    dds = folder / (picture.stem + "_pixels.dds")
    run(petrichor, "texture", "convert", picture, "-o", dds, "--format", "rgba32f")
    data = dds.read_bytes()
    height, width = struct.unpack_from("<2I", data, 12)
    if (width, height) != scenes.SIZE:
        sys.exit(f"{picture}: {width} x {height}, wanted {scenes.SIZE}")
    many = 4 * width * height
    return data[:-4 * many], struct.unpack(f"<{many}f", data[-4 * many:])


def pixels(petrichor, picture, folder):
    """Red, green and blue of a picture, row after row."""
    _, values = as_floats(petrichor, picture, folder)
    return [values[i:i + 3] for i in range(0, len(values), 4)]


def add(petrichor, pictures, out, folder):
    """Their sum, a DDS file."""
    read = [as_floats(petrichor, picture, folder) for picture in pictures]
    out.write_bytes(read[0][0] + b"".join(struct.pack("<f", sum(all_of)) for all_of in zip(*(values for _, values in read))))


def png(path, linear, scale):
    width, height = scenes.SIZE

    def code(x):
        x = min(max(x * scale, 0.0), 1.0)
        return int(255.0 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1.0 / 2.4) - 0.055) + 0.5)

    rows = b"".join(b"\0" + bytes(code(x) for p in linear[y * width:(y + 1) * width] for x in p) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def compare(petrichor, name, folder, samples):
    """Median relative error, share of light, FLIP, and errors by layer."""
    out = folder / name
    scenario = loaded(petrichor, name, folder) if name in scenes.LOADED else scenes.write(name, folder, samples)
    if name == "street" and SHOWN.read_text().strip() != of_street(folder):
        print("street: the reference shows another street than the demo's of today; --accept 512 renders it anew", flush=True)
    run(petrichor, "render", scenario, "-o", out, "--frames", "0")
    ours = pixels(petrichor, out / "frame_0000.exr", folder)
    theirs = pixels(petrichor, HERE / f"{name}.exr", folder)
    sums = [(sum(a), sum(b)) for a, b in zip(ours, theirs)]
    bright = sorted(b for _, b in sums)[int(0.98 * len(sums))]
    sky = 3.0 * scenes.HELMET["sky"] if name == "helmet" else None  # is half of that picture
    lit = [(a, b) for a, b in sums if b > 1.0e-3 * bright and (sky is None or abs(b - sky) > 1.0e-3 * sky)]
    errors = sorted(abs(a - b) / b for a, b in lit)
    apart = by_layer(name, sums, 1.0e-3 * bright)
    scale = 2.4 / bright
    png(folder / f"{name}_ours.png", ours, scale)
    png(folder / f"{name}_cycles.png", theirs, scale)
    flip = json.loads(run(petrichor, "texture", "compare", folder / f"{name}_cycles.png", folder / f"{name}_ours.png", "-o", folder / f"{name}_flip.png", "--json"))["flip"]["mean"]
    return errors[len(errors) // 2], errors[int(0.9 * len(errors))], sum(a for a, _ in lit) / sum(b for _, b in lit), flip, apart


def by_layer(name, sums, dark):
    """Of pictures of a layer in each field: its name, median relative error, light, and what the median may be."""
    width, height = scenes.SIZE
    across, down = width // layers.COLUMNS, height // layers.ROWS
    found = []
    for number, called in enumerate(layers.NAMES.get(name, [])):
        left, top = number % layers.COLUMNS * across, number // layers.COLUMNS * down
        # Where the thing itself is: stripes lie around panes.
        near = 12 if "glass" in called or "body" in called or called == "dispersion" else across
        lit = [(a, b) for y in range(top, top + down) for a, b in sums[y * width + left:y * width + left + across][max(across // 2 - near, 0):across // 2 + near]
               if b > dark and abs(y - top - down // 2) < near]
        errors = sorted(abs(a - b) / b for a, b in lit)
        found.append((called, errors[len(errors) // 2], sum(a for a, _ in lit) / sum(b for _, b in lit), layers.LIMITS.get(called, scenes.LIMITS[name][0])))
    return found


def of_street(folder):
    return hashlib.sha256((folder / "street.glb").read_bytes()).hexdigest()


def loaded(petrichor, name, folder):
    if name == "helmet":
        return scenes.write_helmet(HELMET, folder)
    run(petrichor, "scene", "demo:street", "--glb", folder / "demo.glb")
    return scenes.write_street((folder / "demo.glb").read_bytes(), folder)


def accept(petrichor, name, folder, samples):
    full = folder / f"{name}_full.exr"
    if name in scenes.LOADED:
        loaded(petrichor, name, folder)
    def cycles(out, samples, *more):
        run("blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "--python", HERE / "render_cycles.py", "--", name, out, samples, *more)

    if name == "helmet":  # sun and sky apart, since the Fresnel of its facets is told for either; the sun has less noise
        parts = [folder / f"{name}_{light}.exr" for light in ("sun", "sky")]
        for part, light, many in zip(parts, ("sun", "sky"), (max(int(samples) // 4, 1), samples)):
            cycles(part, many, folder / "helmet.gltf", light)
        full = full.with_suffix(".dds")
        add(petrichor, parts, full, folder)
    else:
        cycles(full, samples, *{"street": [folder / "street.glb"]}.get(name, []))
    run(petrichor, "texture", "convert", full, "-o", HERE / f"{name}.exr", "--bits", "16")
    if name == "street":
        SHOWN.write_text(of_street(folder) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("petrichor")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--keep")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--accept", type=int, nargs="?", const=1024)
    asked = parser.parse_args()
    if subprocess.run([asked.petrichor, "doctor", "--json"], capture_output=True).returncode != 0 and os.environ.get("PETRICHOR_REQUIRE_GPU") != "1":
        print("skipped: no device that renders")
        return 77
    folder = pathlib.Path(asked.keep or tempfile.mkdtemp(prefix="petrichor-cycles-"))
    folder.mkdir(parents=True, exist_ok=True)
    failed = False
    try:
        for name in asked.names or scenes.LIMITS:
            if name == "helmet" and not HELMET.is_file():
                print("helmet: left out, since PETRICHOR_ASSETS/models/FlightHelmet is not there", flush=True)
                continue
            if asked.accept:
                accept(asked.petrichor, name, folder, asked.accept)
            middle, high, light, flip, apart = compare(asked.petrichor, name, folder, asked.samples)
            most, most_flip = scenes.LIMITS[name]
            bad = not ((most is None or middle <= most) and flip <= most_flip)
            failed = failed or bad or any(error > at_most for _, error, _, at_most in apart)
            for called, error, shares, at_most in apart:
                print(f"  {called:24} error median {100 * error:6.2f} % (at most {100 * at_most:g}), light {shares:.3f}{'  FAILED' if error > at_most else ''}", flush=True)
            print(f"{name:16} error median {100 * middle:6.2f} %{'' if most is None else f' (at most {100 * most:g})'}, 90 of 100 below {100 * high:6.2f} %, "
                  f"light {light:.3f}, FLIP {flip:.4f} (at most {most_flip:g}){'  FAILED' if bad else ''}", flush=True)
    finally:
        if not asked.keep:
            shutil.rmtree(folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
