#include "gpu/upload/seen_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/four.h"
#include "gpu/upload/detail/corners.h"
#include "gpu/upload/draw.h"
#include "gpu/upload/steep_io.h"

namespace petrichor::gpu {

namespace {

// With 0 for the last.
Four three(Four v)
{
    const Signs kept{-1, -1, -1, 0};
    Signs bits;
    std::memcpy(&bits, &v, sizeof bits);
    bits &= kept;
    std::memcpy(&v, &bits, sizeof v);
    return v;
}

// Rasterizers round to 1/256 of a pixel.
constexpr float kSlack = 1.0f / 64.0f;
// The device's own rounding on the way to the screen, relative to the largest of its summands.
constexpr float kRounding = 1.0e-6f;
constexpr std::size_t kMostTriangles = 1536u << 10;
// More of it, in pixels, and nothing is said to be hidden.
constexpr float kMostRounding = 0.25f;
// Vertices that are projected together.
constexpr std::uint32_t kGroup = 16;

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

bool all_have(std::span<const std::uint8_t> bytes, std::uint8_t bits)
{
    std::uint8_t some = 0xff;
    for (const std::uint8_t byte : bytes) some = static_cast<std::uint8_t>(some & ((byte & bits) != 0 ? 0xff : 0));
    return some != 0;
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
    blocks_.clear();
    large_.clear();
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

const std::vector<TriangleBlock>& SeenTriangles::blocks(const GpuScene& scene, const Draw& draw, const glm::vec3* own,
                                                        const std::uint32_t* indices)
{
    // What bends and what is laid anew changes its places, and what is laid its triangles as well.
    const std::uint64_t version = draw.overlay ? scene.lays() : scene.bends(draw) ? scene.poses() : 0;
    Blocks& kept = blocks_[{draw.first_index, draw.vertex_offset}];
    if (kept.version != version || kept.index_count != draw.index_count) {
        kept.made = blocks_of({own, draw.vertex_count}, {indices, draw.index_count}, draw.first_vertex);
        kept.version = version;
        kept.index_count = draw.index_count;
    }
    return kept.made;
}

// What is large and solid, and drawn into a map from both sides, hides what lies behind.
Occluders SeenTriangles::occluders(const GpuScene& scene, const SampledView& view, std::span<const Draw* const> draws)
{
    const auto* positions = reinterpret_cast<const glm::vec3*>(scene.positions().mapped);
    const auto* indices = reinterpret_cast<const std::uint32_t*>(scene.indices().mapped);
    Occluders made(view.clip_from_world, static_cast<float>(view.width), kMostRounding);
    for (const Draw* draw : draws) {
        const GpuMaterial& material = scene.materials()[draw->material];
        if (material.masked || material.blended || draw->overlay || draw->shape >= 0 || scene.bends(*draw)) continue;
        if (!made.may_cover(draw->radius_m) || !(rounding_of(view, *draw) < kMostRounding)) continue;
        const glm::vec3* own = positions + draw->vertex_offset + draw->first_vertex;
        const std::uint32_t* own_indices = indices + draw->first_index;
        const auto [large, fresh] = large_.try_emplace({draw->first_index, draw->vertex_offset});
        if (fresh) large->second = large_faces({own, draw->vertex_count}, {own_indices, draw->index_count}, draw->first_vertex);
        const std::span<const std::uint8_t> covered = scene.covered(*draw);
        made.add(draw->to_world, large->second, own, draw->first_vertex, [&](std::uint32_t t) {
            return t < covered.size() && (covered[t] & view.hidden) != 0;
        });
    }
    return made;
}

std::shared_ptr<const SeenDraws> SeenTriangles::list_of(const GpuScene& scene,
                                                        const SampledView& view, bool back_faces,
                                                        std::span<const Draw* const> draws,
                                                        std::span<const Draw* const> all)
{
    auto seen = std::make_shared<SeenDraws>();
    seen->ranges.resize(scene.draws().size());
    seen->indices = indices_.get();
    seen->numbers = numbers_.get();
    const glm::mat4& m = view.clip_from_world;
    const bool flat = m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f;
    std::optional<Occluders> hiding;
    if (flat && back_faces && view.width == view.height) hiding = occluders(scene, view, all);
    for (const Draw* draw : draws) {
        if (used_ + draw->index_count / 3 > capacity_) continue;  // it stays whole
        const auto first = static_cast<std::uint32_t>(used_);
        list_draw(scene, view, back_faces, *draw, hiding ? &*hiding : nullptr);
        seen->ranges[static_cast<std::size_t>(draw - scene.draws().data())] = {
            3 * first, 3 * (static_cast<std::uint32_t>(used_) - first)};
    }
    return seen;
}

void SeenTriangles::list_draw(const GpuScene& scene, const SampledView& view, bool back_faces, const Draw& draw,
                              const Occluders* occluders)
{
    const glm::vec3* own = reinterpret_cast<const glm::vec3*>(scene.positions().mapped) + draw.vertex_offset + draw.first_vertex;
    const std::uint32_t* indices = reinterpret_cast<const std::uint32_t*>(scene.indices().mapped) + draw.first_index;
    const std::vector<TriangleBlock>& blocks = this->blocks(scene, draw, own, indices);
    auto* out_indices = reinterpret_cast<std::uint32_t*>(indices_->mapped);
    auto* out_numbers = reinterpret_cast<std::uint32_t*>(numbers_->mapped);
    const auto width = static_cast<float>(view.width);
    const auto height = static_cast<float>(view.height);
    glm::vec2 low_offset(0.0f), high_offset(0.0f);
    for (const glm::vec2& offset : view.offsets) {
        low_offset = glm::min(low_offset, offset);
        high_offset = glm::max(high_offset, offset);
    }
    const float rounding = rounding_of(view, draw);
    // Front faces turn against the clock on the screen, whose y points down: a negative area.
    VkCullModeFlags cull = scene.materials()[draw.material].cull;
    if (back_faces) cull = VK_CULL_MODE_NONE;
    const float hidden_sign = (cull == VK_CULL_MODE_BACK_BIT) == draw.mirrored ? -1.0f : 1.0f;
    const bool turned_away = cull != VK_CULL_MODE_NONE;
    if (!(rounding < kMostRounding)) occluders = nullptr;

    const AskedPart asked = asked_of(view.asked, view.clip_from_world, draw.centre_m, draw.radius_m).value_or(view.asked);
    const glm::mat4 clip_from_mesh = view.clip_from_world * draw.to_world;
    const BlockSieve sieve(clip_from_mesh, {width, height}, low_offset, high_offset, kSlack, rounding, asked);
    const CornerProjector projector(clip_from_mesh, width, height, asked);
    const std::size_t groups = (draw.vertex_count + kGroup - 1) / kGroup;
    corners_.resize(groups * kGroup);
    projected_.assign(groups, 0);

    const std::uint32_t triangles = draw.index_count / 3;
    const std::span<const std::uint8_t> covered =
        view.hidden != 0 ? scene.covered(draw) : std::span<const std::uint8_t>();
    const std::span<const std::uint8_t> steep = scene.steep().triangles[static_cast<std::size_t>(&draw - scene.draws().data())];
    // An eye sees faces that look up; the others it may see from below.
    const bool by_side = (view.hidden & Covered::kFromEye) != 0;
    const float seen_sign = draw.mirrored ? 1.0f : -1.0f;
    // Beyond these a triangle is outside, by x and y.
    const Four ends_low{low_offset.x, low_offset.y, -INFINITY, -INFINITY};
    const Four ends_high{width + high_offset.x, height + high_offset.y, INFINITY, INFINITY};
    const Corner* corners = corners_.data();
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const TriangleBlock& block = blocks[n];
        if (sieve.leaves_out(block)) continue;
        const auto begin = static_cast<std::uint32_t>(n) * kBlockTriangles;
        const std::uint32_t end = std::min(begin + kBlockTriangles, triangles);
        if (!by_side && end <= covered.size() && all_have(covered.subspan(begin, end - begin), view.hidden)) continue;
        if (occluders && occluders->hide(clip_from_mesh, block.centre, block.half)) continue;
        for (std::size_t k = 3 * std::size_t{begin}; k < 3 * std::size_t{end}; ++k) {
            const std::uint32_t group = (indices[k] - draw.first_vertex) / kGroup;
            if (projected_[group] != 0) continue;
            projected_[group] = 1;
            const std::size_t from = std::size_t{group} * kGroup;
            projector.project(own + from, std::min<std::size_t>(kGroup, draw.vertex_count - from), corners_.data() + from);
        }
        for (std::uint32_t t = begin; t < end; ++t) {
            const bool hidden = t < covered.size() && (covered[t] & view.hidden) != 0;
            if (hidden && !by_side) continue;
            const std::uint32_t* index = indices + 3 * std::size_t{t};
            const Corner& a = corners[index[0] - draw.first_vertex];
            const Corner& b = corners[index[1] - draw.first_vertex];
            const Corner& c = corners[index[2] - draw.first_vertex];
            // Written so that what is not a number stays.
            if ((a.outside & b.outside & c.outside) != 0u) continue;
            const Four at_a = four(&a), at_b = four(&b), at_c = four(&c);
            // The last lane holds bits.
            const Four least = three(smaller(smaller(at_c, at_b), at_a)), most = three(larger(larger(at_c, at_b), at_a));
            if (a.nearer > 0.0f && b.nearer > 0.0f && c.nearer > 0.0f) {
                const float slack = kSlack + rounding * most[2];
                const Four low = least - slack, high = most + slack;
                if (!none((high < ends_low) | (low > ends_high))) continue;
                const float across = high[0] - low[0], down = high[1] - low[1];
                if (turned_away || hidden) {
                    const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
                    const float unsure = 2.0f * slack * (across + high[1] - low[1]);
                    if (turned_away && area * hidden_sign > unsure) continue;
                    if (hidden && area * seen_sign > unsure) continue;
                }
                if (across < 1.0f || down < 1.0f) {
                    const bool met = std::any_of(view.offsets.begin(), view.offsets.end(), [&](const glm::vec2& offset) {
                        return meets(low[0], high[0], offset.x) && meets(low[1], high[1], offset.y);
                    });
                    if (!met) continue;
                }
            } else if (a.nearer == 0.0f && b.nearer == 0.0f && c.nearer == 0.0f) {
                continue;  // behind the eye
            }
            std::copy_n(index, 3, out_indices + 3 * used_);
            out_numbers[used_++] = t | (t < steep.size() && (steep[t] & view.steep) != 0 ? ID_STEEP : 0u);
        }
    }
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

void SeenBinder::draw(const Draw& draw, const SeenRange& range, std::uint32_t instance)
{
    bind(!range.whole());
    if (!range.whole()) {
        vkCmdDrawIndexed(commands_, range.index_count, 1, range.first_index, draw.vertex_offset, instance);
    } else {
        vkCmdDrawIndexed(commands_, draw.index_count, 1, draw.first_index, draw.vertex_offset, instance);
    }
}

}  // namespace petrichor::gpu
