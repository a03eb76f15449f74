#include "film/tiles/tiled_picture.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <optional>
#include <span>

#include "base/hash.h"
#include "film/tiles/exposed_light.h"
#include "film/tiles/lens_picture.h"
#include "texproc/codecs/files/exr_strips.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

std::size_t size_of(int a, int b)
{
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(b);
}

// A row of tiles: the picture's own channels, then those of its AOVs.
class Strip {
public:
    Strip(int width, int height, const std::vector<std::string>& aovs) : width_(width), beauty_(4 * size_of(width, height))
    {
        for (const char* name : {"R", "G", "B", "A"})
            channels_.push_back({name, std::vector<std::uint16_t>(size_of(width, height)), {}});
        for (const std::string& aov : aovs) {
            const gpu::AovInfo& info = gpu::aov_table()[gpu::aov_row(aov)];
            const bool floats = info.precision == gpu::AovPrecision::FLOAT;
            for (const char c : info.channels) {
                texproc::ExrChannel channel{aov + "." + c, {}, {}};
                if (floats) {
                    channel.floats.resize(size_of(width, height));
                } else {
                    channel.half_bits.resize(size_of(width, height));
                }
                channels_.push_back(std::move(channel));
            }
        }
    }

    // What of a rendered window is kept.
    void take(const gpu::RenderResult& result, const PlannedTile& tile)
    {
        for (int y = 0; y < tile.kept.height; ++y) {
            const std::size_t from = size_of(tile.kept.y - tile.window.y + y, result.width) +
                                     static_cast<std::size_t>(tile.kept.x - tile.window.x);
            const std::size_t to = size_of(y, width_) + static_cast<std::size_t>(tile.kept.x);
            const auto count = static_cast<std::size_t>(tile.kept.width);
            std::copy_n(&result.beauty[4 * from], 4 * count, &beauty_[4 * to]);
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t c = 0; c < 4; ++c) channels_[c].half_bits[to + i] = result.beauty[4 * (from + i) + c];
            std::size_t next = 4;
            for (const gpu::AovImage& aov : result.aovs) {
                const auto parts = static_cast<std::size_t>(aov.channels);
                for (std::size_t c = 0; c < parts; ++c, ++next) {
                    texproc::ExrChannel& channel = channels_[next];
                    for (std::size_t i = 0; i < count; ++i) {
                        const float value = aov.pixels[(from + i) * parts + c];
                        if (channel.half_bits.empty()) {
                            channel.floats[to + i] = value;
                        } else {
                            channel.half_bits[to + i] = glm::packHalf1x16(value);
                        }
                    }
                }
            }
        }
    }

    std::span<const std::byte> beauty() const { return std::as_bytes(std::span(beauty_)); }
    const std::vector<texproc::ExrChannel>& channels() const { return channels_; }
    std::vector<std::pair<std::string, bool>> kinds() const
    {
        std::vector<std::pair<std::string, bool>> kinds;
        for (const texproc::ExrChannel& channel : channels_) kinds.emplace_back(channel.name, !channel.half_bits.empty());
        return kinds;
    }

private:
    int width_;
    std::vector<std::uint16_t> beauty_;
    std::vector<texproc::ExrChannel> channels_;
};

}  // namespace

TiledPicture render_tiled(gpu::Renderer& renderer, const gpu::Frame& frame, const TilePlan& plan, const TiledFiles& files,
                          const TiledOptions& options)
{
    TiledPicture made;
    const gpu::Frame bare = without_lens(frame);
    std::optional<ExposedLight> light;
    if (!files.png.empty()) light.emplace(files.folder / (files.png + ".light"), plan.width, plan.height);
    std::optional<texproc::ExrStrips> exr;
    PiecewiseHasher hasher(8 * size_of(plan.width, plan.height));
    const std::shared_ptr<gpu::PictureAround> around = renderer.look_around(bare);
    int done = 0;
    for (int row = 0; row < plan.rows; ++row) {
        const gpu::PictureTile kept = tile_at(plan, 0, row).kept;
        Strip strip(plan.width, kept.height, frame.settings.aovs);
        for (int column = 0; column < plan.columns; ++column) {
            if (options.stop && options.stop()) throw Interrupted("interrupted between tiles");
            const PlannedTile tile = tile_at(plan, column, row);
            const gpu::RenderResult result = renderer.render(bare, tile.window, around);
            if (done == 0) {
                made.exposure = result.exposure;
                made.falling = result.falling;
                made.light = result.light;
            }
            strip.take(result, tile);
            for (int y = 0; light && y < tile.kept.height; ++y) {
                const std::size_t from = size_of(tile.kept.y - tile.window.y + y, result.width) +
                                         static_cast<std::size_t>(tile.kept.x - tile.window.x);
                light->put(tile.kept.x, tile.kept.y + y,
                           std::span(result.exposed).subspan(4 * from, 4 * static_cast<std::size_t>(tile.kept.width)));
            }
            ++done;
            if (options.tile_done) options.tile_done(done);
        }
        hasher.add(strip.beauty());
        if (files.exr.empty()) continue;
        if (!exr) exr.emplace(files.folder / files.exr, plan.width, plan.height, strip.kinds(), files.metadata);
        exr->write(kept.height, strip.channels());
    }
    made.beauty_hash = hasher.text();
    if (exr) exr->finish();
    if (light) {
        const LensPicture picture(frame, *light, options.transform, options.threads);
        texproc::write_png8(
            files.folder / files.png, plan.width, plan.height, 3,
            [&](std::size_t first, std::size_t end) { return picture.rows(first, end); }, files.metadata);
    }
    return made;
}

}  // namespace petrichor::film
