#include "gpu/upload/seen_triangles.h"

#include <algorithm>
#include <cmath>

#include "gpu/upload/draw.h"
#include "gpu/upload/steep_io.h"

namespace petrichor::gpu {

namespace {

// Rasterizers round to 1/256 of a pixel.
constexpr float kSlack = 1.0f / 64.0f;
// The device's own rounding on the way to the screen, relative to the largest of its summands.
constexpr float kRounding = 1.0e-6f;
constexpr std::size_t kMostTriangles = 1536u << 10;

// How far, in pixels at distance 1, rounding may move a corner.
float rounding_of(const SampledView& view, const Draw& draw)
{
    const glm::vec3 far = glm::abs(draw.centre_m) + glm::vec3(draw.radius_m);
    const glm::mat4& m = view.clip_from_world;
    float largest = 0.0f;
    for (int row : {0, 1, 3}) {
        const float sum = std::abs(m[0][row]) * far.x + std::abs(m[1][row]) * far.y +
                          std::abs(m[2][row]) * far.z + std::abs(m[3][row]);
        largest = std::max(largest, sum);
    }
    return kRounding * largest * static_cast<float>(std::max(view.width, view.height));
}

// A sample point k + 1/2 + offset lies between low and high.
bool meets(float low, float high, float offset)
{
    return std::floor(high - 0.5f - offset) >= std::ceil(low - 0.5f - offset);
}

// What is not a number is inside of all.
std::uint32_t outside(const AskedPart& asked, const glm::vec4& clip)
{
    std::uint32_t bits = clip.z < asked.least_z ? 1u << 31 : 0u;
    for (int i = 0; i < asked.count; ++i) {
        const glm::vec3& line = asked.lines[static_cast<std::size_t>(i)];
        bits |= line.x * clip.x + line.y * clip.y + line.z < 0.0f ? 1u << i : 0u;
    }
    return bits;
}

}  // namespace

void SeenTriangles::reset(const GpuScene& scene)
{
    used_ = 0;
    places_.reset(scene);
    if (scene_ == &scene) return;
    scene_ = &scene;
    indices_ = nullptr;
    numbers_ = nullptr;
    arena_ = nullptr;
    capacity_ = 0;
    if (!scene.vertices().mapped || !scene.as_texels()) return;
    std::size_t triangles = 0;
    for (const Draw& draw : scene.draws()) triangles += draw.most_indices / 3;
    capacity_ = std::min<std::size_t>({4 * triangles, kMostTriangles,
                                       device_->limits().maxTexelBufferElements});
    if (capacity_ == 0) return;
    arena_ = std::make_unique<MemoryArena>(*device_);
    indices_ = arena_->buffer({.name = "seen_indices",
                               .size = capacity_ * 12,
                               .usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                               .host = true});
    numbers_ = arena_->buffer({.name = "seen_numbers",
                               .size = capacity_ * 4,
                               .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                               .texel_format = VK_FORMAT_R32_UINT,
                               .host = true});
}

std::shared_ptr<const SeenDraws> SeenTriangles::list_of(const GpuScene& scene,
                                                        const SampledView& view, bool back_faces,
                                                        std::span<const Draw* const> draws)
{
    auto seen = std::make_shared<SeenDraws>();
    seen->ranges.resize(scene.draws().size());
    seen->indices = indices_.get();
    seen->numbers = numbers_.get();
    const auto* positions = reinterpret_cast<const glm::vec3*>(scene.positions().mapped);
    const auto* indices = reinterpret_cast<const std::uint32_t*>(scene.indices().mapped);
    auto* out_indices = reinterpret_cast<std::uint32_t*>(indices_->mapped);
    auto* out_numbers = reinterpret_cast<std::uint32_t*>(numbers_->mapped);
    const auto width = static_cast<float>(view.width);
    const auto height = static_cast<float>(view.height);
    glm::vec2 low_offset(0.0f), high_offset(0.0f);
    for (const glm::vec2& offset : view.offsets) {
        low_offset = glm::min(low_offset, offset);
        high_offset = glm::max(high_offset, offset);
    }
    for (const Draw* draw : draws) {
        if (used_ + draw->index_count / 3 > capacity_) continue;  // it stays whole
        const glm::mat4 clip_from_mesh = view.clip_from_world * draw->to_world;
        const float rounding = rounding_of(view, *draw);
        // Front faces turn against the clock on the screen, whose y points down: a negative area.
        VkCullModeFlags cull = scene.materials()[draw->material].cull;
        if (back_faces) cull = VK_CULL_MODE_NONE;
        const float hidden_sign = (cull == VK_CULL_MODE_BACK_BIT) == draw->mirrored ? -1.0f : 1.0f;
        const bool turned_away = cull != VK_CULL_MODE_NONE;

        const AskedPart asked = asked_of(view.asked, view.clip_from_world, draw->centre_m, draw->radius_m).value_or(view.asked);
        corners_.resize(draw->vertex_count);
        const glm::vec3* own = positions + draw->vertex_offset + draw->first_vertex;
        for (std::uint32_t v = 0; v < draw->vertex_count; ++v) {
            const glm::vec4 clip = clip_from_mesh * glm::vec4(own[v], 1.0f);
            Corner& corner = corners_[v];
            if (!(clip.w > 1.0e-6f)) {
                corner = {0.0f, 0.0f, 0.0f, 0u};
                continue;
            }
            corner.nearer = 1.0f / clip.w;
            corner.x = (clip.x * corner.nearer * 0.5f + 0.5f) * width;
            corner.y = (clip.y * corner.nearer * 0.5f + 0.5f) * height;
            corner.outside = outside(asked, clip);
        }
        const auto first = static_cast<std::uint32_t>(used_);
        const std::uint32_t triangles = draw->index_count / 3;
        const std::span<const std::uint8_t> covered =
            view.hidden != 0 ? scene.covered(*draw) : std::span<const std::uint8_t>();
        const std::span<const std::uint8_t> steep = scene.steep().triangles[static_cast<std::size_t>(draw - scene.draws().data())];
        // An eye sees faces that look up; the others it may see from below.
        const bool by_side = (view.hidden & Covered::kFromEye) != 0;
        const float seen_sign = draw->mirrored ? 1.0f : -1.0f;
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const bool hidden = t < covered.size() && (covered[t] & view.hidden) != 0;
            if (hidden && !by_side) continue;
            const std::uint32_t* index = indices + draw->first_index + 3 * std::size_t{t};
            const Corner& a = corners_[index[0] - draw->first_vertex];
            const Corner& b = corners_[index[1] - draw->first_vertex];
            const Corner& c = corners_[index[2] - draw->first_vertex];
            // Written so that what is not a number stays.
            if ((a.outside & b.outside & c.outside) != 0u) continue;
            const bool before = a.nearer > 0.0f && b.nearer > 0.0f && c.nearer > 0.0f;
            if (before) {
                const float slack =
                    kSlack + rounding * std::max(a.nearer, std::max(b.nearer, c.nearer));
                const float low_x = std::min(a.x, std::min(b.x, c.x)) - slack;
                const float high_x = std::max(a.x, std::max(b.x, c.x)) + slack;
                const float low_y = std::min(a.y, std::min(b.y, c.y)) - slack;
                const float high_y = std::max(a.y, std::max(b.y, c.y)) + slack;
                if (high_x < low_offset.x || low_x > width + high_offset.x ||
                    high_y < low_offset.y || low_y > height + high_offset.y) {
                    continue;
                }
                if (turned_away || hidden) {
                    const float area =
                        (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
                    const float unsure = 2.0f * slack * (high_x - low_x + high_y - low_y);
                    if (turned_away && area * hidden_sign > unsure) continue;
                    if (hidden && area * seen_sign > unsure) continue;
                }
                if (high_x - low_x < 1.0f || high_y - low_y < 1.0f) {
                    bool met = false;
                    for (const glm::vec2& offset : view.offsets) {
                        if (meets(low_x, high_x, offset.x) && meets(low_y, high_y, offset.y)) {
                            met = true;
                            break;
                        }
                    }
                    if (!met) continue;
                }
            } else if (a.nearer == 0.0f && b.nearer == 0.0f && c.nearer == 0.0f) {
                continue;  // behind the eye
            }
            std::copy_n(index, 3, out_indices + 3 * used_);
            out_numbers[used_++] = t | (t < steep.size() && (steep[t] & view.steep) != 0 ? ID_STEEP : 0u);
        }
        seen->ranges[static_cast<std::size_t>(draw - scene.draws().data())] = {
            3 * first, 3 * (static_cast<std::uint32_t>(used_) - first)};
    }
    return seen;
}

SeenRange SeenBinder::range_of(const Draw& draw) const
{
    if (seen_ && draw.index_count > 0) {
        const SeenRange range =
            seen_->ranges[static_cast<std::size_t>(&draw - scene_->draws().data())];
        if (!range.whole()) return range;
    }
    return {};
}

void SeenBinder::bind(bool listed)
{
    if (listed == listed_bound_) return;
    const GpuBuffer& indices = listed ? *seen_->indices : scene_->indices();
    vkCmdBindIndexBuffer(commands_, indices.buffer.get(), 0, VK_INDEX_TYPE_UINT32);
    listed_bound_ = listed;
}

void SeenBinder::draw_run(const Draw& draw, std::uint32_t count, std::uint32_t first)
{
    bind(false);
    vkCmdDrawIndexed(commands_, draw.index_count, count, draw.first_index, draw.vertex_offset, first);
}

void SeenBinder::draw(const Draw& draw, const SeenRange& range)
{
    bind(!range.whole());
    if (!range.whole()) {
        vkCmdDrawIndexed(commands_, range.index_count, 1, range.first_index, draw.vertex_offset, 0);
    } else {
        vkCmdDrawIndexed(commands_, draw.index_count, 1, draw.first_index, draw.vertex_offset, 0);
    }
}

}  // namespace petrichor::gpu
