"""Meshes a metre high for docs/pictures/terrain.py and garden.py: positions, normals, texture coordinates, indices, material."""
import math


def conifer(draw, sides, material):
    """A spruce one metre high: skirts of boughs with ragged rims, each over the one below."""
    positions, normals, uvs, indices = [], [], [], []
    tiers = 7
    for tier in range(tiers):
        low = 0.06 + 0.86 * tier / tiers
        high = min(low + 0.24, 1.0)
        reach = 0.19 * (1 - low) ** 0.8
        first, turn = len(positions) // 3, draw.uniform(0, 6.28)
        for k in range(2 * sides):
            angle = turn + math.pi * k / sides
            far = reach * (draw.uniform(0.85, 1.2) if k % 2 == 0 else draw.uniform(0.45, 0.65))
            positions += [far * math.cos(angle), low + (0.0 if k % 2 == 0 else 0.05) + draw.uniform(-0.015, 0.015),
                          far * math.sin(angle)]
            normals += [0.8 * math.cos(angle), 0.6, 0.8 * math.sin(angle)]
            uvs += [k / sides, 1]
        positions += [0, high, 0]
        normals += [0, 1, 0]
        uvs += [0.5, 0]
        for k in range(2 * sides):
            indices += [first + (k + 1) % (2 * sides), first + k, first + 2 * sides]
    return positions, normals, uvs, indices, material


def tuft(draw, blades, material):
    """Blades of grass, one metre high, that lean outwards."""
    positions, normals, uvs, indices = [], [], [], []
    for k in range(blades):
        angle, lean, high = 6.28 * k / blades + draw.uniform(-0.3, 0.3), draw.uniform(0.15, 0.8), draw.uniform(0.6, 1.0)
        c, s, root = math.cos(angle), math.sin(angle), draw.uniform(0.02, 0.16)
        first = len(positions) // 3
        positions += [root * c - 0.11 * s, 0, root * s + 0.11 * c, root * c + 0.11 * s, 0, root * s - 0.11 * c,
                      (root + lean * high) * c, high, (root + lean * high) * s]
        normals += [0.3 * c, 0.95, 0.3 * s] * 3
        uvs += [0, 1, 1, 1, 0.5, 0]
        # Either way round: of one triangle with two sides the back would look down.
        indices += [first, first + 1, first + 2, first, first + 2, first + 1]
    return positions, normals, uvs, indices, material


def boulder(draw, material):
    """A ball that planes have cut, one metre wide."""
    rings, sides = 6, 9
    cuts = []
    for _ in range(13):
        y, turn = draw.uniform(-0.5, 1.0), draw.uniform(0, 6.28)
        flat = math.sqrt(1 - y * y)
        cuts.append((flat * math.cos(turn), y, flat * math.sin(turn), draw.uniform(0.30, 0.46)))
    corners = []
    for r in range(rings + 1):
        for k in range(sides):
            a, b = math.pi * r / rings, 6.2832 * (k + 0.5 * (r % 2)) / sides
            d = (math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b))
            far = min([0.5] + [cut[3] / dot for cut in cuts if (dot := sum(p * q for p, q in zip(cut, d))) > 0.1])
            corners.append([far * c for c in d])
    positions, normals, uvs, indices = [], [], [], []
    for r in range(rings):
        for k in range(sides):
            a, b = r * sides + k, r * sides + (k + 1) % sides
            odd = r % 2
            quads = [(a, b, b + sides), (a, b + sides, a + sides)] if odd else [(a, b, a + sides), (b, b + sides, a + sides)]
            for face in quads:
                p, q, t = (corners[m] for m in face)
                u, v = [q[m] - p[m] for m in range(3)], [t[m] - p[m] for m in range(3)]
                n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                size = math.sqrt(sum(c * c for c in n))
                if size < 1e-6: continue
                if sum(n[m] * p[m] for m in range(3)) < 0: n, face = [-c for c in n], (face[0], face[2], face[1])
                for m in face:
                    indices.append(len(positions) // 3)
                    positions += corners[m]
                    # Flat faces with soft edges.
                    mean = [0.75 * n[c] / size + 0.25 * corners[m][c] / 0.45 for c in range(3)]
                    length = math.sqrt(sum(c * c for c in mean))
                    normals += [c / length for c in mean]
                    uvs += [corners[m][0], corners[m][2]]
    return positions, normals, uvs, indices, material
