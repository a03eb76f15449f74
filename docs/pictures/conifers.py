"""Spruces and larches a metre high for docs/pictures/forest.py: whorls of boughs that are cards with holes, a trunk, and for
trees far away outlines of three sides with the picture of such a tree.
"""
import math
import random

BOUGH = 256            # texels a side of the picture of half a bough
FAR_WIDE, FAR_HIGH = 128, 256
REACH = 0.25           # half the width, in heights of the tree, of the picture of a tree


# ---- half a bough seen from above --------------------------------------------------------------


def stroke(canvas, size, a, b, wide, color):
    """A tapered line; the first to come to a texel keeps it."""
    steps = max(2, int(1.5 * math.hypot(b[0] - a[0], b[1] - a[1])))
    for k in range(steps + 1):
        t = k / steps
        x, y, half = a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), max(0.5, 0.5 * wide * (1 - 0.8 * t))
        for j in range(math.floor(y - half), math.ceil(y + half)):
            for i in range(math.floor(x - half), math.ceil(x + half)):
                if 0 <= i < size and 0 <= j < size: canvas.setdefault((i, j), color)


def bough_picture(seed):
    """Rows of linear colour and alpha: u from the trunk to the tip, v from the spine to the side. Twigs point to the tip."""
    draw, size, canvas = random.Random(seed), 2 * BOUGH, {}
    stroke(canvas, size, (0, 2), (0.93 * size, 1), 10, (0.050, 0.034, 0.022))
    twigs = 34
    for k in range(twigs):
        u = 0.03 + 0.93 * (k + draw.uniform(-0.3, 0.3)) / twigs
        # Longest at a third of the bough.
        long = size * 1.22 * min(1.0, 0.62 + 1.6 * u) * (1 - u) ** 0.55 * draw.uniform(0.6, 1.0)
        turn = math.radians(draw.uniform(54, 76) - 28 * u)
        along = (math.cos(turn), math.sin(turn))
        long = max(8.0, min(long, size * (0.95 - u) / (along[0] + 0.16)))
        light = draw.uniform(0.7, 1.3)
        needles = max(6, int(long / 3.0))
        for n in range(needles):
            way = (n + draw.random()) / needles
            bend = 0.10 * long * way * way
            x, y = u * size + along[0] * long * way + bend, along[1] * long * way
            # Last year's inwards, the young ones at the tips.
            young = way ** 1.5
            shade = light * (0.42 + 0.78 * young) * draw.uniform(0.7, 1.3) * (0.5 + 0.5 * min(1.0, 2.5 * u + 0.9 * way))
            color = tuple(shade * (o * (1 - young) + y_ * young) for o, y_ in
                          zip((0.030, 0.044, 0.018), (0.062, 0.084, 0.030)))
            for side in (-1, 1):
                lean = turn + side * math.radians(draw.uniform(28, 60))
                reach = draw.uniform(10, 19) * (1.15 - 0.45 * way)
                stroke(canvas, size, (x, y), (x + reach * math.cos(lean), y + reach * math.sin(lean)), 2.6, color)
        stroke(canvas, size, (u * size, 0), (u * size + along[0] * long, along[1] * long), 4, (0.045, 0.036, 0.020))
    return halved(canvas, BOUGH, BOUGH)


def halved(canvas, width, height):
    """Half as many texels a side, with alpha; what is empty has the mean colour, so that edges keep theirs."""
    mean = [sum(c[k] for c in canvas.values()) / len(canvas) for k in range(3)]
    rows = []
    for j in range(height):
        row = []
        for i in range(width):
            here = [canvas[p] for p in ((2 * i, 2 * j), (2 * i + 1, 2 * j), (2 * i, 2 * j + 1), (2 * i + 1, 2 * j + 1))
                    if p in canvas]
            row.append([*(sum(c[k] for c in here) / len(here) for k in range(3)), len(here) / 4] if here else [*mean, 0.0])
        rows.append(row)
    return rows


# ---- trees -------------------------------------------------------------------------------------


class Mesh:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def card(self, corners, uvs, normals):
        """Four corners, either way round: of two-sided triangles the back would look away from the light."""
        first = len(self.positions) // 3
        for p, t, n in zip(corners, uvs, normals):
            size = math.sqrt(sum(c * c for c in n))
            self.positions += p
            self.normals += [c / size for c in n]
            self.uvs += t
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            self.indices += [first + a, first + b, first + c, first + a, first + c, first + b]

    def part(self, material):
        return self.positions, self.normals, self.uvs, self.indices, material


def bough(mesh, at, turn, reach, rise, hang, pieces, wide):
    """Two wings that hang from a spine, which bends down and at its tip up again."""
    out, side = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
    spine = []
    for k in range(pieces + 1):
        t = k / pieces
        spine.append((t, reach * t, at + reach * (rise * t - 0.6 * t * (1 - t))))
    for wing in (-1, 1):
        aside, fall = wing * wide * reach * math.cos(hang), -wide * reach * math.sin(hang)
        place = lambda r, y, s: [r * out[0] + s * aside * side[0], y + s * fall, r * out[1] + s * aside * side[1]]
        # As of a round crown, and from above.
        look = lambda s: [0.75 * out[0] + s * wing * 0.45 * side[0], 0.6, 0.75 * out[1] + s * wing * 0.45 * side[1]]
        for (t0, r0, y0), (t1, r1, y1) in zip(spine, spine[1:]):
            mesh.card([place(r0, y0, 0), place(r1, y1, 0), place(r1, y1, 1), place(r0, y0, 1)],
                      [[t0, 0], [t1, 0], [t1, 1], [t0, 1]], [look(0), look(0), look(1), look(1)])


def tree(seed, whorls, boughs, pieces, girth, low, wide=0.40):
    """Its boughs and its trunk. girth: reach of the lowest boughs; low: where they begin."""
    draw, crown, trunk = random.Random(seed), Mesh(), Mesh()
    lean = (draw.uniform(-0.012, 0.012), draw.uniform(-0.012, 0.012))
    for k in range(whorls):
        share = (k + draw.uniform(-0.25, 0.25)) / whorls
        at = low + (0.97 - low) * max(0.0, share) ** 0.92
        left = (1 - at) / (1 - low)
        reach = girth * (left ** 0.80) * min(1.0, 0.62 + 1.6 * (1 - left)) + 0.016
        turn = draw.uniform(0, 6.28)
        for n in range(boughs):
            if draw.random() < 0.10: continue
            bough(crown, at + draw.uniform(-0.012, 0.012), turn + 6.2832 * (n + draw.uniform(-0.3, 0.3)) / boughs,
                  reach * draw.uniform(0.68, 1.18), 0.42 - 0.85 * left + draw.uniform(-0.08, 0.08),
                  math.radians(draw.uniform(30, 62)), pieces, wide * draw.uniform(0.85, 1.2))
    # The leader: two small cards upright.
    for turn in (0.4, 1.97):
        c, s = 0.008 * math.cos(turn), 0.008 * math.sin(turn)
        crown.card([[-c, 0.955, -s], [-c, 1.0, -s], [c, 1.0, s], [c, 0.955, s]], [[0.55, 0.0], [1.0, 0.0], [1.0, 0.35], [0.55, 0.35]],
                   [[-c * 40, 0.6, -s * 40], [0, 1, 0], [0, 1, 0], [c * 40, 0.6, s * 40]])
    sides, thick = 5, 0.014
    for k in range(sides):
        a, b = (6.2832 * (k + e) / sides for e in (0, 1))
        for y0, y1 in ((-0.05, 0.35), (0.35, 0.95)):
            w0, w1 = thick * (1.05 - y0), thick * (1.05 - y1)
            trunk.card([[w0 * math.cos(a), y0, w0 * math.sin(a)], [w0 * math.cos(b), y0, w0 * math.sin(b)],
                        [w1 * math.cos(b), y1, w1 * math.sin(b)], [w1 * math.cos(a), y1, w1 * math.sin(a)]],
                       [[k / sides, 1 - y0], [(k + 1) / sides, 1 - y0], [(k + 1) / sides, 1 - y1], [k / sides, 1 - y1]],
                       [[math.cos(a), 0, math.sin(a)], [math.cos(b), 0, math.sin(b)]] * 2)
    for mesh in (crown, trunk):
        for k in range(0, len(mesh.positions), 3):
            y = mesh.positions[k + 1]
            mesh.positions[k] += lean[0] * y
            mesh.positions[k + 2] += lean[1] * y
    return crown, trunk


# ---- far away ----------------------------------------------------------------------------------


def tree_picture(crown, trunk, bough_rows):
    """A tree from its side, as rows of linear colour and alpha: darker inside and below, as what its boughs shade."""
    wide, high, canvas, depth = 2 * FAR_WIDE, 2 * FAR_HIGH, {}, {}
    for mesh, bark in ((crown, False), (trunk, True)):
        at = lambda i: mesh.positions[3 * i:3 * i + 3]
        # Each card has its triangles twice.
        for k in range(0, len(mesh.indices), 6):
            corners = [(*at(i), *mesh.uvs[2 * i:2 * i + 2]) for i in mesh.indices[k:k + 3]]
            p = [((c[0] / REACH * 0.5 + 0.5) * wide, (1 - c[1]) * high) for c in corners]
            area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])
            if abs(area) < 1e-6: continue
            for j in range(max(0, math.floor(min(q[1] for q in p))), min(high, math.ceil(max(q[1] for q in p)) + 1)):
                for i in range(max(0, math.floor(min(q[0] for q in p))), min(wide, math.ceil(max(q[0] for q in p)) + 1)):
                    x, y = i + 0.5, j + 0.5
                    s = ((x - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (y - p[0][1])) / area
                    t = ((p[1][0] - p[0][0]) * (y - p[0][1]) - (x - p[0][0]) * (p[1][1] - p[0][1])) / area
                    if s < 0 or t < 0 or s + t > 1: continue
                    here = [c0 + s * (c1 - c0) + t * (c2 - c0) for c0, c1, c2 in zip(*corners)]
                    if depth.get((i, j), -9.0) >= here[2]: continue
                    color = (0.050, 0.036, 0.026, 1.0)
                    if not bark:
                        color = bough_rows[min(BOUGH - 1, int(here[4] * BOUGH))][min(BOUGH - 1, int(here[3] * BOUGH))]
                    if color[3] < 0.5: continue
                    away = math.hypot(here[0], here[2]) / (0.02 + 0.17 * (1 - here[1]))
                    shade = (0.35 + 0.65 * min(1.0, away)) * (0.72 + 0.28 * here[1])
                    depth[i, j] = here[2]
                    canvas[i, j] = tuple(shade * c for c in color[:3])
    return halved(canvas, FAR_WIDE, FAR_HIGH)


def far_tree(seed, column, columns, girth, low, wide):
    """Outlines of boughs on three upright planes with one column of the picture of all trees, shaded as if round. Outlines and not cards
    with holes: of a tree a few texels wide the holes of a small level leave a pillar."""
    draw, mesh, tiers = random.Random(seed), Mesh(), 9
    for k in range(3):
        c, s = math.cos(1.0472 * k + 0.3), math.sin(1.0472 * k + 0.3)
        for side in (-1, 1):
            for tier in range(tiers):
                at = low + (1 - low) * (tier + draw.uniform(-0.2, 0.2)) / tiers
                left = min(1.0, (1 - at) / (1 - low))
                reach = side * (0.92 * girth * left ** 0.8 * min(1.0, 0.62 + 1.6 * (1 - left)) * draw.uniform(0.75, 1.15) + 0.012)
                top = min(1.0, at + 1.9 * (1 - low) / tiers)
                outline = [(0.0, top), (0.55 * reach, at + 0.35 * (top - at)), (reach, at - 0.02), (0.0, at + 0.03 * wide)]
                corners = [[w * c, y, w * s] for w, y in outline]
                uvs = [[(column + 0.5 + 0.5 * w / REACH) / columns, 1 - max(0.0, y)] for w, y in outline]
                for face in (-1, 1):
                    first = len(mesh.positions) // 3
                    mesh.card(corners, uvs, [[(0.9 * side if w else 0.0) * c - face * 0.8 * s, 0.35 + 0.4 * y,
                                              (0.9 * side if w else 0.0) * s + face * 0.8 * c] for w, y in outline])
                    # This way round alone: the other has normals of its own.
                    facing = [first, first + 1, first + 2, first, first + 2, first + 3]
                    mesh.indices[-12:] = facing if face * side < 0 else facing[::-1]
    return mesh
