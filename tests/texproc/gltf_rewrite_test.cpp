#include "texproc/gltf/rewrite.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "tests/texproc/textures.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc {
namespace {

using testing::HasSubstr;

TEST(JsonText, WhatIsNotEditedStaysByteForByte)
{
    const std::string text =
        " {\"a\" : 1.50e+0 ,\t\"b\":[ 1,2 , 3.0],\n\"c\":{\"\\u00e9\": null, \"d\" : "
        "\"\\\"x\\n\"}}  ";
    JsonText json = JsonText::parse(text);
    EXPECT_EQ(json.dump(),
              "{\"a\" : 1.50e+0 ,\t\"b\":[ 1,2 , 3.0],\n\"c\":{\"\\u00e9\": null, "
              "\"d\" : \"\\\"x\\n\"}}");
    EXPECT_EQ(json.find("a")->as_number(), 1.5);
    EXPECT_EQ(json.find("c")->find("d")->as_string(), "\"x\n");
    EXPECT_TRUE(json.find("c")->find("\xc3\xa9"));
    json.edit("c").set("d", JsonText::number(7));
    EXPECT_EQ(json.dump(), "{\"a\":1.50e+0,\"b\":[ 1,2 , 3.0],\"c\":{\"\xc3\xa9\":null,\"d\":7}}");
    EXPECT_TRUE(json.edit("c").erase("d"));
    EXPECT_FALSE(json.edit("c").erase("d"));
}

TEST(JsonText, DamageIsAnError)
{
    const std::string deep(100000, '[');
    for (const std::string& text :
         {std::string("{"), std::string("{\"a\"}"), std::string("[1,]"), std::string("[1 2]"),
          std::string("\"\\q\""), std::string("\"\\u00g0\""), std::string("\"a"), std::string(),
          std::string("{} x"), std::string("tru"), deep})
        EXPECT_THROW(JsonText::parse(text), Error) << text.substr(0, 20);
}

class GltfRewrite : public TextureFiles {
protected:
    // Waves as normals, a ramp as roughness, noise as colour.
    std::vector<std::byte> png(int seed, bool normal) const
    {
        std::vector<std::uint8_t> pixels;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int wave = (x * (3 + seed) + y * 5) % 16 - 8;
                if (normal && dents) {
                    const double at = 2.0 * 3.14159265 / side;
                    const double slope_x = 0.1 * std::sin(at * (3 * x + 2 * y)) + 0.1 * std::sin(at * (9 * x - 7 * y) + 1);
                    const double slope_y = 0.1 * std::sin(at * (4 * y - x) + 2) + 0.1 * std::sin(at * (8 * x + 6 * y));
                    for (const double v : {slope_x, slope_y, std::sqrt(1 - slope_x * slope_x - slope_y * slope_y)})
                        pixels.push_back(static_cast<std::uint8_t>(127.5 + 127.5 * v));
                } else if (normal) {
                    for (const int v : {128 + 9 * wave, 128 - 7 * wave, 230})
                        pixels.push_back(static_cast<std::uint8_t>(v));
                } else {
                    for (const int v : {200, dents ? 50 + 120 * ((x + y) % 2) : 40 + 4 * x, metal ? 255 : seed * 20})
                        pixels.push_back(static_cast<std::uint8_t>(v));
                }
            }
        }
        return encode_png8(side, side, 3, pixels);
    }

    // Views: mesh bytes, image 0 (surface), mesh bytes again, images 1 and 2 (normals).
    std::filesystem::path scene(const std::string& materials, const std::string& more = "")
    {
        GltfFile file;
        file.binary = true;
        std::string views;
        const auto add = [&](const std::vector<std::byte>& bytes) {
            file.bin.resize((file.bin.size() + 3) / 4 * 4);
            views += std::string(views.empty() ? "" : ",") +
                     "{\"buffer\":0,\"byteOffset\":" + std::to_string(file.bin.size()) +
                     ",\"byteLength\":" + std::to_string(bytes.size()) + "}";
            file.bin.insert(file.bin.end(), bytes.begin(), bytes.end());
        };
        add(mesh);
        add(png(1, false));
        add(mesh);
        add(png(1, true));
        add(png(4, true));
        file.json = JsonText::parse(
            "{\"asset\":{\"version\":\"2.0\"},\"x\": 1.0e0,\"buffers\":[{\"byteLength\":" +
            std::to_string(file.bin.size()) + "}],\"bufferViews\":[" + views +
            "],\"images\":[{\"bufferView\":1,\"mimeType\":\"image/png\",\"name\":\"surface\"},"
            "{\"bufferView\":3,\"mimeType\":\"image/png\"},"
            "{\"bufferView\":4,\"mimeType\":\"image/png\"}],"
            "\"textures\":[{\"source\":0},{\"source\":1},{\"source\":2}],\"materials\":[" +
            materials + "]" + more + "}");
        file.others.push_back({0x58585858, mesh});
        const auto path = folder / "in.glb";
        write_bytes(path, to_bytes(file));
        return path;
    }
    GltfFile built(const std::filesystem::path& in, GltfBuildOptions options = {})
    {
        options.score = false;
        report = build_gltf(in, folder / "out.glb", options);
        return read_gltf_file(folder / "out.glb");
    }
    static std::size_t index(const JsonText* value) { return value->as_index().value(); }
    // The image that texture `t` shows by KHR_texture_basisu.
    static std::size_t basis(const GltfFile& file, std::size_t t)
    {
        return index(file.json.find("textures")
                         ->at(t)
                         .find("extensions")
                         ->find("KHR_texture_basisu")
                         ->find("source"));
    }
    // A channel of a level, by texel.
    static std::vector<int> channel(const MipTexture& texture, int level, std::size_t c)
    {
        const RawImage image = decode_level(texture, level);
        std::vector<int> to;
        for (std::size_t i = c; i < image.bytes.size();
             i += static_cast<std::size_t>(image.channels))
            to.push_back(std::to_integer<int>(image.bytes[i]));
        return to;
    }
    static MipTexture texture(const GltfFile& file, std::size_t image)
    {
        return decode_texture(image_bytes(file, image), "image");
    }

    int side = 32;
    bool dents = false;  // and chequers of two glosses
    bool metal = false;
    std::vector<std::byte> mesh = [] {
        std::vector<std::byte> bytes;
        for (int i = 0; i < 300; ++i) bytes.push_back(static_cast<std::byte>(i * 37));
        return bytes;
    }();
    GltfBuildReport report;
};

constexpr const char* kOne =
    R"({"normalTexture":{"index":1},"pbrMetallicRoughness":{"roughnessFactor":0.5,)"
    R"("metallicRoughnessTexture":{"index":0}}})";

TEST_F(GltfRewrite, WhatIsNotATextureStaysByteForByte)
{
    const auto in = scene(kOne, R"(,"VENDOR" : [ 1.0, {"a":-0.0}])");
    const GltfFile before = read_gltf_file(in), after = built(in);
    EXPECT_EQ(after.json.find("VENDOR")->dump(), "[ 1.0, {\"a\":-0.0}]");
    EXPECT_EQ(after.json.find("x")->dump(), "1.0e0");
    EXPECT_EQ(view_bytes(after, 0), mesh);
    EXPECT_EQ(view_bytes(after, 2), mesh) << "between two images that went";
    ASSERT_EQ(after.others.size(), 1u);
    EXPECT_EQ(after.others[0].bytes, mesh);
    EXPECT_EQ(index(after.json.find("bufferViews")->at(2).find("byteOffset")) % 4, 0u);
    // Image 2 is used by nobody: it stays what it was.
    EXPECT_EQ(image_bytes(after, 2), image_bytes(before, 2));
    EXPECT_EQ(after.json.find("images")->size(), 3u) << "taken over, not added";
    const std::size_t length = index(after.json.find("buffers")->at(0).find("byteLength"));
    EXPECT_EQ(after.bin.size(), (length + 3) / 4 * 4);
    EXPECT_LT(after.bin.size(), before.bin.size() + 4000);
}

TEST_F(GltfRewrite, TexturesBecomeKtx2WithAllLevels)
{
    const GltfFile after = built(scene(kOne));
    const MipTexture surface = texture(after, basis(after, 0)),
                     normal = texture(after, basis(after, 1));
    for (const MipTexture* made : {&surface, &normal}) {
        EXPECT_EQ(made->levels.size(), 6u);
        EXPECT_EQ(made->format.block, Block::Uastc);
        EXPECT_FALSE(made->srgb);
    }
    EXPECT_FALSE(after.json.find("textures")->at(0).find("source"));
    EXPECT_EQ(after.json.find("extensionsRequired")->dump(), "[\"KHR_texture_basisu\"]");
    EXPECT_EQ(after.json.find("images")->at(0).find("name")->as_string(), "surface");
    // The factor is in the image.
    const JsonText* pbr = after.json.find("materials")->at(0).find("pbrMetallicRoughness");
    EXPECT_FALSE(pbr->find("roughnessFactor"));
    EXPECT_NEAR(channel(surface, 0, 1)[10], (40 + 4 * 10) / 2, 3);
    EXPECT_NEAR(channel(surface, 0, 0)[10], 200, 3) << "occlusion stays";
}

// What the waves lose goes into the roughness, which plain mips do not change.
TEST_F(GltfRewrite, RoughnessTakesUpWhatItsNormalsLose)
{
    const auto in = scene(kOne);
    const auto mean = [&](const char* rule) {
        GltfBuildOptions options;
        options.images.prefilter.rule = rule;
        const GltfFile after = built(in, options);
        double sum = 0;
        const std::vector<int> level = channel(texture(after, basis(after, 0)), 3, 1);
        for (const int v : level) sum += v;
        return sum / static_cast<double>(level.size());
    };
    EXPECT_GT(mean("vmf"), mean("none") + 25);
}

// One texture under two normals is two images; under the same normals one.
TEST_F(GltfRewrite, ATextureWithTwoNormalsBecomesTwo)
{
    const std::string other =
        R"(,{"normalTexture":{"index":2},"pbrMetallicRoughness":{"roughnessFactor":0.5,)"
        R"("metallicRoughnessTexture":{"index":0}}})";
    GltfBuildOptions options;
    options.images.prefilter.rule = "vmf";
    const GltfFile two = built(scene(std::string(kOne) + other), options);
    EXPECT_EQ(two.json.find("images")->size(), 4u);
    EXPECT_EQ(two.json.find("textures")->size(), 4u);
    const auto surface_of = [&](const GltfFile& file, std::size_t material) {
        return basis(file, index(file.json.find("materials")
                                     ->at(material)
                                     .find("pbrMetallicRoughness")
                                     ->find("metallicRoughnessTexture")
                                     ->find("index")));
    };
    EXPECT_NE(surface_of(two, 0), surface_of(two, 1));
    EXPECT_NE(texture(two, surface_of(two, 0)).levels, texture(two, surface_of(two, 1)).levels);
    const GltfFile same = built(scene(std::string(kOne) + "," + kOne));
    EXPECT_EQ(same.json.find("images")->size(), 3u);
    EXPECT_EQ(same.json.find("textures")->size(), 3u);
}

// Normals that are scaled, moved or turned otherwise than the roughness do not belong to it.
TEST_F(GltfRewrite, TransformsDecideWhatBelongsTogether)
{
    const auto plan = [&](const std::string& extra) {
        return plan_images(
            read_gltf_file(
                scene(R"({"normalTexture":{"index":1)" + extra +
                      R"(},"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}}})")),
            true);
    };
    EXPECT_EQ(plan("").recipes.at(1).normal, 1);
    EXPECT_EQ(plan("").recipes.at(0).surface, 0);
    for (const char* extra :
         {R"(,"texCoord":1)", R"(,"extensions":{"KHR_texture_transform":{"scale":[2,2]}})",
          R"(,"extensions":{"KHR_texture_transform":{"rotation":0.5}})"}) {
        for (const ImageRecipe& recipe : plan(extra).recipes) EXPECT_EQ(recipe.normal, -1) << extra;
        EXPECT_FALSE(plan(extra).notes.empty()) << extra;
    }
}

TEST_F(GltfRewrite, AFallbackKeepsTheOldImagesAndFactors)
{
    const auto in = scene(kOne);
    const GltfFile before = read_gltf_file(in);
    GltfBuildOptions options;
    options.fallback = true;
    const GltfFile after = built(in, options);
    EXPECT_EQ(image_bytes(after, 0), image_bytes(before, 0));
    EXPECT_EQ(index(after.json.find("textures")->at(0).find("source")), 0u);
    EXPECT_EQ(basis(after, 1), 3u) << "the slots in their order: normals first";
    EXPECT_EQ(basis(after, 0), 4u);
    EXPECT_FALSE(after.json.find("extensionsRequired"));
    EXPECT_TRUE(
        after.json.find("materials")->at(0).find("pbrMetallicRoughness")->find("roughnessFactor"));
    EXPECT_NEAR(channel(texture(after, 4), 0, 1)[10], 40 + 4 * 10, 3);
}

// What an unknown extension shows, it goes on showing.
TEST_F(GltfRewrite, UnknownUsesKeepTheirImage)
{
    const std::string material =
        R"({"extensions":{"VENDOR_x":{"glowTexture":{"index":1}}},"normalTexture":{"index":1}})";
    const auto in = scene(material);
    const GltfFile before = read_gltf_file(in), after = built(in);
    EXPECT_EQ(image_bytes(after, 1), image_bytes(before, 1));
    EXPECT_EQ(index(after.json.find("textures")->at(1).find("source")), 1u);
    EXPECT_EQ(index(after.json.find("materials")->at(0).find("normalTexture")->find("index")), 3u);
    EXPECT_EQ(basis(after, 3), 3u);
    EXPECT_THAT(report.notes.at(0), HasSubstr("glowTexture"));
}

TEST_F(GltfRewrite, MeshoptPlacesMoveWithTheirBytes)
{
    const auto in = scene(kOne);
    GltfFile file = read_gltf_file(in);
    const std::size_t at = index(file.json.find("bufferViews")->at(2).find("byteOffset"));
    JsonText view = JsonText::parse(
        R"({"buffer":1,"byteLength":9,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
        std::to_string(at) + R"(,"byteLength":300,"count":3,"mode":"ATTRIBUTES"}}})");
    file.json.edit("bufferViews").append(std::move(view));
    file.json.edit("buffers").append(JsonText::parse(R"({"byteLength":9})"));
    write_bytes(in, to_bytes(file));
    const GltfFile after = built(in);
    const JsonText& moved =
        *after.json.find("bufferViews")->at(5).find("extensions")->find("EXT_meshopt_compression");
    const std::size_t now = index(moved.find("byteOffset"));
    EXPECT_LT(now, at);
    EXPECT_TRUE(
        std::equal(mesh.begin(), mesh.end(), after.bin.begin() + static_cast<std::ptrdiff_t>(now)));
    EXPECT_EQ(index(after.json.find("bufferViews")->at(5).find("byteLength")), 9u);
}

TEST_F(GltfRewrite, BytesDoNotDependOnThreads)
{
    const auto in = scene(kOne);
    GltfBuildOptions options;
    options.images.threads = 1;
    const auto one = to_bytes(built(in, options));
    options.images.threads = 3;
    EXPECT_EQ(one, to_bytes(built(in, options)));
}

// The textures of one lobe stay as they would be without: who does not know the extension sees no difference.
TEST_F(GltfRewrite, TwoLobesStandBesideTheOne)
{
    dents = true;
    metal = true;  // where they gain most
    side = 256;
    const auto in = scene(kOne);
    GltfBuildOptions options;
    options.images.prefilter.rule = "picture";
    options.images.prefilter.quick = false;
    const GltfFile one = built(in, options);
    options.images.prefilter.lobes = 2;
    options.images.threads = 1;
    const GltfFile two = built(in, options);
    ASSERT_THAT(two.json.find("extensionsUsed")->dump(), HasSubstr(kTwoLobes)) << testing::PrintToString(report.notes);
    EXPECT_EQ(two.json.find("extensionsRequired")->dump(), "[\"KHR_texture_basisu\"]");
    for (std::size_t t = 0; t < 2; ++t)
        EXPECT_EQ(image_bytes(two, basis(two, t)), image_bytes(one, basis(one, t))) << "texture " << t;
    const JsonText& material = two.json.find("materials")->at(0);
    EXPECT_EQ(material.find("normalTexture")->dump(), one.json.find("materials")->at(0).find("normalTexture")->dump());
    const JsonText& lobes = *material.find("extensions")->find(kTwoLobes);
    ASSERT_EQ(lobes.size(), 3u);
    const auto map = [&](const char* key) { return texture(two, basis(two, index(lobes.find(key)->find("index")))); };
    const MipTexture second = map("secondLobeTexture");
    const MipTexture normals = map("normalTexture"), surface = map("metallicRoughnessTexture");
    EXPECT_EQ(second.levels.size(), 9u);
    EXPECT_EQ(second.format.block, Block::Uastc);
    // Level 0: both are those of the maps.
    for (const std::size_t i : {0u, 100u, 600u}) {
        EXPECT_NEAR(channel(second, 0, 0)[i], channel(normals, 0, 0)[i], 6);
        EXPECT_NEAR(channel(second, 0, 2)[i], channel(surface, 0, 1)[i], 6);
        EXPECT_NEAR(channel(second, 0, 3)[i], 128, 3);
    }
    const auto differ = [](const std::vector<int>& a, const std::vector<int>& b) {
        int sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
        return sum / static_cast<int>(a.size());
    };
    EXPECT_GT(differ(channel(second, 1, 2), channel(surface, 1, 1)), 5) << "two lobes, not one twice";
}

// In full quality a surface is fitted to what it is by its metallic factor and map: what shines alone wants
// other levels than what is diffuse too. Two materials that show the same maps as one and as the other part.
TEST_F(GltfRewrite, MetalAndPaintHaveLevelsOfTheirOwn)
{
    dents = true;
    side = 128;
    GltfBuildOptions options;
    options.images.prefilter.rule = "picture";
    options.images.prefilter.quick = false;
    const auto factor = [&](const char* metallic) {
        std::string material = kOne;
        material.insert(material.find("\"roughnessFactor\""), std::string("\"metallicFactor\":") + metallic + ",");
        return material;
    };
    const auto surface = [&](const char* metallic) {
        const GltfFile file = built(scene(factor(metallic)), options);
        const JsonText& pbr = *file.json.find("materials")->at(0).find("pbrMetallicRoughness");
        return image_bytes(file, basis(file, index(pbr.find("metallicRoughnessTexture")->find("index"))));
    };
    const auto paint = surface("0");
    EXPECT_NE(paint, surface("1"));
    EXPECT_EQ(paint, surface("0.001")) << "less than a fiftieth is none";
    options.images.prefilter.quick = true;
    EXPECT_EQ(surface("0"), surface("1")) << "quick knows no classes";
}

TEST_F(GltfRewrite, MaterialsPartByMetalOnlyWhereTheyAreFittedByIt)
{
    std::string paint = kOne;
    paint.insert(paint.find("\"roughnessFactor\""), "\"metallicFactor\":0,");
    const GltfFile file = read_gltf_file(scene(paint + "," + kOne));
    EXPECT_EQ(plan_images(file, true).recipes.size(), 2u);
    EXPECT_EQ(plan_images(file, true, 1, true).recipes.size(), 4u);
}

// What lets light through, and what has lighting of its own, is shaded with one.
TEST_F(GltfRewrite, TwoLobesAreForOpaqueSurfaces)
{
    const auto slots = [&](const std::string& extra) {
        const std::string material = std::string(kOne).substr(0, std::strlen(kOne) - 1) + extra + "}";
        const ImagePlan plan = plan_images(read_gltf_file(scene(material)), true, 2);
        return std::count_if(plan.slots.begin(), plan.slots.end(), [](const TextureSlot& s) { return !s.like.empty(); });
    };
    EXPECT_EQ(slots(""), 3);
    EXPECT_EQ(slots(R"(,"alphaMode":"MASK")"), 3);
    EXPECT_EQ(slots(R"(,"alphaMode":"BLEND")"), 0);
    EXPECT_EQ(slots(R"(,"extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5}})"), 0);
    EXPECT_EQ(slots(R"(,"extensions":{"PETRICHOR_materials_weather":{"lightingModel":"skin"}})"), 0);
}

TEST_F(GltfRewrite, BadInputIsAnError)
{
    const auto in = scene(kOne);
    EXPECT_THROW(build_gltf(in, in), Error);
    EXPECT_THROW(build_gltf(in, folder / "out.gltf"), Error);
    EXPECT_THROW(build_gltf(folder / "none.glb", folder / "out.glb"), Error);
    const std::vector<std::byte> whole = to_bytes(read_gltf_file(in));
    for (const std::size_t size : {0u, 11u, 19u, 40u, 700u}) {
        write_bytes(in, std::span(whole).first(size));
        EXPECT_THROW(build_gltf(in, folder / "out.glb"), Error) << size;
    }
    EXPECT_THROW(built(scene(R"({"normalTexture":{"index":9}})")), Error);
}

}  // namespace
}  // namespace petrichor::texproc
