#include "film/scenes/texture_entry.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace petrichor::film {
namespace {

constexpr std::uint32_t kMostLevels = 32;
constexpr std::uint32_t kMostTextures = 16;

void add(std::vector<std::byte>& bytes, std::uint32_t value)
{
    bytes.resize(bytes.size() + 4);
    std::memcpy(bytes.data() + bytes.size() - 4, &value, 4);
}

// Takes numbers and runs from the front; `good` falls when there are too few bytes.
struct Reader {
    std::span<const std::byte> rest;
    bool good = true;

    std::uint32_t number()
    {
        std::uint32_t value = 0;
        const auto run = take(4);
        if (good) std::memcpy(&value, run.data(), 4);
        return value;
    }
    std::span<const std::byte> take(std::size_t count)
    {
        good = good && rest.size() >= count;
        if (!good) return {};
        const auto run = rest.first(count);
        rest = rest.subspan(count);
        return run;
    }
};

}  // namespace

TextureEntry entry_of(const std::vector<gpu::Texture>& textures)
{
    TextureEntry entry;
    add(entry.head, static_cast<std::uint32_t>(textures.size()));
    for (const gpu::Texture& texture : textures) {
        for (const auto value :
             {static_cast<std::uint32_t>(texture.format), static_cast<std::uint32_t>(texture.width),
              static_cast<std::uint32_t>(texture.height),
              static_cast<std::uint32_t>(texture.levels().size())}) {
            add(entry.head, value);
        }
    }
    entry.parts.emplace_back(entry.head);
    for (const gpu::Texture& texture : textures) {
        for (const auto& level : texture.levels()) entry.parts.push_back(level);
    }
    return entry;
}

std::optional<std::vector<gpu::Texture>> textures_in(std::span<const std::byte> bytes,
                                                   std::shared_ptr<const void> holder)
{
    Reader reader{bytes};
    const std::uint32_t count = reader.number();
    if (!reader.good || count > kMostTextures) return std::nullopt;
    std::vector<gpu::Texture> textures(count);
    for (gpu::Texture& texture : textures) {
        const std::uint32_t format = reader.number();
        if (format >= static_cast<std::uint32_t>(gpu::kTexelFormatCount)) return std::nullopt;
        texture.format = static_cast<gpu::TexelFormat>(format);
        texture.width = static_cast<int>(reader.number());
        texture.height = static_cast<int>(reader.number());
        const std::uint32_t levels = reader.number();
        if (!reader.good || levels > kMostLevels) return std::nullopt;
        texture.views.resize(levels);
        texture.holder = holder;
    }
    for (gpu::Texture& texture : textures) {
        for (std::size_t k = 0; k < texture.views.size(); ++k) {
            const auto level = reader.take(gpu::texel_bytes(
                texture.format, std::max(1, texture.width >> k), std::max(1, texture.height >> k)));
            if (!reader.good) return std::nullopt;
            texture.views[k] = level;
        }
    }
    if (!reader.rest.empty()) return std::nullopt;
    return textures;
}

}  // namespace petrichor::film
