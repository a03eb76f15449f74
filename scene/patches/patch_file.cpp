#include "scene/patches/patch_file.h"

#include <cstring>
#include <type_traits>

#include "base/error.h"
#include "base/hash.h"
#include "scene/patches/detail/nodes.h"

namespace petrichor::scene {
namespace {

constexpr std::uint32_t kMagic = 0x68637470;  // "ptch"
// Counts up whenever cutting or tracing gives other patches, or the file another shape.
constexpr std::uint32_t kVersion = 12;
constexpr std::uint32_t kBack = 0x80000000u;

struct Header {
    std::uint32_t magic = kMagic;
    std::uint32_t version = kVersion;
    float cell_m = 0.0f;
    std::int32_t levels = 0;
    std::int32_t rays = 0;
    std::uint32_t seed = 0;
    std::uint32_t count = 0;
    std::uint32_t interior = 0;
};

struct StoredSample {
    std::uint32_t triangle_and_side;
    float b1, b2;
};

template <class T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    const auto part = std::as_bytes(std::span(values));
    bytes.insert(bytes.end(), part.begin(), part.end());
}

[[noreturn]] void refuse(const std::string& what)
{
    throw Error("patches: kept patches " + what, "Remove them; they are made again.");
}

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T>
    std::vector<T> take(std::size_t count)
    {
        if (count > bytes_.size() / sizeof(T)) refuse("end early");
        std::vector<T> values(count);
        if (count > 0) std::memcpy(values.data(), bytes_.data(), count * sizeof(T));
        bytes_ = bytes_.subspan(count * sizeof(T));
        return values;
    }
    bool done() const { return bytes_.empty(); }

private:
    std::span<const std::byte> bytes_;
};

std::string checksum(std::span<const std::byte> bytes)
{
    Hasher hasher;
    hasher.add_bytes(bytes);
    return hasher.text();
}

constexpr std::size_t kChecksum = 32;

}  // namespace

std::vector<std::byte> patches_to_bytes(const Patches& p)
{
    Header header;
    header.cell_m = p.cell_m;
    header.levels = p.levels;
    header.rays = p.rays;
    header.seed = p.seed;
    header.count = p.count;
    header.interior = p.interior;
    std::vector<std::byte> bytes;
    bytes.reserve(p.links.size() * 2 + std::size_t{p.count} * 320);
    append(bytes, std::vector<Header>{header});
    append(bytes, p.key);
    append(bytes, p.position_m);
    append(bytes, p.normal);
    append(bytes, p.area_m2);
    append(bytes, p.connected);
    append(bytes, p.open);
    append(bytes, p.material);
    append(bytes, p.sky_view);
    append(bytes, p.links);
    append(bytes, p.visible);
    std::vector<StoredSample> samples;
    samples.reserve(p.samples.size());
    for (const PatchSample& s : p.samples)
        samples.push_back({s.triangle | (s.back ? kBack : 0u), s.at.b1, s.at.b2});
    append(bytes, samples);
    const std::string sum = checksum(bytes);
    const auto text = std::as_bytes(std::span(sum));
    bytes.insert(bytes.end(), text.begin(), text.end());
    return bytes;
}

Patches patches_from_bytes(std::span<const std::byte> bytes, std::uint32_t triangles)
{
    if (bytes.size() < sizeof(Header) + kChecksum) refuse("end early");
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != kMagic) refuse("are no patches");
    if (header.version != kVersion) {
        refuse("are of version " + std::to_string(header.version) + ", this program reads " +
               std::to_string(kVersion));
    }
    const auto content = bytes.first(bytes.size() - kChecksum);
    if (std::memcmp(bytes.data() + content.size(), checksum(content).data(), kChecksum) != 0)
        refuse("are damaged: their checksum is another");
    if (header.count > kMostPatches || header.levels < 0 || header.levels > shared::kPatchLevels ||
        header.rays < 16 || header.rays > 1024 || !(header.cell_m >= 0.0f) ||
        header.interior > 16 * kMostPatches)
        refuse("hold sizes out of range");

    Patches p;
    p.cell_m = header.cell_m;
    p.levels = header.levels;
    p.rays = header.rays;
    p.seed = header.seed;
    p.count = header.count;
    p.interior = header.interior;
    const std::size_t nodes = p.nodes(), count = p.count;
    Reader reader(content.subspan(sizeof header));
    p.key = reader.take<shared::PatchKey>(nodes);
    p.position_m = reader.take<glm::vec3>(nodes);
    p.normal = reader.take<glm::vec3>(nodes);
    p.area_m2 = reader.take<float>(nodes);
    p.connected = reader.take<std::uint32_t>(nodes);
    p.open = reader.take<float>(nodes);
    p.material = reader.take<std::uint32_t>(count);
    p.sky_view = reader.take<float>(count);
    p.links = reader.take<std::uint16_t>(count * static_cast<std::size_t>(p.rays));
    p.visible = reader.take<std::array<std::uint32_t, 8>>(count);
    const auto samples = reader.take<StoredSample>(count * kPatchSamples);
    if (!reader.done()) refuse("are longer than their header says");
    for (const std::uint16_t id : p.links) {
        if (id > p.black()) refuse("name patches that are not there");
    }
    p.samples.reserve(samples.size());
    for (const StoredSample& s : samples) {
        if ((s.triangle_and_side & ~kBack) >= triangles)
            refuse("name triangles that the scene does not have");
        p.samples.push_back(
            {s.triangle_and_side & ~kBack, {s.b1, s.b2}, (s.triangle_and_side & kBack) != 0});
    }
    index_nodes(p);
    return p;
}

std::string patches_fingerprint(const std::string& what_rays_see, const PatchOptions& options)
{
    Hasher hasher;
    hasher.add(kVersion);
    hasher.add(what_rays_see);
    hasher.add(options.cell_m);
    hasher.add(options.rays);
    hasher.add(options.split_by_sight);
    hasher.add(options.max_patches);
    hasher.add(options.seed);
    return hasher.text();
}

}  // namespace petrichor::scene
