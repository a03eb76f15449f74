"""Meshes of the scenes, and where something is that looks somewhere."""
import math


class Mesh:
    """Triangles with a normal at each corner."""

    def __init__(self, material):
        self.material = material
        self.positions, self.normals, self.triangles = [], [], []
        self.tangents = []  # of balls: along their rings

    def quad(self, corner, u, v):
        """A parallelogram that is seen from where u turns to v against the clock."""
        n = unit(cross(u, v))
        first = len(self.positions)
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            self.positions.append(tuple(corner[i] + s * u[i] + t * v[i] for i in range(3)))
            self.normals.append(n)
        self.triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
        return self

    def box(self, low, high, turn=0.0):
        size = [high[i] - low[i] for i in range(3)]
        middle = [0.5 * (low[i] + high[i]) for i in range(3)]
        c, s = math.cos(turn), math.sin(turn)

        def turned(x, y, z):
            return (c * x + s * z, y, c * z - s * x)

        for axis in range(3):
            for side in (-1, 1):
                u, v, n = [0.0] * 3, [0.0] * 3, [0.0] * 3
                a, b = (axis + 1) % 3, (axis + 2) % 3
                u[a], v[b], n[axis] = size[a], side * size[b], side * 0.5 * size[axis]
                corner = turned(*[n[i] - 0.5 * u[i] - 0.5 * v[i] for i in range(3)])
                self.quad(tuple(middle[i] + corner[i] for i in range(3)), turned(*u), turned(*v))
        return self

    def ball(self, centre, radius, rings=96):
        first = len(self.positions)
        for i in range(rings + 1):
            theta = math.pi * i / rings
            for j in range(2 * rings + 1):
                phi = math.pi * j / rings
                n = (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
                self.normals.append(n)
                self.tangents.append((-math.sin(phi), 0.0, math.cos(phi), 1.0))
                self.positions.append(tuple(centre[k] + radius * n[k] for k in range(3)))
        row = 2 * rings + 1
        for i in range(rings):
            for j in range(2 * rings):
                a = first + i * row + j
                if i > 0:
                    self.triangles.append((a, a + 1, a + row + 1))
                if i < rings - 1:
                    self.triangles.append((a, a + row + 1, a + row))
        return self


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    size = math.sqrt(sum(x * x for x in a))
    return tuple(x / size for x in a)


def looking(position, at):
    """Columns of the axes of something that looks along its own -z, and where it is."""
    z = unit(tuple(position[i] - at[i] for i in range(3)))
    x = unit(cross((0.0, 1.0, 0.0), z))
    return x, cross(z, x), z, position
