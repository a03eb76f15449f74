// From a point of a plane to where the ray of a pixel beside it meets the plane. Before the include: frame.
#ifndef PETRICHOR_PLANE_STEP_GLSL
#define PETRICHOR_PLANE_STEP_GLSL

vec3 plane_step(vec3 point, vec3 normal, vec2 pixel)
{
    const bool orthographic = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u;
    const vec3 origin = orthographic ? frame.origin_corner + frame.ray_dx * pixel.x + frame.ray_dy * pixel.y
                                     : frame.camera_m;
    const vec3 along = orthographic ? frame.forward : pixel_ray(frame, pixel);
    // Seen edge-on, the plane runs away: a slope of 1 in 20 is the steepest that counts.
    const float size = length(along);
    const float lean = min(dot(normal, along), -0.05 * size);
    return origin + along * (dot(normal, point - origin) / lean) - point;
}

#endif
