#include "gpu/upload/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/upload/gpu_scene.h"
#include "scene/animation/deform.h"

namespace petrichor::gpu {

namespace {

scene::Bounds no_box()
{
    return {glm::vec3(std::numeric_limits<float>::max()),
            glm::vec3(std::numeric_limits<float>::lowest())};
}

void widen(scene::Bounds& box, const glm::vec3& point)
{
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
}

}  // namespace

Vertex vertex_of(const scene::Primitive& p, std::size_t i)
{
    const auto set_bytes = [i](std::uint8_t(&target)[4], const std::vector<glm::vec4>& values) {
        for (int c = 0; c < 4; ++c) {
            const float value = values.empty() ? 1.0f : std::clamp(values[i][c], 0.0f, 1.0f);
            target[c] = static_cast<std::uint8_t>(std::lround(value * 255.0f));
        }
    };
    Vertex v{};
    v.position = p.positions[i];
    v.normal = p.normals[i];
    v.tangent = p.tangents.empty() ? glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) : p.tangents[i];
    if (!p.uv0.empty()) v.uv0 = p.uv0[i];
    v.uv1 = p.uv1.empty() ? v.uv0 : p.uv1[i];
    set_bytes(v.color, p.colors);
    set_bytes(v.weather, p.weather);
    v.weather[3] = 255;  // a vertex of snow has less
    return v;
}

scene::Bounds box_in_world(const scene::Bounds& box, const glm::mat4& to_world)
{
    scene::Bounds out = no_box();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                          corner & 4 ? box.high.z : box.low.z);
        widen(out, glm::vec3(to_world * glm::vec4(p, 1.0f)));
    }
    return out;
}

PosedDraw posed(const MovingDraw& draw, const scene::Rig& rig, const scene::Posture& posture,
                std::vector<Vertex>& vertices)
{
    const auto node = static_cast<std::size_t>(draw.instance.node);
    PosedDraw out;
    out.visible = posture.visible[node];
    out.to_world = scene::place_of(draw.instance, posture);
    out.box = draw.box;
    out.mirrored = glm::determinant(glm::mat3(out.to_world)) < 0.0f;
    if (!draw.shape) return out;
    const auto joints = scene::joints_of(rig, draw.instance, posture);
    const scene::Shape shape = scene::deformed(*draw.shape, posture.weights[node], joints);
    out.box = no_box();
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        Vertex& v = vertices[draw.first_vertex + i];
        v.position = shape.positions[i];
        v.normal = shape.normals[i];
        if (!shape.tangents.empty()) v.tangent = shape.tangents[i];
        widen(out.box, v.position);
    }
    if (!joints.empty() && !draw.shape->influences.empty()) {
        const std::uint32_t first = draw.shape->influences.front().joint;
        out.mirrored = glm::determinant(glm::mat3(joints[first])) < 0.0f;
    }
    return out;
}

bool GpuScene::pose(const Device& device, double time_s, const scene::Wind& wind)
{
    const bool posed = pose_rig(time_s);
    const bool bent = bend(wind, posed);
    if (!posed && !bent) return false;
    upload_bending(device);
    return true;
}

void GpuScene::upload_bending(const Device& device)
{
    ++poses_;
    upload_vertices(device, bending_, first_bending_);
}

void GpuScene::move_own(const Device& device, std::span<const MovedVertex> moved)
{
    bounds_ = posed_bounds_;
    for (Draw& draw : draws_) {
        const std::int32_t mover = draw.waving < 0 ? -1 : waving_[static_cast<std::size_t>(draw.waving)].mover;
        if (mover < 0) continue;
        const OwnMover& own = movers_[static_cast<std::size_t>(mover)];
        const glm::mat3 linear(draw.to_world);
        const glm::mat3 back = glm::inverse(linear);
        if (!std::isfinite(back[0].x)) continue;
        const auto unit = [](const glm::vec3& v, const glm::vec3& otherwise) {
            const float size = glm::length(v);
            return size > 0.0f ? v / size : otherwise;
        };
        scene::Bounds box = no_box();
        for (std::size_t i = 0; i < own.shape->positions.size(); ++i) {
            const MovedVertex& to = moved[own.first_vertex + i];
            Vertex& v = bending_[own.first_vertex + i];
            v.position = own.shape->positions[i] + back * to.by_m;
            v.normal = unit(glm::transpose(linear) * to.normal, own.shape->normals[i]);
            if (!own.shape->tangents.empty()) {
                const glm::vec4& t = own.shape->tangents[i];
                v.tangent = glm::vec4(unit(back * to.tangent, glm::vec3(t)), t.w);
            }
            widen(box, v.position);
        }
        place_sphere(draw, box);
        const scene::Bounds here = box_in_world(box, draw.to_world);
        bounds_.low = glm::min(bounds_.low, here.low);
        bounds_.high = glm::max(bounds_.high, here.high);
    }
    upload_bending(device);
}

// Vertices that bend, in the wind; all calm moments are one.
bool GpuScene::bend(const scene::Wind& wind, bool moved)
{
    const scene::Wind now = wind.velocity_m_s == glm::vec2(0.0f) ? scene::Wind{} : wind;
    if (waving_.empty() || (now == wind_ && !moved)) return false;
    wind_ = now;
    const auto wave = [&](Draw& draw) {
        if (draw.waving < 0) return;
        const WavingDraw& waving = waving_[static_cast<std::size_t>(draw.waving)];
        if (waving.mover >= 0) return;
        const scene::Shape shape =
            scene::waved(*waving.shape, waving.box, draw.to_world, waving.look, now);
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
            Vertex& v = bending_[waving.first_vertex + i];
            v.position = shape.positions[i];
            v.normal = shape.normals[i];
            if (!shape.tangents.empty()) v.tangent = shape.tangents[i];
        }
        place_sphere(draw, waving.box);
        if (now.velocity_m_s != glm::vec2(0.0f))
            draw.radius_m += scene::wave_reach_m(waving.box, draw.to_world, waving.look);
    };
    for (Draw& draw : draws_) wave(draw);
    for (Decal& decal : decals_) wave(decal.draw);
    return true;
}

bool GpuScene::pose_rig(double time_s)
{
    if (!rig_ || posed_s_ == time_s) return false;
    posed_s_ = time_s;
    const scene::Posture posture = scene::posture_at(*rig_, time_s);
    bounds_ = rest_bounds_;
    const auto move = [&](Draw& draw) {
        if (draw.moving < 0) return;
        const MovingDraw& moving = moving_[static_cast<std::size_t>(draw.moving)];
        const PosedDraw here = posed(moving, *rig_, posture, bending_);
        draw.index_count = here.visible ? moving.index_count : 0;
        draw.to_world = here.to_world;
        draw.mirrored = here.mirrored;
        place_sphere(draw, here.box);
        if (!here.visible) return;
        const Bounds box = box_in_world(here.box, here.to_world);
        bounds_.low = glm::min(bounds_.low, box.low);
        bounds_.high = glm::max(bounds_.high, box.high);
    };
    for (Draw& draw : draws_) {
        move(draw);
        const std::int32_t mover = draw.waving < 0 ? -1 : waving_[static_cast<std::size_t>(draw.waving)].mover;
        if (mover >= 0) movers_[static_cast<std::size_t>(mover)].to_world = draw.to_world;
    }
    posed_bounds_ = bounds_;
    for (Decal& decal : decals_) {
        move(decal.draw);
        if (!decal.box || decal.box->node == scene::kNoNode) continue;
        const auto node = static_cast<std::size_t>(decal.box->node);
        decal.box->to_world = glm::mat4(posture.to_world[node]) * decal.box->in_node;
        decal.draw.to_world = decal.box->to_world;
        place_sphere(decal.draw, kDecalBox);
    }
    for (std::size_t i = 0; i < lights_.size(); ++i)
        lights_[i] = scene::carried(rest_lights_[i], posture);
    for (std::size_t i = 0; i < glow_sources_.size(); ++i) {
        GlowSource& source = glow_sources_[i];
        if (!source.carrier) continue;
        const scene::Instance& carrier = *source.carrier;
        source = rest_glow_sources_[i];
        if (!posture.visible[static_cast<std::size_t>(carrier.node)]) {
            source.area_m2 = 0.0f;
            source.light.intensity = 0.0f;
            continue;
        }
        const glm::mat4 moved =
            scene::place_of(carrier, posture) * glm::inverse(carrier.to_world);
        const glm::mat3 linear(moved);
        Light& light = source.light;
        light.position_m = glm::vec3(moved * glm::vec4(light.position_m, 1.0f));
        light.direction = glm::normalize(linear * light.direction);
        light.half_u_m = linear * light.half_u_m;
        light.half_v_m = linear * light.half_v_m;
    }
    glows_ = glowing(glow_sources_, current_);
    return true;
}

}  // namespace petrichor::gpu
