"""How sharp the ground of the demo's street is beside Cycles, near and far:

    check.py PETRICHOR street --keep FOLDER
    contrast.py PETRICHOR FOLDER     (Debian: openimageio-tools)

Of level pixels within a hand's breadth of the road's height: how far a pixel is from the mean of the 5 x 5 around it that are such
pixels too, root of the mean square, as a share of that mean. Noise of the reference's paths is in it.
"""
import argparse
import math
import pathlib

import check
import scenes

RADIUS, LEVEL, HEIGHT_M = 2, 0.95, 0.1
RANGES_M = ((0.0, 6.0), (6.0, 12.0), (12.0, 40.0))


def contrast(linear, ground):
    """linear: sums of light; ground: set of pixels (x, y)."""
    width = scenes.SIZE[0]
    total, count = 0.0, 0
    for x, y in ground:
        near = [linear[v * width + u] for u in range(x - RADIUS, x + RADIUS + 1) for v in range(y - RADIUS, y + RADIUS + 1) if (u, v) in ground]
        if len(near) < 20:
            continue
        mean = sum(near) / len(near)
        total += (linear[y * width + x] / mean - 1.0) ** 2
        count += 1
    return math.sqrt(total / max(count, 1)), count


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("petrichor")
    parser.add_argument("folder", type=pathlib.Path)
    asked = parser.parse_args()
    places = asked.folder / "places"
    check.run(asked.petrichor, "render", asked.folder / "street.toml", "-o", places, "--frames", "0", "--samples", "1", "--aov", "depth,position,normal")
    packed = asked.folder / "places.exr"
    check.run("oiiotool", places / "frame_0000.exr", "--ch", "R=depth.Z,G=position.Y,B=normal.Y,A=normal.Y", "-o", packed)
    told = check.pixels(asked.petrichor, packed, asked.folder)
    ours = [sum(p) for p in check.pixels(asked.petrichor, asked.folder / "street/frame_0000.exr", asked.folder)]
    theirs = [sum(p) for p in check.pixels(asked.petrichor, check.HERE / "street.exr", asked.folder)]
    check.run("oiiotool", places / "frame_0000.exr", "--ch", "R,G,B,A", "-o", packed)
    once = [sum(p) for p in check.pixels(asked.petrichor, packed, asked.folder)]
    width = scenes.SIZE[0]
    level = [(i % width, i // width, d, h) for i, (d, h, up) in enumerate(told) if up > LEVEL and d < 1.0e4]
    road = sorted(h for _, _, _, h in level)[len(level) // 2]
    for low, high in RANGES_M:
        ground = {(x, y) for x, y, d, h in level if low <= d < high and abs(h - road) < HEIGHT_M}
        (own, count), (single, _), (cycles, _) = contrast(ours, ground), contrast(once, ground), contrast(theirs, ground)
        print(f"{low:g} to {high:g} m: {count} pixels, contrast {own:.3f}, of one sample {single:.3f}, Cycles {cycles:.3f}")


if __name__ == "__main__":
    main()
