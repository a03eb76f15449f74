#include "film/scenes/lamps.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"
#include "base/words.h"
#include "film/scenario/lamp_keys.h"
#include "scene/ies.h"
#include "scene/light_shape.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

constexpr std::uint64_t kLargestIes = 1u << 19;

// A picture before a spot, its mean over each texel.
scene::LightProfile read_cookie(const std::filesystem::path& file)
{
    const Image image = texproc::read_image(file, {.space = ColorSpace::Linear});
    scene::LightProfile profile;
    profile.name = file.string();
    profile.picture = true;
    const int side = scene::kLightProfileSide;
    const auto reach = [&](int size, int i) {
        const int first = i * size / side;
        return std::pair{first, std::max((i + 1) * size / side, first + 1)};
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto [left, right] = reach(image.width, x);
            const auto [top, bottom] = reach(image.height, y);
            glm::vec3 sum(0.0f);
            for (int v = top; v < bottom; ++v) {
                for (int u = left; u < right; ++u) {
                    const auto at = (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(u)) *
                                    static_cast<std::size_t>(image.channels);
                    for (int c = 0; c < 3; ++c)
                        sum[c] += image.pixels[at + static_cast<std::size_t>(image.channels < 3 ? 0 : c)];
                }
            }
            const auto count = static_cast<float>((right - left) * (bottom - top));
            profile.texels.push_back(glm::clamp(sum / count, glm::vec3(0.0f), glm::vec3(1.0f)));
        }
    }
    return profile;
}

const scene::LightProperty* find_row(const std::string& name)
{
    for (const scene::LightProperty& row : scene::light_table()) {
        if (row.name == name) return &row;
    }
    return nullptr;
}

// Files become profiles once.
class Profiles {
public:
    Profiles(const std::filesystem::path& folder, scene::Scene& scene) : folder_(folder), scene_(scene)
    {
    }

    void give(const LampOverride& one, scene::Light& light)
    {
        const auto found = made_.find(one.profile);
        if (found == made_.end()) made_[one.profile] = read(one);
        const Made& made = made_[one.profile];
        const bool picture = made.peak_cd <= 0.0f;
        if (light.kind == scene::LightKind::Directional || light.kind == scene::LightKind::Rectangle ||
            light.length_m > 0.0f || (picture && light.kind != scene::LightKind::Spot)) {
            throw Error(one.place + ": " + one.profile + " cannot stand before the lamp " + light.name,
                        picture ? "A picture needs a spot." : "A distribution needs a point or a spot.");
        }
        light.profile = made.index;
        if (!picture && !one.intensity) light.intensity = made.peak_cd;
    }
    std::string fingerprint() const { return made_.empty() ? "" : hasher_.text(); }

private:
    struct Made {
        int index = -1;
        float peak_cd = 0.0f;  ///< 0: a picture
    };

    Made read(const LampOverride& one)
    {
        Made made;
        const std::filesystem::path file = folder_ / one.profile;
        std::string kind = file.extension().string();
        std::transform(kind.begin(), kind.end(), kind.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
        scene::LightProfile profile;
        if (kind == ".ies") {
            const std::string text = read_file(file, one.place + ": photometry", kLargestIes);
            scene::IesLight ies = scene::read_ies(text, file.string());
            made.peak_cd = ies.peak_cd;
            profile = std::move(ies.profile);
        } else {
            profile = read_cookie(file);
        }
        for (const glm::vec3& texel : profile.texels)
            hasher_.add_numbers(std::span<const float>(&texel.x, 3));
        hasher_.add(made.peak_cd);
        made.index = static_cast<int>(scene_.light_profiles.size());
        scene_.light_profiles.push_back(std::move(profile));
        return made;
    }

    const std::filesystem::path& folder_;
    scene::Scene& scene_;
    std::map<std::string, Made> made_;
    Hasher hasher_;
};

void apply(const LampOverride& one, Profiles& profiles, scene::Light& light)
{
    if (one.color) light.color = *one.color;
    if (one.intensity) {
        const float before = scene::light_candela(light);
        light.intensity = light.kind == scene::LightKind::Rectangle && before > 0.0f
                              ? light.intensity * (*one.intensity / before)
                              : *one.intensity;
    }
    if (one.range_m) light.range_m = *one.range_m;
    scene::LightShape shape;
    for (const auto& [name, value] : one.shape) find_row(name)->set(shape, value);
    shape.both_sides = one.both_sides;
    const std::string problem = scene::shape_light(light, shape);
    if (!problem.empty()) {
        throw Error(one.place + ": the lamp " + light.name + ": " + problem,
                    "Correct its shape under [lamps.\"" + one.glob + "\"].");
    }
    if (!one.profile.empty()) profiles.give(one, light);
}

std::string no_match(const LampOverride& one, const std::vector<scene::Light>& lights)
{
    std::vector<std::string> names;
    for (const scene::Light& light : lights) {
        if (std::find(names.begin(), names.end(), light.name) == names.end())
            names.push_back(light.name);
    }
    if (names.size() > 12) {
        names.resize(12);
        names.push_back("...");
    }
    return one.place + ": [lamps.\"" + one.glob + "\"] matches no lamp of the scene; " +
           (names.empty() ? "it has none" : "there are: " + join_words(names));
}

}  // namespace

AppliedLamps apply_lamp_overrides(const std::vector<LampOverride>& overrides,
                                  const std::filesystem::path& folder, scene::Scene& scene)
{
    AppliedLamps applied;
    Profiles profiles(folder, scene);
    for (const LampOverride& one : overrides) {
        bool matched = false;
        for (scene::Light& light : scene.lights) {
            if (!glob_matches(one.glob, light.name)) continue;
            matched = true;
            apply(one, profiles, light);
        }
        if (!matched) applied.unmatched.push_back(no_match(one, scene.lights));
    }
    applied.content = profiles.fingerprint();
    return applied;
}

SunCookies read_sun_cookies(const std::vector<std::string>& files, const std::filesystem::path& folder,
                            scene::Scene& scene)
{
    SunCookies cookies;
    Hasher hasher;
    std::size_t texels = 0;
    for (const scene::LightProfile& profile : scene.light_profiles) texels += profile.texels.size();
    for (const std::string& file : files) {
        if (file.empty() || cookies.of_file.contains(file)) continue;
        if (!std::filesystem::is_regular_file(folder / file))
            throw Error("sun.cookie: there is no picture " + file + " in the scenario's folder",
                        "Name a picture file, beside the scenario or by its path from there.");
        scene::LightProfile profile = read_cookie(folder / file);
        std::vector<glm::vec3>& all = profile.texels;
        std::size_t from = 0;
        for (std::size_t side = scene::kLightProfileSide / 2; side > 0; side /= 2) {
            const std::size_t before = 2 * side, next = all.size();
            for (std::size_t y = 0; y < side; ++y)
                for (std::size_t x = 0; x < side; ++x) {
                    const std::size_t at = from + 2 * y * before + 2 * x;
                    all.push_back(0.25f * (all[at] + all[at + 1] + all[at + before] + all[at + before + 1]));
                }
            from = next;
        }
        for (const glm::vec3& texel : all) hasher.add_numbers(std::span<const float>(&texel.x, 3));
        gpu::SunCookie& cookie = cookies.of_file[file];
        cookie.first_texel = static_cast<int>(texels);
        cookie.mean = all.back();
        texels += all.size();
        scene.light_profiles.push_back(std::move(profile));
    }
    if (!cookies.of_file.empty()) cookies.content = hasher.text();
    return cookies;
}

}  // namespace petrichor::film
