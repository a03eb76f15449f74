"""The forest of docs/pictures/terrain.py: where trees stand, as which of the meshes of conifers.py, and what the ground below them is."""
import math

from conifers import bough_picture, far_tree, tree, tree_picture
from eroded import fractal, smooth


def forest(land_, lake, eye, draw, count):
    """Places of trees in groves with clearings, none closer than their boughs reach: x, height of the land, z, height, species."""
    places, cells = [], {}
    while len(places) < count:
        x, z = draw.uniform(-1000, 1000), draw.uniform(-800, 1150)
        h, away = land_.height(x, z), math.hypot(x - eye[0], z - eye[1])
        if h < 2.0 or away < 34: continue
        steep = land_.slope(x, z)
        grove = fractal(x / 190, z / 190, 41, 4) + 0.12 * smooth(0.05, 0.3, steep) - 0.05
        clump = fractal(x / 26, z / 26, 43, 2)
        stands = smooth(0.47, 0.58, grove) * smooth(0.36, 0.56, clump + 0.25 * smooth(0.52, 0.66, grove))
        stands *= smooth(1.05, 0.75, steep) * smooth(240, 140, h + 70 * (fractal(x / 60, z / 60, 45, 3) - 0.5))
        stands *= smooth(0.03, 0.12, lake(x, z))
        if draw.random() > max(stands, 0.010 * (h < 230) * smooth(0.36, 0.5, clump)): continue
        # Smaller where it is cold and at the rims of groves, where the young ones stand.
        young = draw.random() < 0.22 + 0.4 * smooth(0.6, 0.1, stands)
        high = (draw.uniform(2.5, 8) if young else draw.uniform(11, 24)) * (1 - 0.55 * smooth(80, 240, h))
        room, key = 0.13 * high, (math.floor(x / 8), math.floor(z / 8))
        near = [p for i in (-1, 0, 1) for j in (-1, 0, 1) for p in cells.get((key[0] + i, key[1] + j), [])]
        if any(math.hypot(x - p[0], z - p[2]) < room + 0.10 * p[3] for p in near): continue
        # Larches, yellow in autumn, high up and in groves of their own.
        larch = draw.random() < smooth(0.52, 0.60, fractal(x / 85, z / 85, 48, 3) + 0.0009 * h - 0.02)
        kind = 3 if larch else 1 if young else draw.choice((0, 0, 1, 2))
        cells.setdefault(key, []).append((x, h - 0.02 * high, z, high, kind))
        places.append(cells[key][-1])
    return places


# Trees nearer than this have all their boughs, those nearer than that fewer; beyond they are outlines.
NEAR_M, MIDDLE_M = 190.0, 420.0
# Whorls, boughs of each, reach of the lowest, height where they begin, how far the wings of a bough reach.
SPECIES = [(36, 7, 0.150, 0.06, 0.40), (28, 7, 0.200, 0.03, 0.42), (38, 6, 0.118, 0.14, 0.42), (30, 6, 0.165, 0.10, 0.30)]


def golden(rows):
    """Needles of a larch in autumn."""
    return [[[2.9 * c[0], 1.5 * c[1], 0.6 * c[2], c[3]] for c in row] for row in rows]


def shaded_ground(places, side_m, texels):
    """0..1: how far trees stand over the ground, on a square of so many texels, row by row."""
    left, step = [1.0] * (texels * texels), side_m / texels
    for x, _, z, high, _ in places:
        reach = 0.30 * high + 0.5 * step
        u, v = (x + side_m / 2) / step - 0.5, (z + side_m / 2) / step - 0.5
        wide = reach / step
        for j in range(max(0, math.ceil(v - wide)), min(texels - 1, math.floor(v + wide)) + 1):
            for i in range(max(0, math.ceil(u - wide)), min(texels - 1, math.floor(u + wide)) + 1):
                left[j * texels + i] *= 1 - 0.8 * max(0.0, 1 - math.hypot(i - u, j - v) / wide)
    return [1 - share for share in left]


def woods(places, eye, needles, larch, bark, far, save):
    """Meshes of the forest and where they stand: by species and by how far from the eye. save: writes a picture by its name."""
    rows = bough_picture(3)
    save("terrain_bough.png", rows)
    save("terrain_larch.png", golden(rows))
    spread, pictures = [], None
    for kind, (whorls, boughs, girth, low, wide) in enumerate(SPECIES):
        foliage = larch if kind == 3 else needles
        crown, trunk = tree(kind + 1, whorls, boughs, 2, girth, low, wide)
        fewer, stem = tree(kind + 11, whorls // 2, boughs - 1, 1, girth, low, 1.5 * wide)
        picture = tree_picture(crown, trunk, rows)
        if kind == 3: picture = golden(picture)
        pictures = picture if pictures is None else [a + b for a, b in zip(pictures, picture)]
        levels = [[crown.part(foliage), trunk.part(bark)], [fewer.part(foliage), stem.part(bark)],
                  [far_tree(kind + 21, kind, len(SPECIES), girth, low, wide).part(far)]]
        for level, parts in enumerate(levels):
            here = [p[:4] for p in places if p[4] == kind and level ==
                    sum(math.hypot(p[0] - eye[0], p[2] - eye[1]) > edge for edge in (NEAR_M, MIDDLE_M))]
            if here: spread.append((parts, here))
    save("terrain_trees.png", pictures)
    return spread
