#include "texproc/material/prefiltered_maps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "texproc/filter/normal_codes.h"
#include "texproc/material/shipped.h"
#include "texproc/material/surface_class.h"
#include "texproc/prefilter/picture.h"
#include "texproc/prefilter/stored.h"

namespace petrichor::texproc {

namespace {

// These blocks hold numbers between 8-bit codes.
bool between_codes(const OutputRule& rule)
{
    return rule.compression == "bc4" || rule.compression == "bc5";
}

}  // namespace

PrefilteredMaps::PrefilteredMaps(const PlannedMaterial& plan, const SourceMaps& maps, int threads)
    : plan_(plan), maps_(maps)
{
    const auto filtered = [](const PlannedOutput& output) { return output.prefiltered; };
    if (std::none_of(plan.outputs.begin(), plan.outputs.end(), filtered)) return;
    rough_role_ = maps.rough_role();
    choose_options(threads);
    const RawImage &normal = maps.images.at("normal"), &rough = maps.images.at(rough_role_);
    // Lobes are fitted to the level 0 that ships.
    const bool rounds = options_.rule == "overlap" && options_.bits == 8 &&
                        std::none_of(plan.outputs.begin(), plan.outputs.end(), [](const PlannedOutput& output) {
                            return output.prefiltered && output.rule.compression != "none";
                        });
    if (rounds && normal.type != PixelType::U8) normal_ = normals_in_8_bits(normal);
    if (rounds && rough.type != PixelType::U8) rough_ = in_8_bits(rough);
    chains_ = prefilter_raw(this->normal(), this->rough(), options_);
}

namespace {

// Without a map of it nothing is metal.
SurfaceClass class_of(const SourceMaps& maps)
{
    const RawImage* map = maps.find("metallic");
    if (!map) return SurfaceClass::Paint;
    if (map->channels != 1) return SurfaceClass::Both;
    return surface_class(to_image(*map, ColorSpace::Data));
}

}  // namespace

void PrefilteredMaps::choose_options(int threads)
{
    bool joint = false, all_eight = true;
    int bits = 0;
    for (const PlannedOutput& output : plan_.outputs) {
        if (!output.prefiltered) continue;
        // Re-aimed normals are of use only where they are written with the roughness.
        joint = joint || holds(output, "normal");
        bits = std::max(bits, output.rule.bits);
        all_eight = all_eight && output.rule.bits == 8 && !between_codes(output.rule);
    }
    options_ =
        prefilter_options(plan_.recipe->prefilter, {.joint = joint,
                                                    .bits = all_eight ? 8 : 16,
                                                    .smoothness = rough_role_ == "smoothness",
                                                    .threads = threads});
    if (options_.rule == "picture" && !options_.quick) options_.surface = class_of(maps_);
    bits_ = std::min(bits, 16);
}

const RawImage& PrefilteredMaps::normal() const
{
    return normal_ ? *normal_ : maps_.images.at("normal");
}

const RawImage& PrefilteredMaps::rough() const
{
    return rough_ ? *rough_ : maps_.images.at(rough_role_);
}

const RawImage* PrefilteredMaps::level0(std::size_t number, const std::string& role) const
{
    return normal_ && role == "normal" && holds(plan_.outputs[number], role) ? &*normal_ : nullptr;
}

bool PrefilteredMaps::holds(const PlannedOutput& output, const std::string& role) const
{
    return output.prefiltered &&
           std::find(output.roles.begin(), output.roles.end(), role) != output.roles.end();
}

// Codes that were chosen with the roughness come back as they are.
bool PrefilteredMaps::changes_normals(const PlannedOutput& output) const
{
    return output.rule.compression != "none" || (output.rule.bits == 8 && options_.bits != 8);
}

// The output whose normals are read with the roughness of output `number`: of the same engine, and
// best of the same kind of file.
std::optional<std::size_t> PrefilteredMaps::normals_of(std::size_t number) const
{
    const PlannedOutput& rough = plan_.outputs[number];
    std::optional<std::size_t> best;
    int most = -1;
    for (std::size_t i = 0; i < plan_.outputs.size(); ++i) {
        const PlannedOutput& output = plan_.outputs[i];
        if (!holds(output, "normal")) continue;
        const int fits = 2 * (output.rule.folder == rough.rule.folder) +
                         (output.rule.format == rough.rule.format);
        if (fits > most) {
            most = fits;
            best = i;
        }
    }
    return best;
}

std::vector<std::size_t> PrefilteredMaps::order() const
{
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < plan_.outputs.size(); ++i) numbers.push_back(i);
    if (rough_role_.empty()) return numbers;
    // Base colours last: whether they are darkened is known when roughness was looked at.
    std::stable_sort(numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) {
        const auto turn = [&](std::size_t i) {
            if (holds(plan_.outputs[i], rough_role_)) return 1;
            if (holds(plan_.outputs[i], kSecondLobe)) return 2;  // so is which levels are plain
            const std::vector<std::string>& roles = plan_.outputs[i].roles;
            return std::find(roles.begin(), roles.end(), "albedo") != roles.end() ? 2 : 0;
        };
        return turn(a) < turn(b);
    });
    return numbers;
}

std::vector<Image> PrefilteredMaps::read_back(std::size_t number, const std::string& role,
                                              const std::vector<MadeOutput>& made,
                                              const std::filesystem::path& folder) const
{
    const auto has = [&](const std::string& name) { return maps_.find(name) != nullptr; };
    return shipped_levels(folder, plan_.outputs[number], made[number], role,
                          role == "normal" ? 3 : role == kSecondLobe ? 4 : 1, maps_.images.at("normal").width, has);
}

void PrefilteredMaps::aim(std::size_t number, const std::vector<MadeOutput>& made,
                          const std::filesystem::path& folder)
{
    if (rough_role_.empty() || options_.rule != "overlap") return;
    if (!holds(plan_.outputs[number], rough_role_)) return;
    const std::optional<std::size_t> normals = normals_of(number);
    if (!normals || *normals == number || aimed_.count(*normals) != 0) return;
    if (!changes_normals(plan_.outputs[*normals])) return;
    std::vector<Image> read = read_back(*normals, "normal", made, folder);
    if (read.empty()) return;
    for (std::size_t k = 1; k < read.size(); ++k) {  // above the first level of a smaller output
        if (read[k].empty()) read[k] = chains_.normal[k];
    }
    aimed_[*normals] = aim_roughness(maps_.images.at("normal"), maps_.images.at(rough_role_),
                                     {std::move(read), chains_.roughness, {}, {}, {}}, options_);
}

const std::vector<Image>* PrefilteredMaps::levels(std::size_t number, const std::string& role) const
{
    if (rough_role_.empty() || !holds(plan_.outputs[number], role)) return nullptr;
    if (role == "normal") return &chains_.normal;
    if (role == kSecondLobe) return &second_levels(number);
    if (role != rough_role_) return nullptr;
    if (const auto plain = guarded_.find(number); plain != guarded_.end()) return &plain->second;
    const std::optional<std::size_t> normals = normals_of(number);
    const auto aimed = normals ? aimed_.find(*normals) : aimed_.end();
    return aimed == aimed_.end() ? &chains_.roughness : &aimed->second;
}

namespace {

// RG normal, B roughness of 0..1 whatever the map holds, A share.
Image packed_lobe(const Image& normal, const Image& rough, const Image* share, bool smoothness)
{
    Image to(rough.width, rough.height, 4, ColorSpace::Data, 0.5f);
    const std::size_t step = static_cast<std::size_t>(normal.channels);
    for (std::size_t i = 0; i < rough.pixels.size(); ++i) {
        std::copy_n(&normal.pixels[step * i], 2, &to.pixels[4 * i]);
        to.pixels[4 * i + 2] = smoothness ? 1.0f - rough.pixels[i] : rough.pixels[i];
        if (share) to.pixels[4 * i + 3] = share->pixels[i];
    }
    return to;
}

}  // namespace

RawImage PrefilteredMaps::second_lobe_of_maps() const
{
    return to_raw(packed_lobe(to_image(maps_.images.at("normal"), ColorSpace::Data), maps_.data(rough_role_), nullptr,
                              options_.smoothness),
                  PixelType::U16);
}

// Where levels of the roughness were made plain there is no second lobe.
SecondLobe PrefilteredMaps::second_with(const std::vector<Image>& roughness) const
{
    SecondLobe second = chains_.second;
    for (std::size_t k = 1; k < second.share.size() && k < roughness.size(); ++k) {
        if (roughness[k].pixels == chains_.roughness[k].pixels) continue;
        second.normal[k] = chains_.normal[k];
        second.roughness[k] = roughness[k];
        std::fill(second.share[k].pixels.begin(), second.share[k].pixels.end(), 0.5f);
    }
    return second;
}

const std::vector<Image>& PrefilteredMaps::second_levels(std::size_t number) const
{
    if (const auto made = second_.find(number); made != second_.end()) return made->second;
    // As the roughness of the same folder is.
    const std::vector<Image>* roughness = &chains_.roughness;
    for (const auto& [output, levels] : guarded_)
        if (plan_.outputs[output].rule.folder == plan_.outputs[number].rule.folder) roughness = &levels;
    const SecondLobe second = second_with(*roughness);
    std::vector<Image>& packed = second_[number];
    packed.resize(second.share.size());
    for (std::size_t k = 1; k < packed.size(); ++k)
        packed[k] = packed_lobe(second.normal[k], second.roughness[k], &second.share[k], options_.smoothness);
    return packed;
}

// The second lobe that is read with the roughness of an output: from its file, where that is there.
void PrefilteredMaps::read_second(const std::vector<MadeOutput>& made, const std::filesystem::path& folder,
                                  std::size_t rough, Prefiltered& read) const
{
    if (!has_second_lobe()) return;
    const auto guarded = guarded_.find(rough);
    read.second = second_with(guarded == guarded_.end() ? chains_.roughness : guarded->second);
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (!holds(plan_.outputs[i], kSecondLobe) || made[i].files.empty()) continue;
        if (plan_.outputs[i].rule.folder != plan_.outputs[rough].rule.folder) continue;
        const std::vector<Image> levels = read_back(i, kSecondLobe, made, folder);
        for (std::size_t k = 1; k < levels.size() && k < read.second.share.size(); ++k) {
            if (levels[k].empty()) continue;
            for (std::size_t t = 0; t < read.second.share[k].pixels.size(); ++t) {
                const float* code = &levels[k].pixels[4 * t];
                const float x = 2.0f * code[0] - 1.0f, y = 2.0f * code[1] - 1.0f;
                float* n = &read.second.normal[k].pixels[3 * t];
                n[0] = code[0], n[1] = code[1];
                n[2] = 0.5f + 0.5f * std::sqrt(std::max(1.0f - x * x - y * y, 0.0f));
                read.second.roughness[k].pixels[t] = options_.smoothness ? 1.0f - code[2] : code[2];
                read.second.share[k].pixels[t] = code[3];
            }
        }
    }
}

std::vector<Image> PrefilteredMaps::texel_weights(std::size_t number, std::size_t first) const
{
    const PlannedOutput& output = plan_.outputs[number];
    if (!output.prefiltered || !between_codes(output.rule) || options_.rule != "overlap") return {};
    LobeWeights both = lobe_weights(chains_, options_);
    std::vector<Image> weights;
    if (output.roles == std::vector<std::string>{"normal"}) {
        weights = std::move(both.normal);
    } else if (output.roles == std::vector<std::string>{rough_role_}) {
        weights = std::move(both.roughness);
    } else {
        return {};
    }
    weights.erase(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(first));
    return weights;
}

std::optional<Prefiltered> PrefilteredMaps::shipped(const std::vector<MadeOutput>& made,
                                                    const std::filesystem::path& folder) const
{
    if (rough_role_.empty() || !plan_.recipe->score) return {};
    Prefiltered read;
    for (std::size_t i = 0; i < made.size() && read.roughness.empty(); ++i) {
        if (!holds(plan_.outputs[i], rough_role_)) continue;
        read.roughness = read_back(i, rough_role_, made, folder);
        const std::optional<std::size_t> normals = normals_of(i);
        if (normals && !read.roughness.empty()) {
            read.normal = read_back(*normals, "normal", made, folder);
        }
        if (!read.roughness.empty()) read_second(made, folder, i, read);
    }
    if (read.roughness.empty()) {  // files that are not read back: as their numbers are rounded
        read = chains_;
        quantize(read, bits_);
    }
    if (!options_.joint) read.normal.clear();
    read.base_share = chains_.base_share;
    read.metal_share = chains_.metal_share;
    return read;
}

Score PrefilteredMaps::lobe_error(const Prefiltered& shipped) const
{
    return texproc::score(
        normal(), rough(), shipped, options_,
        {.light = plan_.recipe->prefilter.design_light, .texels = 16, .threads = options_.threads});
}

PictureError PrefilteredMaps::picture_error(const Prefiltered& shipped,
                                            const std::vector<MadeOutput>& made) const
{
    PictureError error{mean_score(bench().score(shipped)), {}};
    for (std::size_t i = 0; i < made.size(); ++i) {  // the output that shipped() read
        if (!holds(plan_.outputs[i], rough_role_)) continue;
        const auto plain = plain_scores_.find(i);
        if (plain == plain_scores_.end()) break;
        error.plain = plain->second;
        return error;
    }
    error.plain = mean_score(bench().score({}));
    return error;
}

const PictureBench& PrefilteredMaps::bench() const
{
    if (!bench_) {
        bench_.emplace(normal(), rough(), options_,
                       build_pictures(options_.threads, options_.surface));
    }
    return *bench_;
}

// Another rule is asked for as it is; 16 bits are as good as floats.
bool PrefilteredMaps::is_guarded(const PlannedOutput& output) const
{
    const OutputRule& rule = output.rule;
    return options_.rule == "picture" && holds(output, rough_role_) && rule.has_levels() &&
           (rule.compression != "none" || rule.bits == 8);
}

Prefiltered PrefilteredMaps::as_read(std::size_t number, const std::vector<MadeOutput>& made,
                                     const std::filesystem::path& folder) const
{
    Prefiltered read;
    read.roughness = read_back(number, rough_role_, made, folder);
    const std::optional<std::size_t> normals = normals_of(number);
    if (normals && !made[*normals].files.empty())
        read.normal = read_back(*normals, "normal", made, folder);
    read.base_share = chains_.base_share;
    read.metal_share = chains_.metal_share;
    read_second(made, folder, number, read);
    return read;
}

void PrefilteredMaps::guard(std::size_t number, std::vector<MadeOutput>& made,
                            const std::filesystem::path& folder,
                            const std::function<MadeOutput()>& write)
{
    if (rough_role_.empty() || !is_guarded(plan_.outputs[number])) return;
    const Prefiltered ours = as_read(number, made, folder);
    if (ours.roughness.empty()) return;  // files that are not read back
    // Blocks hardly ever make plain mips better: what beats those of floats clearly is not written
    // a second time.
    constexpr double kClear = 0.99;
    const PictureScore plain = mean_score(bench().score({})), now = mean_score(bench().score(ours));
    if (now.rmse < kClear * plain.rmse && now.flicker < kClear * plain.flicker) return;
    const std::vector<Image> floats = bench().plain_roughness();
    guarded_[number] = floats;
    made[number] = write();
    const StoredGuard chosen = guard_stored(bench(), ours, as_read(number, made, folder).roughness);
    plain_scores_[number] = chosen.plain_score;
    if (!chosen.darken) {
        chains_.base_share.clear();
        chains_.metal_share.clear();
    }
    std::vector<Image>& levels = guarded_[number];
    for (std::size_t k = 1; k < levels.size(); ++k)
        if (k >= chosen.plain.size() || !chosen.plain[k]) levels[k] = chains_.roughness[k];
    made[number] = write();
}

}  // namespace petrichor::texproc
