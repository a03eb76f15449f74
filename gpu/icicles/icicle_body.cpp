#include "gpu/icicles/icicle_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petrichor::gpu {
namespace {

using glm::vec3;

// Of a hanging thing, whatever way it looks: along it, or across.
Vertex vertex_at(const vec3& position, const vec3& normal)
{
    Vertex v{};
    v.position = position;
    v.normal = normal;
    const vec3 side = std::abs(normal.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    v.tangent = glm::vec4(glm::normalize(glm::cross(side, normal)), 1.0f);
    std::fill(std::begin(v.color), std::end(v.color), std::uint8_t{255});
    std::fill(std::begin(v.weather), std::end(v.weather), std::uint8_t{255});  // no snow of its own
    return v;
}

void append(const Overlay& own, const LaidOverlay& laid, std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices,
            std::vector<std::uint32_t>& counts, std::vector<std::uint8_t>& hidden)
{
    const auto base = static_cast<std::uint32_t>(vertices.size());
    const bool lies = !laid.vertices.empty();
    const auto& from = lies ? laid.vertices : std::span<const Vertex>(own.vertices);
    vertices.insert(vertices.end(), from.begin(), from.end());
    const auto corners = lies ? laid.indices : std::span<const std::uint32_t>(own.indices);
    for (const std::uint32_t corner : corners) indices.push_back(corner + base);
    for (std::size_t i = 0; i < own.parts.size(); ++i) counts.push_back(lies ? laid.counts[i] : 0);
    if (lies) hidden.insert(hidden.end(), laid.hidden.begin(), laid.hidden.end());
    hidden.resize(indices.size() / 3);
}

}  // namespace

IcicleBody::IcicleBody(std::shared_ptr<const scene::Icicles> icicles) : icicles_(std::move(icicles))
{
    overlay_.vertices.resize(icicles_->vertices, vertex_at(vec3(0.0f), vec3(0.0f, 1.0f, 0.0f)));
    overlay_.indices.reserve(std::size_t{3} * icicles_->triangles);
    for (const scene::Icicles::Part& from : icicles_->parts) {
        Overlay::Part part{icicles_->material, icicles_->instance, static_cast<std::uint32_t>(overlay_.indices.size()), 0, from.box};
        part.ice = true;
        for (std::uint32_t i = from.first; i < from.end; ++i) {
            const scene::Icicle& one = icicles_->icicles[i];
            const std::size_t first = overlay_.indices.size();
            overlay_.indices.resize(first + std::size_t{3} * scene::icicle_triangles(one));
            scene::icicle_indices(one, std::span(overlay_.indices).subspan(first));
        }
        part.index_count = static_cast<std::uint32_t>(overlay_.indices.size()) - part.first_index;
        overlay_.parts.push_back(part);
    }
    hidden_.assign(overlay_.indices.size() / 3, 0);
}

bool IcicleBody::lay(const Frame& frame)
{
    const scene::IcicleLengths lengths = frame.settings.icicles ? frame.icicles : scene::IcicleLengths{};
    if (laid_ == lengths) return false;
    laid_ = lengths;
    const bool hung = std::exchange(hang_, false);
    if (!lengths.any()) return hung;
    counts_.assign(overlay_.parts.size(), 0);
    std::vector<vec3> positions, normals;
    for (std::size_t p = 0; p < overlay_.parts.size(); ++p) {
        const scene::Icicles::Part& part = icicles_->parts[p];
        for (std::uint32_t i = part.first; i < part.end; ++i) {
            const scene::Icicle& one = icicles_->icicles[i];
            const float length_m = scene::icicle_length_m(one, lengths);
            if (!(length_m > 0.0f)) continue;
            hang_ = true;
            const std::uint32_t vertices = scene::icicle_vertices(one);
            positions.resize(vertices);
            normals.resize(vertices);
            scene::shape_icicle(one, length_m, positions, normals);
            for (std::uint32_t v = 0; v < vertices; ++v) overlay_.vertices[one.first_vertex + v] = vertex_at(positions[v], normals[v]);
            const std::size_t at = overlay_.parts[p].first_index + counts_[p];
            const std::uint32_t corners = 3 * scene::icicle_triangles(one);
            scene::icicle_indices(one, std::span(overlay_.indices).subspan(at, corners));
            counts_[p] += corners;
        }
    }
    return hung || hang_;
}

LaidOverlay IcicleBody::laid() const
{
    if (!hang_) return {};
    return {overlay_.vertices, overlay_.indices, counts_, hidden_, {}, false};
}

std::vector<scene::DripPoint> IcicleBody::tips(std::span<const scene::DripPoint> points) const
{
    std::vector<scene::DripPoint> moved(points.begin(), points.end());
    if (!hang_) return moved;
    for (const scene::Icicle& one : icicles_->icicles) {
        const float length_m = scene::icicle_length_m(one, *laid_);
        if (!(length_m > 0.0f) || one.drip >= moved.size()) continue;
        moved[one.drip].from_m = one.root_m + vec3(one.lean.x * length_m, -length_m, one.lean.y * length_m);
    }
    return moved;
}

Overlay joined(const Overlay& first, const Overlay& second)
{
    Overlay both = first;
    const auto vertices = static_cast<std::uint32_t>(first.vertices.size());
    const auto indices = static_cast<std::uint32_t>(first.indices.size());
    both.vertices.insert(both.vertices.end(), second.vertices.begin(), second.vertices.end());
    for (const std::uint32_t corner : second.indices) both.indices.push_back(corner + vertices);
    for (Overlay::Part part : second.parts) {
        part.first_index += indices;
        both.parts.push_back(part);
    }
    return both;
}

JoinedOverlay::JoinedOverlay(const Overlay& first, const LaidOverlay& first_laid, const Overlay& second, const LaidOverlay& second_laid)
    : covered_(first_laid.covered), snow_(first_laid.snow && !first_laid.vertices.empty())
{
    if (first_laid.vertices.empty() && second_laid.vertices.empty()) return;
    append(first, first_laid, vertices_, indices_, counts_, hidden_);
    append(second, second_laid, vertices_, indices_, counts_, hidden_);
}

LaidOverlay JoinedOverlay::laid() const
{
    return {vertices_, indices_, counts_, hidden_, covered_, snow_};
}

}  // namespace petrichor::gpu
