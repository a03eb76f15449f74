#include "gpu/passes/own_moves/own_moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "base/error.h"
#include "gpu/passes/own_moves/own_move_io.h"

namespace petrichor::gpu {

namespace {

static_assert(sizeof(shared::MovedVertex) == sizeof(MovedVertex));

constexpr double kSamePlace_m = 1.0e-4;

// What vertices of one material at one place have together, in the world.
struct Place {
    glm::vec3 normal{0.0f};
    float spacing_m = 0.0f;
};
using PlaceKey = std::array<std::int64_t, 4>;

PlaceKey key_of(std::uint32_t material, const glm::vec3& p)
{
    const auto whole = [](float x) { return static_cast<std::int64_t>(std::llround(static_cast<double>(x) / kSamePlace_m)); };
    return {material, whole(p.x), whole(p.y), whole(p.z)};
}

glm::vec3 world_of(const OwnMover& mover, const glm::vec3& p)
{
    return glm::vec3(mover.to_world * glm::vec4(p, 1.0f));
}

// Vertices that differ in more than their place move alike, so no seam opens.
std::vector<glm::vec4> points_of(const std::vector<OwnMover>& movers, std::size_t vertices)
{
    std::map<PlaceKey, Place> places;
    for (const OwnMover& mover : movers) {
        const scene::Primitive& shape = *mover.shape;
        for (std::size_t k = 0; k + 2 < shape.indices.size(); k += 3) {
            std::array<glm::vec3, 3> corner;
            for (std::size_t i = 0; i < 3; ++i) corner[i] = world_of(mover, shape.positions[shape.indices[k + i]]);
            glm::vec3 face = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
            if (glm::determinant(glm::mat3(mover.to_world)) < 0.0f) face = -face;
            for (std::size_t i = 0; i < 3; ++i) {
                Place& place = places[key_of(mover.material, corner[i])];
                place.normal += face;
                place.spacing_m = std::max({place.spacing_m, glm::distance(corner[i], corner[(i + 1) % 3]),
                                            glm::distance(corner[i], corner[(i + 2) % 3])});
            }
        }
    }
    std::vector<glm::vec4> points(vertices, glm::vec4(0.0f, 1.0f, 0.0f, 1.0f));
    for (const OwnMover& mover : movers) {
        const glm::mat3 to_own = glm::transpose(glm::mat3(mover.to_world));
        for (std::size_t v = 0; v < mover.shape->positions.size(); ++v) {
            const Place& place = places[key_of(mover.material, world_of(mover, mover.shape->positions[v]))];
            glm::vec3 normal = to_own * place.normal;
            if (!(glm::length(normal) > 0.0f)) normal = mover.shape->normals[v];
            points[mover.first_vertex + v] = glm::vec4(glm::normalize(normal), place.spacing_m);
        }
    }
    return points;
}

void check_moved(std::span<const MovedVertex> moved, const std::string& name)
{
    const auto lost = std::count_if(moved.begin(), moved.end(), [](const MovedVertex& to) {
        return !std::isfinite(to.by_m.x + to.by_m.y + to.by_m.z);
    });
    if (lost == 0) return;
    throw Error("surface " + name + ".glsl: " + name + "_move gives no finite way at " + std::to_string(lost) + " of " +
                    std::to_string(moved.size()) + " vertices",
                "Look for a division by zero, a root or logarithm of what is negative, or a number beyond 1e38.");
}

}  // namespace

OwnMoves::OwnMoves(const Device& device, const GpuScene& scene) : arena_(device)
{
    const std::span<const Vertex> rest = scene.bending();
    const std::vector<glm::vec4> points = points_of(scene.own_movers(), rest.size());
    const auto texel_buffer = [&](const char* name, std::span<const std::byte> bytes, VkFormat format) {
        auto buffer = arena_.buffer({.name = name,
                                     .size = bytes.size(),
                                     .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                     .texel_format = format});
        upload_buffer(device, *buffer, bytes);
        return buffer;
    };
    vertices_ = texel_buffer("vertices_at_rest", std::as_bytes(rest), VK_FORMAT_R32G32B32A32_UINT);
    points_ = texel_buffer("points_at_rest", std::as_bytes(std::span(points)), VK_FORMAT_R32G32B32A32_SFLOAT);
    const std::array<std::uint32_t, 4> nothing{};
    no_words_ = texel_buffer("no_words", std::as_bytes(std::span(nothing)), VK_FORMAT_R32_UINT);
    no_numbers_ = texel_buffer("no_numbers", std::as_bytes(std::span(nothing)), VK_FORMAT_R32G32B32A32_SFLOAT);
    no_map_ = arena_.image({.name = "no_map", .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    upload_image(device, *no_map_, {std::vector<std::byte>(4, std::byte{255})});
    nearest_ = make_sampler(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
    moved_ = arena_.buffer({.name = "moved_vertices", .size = rest.size() * sizeof(MovedVertex), .host = true});
    constants_ = arena_.buffer({.name = "move_constants",
                                .size = sizeof(shared::FrameConstants),
                                .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                .host = true});
    arguments_ = arena_.buffer({.name = "move_groups",
                                .size = scene.own_movers().size() * sizeof(VkDispatchIndirectCommand),
                                .usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                                .host = true});
    for (std::size_t i = 0; i < scene.own_movers().size(); ++i) {
        const auto count = static_cast<std::uint32_t>(scene.own_movers()[i].shape->positions.size());
        const VkDispatchIndirectCommand groups{(count + OWN_MOVE_GROUP - 1) / OWN_MOVE_GROUP, 1, 1};
        std::memcpy(arguments_->mapped + i * sizeof(groups), &groups, sizeof(groups));
    }
}

bool OwnMoves::move(const Device& device, PipelineCache& pipelines, DescriptorArena& descriptors, GpuScene& scene,
                    const shared::FrameConstants& now, bool posed)
{
    shared::FrameConstants told{};
    told.time_s = now.time_s;
    told.weather = now.weather;
    told.look = now.look;
    if (valid_ && !posed && std::memcmp(&told, &told_, sizeof(told)) == 0) return false;
    std::memcpy(&told_, &told, sizeof(told));
    std::memcpy(constants_->mapped, &told, sizeof(told));
    valid_ = true;

    DispatchListPass pass{.name = "own_moves",
                          .bindings = {{SURFACE_FRAME, uniform(*constants_, 0, sizeof(told))},
                                       {SURFACE_RIPPLE, sampled(*no_map_, nearest_)},
                                       {SURFACE_FLOW, texels(*no_words_)},
                                       {SURFACE_SNOW, sampled(*no_map_, nearest_)},
                                       {SURFACE_SHELTER, texels(*no_numbers_)},
                                       {SURFACE_PLACE_TABLE, texels(*no_words_)},
                                       {SURFACE_PLACE_STATES, texels(*no_numbers_)},
                                       {SURFACE_PLACE_LABELS, texels(*no_words_)},
                                       {SURFACE_PLACE_LEVELS, texels(*no_numbers_)},
                                       {SURFACE_TRACKS, sampled(*no_map_, nearest_)},
                                       {SURFACE_INSTANCE_LOOKS, texels(*no_numbers_)},
                                       {OWN_MOVE_VERTICES, texels(*vertices_)},
                                       {OWN_MOVE_POINTS, texels(*points_)},
                                       {OWN_MOVE_MOVED, storage_buffer(*moved_)}},
                          .arguments = arguments_.get(),
                          .pipelines = {},
                          .record = {}};
    pass.record = [&scene](DispatchContext& list) {
        for (std::size_t i = 0; i < scene.own_movers().size(); ++i) {
            const OwnMover& mover = scene.own_movers()[i];
            const GpuMaterial& material = scene.materials()[mover.material];
            list.bind(kOwnMoveShader,
                      {{SURFACE_SPEC_OWN, material.own_surface}, {SURFACE_SPEC_SLOTS, material.slots}},
                      types_of(material.bindings));
            list.bind_set1(material.bindings);
            const glm::mat4 rows = glm::transpose(mover.to_world);
            const glm::mat3 normals = glm::inverse(glm::mat3(mover.to_world));  // rows of its transpose's inverse
            shared::OwnMoveParams params{};
            for (int r = 0; r < 3; ++r) {
                params.to_world[r] = rows[r];
                params.normal_to_world[r] = glm::vec4(normals[r], 0.0f);
            }
            params.first = static_cast<std::uint32_t>(mover.first_vertex);
            params.count = static_cast<std::uint32_t>(mover.shape->positions.size());
            list.push(params);
            list.dispatch_indirect(static_cast<std::uint32_t>(i));
        }
    };
    FrameGraph graph;
    graph.add(std::move(pass));
    graph.read_back({moved_.get()});
    graph.execute(device, pipelines, descriptors);
    const std::span<const MovedVertex> moved{reinterpret_cast<const MovedVertex*>(moved_->mapped), moved_->size / sizeof(MovedVertex)};
    for (const OwnMover& mover : scene.own_movers()) {
        check_moved(moved.subspan(mover.first_vertex, mover.shape->positions.size()),
                    scene.own_surfaces().name_of(scene.materials()[mover.material].own_surface));
    }
    scene.move_own(device, moved);
    return true;
}

}  // namespace petrichor::gpu
