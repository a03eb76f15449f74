// The part of space that a rectangle of pixels sees, for culling light spheres.
#ifndef PETRICHOR_LIGHT_VOLUME_GLSL
#define PETRICHOR_LIGHT_VOLUME_GLSL

#include "gpu/frame/gbuffer.glsl"

struct TileVolume {
    vec4 planes[4];  // inside: dot(plane.xyz, p) + plane.w >= 0
    vec3 rays[4];    // corner directions (or offsets on the camera plane)
};

vec4 plane_through(vec3 point, vec3 normal, vec3 inside)
{
    vec3 n = normalize(normal);
    if (dot(n, inside) < 0.0) n = -n;
    return vec4(n, -dot(n, point));
}

TileVolume tile_volume(FrameConstants frame, vec2 low, vec2 high)
{
    TileVolume volume;
    const vec2 corners[4] = vec2[](low, vec2(high.x, low.y), high, vec2(low.x, high.y));
    const bool orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    for (int i = 0; i < 4; ++i) {
        volume.rays[i] = orthographic ? frame.origin_corner + frame.ray_dx * corners[i].x +
                                            frame.ray_dy * corners[i].y
                                      : pixel_ray(frame, corners[i]);
    }
    const vec3 centre = 0.25 * (volume.rays[0] + volume.rays[1] + volume.rays[2] + volume.rays[3]);
    for (int i = 0; i < 4; ++i) {
        const vec3 a = volume.rays[i];
        const vec3 b = volume.rays[(i + 1) & 3];
        volume.planes[i] = orthographic
                               ? plane_through(a, cross(frame.forward, b - a), centre - a)
                               : plane_through(frame.camera_m, cross(a, b), centre);
    }
    return volume;
}

bool touches_sides(TileVolume volume, vec3 centre, float radius)
{
    for (int i = 0; i < 4; ++i) {
        if (dot(volume.planes[i].xyz, centre) + volume.planes[i].w < -radius) return false;
    }
    return true;
}

#endif
