#include "scene/patches/radiosity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/parallel.h"
#include "scene/patches/detail/cells.h"
#include "scene/patches/detail/sampling.h"
#include "scene/patches/lamps.h"
#include "scene/patches/lookup.h"
#include "scene/patches/open_sky.h"
#include "scene/patches/visible_way.h"

namespace petrichor::scene {
namespace {

constexpr float kMostAlbedo = 0.98f;
constexpr std::size_t kRowsAJob = 512;
constexpr float kLeastFactor = 1e-4f;
constexpr int kPairs = 4;
constexpr float kSameWay = 0.7f;  // cosine

// Four floats that one instruction adds: the compiler's own vectors, on any machine.
using Four = float __attribute__((vector_size(16)));

Four four(glm::vec3 v)
{
    return Four{v.x, v.y, v.z, 0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z};
}

// Of what a row's rays meet, by four sums: an addition need not wait for the one before.
Four sum_of_row(const std::vector<Four>& sent, const std::uint16_t* row, std::size_t rays)
{
    Four a{}, b{}, c{}, d{};
    const std::size_t fours = rays - rays % 4;
    for (std::size_t r = 0; r < fours; r += 4) {
        a += sent[row[r]];
        b += sent[row[r + 1]];
        c += sent[row[r + 2]];
        d += sent[row[r + 3]];
    }
    for (std::size_t r = fours; r < rays; ++r) a += sent[row[r]];
    return (a + b) + (c + d);
}

template <class Body>
void over_rows(std::uint32_t count, int threads, const Body& body)
{
    const std::size_t jobs = (count + kRowsAJob - 1) / kRowsAJob;
    parallel_for(jobs, threads, [&](std::size_t job) {
        const auto first = static_cast<std::uint32_t>(job * kRowsAJob);
        const std::uint32_t last =
            std::min(first + static_cast<std::uint32_t>(kRowsAJob), count);
        for (std::uint32_t i = first; i < last; ++i) body(i);
    });
}

SamplePoint sample_of(const Patches& patches, const Triangles& triangles, std::uint32_t patch,
                      std::size_t k)
{
    return sample_point(triangles,
                        patches.samples[std::size_t{patch} * kPatchSamples + k % kPatchSamples]);
}

// The local directions of a row's rays before they are turned about the normal by a patch's own
// angle, and the middle of their strata: enough for a gradient.
std::vector<Four> row_pattern(int rays)
{
    std::vector<Four> pattern;
    for (int r = 0; r < rays; ++r) {
        const float u = (static_cast<float>(r) + 0.5f) / static_cast<float>(rays);
        const auto turn =
            portable_sin_cos(6.283185307179586 * static_cast<double>(kGoldenRatio) * r);
        const float side = std::sqrt(u);
        pattern.push_back(Four{side * static_cast<float>(turn.cosine),
                               side * static_cast<float>(turn.sine), std::sqrt(1.0f - u), 0.0f});
    }
    return pattern;
}

// Radiance a + b . w over the hemisphere whose cosine-weighted moments are `mean` (share of the
// light times direction) about the normal n: E = pi a + 2 pi / 3 b_n, m_n = 2 pi / 3 a + pi / 2 b_n, m_t = pi / 4 b_t,
// for E = 1. What is returned is 2 pi / 3 b.
glm::vec3 gradient_of(glm::vec3 mean, glm::vec3 n)
{
    const float along = glm::dot(mean, n);
    const float b_normal = (along - 2.0f / 3.0f) * (18.0f / std::numbers::pi_v<float>);
    const glm::vec3 b = (mean - n * along) * (4.0f / std::numbers::pi_v<float>) + n * b_normal;
    glm::vec3 gradient = b * (2.0f * std::numbers::pi_v<float> / 3.0f);
    // A radiance below zero nowhere: no more than all of it.
    const float length = std::sqrt(glm::dot(gradient, gradient));
    if (length > 1.0f) gradient = gradient / length;
    return gradient;
}

// Of each patch: the light of the sky above the horizon as it is where it is seen, and the share of its rays that
// leave there.
struct SkyShares {
    std::vector<Four> light;
    std::vector<glm::vec3> moment;  // world
    std::vector<float> share;
};

bool leaves_above(const Patches& patches, std::uint32_t link)
{
    return link >= patches.count && link < patches.count + static_cast<std::uint32_t>(shared::kSkyBins) &&
           shared::sky_bin_above(static_cast<int>(link - patches.count));
}

SkyShares sky_shares(const Patches& patches, const StandingLinks& links, const Relight& input)
{
    SkyShares sky{std::vector<Four>(patches.count, Four{}), std::vector<glm::vec3>(patches.count, glm::vec3(0.0f)),
                  std::vector<float>(patches.count, 0.0f)};
    const std::vector<SkyTexel> coarse = input.sky_above.empty() ? sky_texels(input.sky) : std::vector<SkyTexel>{};
    const OpenSky open(input.sky_above.empty() ? std::span<const SkyTexel>(coarse) : input.sky_above);
    over_rows(patches.count, input.threads, [&](std::uint32_t i) {
        const int rays = links.above[i];
        if (rays == 0) return;
        sky.share[i] = static_cast<float>(rays) / static_cast<float>(patches.rays);
        const OpenSky::Mean seen = open.seen_by(links.front[i], patches.normal[i]);
        if (seen.known) {
            sky.light[i] = Four{seen.light.x, seen.light.y, seen.light.z, seen.light.w};
            sky.moment[i] = seen.moment;
        } else {
            // A slit that none of its bits looks through: by the rays that do.
            const std::uint16_t* row = patches.row(i);
            glm::vec3 mean(0.0f);
            for (int r = 0; r < patches.rays; ++r)
                if (leaves_above(patches, row[r])) mean += input.sky[row[r] - patches.count];
            sky.light[i] = four(mean / static_cast<float>(rays));
            sky.moment[i] = patches.normal[i] * (sky.light[i][3] * 2.0f / 3.0f);
        }
    });
    return sky;
}

constexpr int kOpenLevel = 2;  // of cells that stand in the open

// Light that wide cells are short of, by all rays between them and smaller patches (StandingLinks), to be added to that of their own rays.
// own: of leaves, and none of what else rays meet.
std::vector<Four> by_reciprocity(const Patches& patches, const StandingLinks& links, const std::vector<Four>& own, int threads)
{
    std::vector<Four> more(patches.count, Four{});
    const float share = 1.0f / static_cast<float>(patches.rays);
    over_rows(static_cast<std::uint32_t>(links.wide.size()), threads, [&](std::uint32_t w) {
        const Four sum = sum_of_row(own, patches.row(links.wide[w]), static_cast<std::size_t>(patches.rays));
        const Four mean = sum * Four{share, share, share, share};
        Four light{};
        for (std::uint32_t e = links.first[w]; e < links.first[w + 1]; ++e) {
            const float weight = links.weight[e];
            light += (own[links.sender[e]] - mean) * Four{weight, weight, weight, weight};
        }
        more[links.wide[w]] = light;
    });
    return more;
}

// Of the light of glowing patches what does not come from those that patch i knows as near.
Four glow_beyond(const Relight& input, std::uint32_t i)
{
    const GlowLinks& glow = *input.glow;
    Four sum{};
    for (std::uint32_t g = glow.first[i]; g < glow.first[i + 1]; ++g) {
        const float taken = static_cast<float>(input.near->glow_taken[g]) * (1.0f / 255.0f);
        const float f = glow.factor[g] * (1.0f - taken);
        sum += four(input.emission[glow.senders[glow.sender[g]]]) * Four{f, f, f, f};
    }
    return sum;
}

// Radiosity of the sources of close polygons. sent: of what rays meet; sky above the horizon apart.
std::vector<glm::vec3> near_sends(const Patches& patches, const Relight& input, const StandingLinks& standing,
                                  const std::vector<Four>& sent, const SkyShares& sky, const std::vector<Four>& glow_light)
{
    const NearLinks& near = *input.near;
    const bool glows = input.glow != nullptr && !input.glow->empty() && !near.glow_first.empty();
    std::vector<glm::vec3> sends(near.sources());
    over_rows(static_cast<std::uint32_t>(sends.size()), input.threads, [&](std::uint32_t s) {
        const std::uint16_t* row = near.links.data() + std::size_t{s} * NearLinks::kLinks;
        constexpr float kShare = 1.0f / static_cast<float>(NearLinks::kLinks);
        const std::uint32_t j = near.sender[s];
        Four light = sum_of_row(sent, row, NearLinks::kLinks);
        // Of the sky above it has what its patch has, which is known to more than a few rays, unless it faces
        // another way.
        if (const auto up = static_cast<float>(standing.near_above[s]); up > 0.0f) {
            const bool along = sky.share[j] > 0.0f && glm::dot(near.normal[s], patches.normal[j]) > kSameWay;
            if (along) light += sky.light[j] * Four{up, up, up, up};
            for (std::size_t r = 0; !along && r < NearLinks::kLinks; ++r)
                if (leaves_above(patches, row[r])) light += four(input.sky[row[r] - patches.count]);
        }
        light = light * Four{kShare, kShare, kShare, kShare};
        if (glows) {
            Four glow = glow_light[j];
            for (std::uint32_t g = near.glow_first[s]; g < near.glow_first[s + 1]; ++g) {
                const float more = near.glow_more[g];
                glow += four(input.emission[near.glow_patch[g]]) * Four{more, more, more, more};
            }
            for (int c = 0; c < 3; ++c) light[c] += std::max(glow[c], 0.0f);
        }
        const glm::vec3 falls = glm::vec3(light[0], light[1], light[2]) + input.near_direct[s];
        sends[s] = glm::clamp(input.near_albedo[s], 0.0f, kMostAlbedo) * falls;
        if (!input.near_emission.empty()) sends[s] += input.near_emission[s];
    });
    return sends;
}

}  // namespace

std::vector<glm::vec4> near_texels(const NearLinks& near)
{
    std::vector<glm::vec4> texels;
    texels.reserve(near.entries() * 4);
    for (std::size_t e = 0; e < near.entries(); ++e)
        for (std::size_t c = 0; c < 4; ++c) texels.emplace_back(near.corners[e][c], c == 0 ? near.seen[e] : 0.0f);
    return texels;
}

StandingLinks standing_links(const Patches& patches, const NearLinks* near)
{
    StandingLinks links;
    for (std::size_t s = 0; near != nullptr && s < near->sources(); ++s) {
        const std::uint16_t* row = near->links.data() + s * NearLinks::kLinks;
        links.near_above.push_back(static_cast<std::uint8_t>(std::count_if(
            row, row + NearLinks::kLinks, [&](std::uint16_t link) { return leaves_above(patches, link); })));
    }
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const auto turn = portable_sin_cos(6.283185307179586 * static_cast<double>(row_turn(cell_hash(patches.seed, patches.key[i]))));
        links.turn.emplace_back(static_cast<float>(turn.cosine), static_cast<float>(turn.sine));
        const std::uint16_t* row = patches.row(i);
        links.above.push_back(static_cast<std::uint16_t>(
            std::count_if(row, row + patches.rays, [&](std::uint16_t link) { return leaves_above(patches, link); })));
        links.front.push_back(OpenSky::front_of(patches, i));
    }
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> number(patches.count, kNone);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        if (level_of(patches.key[i]) < kOpenLevel) continue;
        number[i] = static_cast<std::uint32_t>(links.wide.size());
        links.wide.push_back(i);
    }
    const float share = 1.0f / static_cast<float>(patches.rays);
    // Of a ray that a patch of that area sends.
    const auto both_ways = [&](std::uint32_t i, std::uint32_t j, float area_m2) {
        return share * area_m2 / (patches.area_m2[i] + patches.area_m2[j]);
    };
    const auto each = [&](const auto& put) {
        for (const std::uint32_t i : links.wide) {
            const std::uint16_t* row = patches.row(i);
            for (int r = 0; r < patches.rays; ++r)
                if (row[r] < patches.count && patches.area_m2[i] > patches.area_m2[row[r]])
                    put(number[i], row[r], -both_ways(i, row[r], patches.area_m2[i]));
        }
        for (std::uint32_t j = 0; j < patches.count; ++j) {
            const std::uint16_t* row = patches.row(j);
            for (int r = 0; r < patches.rays; ++r)
                if (row[r] < patches.count && number[row[r]] != kNone && patches.area_m2[row[r]] > patches.area_m2[j])
                    put(number[row[r]], j, both_ways(row[r], j, patches.area_m2[j]));
        }
    };
    links.first.assign(links.wide.size() + 1, 0);
    each([&](std::uint32_t w, std::uint32_t, float) { ++links.first[w + 1]; });
    for (std::size_t w = 1; w < links.first.size(); ++w) links.first[w] += links.first[w - 1];
    links.sender.resize(links.first.back());
    links.weight.resize(links.first.back());
    std::vector<std::uint32_t> next(links.first.begin(), links.first.end() - 1);
    each([&](std::uint32_t w, std::uint32_t j, float weight) {
        links.sender[next[w]] = j;
        links.weight[next[w]++] = weight;
    });
    return links;
}

GlowLinks trace_glow(const Patches& patches, const Tracer& tracer,
                     std::span<const std::uint32_t> senders, int threads)
{
    assert(senders.size() <= 4096);
    GlowLinks glow;
    glow.senders.assign(senders.begin(), senders.end());
    if (senders.empty()) return glow;
    const Triangles& triangles = tracer.triangles();
    const float regular = patches.level_cell_m(1);
    struct Entry {
        std::uint32_t sender;
        float factor;
    };
    constexpr std::size_t kNoRay = std::numeric_limits<std::size_t>::max();
    struct Pair {
        std::uint32_t sender;
        float kernel;
        std::size_t ray;
    };
    std::vector<SamplePoint> ends;
    for (const std::uint32_t sender : senders)
        for (std::size_t k = 0; k < kPairs; ++k) ends.push_back(sample_of(patches, triangles, sender, 4 * k + 3));
    std::vector<std::vector<Entry>> rows(patches.count);
    over_rows(patches.count, threads, [&](std::uint32_t i) {
        const glm::vec3 x = patches.position_m[i], n = patches.normal[i];
        std::array<SamplePoint, kPairs> starts;
        for (std::size_t k = 0; k < kPairs; ++k) starts[k] = sample_of(patches, triangles, i, 4 * k + 1);
        std::vector<Pair> pairs;
        std::vector<Ray> rays;
        for (std::uint32_t s = 0; s < senders.size(); ++s) {
            const std::uint32_t j = senders[s];
            if (j == i) continue;
            const float area = patches.area_m2[j];
            const glm::vec3 way = patches.position_m[j] - x;
            const float far2 = glm::dot(way, way);
            // The most that it can be, for patches that are small against their distance.
            if (area < kLeastFactor * std::numbers::pi_v<float> * far2) continue;
            const float size = std::sqrt(patches.area_m2[i]) + std::sqrt(area);
            if (far2 > size * size &&
                (glm::dot(way, n) < -0.7f * std::sqrt(far2) ||
                 glm::dot(way, patches.normal[j]) > 0.7f * std::sqrt(far2)))
                continue;
            for (std::size_t k = 0; k < kPairs; ++k) {
                const SamplePoint& from = starts[k];
                const SamplePoint& to = ends[s * kPairs + k];
                const glm::vec3 d = to.position_m - from.position_m;
                const float r2 = glm::dot(d, d);
                const float cosines = std::max(glm::dot(d, from.normal), 0.0f) *
                                      std::max(-glm::dot(d, to.normal), 0.0f);
                if (!(cosines > 0.0f)) continue;
                const float kernel =
                    cosines / r2 * area / (std::numbers::pi_v<float> * r2 + area);
                if (kernel < kLeastFactor) continue;
                const auto ray = ray_between(from.position_m + from.normal * ray_lift_m(from.position_m, regular),
                                             to.position_m + to.normal * ray_lift_m(to.position_m, regular));
                pairs.push_back({s, kernel, ray ? rays.size() : kNoRay});
                if (ray) rays.push_back(*ray);
            }
        }
        const auto blocked = std::make_unique<bool[]>(rays.size());
        tracer.blocked(rays, {blocked.get(), rays.size()});
        for (std::size_t first = 0, last = 0; first < pairs.size(); first = last) {
            float sum = 0.0f;
            for (; last < pairs.size() && pairs[last].sender == pairs[first].sender; ++last)
                if (pairs[last].ray == kNoRay || !blocked[pairs[last].ray]) sum += pairs[last].kernel;
            const float factor = sum / static_cast<float>(kPairs);
            if (factor >= kLeastFactor) rows[i].push_back({pairs[first].sender, factor});
        }
    });
    glow.first.push_back(0);
    for (const auto& row : rows) {
        for (const Entry& entry : row) {
            glow.sender.push_back(entry.sender);
            glow.factor.push_back(entry.factor);
        }
        glow.first.push_back(static_cast<std::uint32_t>(glow.sender.size()));
    }
    return glow;
}

void add_sun(const Patches& patches, glm::vec3 towards_sun, glm::vec3 illuminance,
             std::vector<glm::vec3>& direct)
{
    const VisibleWay way(towards_sun);
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const float cosine = glm::dot(patches.normal[i], towards_sun);
        if (!(cosine > 0.0f)) continue;
        direct[i] += illuminance * (cosine * way.share(patches.visible[i]));
    }
}

std::vector<std::uint8_t> trace_lamp(const Patches& patches, const Tracer& tracer,
                                     glm::vec3 position_m, float range_m, int threads)
{
    const Triangles& triangles = tracer.triangles();
    const float regular = patches.level_cell_m(1);
    std::vector<std::uint8_t> reached(patches.count, 0);
    over_rows(patches.count, threads, [&](std::uint32_t i) {
        const glm::vec3 way = position_m - patches.position_m[i];
        const float size = patches.level_cell_m(level_of(patches.key[i]));
        if (!(std::sqrt(glm::dot(way, way)) < range_m + size)) return;
        int seen = 0;
        Tracer::Blocker last;
        for (std::size_t k = 0; k < kPairs; ++k) {
            const SamplePoint from = sample_of(patches, triangles, i, 4 * k);
            const glm::vec3 origin =
                from.position_m + from.normal * ray_lift_m(from.position_m, regular);
            const glm::vec3 d = position_m - origin;
            const float length = std::sqrt(glm::dot(d, d));
            if (!(glm::dot(d, from.normal) > 0.0f)) continue;
            const bool blocked = length > kLanternRadius_m &&
                                 tracer.blocked({origin, d / length, length - kLanternRadius_m}, &last);
            seen += blocked ? 0 : 1;
        }
        reached[i] = static_cast<std::uint8_t>(seen * 255 / kPairs);
    });
    return reached;
}

PatchIrradiance relight(const Patches& patches, const Relight& input)
{
    assert(input.albedo.size() == patches.count && input.direct.size() == patches.count);
    assert(input.emission.empty() || input.emission.size() == patches.count);
    assert(input.near == nullptr || (input.near_direct.size() == input.near->sources() &&
                                     input.near_albedo.size() == input.near->sources()));
    assert(input.near == nullptr || input.near_texels.empty() || input.near_texels.size() == 4 * input.near->entries());
    assert(input.near == nullptr || input.standing == nullptr || input.standing->near_above.size() == input.near->sources());
    assert(input.near_emission.empty() || input.near_emission.size() == input.near->sources());
    assert(input.sky.size() == static_cast<std::size_t>(shared::kSkyBins));
    const std::uint32_t count = patches.count;
    const bool glows = input.glow != nullptr && !input.glow->empty();

    // What a patch sends by itself, seen by rows (`own`) and by pairs (`glow_light`).
    const std::size_t met = std::size_t{count} + shared::kSkyBins + 1;
    std::vector<Four> own(met, Four{}), albedo(count), glow_light(count, Four{});
    std::vector<bool> linked(count, false);
    if (glows) {
        for (const std::uint32_t s : input.glow->senders) linked[s] = true;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 rho = glm::clamp(input.albedo[i], 0.0f, kMostAlbedo);
        albedo[i] = Four{rho.x, rho.y, rho.z, 0.0f};
        own[i] = four(rho * input.direct[i]);
        if (!input.emission.empty() && !linked[i]) own[i] += four(input.emission[i]);
    }
    if (glows) {
        over_rows(count, input.threads, [&](std::uint32_t i) {
            Four sum{};
            for (std::uint32_t e = input.glow->first[i]; e < input.glow->first[i + 1]; ++e) {
                const float f = input.glow->factor[e];
                const std::uint32_t j = input.glow->senders[input.glow->sender[e]];
                sum += four(input.emission[j]) * Four{f, f, f, f};
            }
            glow_light[i] = sum;
        });
        for (std::uint32_t i = 0; i < count; ++i) own[i] += albedo[i] * glow_light[i];
    }

    std::vector<Four> sent = own;
    const StandingLinks found = input.standing != nullptr ? StandingLinks{} : standing_links(patches, input.near);
    const StandingLinks& standing = input.standing != nullptr ? *input.standing : found;
    const SkyShares sky = sky_shares(patches, standing, input);
    const std::vector<Four> bright = by_reciprocity(patches, standing, own, input.threads);
    std::vector<Four> reflected(count);  // own, and of the sky above
    for (int s = 0; s < shared::kSkyBins; ++s) {
        const auto bin = static_cast<std::size_t>(s);
        if (!shared::sky_bin_above(s)) sent[count + bin] = four(input.sky[bin]);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const Four share{sky.share[i], sky.share[i], sky.share[i], sky.share[i]};
        reflected[i] = own[i] + albedo[i] * (sky.light[i] * share + bright[i]);
    }
    std::vector<Four> next = sent;
    const auto rays = static_cast<std::size_t>(patches.rays);
    const float share = 1.0f / static_cast<float>(patches.rays);
    const Four shares{share, share, share, share};
    for (int bounce = 0; bounce < input.bounces; ++bounce) {
        over_rows(count, input.threads, [&](std::uint32_t i) {
            next[i] = reflected[i] + albedo[i] * (sum_of_row(sent, patches.row(i), rays) * shares);
        });
        sent.swap(next);
    }

    // The light that falls, and where it comes from.
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 rgb{sent[i][0], sent[i][1], sent[i][2]};
        sent[i] = four(rgb);
    }
    PatchIrradiance result;
    const bool close = input.near != nullptr && !input.near->empty();
    std::vector<glm::vec4> irradiance(count), gradient(count);
    result.radiosity.resize(count);
    const std::vector<Four> pattern = row_pattern(patches.rays);
    const std::vector<float> sizes = lookup_sizes(patches);
    over_rows(count, input.threads, [&](std::uint32_t i) {
        const std::uint16_t* row = patches.row(i);
        // Two sums, as in sum_of_row.
        Four sum{}, sum_odd{}, moment{}, moment_odd{};
        const auto add = [&](std::size_t r, Four& to, Four& way) {
            const Four light = sent[row[r]];
            const float luminance = light[3];
            to += light;
            way += pattern[r] * Four{luminance, luminance, luminance, luminance};
        };
        std::size_t r = 0;
        for (; r + 1 < rays; r += 2) {
            add(r, sum, moment);
            add(r + 1, sum_odd, moment_odd);
        }
        if (r < rays) add(r, sum, moment);
        sum += sum_odd;
        moment += moment_odd;
        const auto all_rays = static_cast<float>(rays);
        const float from_above = sky.share[i] * static_cast<float>(rays);
        sum += sky.light[i] * Four{from_above, from_above, from_above, from_above};
        sum += bright[i] * Four{all_rays, all_rays, all_rays, all_rays};
        for (int c = 0; c < 4; ++c) sum[c] = std::max(sum[c], 0.0f);
        const float all = sum[3];
        glm::vec3 g(0.0f);
        if (all > 0.0f) {
            const glm::vec3 n = patches.normal[i];
            const Tangents f = tangents_of(n);
            const float c = standing.turn[i].x, s = standing.turn[i].y;
            const glm::vec3 by_rays = f.t * (moment[0] * c - moment[1] * s) +
                                      f.b * (moment[0] * s + moment[1] * c) + n * moment[2];
            g = gradient_of((by_rays + sky.moment[i] * from_above) / all, n);
        }
        float open = patches.open[i];
        Four glow_far = glow_light[i];
        const std::uint32_t met_close = close ? input.near->rays_of(i) : 0;
        if (met_close > 0) {
            // What its rays met close by is left to the points themselves.
            const NearLinks& near = *input.near;
            const float left = static_cast<float>(patches.rays) - static_cast<float>(met_close);
            Four nearby{};  // in the order of the entries
            for (std::uint32_t k = near.ray_first[i]; k < near.ray_first[i + 1]; ++k)
                nearby += sent[row[near.rays[k]]];
            const float over = left > 0.5f ? 1.0f / left : 0.0f;
            sum = (sum - nearby) * Four{over, over, over, over};
            open = std::min(1.0f, open * static_cast<float>(patches.rays) * over);
            const float rest = static_cast<float>(patches.rays) * over;
            if (glows && !near.glow_taken.empty())
                glow_far = glow_beyond(input, i) * Four{rest, rest, rest, rest};
            for (int c = 0; c < 3; ++c) sum[c] = std::max(sum[c], 0.0f);  // rounding
        } else {
            sum = sum * shares;
        }
        sum = sum + glow_far;
        irradiance[i] = {sum[0], sum[1], sum[2], open};
        gradient[i] = glm::vec4(g, sizes[i]);
        result.radiosity[i] = {sent[i][0], sent[i][1], sent[i][2]};
    });
    result.irradiance = with_interior(patches, irradiance);
    result.gradient = with_interior(patches, gradient);
    for (std::uint32_t i = 0; i < patches.nodes(); ++i) result.gradient[i].w = sizes[i];
    if (!close) return result;
    const NearLinks& near = *input.near;
    const std::vector<glm::vec3> sends = near_sends(patches, input, standing, sent, sky, glow_light);
    if (input.near_texels.empty()) result.near = near_texels(near);
    const std::span<glm::vec4> texels = input.near_texels.empty() ? std::span(result.near) : input.near_texels;
    for (std::size_t e = 0; e < near.entries(); ++e) {
        const glm::vec3 light = sends[near.source[e]];
        for (int c = 0; c < 3; ++c) texels[4 * e + static_cast<std::size_t>(c) + 1].w = light[c];
    }
    return result;
}

}  // namespace petrichor::scene
