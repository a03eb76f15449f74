// Buffers packed by meshoptimizer 0.18 and a mesh packed by Draco 1.5.5: what is unpacked is what their
// libraries unpack (a hash of it), and damage is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/gltf/detail/meshopt.h"
#include "scene/gltf/detail/meshopt_views.h"
#include "scene/gltf/gltf.h"
#include "tests/scene/gltf_helpers.h"
#include "tests/support/gltf_builder.h"

namespace petrichor::scene {
namespace {

using testing::HasSubstr;
using testing_gltf::GltfBuilder;

std::vector<std::byte> from_hex(const std::string& hex)
{
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

// FNV-1a.
std::uint64_t hash_of(const std::vector<std::byte>& bytes)
{
    std::uint64_t hash = 1469598103934665603ull;
    for (const std::byte byte : bytes) {
        hash ^= std::to_integer<std::uint64_t>(byte);
        hash *= 1099511628211ull;
    }
    return hash;
}

struct PackedCase {
    const char* name;
    std::size_t count, stride;
    MeshoptMode mode;
    MeshoptFilter filter;
    std::uint64_t hash;
    const char* hex;
};
void PrintTo(const PackedCase& c, std::ostream* out)
{
    *out << c.name;
}

class Meshopt : public testing::TestWithParam<PackedCase> {};

TEST_P(Meshopt, UnpacksAsItsLibraryDoes)
{
    const PackedCase& c = GetParam();
    const auto bytes = unpack_meshopt(from_hex(c.hex), c.count, c.stride, c.mode, c.filter);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(bytes->size(), c.count * c.stride);
    EXPECT_EQ(hash_of(*bytes), c.hash);
}

// Cut short, made longer, every byte changed: refused or unpacked to something, never read past.
TEST_P(Meshopt, SurvivesDamage)
{
    const PackedCase& c = GetParam();
    const std::vector<std::byte> packed = from_hex(c.hex);
    const auto unpack = [&](const std::vector<std::byte>& bytes) {
        return unpack_meshopt(bytes, c.count, c.stride, c.mode, c.filter);
    };
    for (std::size_t size = 0; size < packed.size(); ++size) {
        const std::vector<std::byte> cut(packed.begin(),
                                         packed.begin() + static_cast<std::ptrdiff_t>(size));
        const auto answer = unpack(cut);
        if (answer) {
            EXPECT_NE(hash_of(*answer), c.hash) << size;
        }
    }
    for (std::size_t i = 0; i < packed.size(); ++i) {
        for (const int flip : {1, 128, 255}) {
            auto changed = packed;
            changed[i] ^= static_cast<std::byte>(flip);
            const auto answer = unpack(changed);
            if (answer) {
                EXPECT_EQ(answer->size(), c.count * c.stride);
            }
        }
    }
    EXPECT_FALSE(unpack_meshopt(packed, c.count, 3, c.mode, c.filter));
}

INSTANTIATE_TEST_SUITE_P(
    Table, Meshopt,
    testing::Values(
        PackedCase{"Triangles", 288, 4, MeshoptMode::Triangles, MeshoptFilter::None, 0x3be841d5fcc8c073ull,
                   "e1fe0d3f105f0d6f028f107f12df0ddf02ae019f0d9f029e019f0d1f0d3f9f01373f2f01383f"
                   "1f1a2f2f3f112f7f3f0f8f028f013fbf0f1f5f165e112e6f186e119e112eff154fdf124f013f"
                   "000f0430ff233c7f01307f122f1f4f01343e2001100f140410040f120e040e040e1404111411"
                   "1411142514143b2a142713133e14111517fc1b021316131316fc120211141411130076875667"
                   "78a9866589689801690000"},
        PackedCase{"OddTriangles", 90, 4, MeshoptMode::Triangles, MeshoptFilter::None, 0x2953dd0990543257ull,
                   "e1fffffffffffffffffffffffffffffffffffffffffffffffffffffeffffffff242a37ff6073"
                   "48ff294447ff180307bf3810ff572c049f050bf2463bff0d113eff063528ff2d526dff06034a"
                   "ff203313f9161bff255c5bff5c273aff65035cff513c108f2320ff16173ff34815ff2f02267f"
                   "3974ff75000efb0f6aff09073bff5259ff0a442f86039f1606007687566778a9866589689801"
                   "690000"},
        PackedCase{"Indices", 90, 4, MeshoptMode::Indices, MeshoptFilter::None, 0xd0b31eb76cbb95e7ull,
                   "d148546eed01265753c4010731070f712345960158080a4a341914041e223b0d6b515bb40137"
                   "0d07424066262c360246a50100014f7510061b142b214703452d2f0c112b4d04044c722f4902"
                   "001c1e1b28130f102d0e2e44175f07554227291b00000000"},
        PackedCase{"Attributes", 63, 12, MeshoptMode::Attributes, MeshoptFilter::None, 0xa1deac0fa43515adull,
                   "a00000ff0000ff808040404040ff00ff808040404040ff00ff808040404040ff00ff80804040"
                   "4040ff00ff808040404040ff00ff808040404040ff00ff808040404040005530803c207e7f7e"
                   "0f0803c27f7e7f7e00f0803c7f7e7f7e200f08007f7e00005500000fffffff8080fffffccf33"
                   "f3ff807fff7f7fffff8080ff3cffffc08080ffff7f7fffffff7f7f0003fffcffff8080ffffff"
                   "805500000e0f7c7d7c8f1bc7d87d7e7d7e7b7ef6f07c307d7e7d7e7b7e7d000383e07c7d7c00"
                   "00540c000300ff8000c000308040000c00004011000030007e00800000000000000000000000"
                   "0000000000000000000000000000000000000000000000"},
        PackedCase{"Octahedral8", 40, 4, MeshoptMode::Attributes, MeshoptFilter::Octahedral, 0xda35d15368c9321dull,
                   "a01f00301b57691730c54218374bf3352c543e0b460435716f031e730c144b65a52bffff0000"
                   "2a441c34421549971f002a460637a35d290c47172c3b716f251840044258092fed491f18830a"
                   "405963ffff0000530d34212e56782b002a034343434343434343434343434343434343434300"
                   "0000000000000000000000000000000000000000000000000000000000000000007f81"},
        PackedCase{"Octahedral16", 40, 8, MeshoptMode::Attributes, MeshoptFilter::Octahedral, 0x66b7852b80930217ull,
                   "a01f00ed2476af96fd35268f8cdda49edad30fc3684696d2f62d35fac6cdc36369d3ffff0000"
                   "b23e2db72a96ab6e1a0215514f4015d32614404035702f20359318bacf0000060405091f0096"
                   "6a6882632e9fbe618eb446c6fd73670a38267d8fecf6a90e8911a60e605fffff0000caf3a739"
                   "f2a553d91a024039510f1437511c0424401f310f24550f18c9fd00000504040800002a034343"
                   "4343434343434343434343434343434343000000001519999999999999999999000000000000"
                   "000000000000000000000000000000000000000000000000ff070180"},
        PackedCase{"Quaternion", 40, 8, MeshoptMode::Attributes, MeshoptFilter::Quaternion, 0x536c9cae917dfaccull,
                   "a01f00bd484685d2bda804252584a845d7fdc4c3bc9a4b064f2ce9cc7c187089b9f6ffff0000"
                   "4fe2a45932437d031a04593e49976f9c1214296f2a8feb1ce1071715fbf70000030305100815"
                   "1f00ba0ce522e8adb5a9b7ef9058f95d6052178a35c9906d75ec9ca74a4355d4baffff000066"
                   "033edd76cc85471a07d32104a20d3f8112d740f4f6d8c812db1415bfcb00000e0a11070c1f00"
                   "dc06a3914b71f5289097e7526966695c3800d345d37a7235a800c6da90865affff0000166957"
                   "52ee57d7e72a064ff311f6835f0015160f145f06c5bfda22219711163141440400000000192b"
                   "408936030403411411230042000d000000030000000000000000000000000000000000000000"
                   "0000000000c805df060000fd07"},
        PackedCase{"Exponential", 40, 12, MeshoptMode::Attributes, MeshoptFilter::Exponential, 0xefd7487a069e26d2ull,
                   "a01f0037e989326d19c23eeaaadf51a4f6d33105b53ff7e3189388153bfc9114f9e7fbff0000"
                   "1853637e5889311f004c088978048172142f4b2d887fcc198b1f12010301286a8909a0b36061"
                   "0ca63ffc0000492b2da61a2515018604984002499204800000110000003c0304001800001f00"
                   "7d96458a384f6eb2f4583f4bd20e1c9a95fbe1a6a82d889044da7103e8e0fbffff0000bc3373"
                   "9c213f9ce21f00333a158fac158d942a5b0e7b9a7374149b11141021006e165f138091805129"
                   "fcff0000724041298c450315006180661002126480600000110000003c0304001800001f00a1"
                   "ae8077a934ac3a504012453b038814f7ccd1612bfee8d479da7d358ae071ffff000038ac2698"
                   "30ffb3561f00190c22511f6a236d5a3a51564f112b3e132905025a5f038e6d10233e4e1d39ff"
                   "ff000051129e2b242c411215001861849024908108000000110000003c030400180000000000"
                   "0000000000000000000000000000000000000000f2e42600f2ba2000f2"}),
    [](const auto& test) { return std::string(test.param.name); });

// A grid of 5 x 4 points, 0.5 m apart, its heights (x y mod 3) / 4; normals +y. Positions in 14 bits.
constexpr const char* kDracoGrid =
    "445241434f02020101000000141801180300085ff7f4a96af5a902ff0111ff02fb4102ff0000"
    "0000000100090300000201010903000103010101000f03cd0c35032301106916990908453b76"
    "0c5e152e81012000f0fff77f00e0ffe7ffff3f000000ff1f000480ff0f0000e0ff010000fc7f"
    "004001000000010000f87f000000fc3f0000c0ff0340000080000000fe1f0000c0ff07000000"
    "ff3f000000000000ff3f0000000000000000000000000000000000400e060301000903350317"
    "cd3c03491c8de51a16d41ae52bbf2fc516d4d416df11bf21bf0c1acc11df2bd4c52fd416bf2b"
    "bf1630145b5003ff0000007f0000000102454108";

// Bytes of a view, as floats of an accessor are put down by the builder.
int view_of(GltfBuilder& b, std::vector<std::byte> bytes)
{
    const std::size_t size = bytes.size();
    while (bytes.size() % 4 != 0) bytes.push_back(std::byte{0});
    std::vector<float> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    const int accessor = b.floats("SCALAR", words);
    const int view = b.document["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
    b.document["bufferViews"][static_cast<std::size_t>(view)]["byteLength"] = size;
    b.document["accessors"][static_cast<std::size_t>(accessor)] = {
        {"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
    return view;
}

GltfBuilder draco_grid(const std::vector<std::byte>& packed)
{
    GltfBuilder b;
    const int view = view_of(b, packed);
    const auto accessor = [&b](int component, std::size_t count, const char* type) {
        b.document["accessors"].push_back(
            {{"componentType", component}, {"count", count}, {"type", type}});
        return static_cast<int>(b.document["accessors"].size()) - 1;
    };
    const int mesh = b.mesh(
        {{"attributes", {{"POSITION", accessor(5126, 20, "VEC3")}, {"NORMAL", accessor(5126, 20, "VEC3")}}},
         {"indices", accessor(5125, 72, "SCALAR")},
         {"extensions",
          {{"KHR_draco_mesh_compression",
            {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}});
    b.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    b.node({{"mesh", mesh}});
    return b;
}

TEST(Draco, AMeshComesBackWhole)
{
#ifndef PETRICHOR_DRACO
    GTEST_SKIP() << "this build reads no Draco";
#endif
    const Scene scene = load_gltf(draco_grid(from_hex(kDracoGrid)).glb(), "grid.glb", nullptr);
    scene_files::expect_sound(scene);
    const Primitive& grid = scene.meshes[0].primitives[0];
    EXPECT_EQ(grid.indices.size(), 72u);
    EXPECT_EQ(grid.positions.size(), 20u);
    double area = 0.0;
    for (std::size_t i = 0; i < grid.indices.size(); i += 3) {
        const glm::vec3 a = grid.positions[grid.indices[i]], b = grid.positions[grid.indices[i + 1]],
                        c = grid.positions[grid.indices[i + 2]];
        area += 0.5 * std::abs(static_cast<double>((b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x)));
    }
    EXPECT_NEAR(area, 2.0 * 1.5, 1e-3) << "seen from above";
    for (const glm::vec3& p : grid.positions) {
        const long x = std::lround(p.x / 0.5f), z = std::lround(p.z / 0.5f);
        EXPECT_NEAR(p.y, 0.25f * static_cast<float>(x * z % 3), 1e-3f);
    }
    for (const glm::vec3& normal : grid.normals) EXPECT_GT(normal.y, 0.99f);
}

TEST(Draco, DamageIsRefusedByName)
{
#ifndef PETRICHOR_DRACO
    GTEST_SKIP() << "this build reads no Draco";
#endif
    auto packed = from_hex(kDracoGrid);
    packed.resize(packed.size() / 2);
    try {
        load_gltf(draco_grid(packed).glb(), "grid.glb", nullptr);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("Draco"));
        EXPECT_FALSE(error.fix().empty());
    }
    GltfBuilder b = draco_grid(from_hex(kDracoGrid));
    b.document["accessors"][1]["count"] = 21;
    try {
        load_gltf(b.glb(), "grid.glb", nullptr);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the accessor says 21 of 3"));
    }
}

TEST(MeshoptView, StandsInForItsBytes)
{
    const PackedCase c{"", 63, 12, MeshoptMode::Attributes, MeshoptFilter::None, 0,
                       "a00000ff0000ff808040404040ff00ff808040404040ff00ff808040404040ff00ff80804040"
                       "4040ff00ff808040404040ff00ff808040404040ff00ff808040404040005530803c207e7f7e"
                       "0f0803c27f7e7f7e00f0803c7f7e7f7e200f08007f7e00005500000fffffff8080fffffccf33"
                       "f3ff807fff7f7fffff8080ff3cffffc08080ffff7f7fffffff7f7f0003fffcffff8080ffffff"
                       "805500000e0f7c7d7c8f1bc7d87d7e7d7e7b7ef6f07c307d7e7d7e7b7e7d000383e07c7d7c00"
                       "00540c000300ff8000c000308040000c00004011000030007e00800000000000000000000000"
                       "0000000000000000000000000000000000000000000000"};
    GltfBuilder b;
    const int packed = view_of(b, from_hex(c.hex));
    b.document["bufferViews"].push_back(
        {{"buffer", 1},
         {"byteLength", 756},
         {"byteStride", 12},
         {"extensions",
          {{"EXT_meshopt_compression",
            {{"buffer", 0},
             {"byteOffset", b.document["bufferViews"][static_cast<std::size_t>(packed)]["byteOffset"]},
             {"byteLength", from_hex(c.hex).size()},
             {"byteStride", 12},
             {"count", 63},
             {"mode", "ATTRIBUTES"}}}}}});
    b.document["accessors"].push_back({{"bufferView", b.document["bufferViews"].size() - 1},
                                       {"componentType", 5126},
                                       {"count", 63},
                                       {"type", "VEC3"}});
    const int positions = static_cast<int>(b.document["accessors"].size()) - 1;
    const int mesh = b.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", b.wholes({0, 9, 10, 62, 61, 0})}});
    b.node({{"mesh", mesh}});
    b.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    const Scene scene = load_gltf(b.glb(), "packed.glb", nullptr);
    const Bounds bounds = scene_bounds(scene);
    EXPECT_EQ(bounds.high, glm::vec3(4.0f, 0.75f, 3.0f));
    b.document["bufferViews"].back()["extensions"]["EXT_meshopt_compression"]["count"] = 62;
    EXPECT_THROW(load_gltf(b.glb(), "packed.glb", nullptr), Error);
    b.document["bufferViews"].back()["extensions"]["EXT_meshopt_compression"]["count"] = 1e9;
    b.document["bufferViews"].back()["byteLength"] = 12e9;
    EXPECT_THROW(load_gltf(b.glb(), "packed.glb", nullptr), Error);
}

// Views of all kinds in one run of the child, one of them damaged: the others come back whole.
TEST(MeshoptView, TheChildUnpacksAllOfAFile)
{
    const auto first = from_hex("a01f00301b57691730c54218374bf3352c543e0b460435716f031e730c144b65a52bffff0000"
                                "2a441c34421549971f002a460637a35d290c47172c3b716f251840044258092fed491f18830a"
                                "405963ffff0000530d34212e56782b002a034343434343434343434343434343434343434300"
                                "0000000000000000000000000000000000000000000000000000000000000000007f81");
    auto damaged = first;
    damaged[0] = std::byte{0x55};
    const auto view = [](const std::vector<std::byte>& bytes, MeshoptFilter filter) {
        return MeshoptView{bytes, 40, 4, MeshoptMode::Attributes, filter};
    };
    const std::vector<MeshoptView> views{view(first, MeshoptFilter::Octahedral), view(damaged, MeshoptFilter::None),
                                         view(first, MeshoptFilter::None)};
    const auto unpacked = unpack_meshopt_views(views, "packed.glb");
    ASSERT_EQ(unpacked.size(), 3u);
    for (const std::size_t i : {0u, 2u})
        EXPECT_EQ(unpacked[i], unpack_meshopt(first, 40, 4, MeshoptMode::Attributes, views[i].filter)) << i;
    EXPECT_NE(unpacked[0], unpacked[2]);
    EXPECT_FALSE(unpacked[1]);
}

}  // namespace
}  // namespace petrichor::scene
