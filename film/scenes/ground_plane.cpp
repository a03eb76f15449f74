#include "film/scenes/ground_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "formulas/color/srgb.h"
#include "formulas/noise/noise.h"
#include "scene/subdivide/subdivide.h"
#include "texproc/codecs/files/io.h"
#include "texproc/generate/generate.h"

namespace petrichor::film {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kCells = 64;         // a side, of the look from above
constexpr int kHiddenCells = 192;  // likewise, of what hides ground
constexpr int kHalvings = 3;       // of triangles that are hidden in part
constexpr double kFilled = 0.8;    // of them, of a scene with ground
// A plate narrower than this is a thing that lies somewhere: an eye at 1.7 m amid it sees its rim two degrees below the horizon and more,
// and nothing between.
constexpr float kLand_m = 100.0f;
constexpr int kTexels = 1024;      // a side, of the paving or the asphalt
constexpr int kSegments = 128;
constexpr float kNextRing = 1.09f;  // the radius of a ring of vertices over that of the one inside
constexpr float kInnerRing = 0.06f, kFineRings = 40.0f;  // times the scene's size ..
// Where it ends: what ends nearer is a second horizon, what ends farther is all air. For the eye of a framing camera its rim is a pixel
// of 720 rows below the horizon.
constexpr float kOutermostRing = 1150.0f, kLeastOutermost = 300.0f, kHorizon_m = 4000.0f;
constexpr float kFarRing = 2.5f;   // likewise of rings beyond the fine ones
constexpr float kClose = 0.025f;   // of the scene's size: ground so close below it is left out where it is hidden
const vec3 kColor(0.150f, 0.150f, 0.149f);
const vec3 kPaving(0.168f, 0.160f, 0.147f);
// Paving as far as a yard goes, or a few widths of what stands there; then grass: paving out to the horizon is a grey sea. Its rim runs in and out.
constexpr float kYard_m = 24.0f, kYardWidths = 6.0f, kRimBend = 0.16f;
constexpr float kMostYard = 250.0f;  // times the scene's size: of a smaller thing all that is in sight is asphalt
const vec3 kGrass(0.095f, 0.118f, 0.047f);

// Calls back with each of `cells` times `cells` cells that a triangle covers when seen from above.
template <class Covers>
void mark(const std::array<vec2, 3>& t, int cells, const Covers& covers)
{
    const vec2 low = glm::min(glm::min(t[0], t[1]), t[2]);
    const vec2 high = glm::max(glm::max(t[0], t[1]), t[2]);
    const auto clamped = [&](float v) {
        return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(cells - 1)));
    };
    const auto cross = [](vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; };
    for (int z = clamped(low.y); z <= clamped(high.y); ++z) {
        for (int x = clamped(low.x); x <= clamped(high.x); ++x) {
            const vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f);
            const float a = cross(t[1] - t[0], p - t[0]);
            const float b = cross(t[2] - t[1], p - t[1]);
            const float c = cross(t[0] - t[2], p - t[2]);
            if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
                covers(static_cast<std::size_t>(z * cells + x));
        }
    }
    // Triangles smaller than a cell may miss all centres.
    const vec2 middle = (t[0] + t[1] + t[2]) / 3.0f;
    covers(static_cast<std::size_t>(clamped(middle.y) * cells + clamped(middle.x)));
}

constexpr float kNothing = std::numeric_limits<float>::max();

// How a scene looks from above: of each cell of the rectangle around it the height up to which what faces up there comes
// down, of all triangles in it, kNothing where there is none.
struct FromAbove {
    int cells;        // a side
    vec2 low, scale;  // cell = (xz - low) * scale
    std::vector<float> height_m;

    FromAbove(const scene::Scene& scene, const scene::Bounds& content, int cells_a_side)
        : cells(cells_a_side),
          low(content.low.x, content.low.z),
          height_m(static_cast<std::size_t>(cells * cells), kNothing)
    {
        const vec3 size = content.high - content.low;
        scale = static_cast<float>(cells) /
                glm::max(vec2(size.x, size.z), vec2(1e-6f * std::max(size.x, size.z)));
        for (const scene::Instance& instance : scene.instances)
            for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives)
                add(instance, primitive);
    }
    vec2 cell(const vec3& p) const { return (vec2(p.x, p.z) - low) * scale; }

private:
    void add(const scene::Instance& instance, const scene::Primitive& primitive)
    {
        std::vector<vec3> world;
        world.reserve(primitive.positions.size());
        for (const vec3& p : primitive.positions)
            world.emplace_back(instance.to_world * glm::vec4(p, 1.0f));
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const vec3& a = world[primitive.indices[i]];
            const vec3& b = world[primitive.indices[i + 1]];
            const vec3& c = world[primitive.indices[i + 2]];
            const vec3 face = glm::cross(b - a, c - a);
            // Either way up: what winding says is often wrong.
            if (!(std::abs(face.y) > 0.6f * glm::length(face))) continue;
            const std::array<vec2, 3> t{cell(a), cell(b), cell(c)};
            const auto outside = [&](int k) {
                const auto end = static_cast<float>(cells);
                return (t[0][k] < 0 && t[1][k] < 0 && t[2][k] < 0) ||
                       (t[0][k] > end && t[1][k] > end && t[2][k] > end);
            };
            if (outside(0) || outside(1)) continue;
            const float lowest = std::min(a.y, std::min(b.y, c.y));
            mark(t, cells, [&](std::size_t at) { height_m[at] = std::min(height_m[at], lowest); });
        }
    }
};

// Where level ground is hidden by what lies on it: nobody sees it there, and patches could not tell it from that.
class HiddenGround {
public:
    // Hidden is a cell when it and all around it come down to `close_m` over the ground.
    HiddenGround(const scene::Scene& scene, const scene::Bounds& content, float ground_m, float close_m)
        : seen_(scene, content, kHiddenCells)
    {
        const auto lies = [&](int x, int z) {
            if (x < 0 || z < 0 || x >= kHiddenCells || z >= kHiddenCells) return false;
            return seen_.height_m[static_cast<std::size_t>(z * kHiddenCells + x)] - ground_m < close_m;
        };
        for (int z = 0; z < kHiddenCells; ++z) {
            for (int x = 0; x < kHiddenCells; ++x) {
                bool all = true;
                for (int k = 0; k < 9; ++k) all = all && lies(x + k % 3 - 1, z + k / 3 - 1);
                hidden_.push_back(all);
            }
        }
    }
    bool at(const vec3& p) const
    {
        const vec2 c = glm::floor(seen_.cell(p));
        const auto end = static_cast<float>(kHiddenCells);
        if (!(c.x >= 0.0f && c.y >= 0.0f && c.x < end && c.y < end)) return false;
        return hidden_[static_cast<std::size_t>(static_cast<int>(c.y) * kHiddenCells + static_cast<int>(c.x))];
    }

private:
    FromAbove seen_;
    std::vector<bool> hidden_;
};

scene::TextureIndex add_texture(scene::Scene& scene, const char* name, const Image& image)
{
    std::vector<std::uint8_t> bytes(image.pixels.size());
    const bool color = image.space == ColorSpace::Linear;
    for (std::size_t k = 0; k < bytes.size(); ++k) {
        const float v = std::clamp(image.pixels[k], 0.0f, 1.0f);
        bytes[k] = static_cast<std::uint8_t>(
            std::lround(255.0f * (color ? shared::srgb_from_linear(v) : v)));
    }
    scene.textures.push_back(
        {.name = name,
         .bytes = texproc::encode_png8(image.width, image.height, image.channels, bytes)});
    return static_cast<scene::TextureIndex>(scene.textures.size() - 1);
}

// Occlusion, roughness and metallic in one picture, as glTF reads them.
Image packed(const texproc::MaterialMaps& maps)
{
    Image image(maps.roughness.width, maps.roughness.height, 3, ColorSpace::Data);
    for (std::size_t k = 0; k < maps.roughness.pixels.size(); ++k) {
        image.pixels[3 * k] = maps.occlusion.pixels[k];
        image.pixels[3 * k + 1] = maps.roughness.pixels[k];
    }
    return image;
}

// Mean of a square of 2 * half + 1 texels around each, over the edges of the tile.
std::vector<float> blurred(const std::vector<float>& pixels, int size, int channels, int half)
{
    const auto at = [&](int i) { return (i % size + size) % size; };
    const float share = 1.0f / static_cast<float>(2 * half + 1);
    std::vector<float> from = pixels, to(pixels.size());
    for (const bool down : {false, true}) {
        const auto texel = [&](int line, int i, int c) -> std::size_t {
            const int x = down ? line : at(i), y = down ? at(i) : line;
            return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(x)) * static_cast<std::size_t>(channels) +
                   static_cast<std::size_t>(c);
        };
        for (int line = 0; line < size; ++line) {
            for (int c = 0; c < channels; ++c) {
                double sum = 0.0;
                for (int i = -half; i <= half; ++i) sum += static_cast<double>(from[texel(line, i, c)]);
                for (int i = 0; i < size; ++i) {
                    to[texel(line, i, c)] = static_cast<float>(sum) * share;
                    sum += static_cast<double>(from[texel(line, i + half + 1, c)]) -
                           static_cast<double>(from[texel(line, i - half, c)]);
                }
            }
        }
        std::swap(from, to);
    }
    return from;
}

// Takes out what is wider than an eighth of the tile: where the tile is small in the picture that would be
// a lattice.
void level(Image& image)
{
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::vector<float> wide =
        blurred(blurred(image.pixels, image.width, image.channels, image.width / 16), image.width,
                image.channels, image.width / 16);
    std::vector<double> mean(channels);
    for (std::size_t k = 0; k < wide.size(); ++k)
        mean[k % channels] += static_cast<double>(wide[k]) *
                              (static_cast<double>(channels) / static_cast<double>(wide.size()));
    for (std::size_t k = 0; k < wide.size(); ++k)
        image.pixels[k] *= static_cast<float>(mean[k % channels]) / std::max(wide[k], 1e-4f);
}

// Lays a generated material and returns the edge of its square.
float lay(scene::Scene& scene, scene::Material& material, const texproc::MaterialMaps& maps)
{
    material.base_color_texture.texture = add_texture(scene, "colour of the ground", maps.albedo);
    material.normal_texture.texture = add_texture(scene, "relief of the ground", maps.normal);
    material.metallic_roughness_texture.texture =
        add_texture(scene, "gloss of the ground", packed(maps));
    material.occlusion_texture.texture = material.metallic_roughness_texture.texture;
    return maps.tile_m;
}

// Asphalt of some years, bleached: grey enough to show what stands on it and its shadow.
float lay_asphalt(scene::Scene& scene, scene::Material& material)
{
    texproc::MaterialRecipe recipe;
    recipe.kind = texproc::MaterialKind::Asphalt;
    recipe.size = kTexels;
    recipe.seed = 11;
    recipe.values = {{"tile_m", 1.6f}, {"stone_m", 0.007f}, {"wear", 0.5f}, {"cracks", 0.0f},
                     {"stains", 0.0f}};
    recipe.color = kColor;
    texproc::MaterialMaps maps = texproc::generate_material(recipe);
    level(maps.albedo);
    level(maps.roughness);
    return lay(scene, material, maps);
}

// Slabs of stone, as grey: their courses say how large what stands on them is, and their joints how wet they are.
float lay_paving(scene::Scene& scene, scene::Material& material)
{
    texproc::MaterialRecipe recipe;
    recipe.kind = texproc::MaterialKind::Paving;
    recipe.size = kTexels;
    recipe.seed = 5;
    recipe.values = {{"tile_m", 2.4f}, {"stone_width_m", 0.40f}, {"stone_length_m", 0.52f}, {"joint_m", 0.009f}, {"irregularity", 0.3f},
                     {"moss", 0.25f}};
    recipe.color = kPaving;
    return lay(scene, material, texproc::generate_material(recipe));
}

// Where on the square of asphalt a point lies: shifted by up to two squares from place to place, so that no
// lattice of squares is seen. No stretch is above one part in six.
vec2 place_on_square(const vec2& at, float tile_m)
{
    const auto shift = [&](std::uint32_t salt) {
        return 2.0f * shared::tileable_noise(at / (24.0f * tile_m) + 11.3f, 1024, salt);
    };
    return at / tile_m + vec2(shift(521), shift(522));
}

// Stains of all sizes that vertices can carry: on ground of one grain a wide view would be flat.
float stains(const vec2& at, float around)
{
    const float between = (kNextRing - 1.0f) * glm::length(at);
    float tone = 1.0f;
    float wide = 0.15f * around;
    for (std::uint32_t octave = 0; octave < 9; ++octave, wide *= 2.0f) {
        const float shows = glm::smoothstep(2.0f * between, 5.0f * between, wide);
        const float noise = shared::tileable_noise(at / wide + 37.7f, 1024, 401u + octave);
        tone += 0.24f * shows * (noise - 0.5f);
    }
    return std::clamp(tone, 0.6f, 1.4f);
}

// Over the radius of a ring, so many of the rim's: at the rim it runs in and out, and less the farther from there.
float bent_ring(float ring, const vec2& way)
{
    const auto octave = [&](float wide, std::uint32_t salt) { return shared::tileable_noise(wide * way + 53.1f, 1024, salt) - 0.5f; };
    const float bend = octave(1.3f, 541) + 0.5f * octave(4.1f, 542) + 0.25f * octave(11.0f, 543);
    const float near = 1.0f - glm::smoothstep(0.0f, 1.2f, std::abs(std::log(ring)));
    return 1.0f + kRimBend * near * bend;
}

// Grass around the yard, told by its name: it holds water on its blades, and has the fields and hedges of wide ground.
scene::Material meadow(const scene::Material& yard)
{
    scene::Material grass;
    grass.name = "default meadow";
    grass.base_color = glm::vec4(kGrass, 1.0f);
    grass.metallic = 0.0f;
    grass.roughness = 0.9f;
    grass.normal_texture = yard.normal_texture;
    return grass;
}

void lay_backdrop(scene::Scene& scene, const char* name, scene::Primitive ground)
{
    scene::Instance instance;
    instance.name = name;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.backdrop = true;
    scene.meshes.push_back({name, {std::move(ground)}});
    scene.instances.push_back(std::move(instance));
}

// The ground without what of it is hidden, as far as some halvings of its sides tell that. A side is halved for both of its
// triangles: corners of one within a side of the other would be the ends of snow.
scene::Primitive seen_part(scene::Primitive disc, const HiddenGround& hidden)
{
    scene::SubdivideOptions halvings;
    halvings.most_levels = kHalvings;
    halvings.too_long = [&](const vec3& a, const vec3& b) {
        const bool from = hidden.at(a);
        return hidden.at(b) != from || hidden.at(0.5f * (a + b)) != from;
    };
    scene::CutMesh mesh = scene::subdivide({std::move(disc)}, halvings);
    scene::Primitive& cut = mesh.primitives.front();
    std::vector<std::uint32_t> seen;
    for (std::size_t k = 0; k + 2 < cut.indices.size(); k += 3) {
        const std::array<std::uint32_t, 3> t{cut.indices[k], cut.indices[k + 1], cut.indices[k + 2]};
        const std::array<vec3, 3> p{cut.positions[t[0]], cut.positions[t[1]], cut.positions[t[2]]};
        bool all = true;
        for (const vec3& at : {p[0], p[1], p[2], 0.5f * (p[0] + p[1]), 0.5f * (p[1] + p[2]), 0.5f * (p[2] + p[0])})
            all = all && hidden.at(at);
        if (!all) seen.insert(seen.end(), t.begin(), t.end());
    }
    cut.indices = std::move(seen);
    return std::move(cut);
}

}  // namespace

bool brings_ground(const scene::Scene& scene, const scene::Bounds& content)
{
    const vec3 size = content.high - content.low;
    const float width = std::max(size.x, size.z);
    if (!(width >= kLand_m) || size.y > 0.5f * width) return false;
    const FromAbove seen(scene, content, kCells);
    const auto empty = std::count(seen.height_m.begin(), seen.height_m.end(), kNothing);
    const auto cells = static_cast<double>(seen.height_m.size());
    return cells - static_cast<double>(empty) >= kFilled * cells;
}

void add_ground(scene::Scene& scene, const scene::Bounds& content)
{
    const vec3 size = content.high - content.low;
    const float around = std::max(0.5f * glm::length(size), 1e-3f);
    const vec3 centre(0.5f * (content.low.x + content.high.x),
                      content.low.y - 0.0005f * around,
                      0.5f * (content.low.z + content.high.z));
    scene::Material material;
    material.name = "default ground";
    material.weather.beads = 0.0f;
    // Puddles as wide as what stands there, by eye: below a helmet those of a street would be seas.
    material.weather.hollow_tiling = std::clamp(1.6f / around, 1.0f, 5.0f);
    material.weather.flow_tiling = 2.0f * material.weather.hollow_tiling;
    material.weather.flow_normal_strength = 1.0f / material.weather.hollow_tiling;
    scene::Primitive disc;
    const float yard = std::max(kYard_m / around, kYardWidths);
    const bool has_rim = yard < kMostYard;
    const float tile_m = has_rim ? lay_paving(scene, material) : lay_asphalt(scene, material);
    const auto grass = static_cast<std::uint32_t>(scene.materials.size());
    if (has_rim) scene.materials.push_back(meadow(material));
    disc.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    const auto add = [&](const vec2& offset, float tone) {
        disc.positions.push_back(centre + vec3(offset.x, 0.0f, offset.y));
        disc.normals.emplace_back(0.0f, 1.0f, 0.0f);
        disc.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        // v runs towards +z below: the bitangent of +x and +y up is -z.
        disc.uv0.push_back(has_rim ? offset / tile_m : place_on_square(offset, tile_m));
        disc.colors.emplace_back(vec3(tone), 1.0f);
    };
    add(vec2(0.0f), stains(vec2(0.0f), around));
    std::vector<float> rings;
    const float fine = has_rim ? std::max(kFineRings, yard) : kFineRings;
    for (float ring = kInnerRing; ring < fine; ring *= kNextRing) rings.push_back(ring);
    const float outermost = std::clamp(kHorizon_m / around, kLeastOutermost, kOutermostRing);
    std::size_t rim = rings.size();
    if (has_rim) {
        rim = static_cast<std::size_t>(std::lower_bound(rings.begin(), rings.end(), yard) - rings.begin());
        if (rim == rings.size()) rings.push_back(yard);
        for (float ring = kFarRing * rings.back(); ring < outermost; ring *= kFarRing) rings.push_back(ring);
    } else {
        for (float ring = kFineRings; ring < outermost; ring *= kFarRing) rings.push_back(ring);
    }
    rings.push_back(outermost);
    for (std::size_t r = 0; r < rings.size(); ++r) {
        for (int s = 0; s < kSegments; ++s) {
            const float angle = 6.2831853f * static_cast<float>(s) / kSegments;
            const vec2 way(std::cos(angle), std::sin(angle));
            const vec2 at = (rings[r] * (has_rim ? bent_ring(rings[r] / rings[rim], way) : 1.0f)) * around * way;
            add(at, stains(at, around));
        }
    }
    const auto at = [](std::size_t ring, int s) {
        return static_cast<std::uint32_t>(1 + ring * kSegments +
                                          static_cast<std::size_t>(s % kSegments));
    };
    std::vector<std::uint32_t> beyond;  // triangles of grass
    const auto lay = [&](std::size_t ring, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        auto& to = ring >= rim && has_rim ? beyond : disc.indices;
        to.insert(to.end(), {a, b, c});
    };
    for (int s = 0; s < kSegments; ++s) {
        lay(0, 0u, at(0, s + 1), at(0, s));
        for (std::size_t ring = 0; ring + 1 < std::size(rings); ++ring) {
            lay(ring, at(ring, s), at(ring, s + 1), at(ring + 1, s));
            lay(ring, at(ring, s + 1), at(ring + 1, s + 1), at(ring + 1, s));
        }
    }
    if (has_rim) {
        scene::Primitive land = disc;
        land.material = grass;
        land.indices = std::move(beyond);
        // Grass has no mirrors.
        land.weather.assign(land.positions.size(), glm::vec4(1.0f, 0.0f, 1.0f, 1.0f));
        lay_backdrop(scene, "default land", std::move(land));
    }
    disc = seen_part(std::move(disc), HiddenGround(scene, content, centre.y, kClose * around));
    lay_backdrop(scene, "default ground", std::move(disc));
}

}  // namespace petrichor::film
