#include "film/frames/kept.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

// "camera, weather changed", or "".
std::string what_changed(const FrameParts& then, const FrameParts& now)
{
    if (then.empty()) return "it was written by an older version";
    std::vector<std::string> names;
    for (const auto& [name, hash] : now) {
        const auto found = then.find(name);
        if (found == then.end() || found->second != hash) names.push_back(name);
    }
    for (const auto& [name, hash] : then) {
        if (now.count(name) == 0) names.push_back(name);
    }
    return names.empty() ? "" : join_words(names) + " changed";
}

// The hash that write_frame() took of the beauty, from the pixels of an EXR; "" without a beauty.
std::string beauty_hash_of(const texproc::RawImage& image)
{
    std::size_t at[4];
    for (std::size_t c = 0; c < 4; ++c) {
        const auto& names = image.channel_names;
        const auto found = std::find(names.begin(), names.end(), std::string(1, "RGBA"[c]));
        if (found == names.end()) return "";
        at[c] = static_cast<std::size_t>(found - names.begin());
    }
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const bool half = image.type == texproc::PixelType::F16;
    std::vector<std::uint16_t> beauty(pixels * 4);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t from = i * channels + at[c];
            if (half) {
                std::memcpy(&beauty[4 * i + c], &image.bytes[2 * from], 2);
                continue;
            }
            // With an AOV of full floats beside it the library gives all channels as floats.
            float value = 0.0f;
            std::memcpy(&value, &image.bytes[4 * from], 4);
            beauty[4 * i + c] = glm::packHalf1x16(value);
        }
    }
    Hasher hasher;
    hasher.add_numbers(std::span<const std::uint16_t>(beauty));
    return hasher.text();
}

// Reads the pictures again: a file may have been damaged before its hash was taken.
std::string wrong_with_pixels(const FrameRecord& record, const fs::path& folder)
{
    for (const auto& [name, mark] : record.files) {
        try {
            const texproc::RawImage image = texproc::read_raw(folder / name);
            if (fs::path(name).extension() != ".exr") continue;
            if (beauty_hash_of(image) != record.beauty_hash) return name + " holds other pixels";
        } catch (const Error& error) {
            return error.what();
        }
    }
    return "";
}

}  // namespace

std::string why_again(const std::map<Job, FrameRecord>& records, const Job& job,
                      const FrameParts& parts, const WrittenKinds& kinds, const fs::path& folder,
                      bool verify)
{
    const auto found = records.find(job);
    if (found == records.end()) return "it is not there";
    const FrameRecord& record = found->second;
    if (const std::string changed = what_changed(record.made_from, parts); !changed.empty())
        return changed;
    for (const auto& [wanted, extension] :
         {std::pair(kinds.exr, "exr"), std::pair(kinds.png, "png")}) {
        const std::string name = file_name(job, extension);
        if (wanted && record.files.count(name) == 0) return name + " was not asked for then";
    }
    const std::string wrong = wrong_with_files(record, folder);
    return wrong.empty() && verify ? wrong_with_pixels(record, folder) : wrong;
}

}  // namespace petrichor::film
