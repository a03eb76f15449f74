#include "scene/snow/snow_caps_file.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/hash.h"

namespace petrichor::scene {
namespace {

constexpr std::uint32_t kMagic = 0x6b706163;  // "capk"
static_assert(sizeof(SnowCaps::Point) == 38 * sizeof(float), "no padding: bytes are compared");

struct Writer {
    std::vector<std::byte> bytes;

    template <class T>
    void one(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto part = std::as_bytes(std::span(&value, 1));
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    template <class T>
    void list(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        one(static_cast<std::uint64_t>(values.size()));
        const auto part = std::as_bytes(std::span(values));
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
};

struct Reader {
    std::span<const std::byte> left;
    bool good = true;

    template <class T>
    T one()
    {
        T value{};
        good = good && left.size() >= sizeof value;
        if (!good) return value;
        std::memcpy(static_cast<void*>(&value), left.data(), sizeof value);
        left = left.subspan(sizeof value);
        return value;
    }
    template <class T>
    std::vector<T> list()
    {
        const auto count = one<std::uint64_t>();
        good = good && count <= left.size() / sizeof(T);
        if (!good) return {};
        std::vector<T> values(count);
        if (count > 0) std::memcpy(static_cast<void*>(values.data()), left.data(), count * sizeof(T));
        left = left.subspan(count * sizeof(T));
        return values;
    }
};

// Whether the lists of a part fit each other, the caps and the scene.
bool fits(const SnowCaps& caps, const SnowCaps::Part& part, const Scene& scene)
{
    const Primitive& p = part.source;
    const std::size_t corners = p.positions.size();
    if (part.instance >= scene.instances.size()) return false;
    const auto& primitives = scene.meshes[scene.instances[part.instance].mesh].primitives;
    if (part.primitive >= primitives.size() || part.below.size() != part.index_count / 3) return false;
    const std::size_t own = primitives[part.primitive].indices.size() / 3;
    const bool all_there = std::all_of(part.below.begin(), part.below.end(), [own](std::uint32_t below) {
        return below < own || below == SnowCaps::kUncovered;
    });
    return all_there && part.material < scene.materials.size() &&
           part.first_index <= caps.indices.size() &&
           part.index_count <= caps.indices.size() - part.first_index &&
           part.first_corner <= caps.corner_points.size() &&
           corners <= caps.corner_points.size() - part.first_corner && p.normals.size() == corners &&
           p.tangents.size() == corners && p.uv0.size() == corners && p.uv1.size() == corners &&
           p.colors.size() == corners && p.weather.size() == corners;
}

// Whether the pieces have room among the triangles of their parts.
bool fits(const SnowCaps& caps)
{
    std::vector<std::size_t> whole(caps.parts.size(), 0);
    for (const SnowLevels::Piece& piece : caps.levels.pieces) {
        if (piece.part >= caps.parts.size()) return false;
        whole[piece.part] += piece.levels[0].index_count;
        for (const SnowLevels::Range& range : piece.levels) {
            if (range.first_index > caps.levels.indices.size() || range.index_count > caps.levels.indices.size() - range.first_index ||
                range.index_count > piece.levels[0].index_count || range.index_count % 3 != 0)
                return false;
        }
    }
    for (std::size_t i = 0; i < whole.size(); ++i)
        if (whole[i] != caps.parts[i].index_count) return false;
    return true;
}

}  // namespace

std::vector<std::byte> snow_caps_to_bytes(const SnowCaps& caps)
{
    Writer to;
    to.one(kMagic);
    to.one(caps.finest_m);
    to.list(caps.points);
    to.list(caps.corner_points);
    to.list(caps.indices);
    to.one(static_cast<std::uint64_t>(caps.parts.size()));
    for (const SnowCaps::Part& part : caps.parts) {
        for (const std::uint32_t v : {part.material, part.instance, part.first_index, part.index_count,
                                      part.first_corner, part.primitive})
            to.one(v);
        to.list(part.below);
        const Primitive& p = part.source;
        to.list(p.positions);
        to.list(p.normals);
        to.list(p.tangents);
        to.list(p.uv0);
        to.list(p.uv1);
        to.list(p.colors);
        to.list(p.weather);
    }
    to.list(caps.levels.pieces);
    to.list(caps.levels.indices);
    return std::move(to.bytes);
}

std::optional<SnowCaps> snow_caps_from_bytes(std::span<const std::byte> bytes, const Scene& scene)
{
    Reader from{bytes};
    if (from.one<std::uint32_t>() != kMagic) return {};
    SnowCaps caps;
    caps.finest_m = from.one<float>();
    caps.points = from.list<SnowCaps::Point>();
    caps.corner_points = from.list<std::uint32_t>();
    caps.indices = from.list<std::uint32_t>();
    const auto parts = from.one<std::uint64_t>();
    for (std::uint64_t i = 0; i < parts && from.good; ++i) {
        SnowCaps::Part part;
        for (std::uint32_t* v : {&part.material, &part.instance, &part.first_index, &part.index_count,
                                 &part.first_corner, &part.primitive})
            *v = from.one<std::uint32_t>();
        part.below = from.list<std::uint32_t>();
        Primitive& p = part.source;
        p.material = part.material;
        p.positions = from.list<glm::vec3>();
        p.normals = from.list<glm::vec3>();
        p.tangents = from.list<glm::vec4>();
        p.uv0 = from.list<glm::vec2>();
        p.uv1 = from.list<glm::vec2>();
        p.colors = from.list<glm::vec4>();
        p.weather = from.list<glm::vec4>();
        if (!fits(caps, part, scene)) return {};
        caps.parts.push_back(std::move(part));
    }
    caps.levels.pieces = from.list<SnowLevels::Piece>();
    caps.levels.indices = from.list<std::uint32_t>();
    if (!from.good || !from.left.empty() || !fits(caps)) return {};
    const auto all_below = [](const std::vector<std::uint32_t>& list, std::size_t end) {
        return std::all_of(list.begin(), list.end(), [&](std::uint32_t v) { return v < end; });
    };
    if (!all_below(caps.corner_points, caps.points.size()) ||
        !all_below(caps.indices, caps.corner_points.size()) ||
        !all_below(caps.levels.indices, caps.corner_points.size()))
        return {};
    return caps;
}

std::string snow_caps_fingerprint(const std::string& what_rays_see, const Scene& scene,
                                  const SnowCapOptions& options)
{
    Hasher hasher;
    hasher.add(what_rays_see);
    hasher.add_bytes(std::as_bytes(std::span(options.eyes_m)));
    for (const float v : {options.finest_m, options.coarsest_m, options.per_metre, options.reach_m})
        hasher.add(v);
    hasher.add(options.most_triangles);
    for (const Material& m : scene.materials) {
        hasher.add(holds_snow_body(m));
        hasher.add(m.cull_front);
        hasher.add(m.double_sided);
    }
    for (const Instance& instance : scene.instances) {
        hasher.add(instance.stands());
        hasher.add_bytes(std::as_bytes(std::span(&instance.to_world, 1)));
        for (const Primitive& p : scene.meshes[instance.mesh].primitives) {
            hasher.add(p.material);
            hasher.add_bytes(std::as_bytes(std::span(p.positions)));
            hasher.add_bytes(std::as_bytes(std::span(p.indices)));
            hasher.add_bytes(std::as_bytes(std::span(p.tangents)));
            hasher.add_bytes(std::as_bytes(std::span(p.uv0)));
            hasher.add_bytes(std::as_bytes(std::span(p.uv1)));
            hasher.add_bytes(std::as_bytes(std::span(p.colors)));
            hasher.add_bytes(std::as_bytes(std::span(p.weather)));
        }
    }
    return hasher.text();
}

}  // namespace petrichor::scene
