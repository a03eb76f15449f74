#include "film/scenes/displacement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include "formulas/weather/mix_sets.h"
#include "scene/subdivide/subdivide.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::film {
namespace {

using glm::vec2;
using glm::vec3;
using scene::TextureUse;

constexpr std::size_t kMostTriangles = 2'000'000;  // of a mesh
constexpr float kCoarser = 1.41421356f;            // edges, where a limit bites
constexpr int kTries = 16;

// One channel of a texture with its levels, each the mean of two by two texels of the one before.
class HeightMap {
public:
    HeightMap(const scene::EncodedImage& source, int channel) : source_(&source)
    {
        const Image image =
            texproc::decode_image(source.bytes, source.name, {.space = ColorSpace::Data});
        Level level{image.width, image.height, {}};
        // Grey pictures hold the same in red, green and blue.
        const int last = image.channels - 1;
        const int kept = image.channels <= 2 ? (channel == 3 ? last : 0) : std::min(channel, last);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) level.values.push_back(image.at(x, y, kept));
        }
        levels_.push_back(std::move(level));
        while (levels_.back().width > 1 || levels_.back().height > 1) add_level();
    }

    // texels: how far apart the places are that are asked.
    float at(vec2 uv, float texels) const
    {
        const float level = std::clamp(std::log2(std::max(texels, 1.0f)), 0.0f,
                                       static_cast<float>(levels_.size() - 1));
        const auto low = static_cast<std::size_t>(level);
        const std::size_t high = std::min(low + 1, levels_.size() - 1);
        return glm::mix(bilinear(levels_[low], uv), bilinear(levels_[high], uv),
                        level - static_cast<float>(low));
    }
    vec2 size() const { return {levels_.front().width, levels_.front().height}; }

private:
    struct Level {
        int width = 1, height = 1;
        std::vector<float> values;
        float at(int x, int y) const
        {
            return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)];
        }
    };

    void add_level()
    {
        const Level& from = levels_.back();
        Level to{std::max(from.width / 2, 1), std::max(from.height / 2, 1), {}};
        for (int y = 0; y < to.height; ++y) {
            for (int x = 0; x < to.width; ++x) {
                const int x1 = std::min(2 * x + 1, from.width - 1);
                const int y1 = std::min(2 * y + 1, from.height - 1);
                const int x0 = std::min(2 * x, x1), y0 = std::min(2 * y, y1);
                to.values.push_back(0.25f * (from.at(x0, y0) + from.at(x1, y0) + from.at(x0, y1) +
                                             from.at(x1, y1)));
            }
        }
        levels_.push_back(std::move(to));
    }

    static int wrapped(int i, int size, scene::Wrap wrap)
    {
        if (wrap == scene::Wrap::Clamp) return std::clamp(i, 0, size - 1);
        const int period = wrap == scene::Wrap::Mirror ? 2 * size : size;
        const int in = ((i % period) + period) % period;
        return in < size ? in : period - 1 - in;
    }

    float bilinear(const Level& level, vec2 uv) const
    {
        const vec2 p = uv * vec2(level.width, level.height) - 0.5f;
        if (!(std::abs(p.x) < 1.0e9f && std::abs(p.y) < 1.0e9f)) return 0.5f;
        const vec2 whole = glm::floor(p);
        const vec2 part = p - whole;
        const auto column = [&](int dx) {
            return wrapped(static_cast<int>(whole.x) + dx, level.width, source_->wrap_u);
        };
        const auto row = [&](int dy) {
            return wrapped(static_cast<int>(whole.y) + dy, level.height, source_->wrap_v);
        };
        return glm::mix(glm::mix(level.at(column(0), row(0)), level.at(column(1), row(0)), part.x),
                        glm::mix(level.at(column(0), row(1)), level.at(column(1), row(1)), part.x),
                        part.y);
    }

    const scene::EncodedImage* source_;
    std::vector<Level> levels_;
};

vec2 placed(const TextureUse& use, vec2 uv)
{
    const float c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
    uv *= use.scale;
    return vec2(c * uv.x + s * uv.y, -s * uv.x + c * uv.y) + use.offset;
}

class Heights {
public:
    explicit Heights(const scene::Scene& scene) : scene_(&scene) {}

    // step: to the next place that is asked, in the coordinates of the mesh.
    float at(const TextureUse& use, const scene::Primitive& p, std::size_t v, vec2 tiling, float step)
    {
        const HeightMap& map = map_of(use);
        const auto& uvs = use.texcoord == 1 && !p.uv1.empty() ? p.uv1 : p.uv0;
        const vec2 texels = glm::abs(tiling * use.scale) * map.size() * step;
        return map.at(placed(use, uvs[v]) * tiling, std::max(texels.x, texels.y));
    }

private:
    const HeightMap& map_of(const TextureUse& use)
    {
        const auto key = std::make_pair(use.texture, static_cast<int>(use.channel));
        auto found = maps_.find(key);
        if (found == maps_.end()) {
            const auto& source = scene_->textures[static_cast<std::size_t>(use.texture)];
            found = maps_.emplace(key, HeightMap(source, key.second)).first;
        }
        return found->second;
    }

    const scene::Scene* scene_;
    std::map<std::pair<int, int>, HeightMap> maps_;
};

bool has_heights(const scene::Material& m)
{
    const bool other = m.second.use == scene::SecondSetUse::Mix && m.second.height.present();
    return m.weather.height.present() || other;
}

bool moves(const scene::Material& m)
{
    return m.displacement.height_m > 0.0f && has_heights(m);
}

bool is_cut(const scene::Scene& scene, const scene::Primitive& p)
{
    const scene::Material& m = scene.materials[p.material];
    return m.displacement.phong > 0.0f || (moves(m) && !p.uv0.empty());
}

// Height at a vertex, 0..1, as the surface pass finds it (gpu/passes/surface/sets.glsl).
float height_of(Heights& heights, const scene::Material& m, const scene::Primitive& p, std::size_t v,
                float step)
{
    const auto read = [&](const TextureUse& use, vec2 tiling, float otherwise) {
        return use.present() ? heights.at(use, p, v, tiling, step) : otherwise;
    };
    const float first = read(m.weather.height, vec2(1.0f), m.weather.default_height);
    if (m.second.use != scene::SecondSetUse::Mix) return first;
    const float other = read(m.second.height, m.second.tiling, m.weather.default_height);
    const float mask = read(m.second.mix_mask, m.second.mix_mask_tiling, 1.0f);
    const float red = p.weather.empty() ? 1.0f : p.weather[v].x;
    const vec2 shares = shared::mix_by_height(
        std::clamp(m.second.mix_factor * red * mask, 0.0f, 1.0f), vec2(first, other));
    return shares.x * first + shares.y * other;
}

// What all primitives of a mesh are cut by: of several materials the finest of each.
struct Rule {
    float edge_m = 1.0e30f, near_m = 0.0f, far_m = 0.0f, phong = 0.0f, most = 1.0f;
};

Rule rule_of(const scene::Scene& scene, const scene::Mesh& mesh)
{
    Rule rule;
    for (const scene::Primitive& p : mesh.primitives) {
        if (!is_cut(scene, p)) continue;
        const scene::Displacement& d = scene.materials[p.material].displacement;
        rule.edge_m = std::min(rule.edge_m, d.edge_m);
        rule.near_m = std::max(rule.near_m, d.near_m);
        rule.far_m = std::max(rule.far_m, d.far_m);
        rule.phong = std::max(rule.phong, d.phong);
        rule.most = std::max(rule.most, d.most);
    }
    return rule;
}

// Distance, in the world, from the nearest eye to a place of a mesh that stands in several places.
class Views {
public:
    Views(const scene::Scene& scene, std::size_t mesh, std::span<const vec3> eyes) : eyes_(eyes)
    {
        for (const scene::Instance& instance : scene.instances) {
            if (instance.mesh == mesh) worlds_.push_back(instance.to_world);
        }
    }
    bool any() const { return !worlds_.empty(); }
    // Metres of a unit of the mesh, where it stands first.
    float scale() const { return std::cbrt(std::abs(glm::determinant(glm::mat3(worlds_[0])))); }

    // 1 near, 0 far (Lux 2.02), of what lies around a place as far as an edge there is long.
    template <class Visit>
    void each(const vec3& p, const vec3& edge, float near_m, float far_m, const Visit& visit) const
    {
        for (const glm::mat4& world : worlds_) {
            const vec3 at(world * glm::vec4(p, 1.0f));
            const float length = glm::length(glm::mat3(world) * edge);
            float nearest = eyes_.empty() ? 0.0f : 1.0e30f;
            for (const vec3& eye : eyes_) nearest = std::min(nearest, glm::distance(at, eye) - length);
            const float share = (nearest - near_m) / std::max(far_m - near_m, 1.0e-6f);
            visit(length, std::clamp(1.0f - share, 0.0f, 1.0f));
        }
    }

private:
    std::span<const vec3> eyes_;
    std::vector<glm::mat4> worlds_;
};

// The mean step of texture coordinates along the edges at each vertex.
std::vector<float> steps_of(const scene::Primitive& p)
{
    std::vector<float> sum(p.positions.size(), 0.0f), count(p.positions.size(), 0.0f);
    if (p.uv0.empty()) return sum;
    for (std::size_t k = 0; k < p.indices.size(); ++k) {
        const std::uint32_t a = p.indices[k];
        const std::uint32_t b = p.indices[k % 3 == 2 ? k - 2 : k + 1];
        const float length = glm::distance(p.uv0[a], p.uv0[b]);
        for (const std::uint32_t v : {a, b}) {
            sum[v] += length;
            count[v] += 1.0f;
        }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1.0f);
    return sum;
}

void move_points(const scene::Scene& scene, scene::CutMesh& cut, Heights& heights, const Views& views)
{
    const std::size_t points = cut.normals.size();
    std::vector<float> lift(points, 0.0f), count(points, 0.0f);
    for (std::size_t i = 0; i < cut.primitives.size(); ++i) {
        const scene::Primitive& p = cut.primitives[i];
        const scene::Material& m = scene.materials[p.material];
        if (!moves(m) || p.uv0.empty()) continue;
        const scene::Displacement& d = m.displacement;
        const std::vector<float> steps = steps_of(p);
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            float near = 0.0f;
            views.each(p.positions[v], vec3(0.0f), d.near_m, d.far_m,
                       [&](float, float share) { near = std::max(near, share); });
            const std::uint32_t point = cut.points[i][v];
            count[point] += 1.0f;
            if (near > 0.0f)
                lift[point] += (height_of(heights, m, p, v, steps[v]) - 0.5f) * d.height_m * near;
        }
    }
    const float unit = 1.0f / std::max(views.scale(), 1.0e-12f);
    for (std::size_t i = 0; i < points; ++i)
        lift[i] = cut.pinned[i] || count[i] == 0.0f ? 0.0f : lift[i] / count[i] * unit;
    for (std::size_t i = 0; i < cut.primitives.size(); ++i) {
        scene::Primitive& p = cut.primitives[i];
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const std::uint32_t point = cut.points[i][v];
            p.positions[v] += cut.normals[point] * lift[point];
        }
    }
    // A normal map holds the slopes of its heights; without one they are those of the new shape, but
    // where the mesh has an edge.
    const std::vector<vec3> normals = scene::point_normals(cut);
    for (std::size_t i = 0; i < cut.primitives.size(); ++i) {
        scene::Primitive& p = cut.primitives[i];
        const scene::Material& m = scene.materials[p.material];
        if (!moves(m) || m.normal_texture.present()) continue;
        for (std::size_t v = 0; v < p.normals.size(); ++v) {
            const std::uint32_t point = cut.points[i][v];
            if (glm::dot(p.normals[v], cut.normals[point]) > 0.9f) p.normals[v] = normals[point];
        }
    }
}

}  // namespace

bool wants_displacement(const scene::Scene& scene)
{
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& m) {
        return m.displacement.height_m > 0.0f || m.displacement.phong > 0.0f;
    });
}

std::vector<std::string> displace(scene::Scene& scene, std::span<const vec3> eyes_m)
{
    std::vector<std::string> notes;
    for (const scene::Material& m : scene.materials) {
        if (m.displacement.height_m > 0.0f && !has_heights(m)) {
            notes.push_back("displacement_m of material \"" + m.name +
                            "\": it has no height_texture, so nothing is displaced");
        }
    }
    Heights heights(scene);
    for (std::size_t number = 0; number < scene.meshes.size(); ++number) {
        scene::Mesh& mesh = scene.meshes[number];
        const Views views(scene, number, eyes_m);
        scene::SubdivideOptions options;
        for (const scene::Primitive& p : mesh.primitives) options.cut.push_back(is_cut(scene, p));
        if (!views.any() || std::find(options.cut.begin(), options.cut.end(), true) == options.cut.end())
            continue;
        const Rule rule = rule_of(scene, mesh);
        options.most_levels = static_cast<int>(std::floor(std::log2(std::max(rule.most, 1.0f))));
        options.most_triangles = kMostTriangles;
        options.phong = rule.phong;
        float edge_m = rule.edge_m;
        options.too_long = [&](const vec3& a, const vec3& b) {
            bool longer = false;
            views.each(0.5f * (a + b), b - a, rule.near_m, rule.far_m,
                       [&](float length, float near) {
                           longer = longer || (near > 0.0f && length * std::max(near, 0.01f) > edge_m);
                       });
            return longer;
        };
        scene::CutMesh cut = scene::subdivide(mesh.primitives, options);
        for (int i = 0; cut.limited && i < kTries; ++i) {
            edge_m *= kCoarser;
            cut = scene::subdivide(mesh.primitives, options);
        }
        if (edge_m != rule.edge_m) {
            char text[160];
            std::snprintf(text, sizeof text,
                          ": edges of %.4g m would be more than %zu triangles; they are %.4g m",
                          static_cast<double>(rule.edge_m), kMostTriangles, static_cast<double>(edge_m));
            notes.push_back("displacement of mesh \"" + mesh.name + "\"" + text);
        }
        move_points(scene, cut, heights, views);
        mesh.primitives = std::move(cut.primitives);
    }
    return notes;
}

}  // namespace petrichor::film
