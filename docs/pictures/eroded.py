"""Land that rivers have cut: stream power over a grid, solved implicitly from the outlets upwards (Braun and Willett 2013), and
slopes that fall to their angle of repose, steeper where a bed of hard rock crops out. Of docs/pictures/terrain.py.
"""
import heapq
import math


def hashed(x, y, seed):
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed):
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * u * (u * (6 * u - 15) + 10), v * v * v * (v * (6 * v - 15) + 10)
    low = hashed(i, j, seed) * (1 - u) + hashed(i + 1, j, seed) * u
    high = hashed(i, j + 1, seed) * (1 - u) + hashed(i + 1, j + 1, seed) * u
    return low * (1 - v) + high * v


def fractal(x, y, seed, octaves):
    """0..1 around 0.5."""
    total, share, sum_of_shares = 0.0, 1.0, 0.0
    for k in range(octaves):
        total += share * noise(x, y, seed + k)
        sum_of_shares += share
        x, y, share = 1.6 * x - 1.2 * y + 3.7, 1.2 * x + 1.6 * y + 9.1, 0.5 * share
    return total / sum_of_shares


def smooth(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def bed(x, y, z, side_m):
    """How hard the rock is at a height: beds of 70, 31 and 13 m, which dip and are bent. 0 soft .. 1 hard."""
    at = y + 0.13 * x - 0.08 * z + 0.055 * side_m * (fractal(5 * x / side_m + 4.0, 5 * z / side_m, 91, 3) - 0.5)
    return 0.45 * noise(at / 70.0, 0.5, 95) + 0.35 * noise(at / 31.0, 0.5, 96) + 0.2 * noise(at / 13.0, 0.5, 97)


def downstream(heights, fixed, n, step_m):
    """Nodes from the outlets upwards, and for each the one that it drains to, through hollows too (Barnes et al. 2014)."""
    near = [(-1, 1.0), (1, 1.0), (-n, 1.0), (n, 1.0), (-n - 1, 1.414), (-n + 1, 1.414), (n - 1, 1.414), (n + 1, 1.414)]
    to, seen, order = [-1] * (n * n), bytearray(n * n), []
    heap = []
    for k in range(n * n):
        if fixed[k]:
            seen[k] = 1
            heap.append((heights[k], k))
    heapq.heapify(heap)
    done = bytearray(n * n)
    while heap:
        level, k = heapq.heappop(heap)
        h, steepest, best = heights[k], 0.0, to[k]
        column = k % n
        for offset, way in near:
            m = k + offset
            if m < 0 or m >= n * n or abs(m % n - column) > 1: continue
            if done[m]:
                fall = (h - heights[m]) / way
                if fall > steepest: steepest, best = fall, m
            elif not seen[m]:
                seen[m] = 1
                to[m] = k
                heapq.heappush(heap, (max(heights[m], level + 1e-4), m))
        if not fixed[k]: to[k] = best
        done[k] = 1
        order.append(k)
    return order, to


def erode(heights, fixed, uplift_m, n, step_m, side_m, steps, cut):
    """Heights after so many steps, and the area, in cells, that drains through each node."""
    area = []
    for step in range(steps):
        order, to = downstream(heights, fixed, n, step_m)
        area = [1.0] * (n * n)
        for k in reversed(order):
            if to[k] >= 0: area[to[k]] += area[k]
        for k in order:
            if fixed[k]: continue
            m = to[k]
            way = step_m * (1.0 if abs(k - m) in (1, n) else 1.414)
            x, z = (k % n) * step_m - side_m / 2, (k // n) * step_m - side_m / 2
            raised, below = heights[k] + uplift_m[k], heights[m]
            hard = bed(x, raised, z, side_m) if raised > 40 else 0.4
            factor = cut * (1.5 - hard) * area[k] ** 0.42 / way
            h = (raised + factor * below) / (1 + factor)
            repose = 0.95 + 1.3 * smooth(0.42, 0.66, hard)
            heights[k] = min(h, below + repose * way) if h > below else below + 1e-3
    return heights, area
