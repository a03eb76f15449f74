// Pixels find the weather of the patch where they lie, and the water of the hollow below them.
#include <cmath>

#include "scene/basins/water.h"
#include "scene/patches/lookup.h"
#include "scene/patches/patches.h"
#include "gpu/place/place_parts.h"
#include "gpu/place/place_tree.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/place_street.h"

namespace petrichor::gpu {
namespace {

class PlaceTest : public GpuTest {
protected:
    // A floor of 4 x 4 m seen from above, and its patches.
    void load_floor()
    {
        floor =
            scene_of({quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4})}, {plain_material(glm::vec3(0.3f))});
        const scene::Triangles triangles(floor, {});
        const scene::Tracer tracer(triangles);
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 32;
        patches = scene::build_patches(tracer, options);
        ASSERT_GT(patches.count, 8u);
        renderer->load(floor, {});
        shape = std::make_shared<PlaceShape>();
        shape->grid = scene::table_grid(patches);
        shape->table = patches.table;
    }
    std::shared_ptr<PlaceWeather> dry() const
    {
        auto place = std::make_shared<PlaceWeather>();
        place->shape = shape;
        place->states.assign(std::size_t{patches.count} * PLACE_STATE_TEXELS, glm::vec4(0.0f));
        for (std::uint32_t i = 0; i < patches.count; ++i)
            place->states[i * PLACE_STATE_TEXELS + 1].z = 1.0f;
        place->levels_m = {0.0f};
        return place;
    }
    Frame from_above(std::shared_ptr<const PlaceWeather> place, int samples = 1) const
    {
        Frame frame;
        frame.camera = look({0, 6, 0}, {0, 0, 0}, 0.7f);
        frame.settings.width = 64;
        frame.settings.height = 64;
        frame.settings.samples = samples;
        frame.settings.aovs = {"depth",
                               "position",
                               "snow",
                               "film",
                               "water",
                               "film_depth",
                               "water_depth",
                               "snow_depth",
                               "ice",
                               "liquid",
                               "surface_temperature",
                               "rain_exposure"};
        frame.place = std::move(place);
        return frame;
    }

    Scene floor;
    scene::Patches patches;
    std::shared_ptr<PlaceShape> shape;
};

TEST_F(PlaceTest, LabelsAreThoseOfThePatchToTheBit)
{
    load_floor();
    auto place = dry();
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const auto f = static_cast<float>(i);
        place->states[i * PLACE_STATE_TEXELS + 2] = {0.1f * f, 0.01f * f, 0.003f * f, 2.0f * f};
        place->states[i * PLACE_STATE_TEXELS + 1].z = 0.25f;
        place->states[i * PLACE_STATE_TEXELS + 3] = {0.5f, 250.0f + f, 0.1f, 1.0f};
    }
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        Frame frame = from_above(place);
        frame.settings.surface_path = path;
        const RenderResult r = renderer->render(frame);
        std::size_t seen = 0;
        for (int y = 2; y < 62; y += 3) {
            for (int x = 2; x < 62; x += 3) {
                if (std::isinf(aov(r, "depth", x, y))) continue;
                const glm::vec3 at(aov(r, "position", x, y, 0), aov(r, "position", x, y, 1),
                                   aov(r, "position", x, y, 2));
                const auto patch = scene::patch_at(patches, at + glm::vec3(0, 0.03f, 0), {0, 1, 0});
                ASSERT_TRUE(patch);
                const auto i = static_cast<float>(*patch);
                EXPECT_EQ(aov(r, "film_depth", x, y), 0.1f * i);
                EXPECT_EQ(aov(r, "water_depth", x, y), 0.01f * i);
                EXPECT_EQ(aov(r, "snow_depth", x, y), 0.003f * i);
                EXPECT_EQ(aov(r, "ice", x, y), 2.0f * i);
                EXPECT_EQ(aov(r, "surface_temperature", x, y), 250.0f + i);
                EXPECT_EQ(aov(r, "rain_exposure", x, y), 0.25f);
                ++seen;
            }
        }
        EXPECT_GT(seen, 200u);
    }
}

TEST_F(PlaceTest, SnowLiesWhereItsPatchesAre)
{
    load_floor();
    auto place = dry();
    for (std::uint32_t i = 0; i < patches.count; ++i)
        if (patches.position_m[i].x < 0.0f) place->states[i * PLACE_STATE_TEXELS].w = 1.0f;
    const RenderResult r = renderer->render(from_above(place, 4));
    EXPECT_GT(aov(r, "snow", 14, 32), 0.8f);
    EXPECT_EQ(aov(r, "snow", 50, 32), 0.0f);
    EXPECT_GT(luminance(pixel(r, 14, 32)), 1.8f * luminance(pixel(r, 50, 32)));
    // Whatever the frame's own weather says: it is the patches' that counts.
    Frame white = from_above(place);
    white.weather.snow_amount = 1.0f;
    EXPECT_EQ(aov(renderer->render(white), "snow", 50, 32), 0.0f);
    white.place = nullptr;
    EXPECT_GT(aov(renderer->render(white), "snow", 50, 32), 0.8f);
}

TEST_F(PlaceTest, FilmsDarkenTheirPatchesOnly)
{
    load_floor();
    auto place = dry();
    for (std::uint32_t i = 0; i < patches.count; ++i)
        if (patches.position_m[i].x < 0.0f) place->states[i * PLACE_STATE_TEXELS].x = 1.0f;
    const RenderResult r = renderer->render(from_above(place, 4));
    EXPECT_NEAR(aov(r, "film", 14, 32), 1.0f, 0.01f);
    EXPECT_EQ(aov(r, "film", 50, 32), 0.0f);
    EXPECT_LT(luminance(pixel(r, 14, 32)), 0.9f * luminance(pixel(r, 50, 32)));
}

// What of the frame's water is frozen tells nothing of a film that patches hold.
TEST_F(PlaceTest, FilmsAreNotFrozenTwice)
{
    load_floor();
    auto place = dry();
    for (std::uint32_t i = 0; i < patches.count; ++i) place->states[i * PLACE_STATE_TEXELS].x = 1.0f;
    Frame frame = from_above(place);
    frame.sky.sun_elevation_rad = 1.4f;
    frame.settings.film_lobe = true;
    const RenderResult thawed = renderer->render(frame);
    frame.weather.water_to_snow = 0.8f;
    const RenderResult frozen = renderer->render(frame);
    for (int x = 8; x < 56; x += 4) EXPECT_EQ(pixel(frozen, x, 32), pixel(thawed, x, 32)) << x;
    frame.place = dry();
    EXPECT_GT(std::abs(luminance(pixel(renderer->render(frame), 32, 32)) - luminance(pixel(thawed, 32, 32))),
              0.01f * luminance(pixel(thawed, 32, 32)));
}

// What moves and what lies beyond the patches has the frame's own film, not that of a closed one.
TEST_F(PlaceTest, WhatHasNoPatchHasTheFilmOfTheFrame)
{
    load_floor();
    renderer->load(scene_of({quad({-2, 0, 2}, {2, 0, 0}, {0, 0, -4}),
                             quad({20, 0, 22}, {4, 0, 0}, {0, 0, -4})},
                            {plain_material(glm::vec3(0.3f))}),
                   {});
    Frame frame = from_above(dry());
    frame.camera = look({22, 6, 20}, {22, 0, 20}, 0.7f);
    EXPECT_EQ(aov(renderer->render(frame), "film", 32, 32), 0.0f);
    frame.weather.film_mm = 0.2f;
    frame.weather.film_albedo = frame.weather.film_smoothness = 0.3f;
    EXPECT_NEAR(aov(renderer->render(frame), "film", 32, 32), 1.0f - std::exp(-0.8f), 0.01f);
}

// Ground goes on as its patches are in the open: no border where they end. What is made of another
// material is no such ground.
// Strips above the floor, which have no patch: a group of lanes has pixels of both, and those of the strips ask where the rain
// comes from one direction after the other. Fragments read the directions as they are.
TEST_F(PlaceTest, WhatHasNoPatchIsShelteredAlikeBesidePixelsThatHaveOne)
{
    load_floor();
    std::vector<Primitive> quads{quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                                   quad({-2.1f, 0, -3}, {0, 0, 6}, {0, 2, 0}), quad({2.1f, 0, 3}, {0, 0, -6}, {0, 1, 0})};
    for (int i = 0; i < 10; ++i)
        quads.push_back(quad({-1.9f + 0.4f * static_cast<float>(i), 0.8f, 2}, {0.2f, 0, 0}, {0, 0, -4}));
    renderer->load(scene_of(quads, {plain_material(glm::vec3(0.3f))}), {});
    Frame frame = from_above(dry());
    frame.settings.shelter = true;
    frame.weather.rain = 1.0f;
    frame.weather.wind_m_s = {6.0f, 1.0f};
    frame.weather.film_mm = 1.0f;
    frame.weather.film_albedo = 1.0f;
    frame.weather.film_smoothness = 1.0f;
    frame.settings.surface_path = SurfacePath::Fragment;
    const RenderResult expected = renderer->render(frame);
    frame.settings.surface_path = SurfacePath::Visibility;
    const RenderResult r = renderer->render(frame);
    float least = 1.0f, most = 0.0f;
    for (int y = 2; y < 62; ++y) {
        for (int x = 2; x < 62; ++x) {
            if (aov(r, "position", x, y, 1) < 0.79f || aov(r, "position", x, y, 1) > 0.81f) continue;
            const float film = aov(r, "film", x, y);
            EXPECT_NEAR(film, aov(expected, "film", x, y), 0.01f) << x << " " << y;
            least = std::min(least, film);
            most = std::max(most, film);
        }
    }
    EXPECT_GT(most - least, 0.2f) << "a wall keeps rain away";
}

TEST_F(PlaceTest, GroundBeyondThePatchesIsWhatTheyAreInTheOpen)
{
    load_floor();
    renderer->load(scene_of({quad({-2, 0, 2}, {2, 0, 0}, {0, 0, -4}),
                             quad({20, 0, 22}, {2, 0, 0}, {0, 0, -4}),
                             quad({22, 0, 22}, {2, 0, 0}, {0, 0, -4}, 1)},
                            {plain_material(glm::vec3(0.3f)), plain_material(glm::vec3(0.3f))}),
                   {});
    auto place = dry();
    place->open = {{0.6f, 0, 0, 0}, {0.5f, 0, 1, 0}, {0.1f, 0, 0, 0.02f}, {0, 265.0f, 0, 0.0f}};
    Frame frame = from_above(place);
    frame.settings.aovs.push_back("frost");
    frame.camera = look({22, 6, 20}, {22, 0, 20}, 0.7f);
    frame.weather.surface_temperature_k = 270.0f;
    const RenderResult r = renderer->render(frame);
    EXPECT_NEAR(aov(r, "film", 14, 32), 0.6f, 0.01f);
    EXPECT_EQ(aov(r, "film", 50, 32), 0.0f);
    EXPECT_EQ(aov(r, "surface_temperature", 14, 32), 265.0f);
    EXPECT_EQ(aov(r, "surface_temperature", 50, 32), 270.0f);
    EXPECT_EQ(aov(r, "ice", 14, 32), 0.02f);
    EXPECT_EQ(aov(r, "frost", 50, 32), 0.0f);
    float most = 0.0f;
    for (int x = 2; x < 30; ++x) most = std::max(most, aov(r, "frost", x, 32));
    EXPECT_GT(most, 0.3f);
    auto wrong = std::make_shared<PlaceWeather>(*place);
    wrong->open.pop_back();
    wrong->shape = std::make_shared<PlaceShape>(*shape);
    EXPECT_THROW(renderer->render(from_above(wrong)), Error);
}

// A path along a lawn, whose border runs through cells: each has the weather of its own patches.
TEST_F(PlaceTest, WhatSharesACellWithAnotherMaterialHasTheWeatherOfItsOwn)
{
    load_floor();
    for (const float border : {0.08f, 0.2f, 0.33f}) {
        const Scene ground = scene_of({quad({-2, 0, 2}, {2 + border, 0, 0}, {0, 0, -4}),
                                      quad({border, 0, 2}, {2 - border, 0, 0}, {0, 0, -4}, 1)},
                                     {plain_material(glm::vec3(0.3f)), plain_material(glm::vec3(0.3f))});
        const scene::Triangles triangles(ground, {});
        const scene::Tracer tracer(triangles);
        scene::PatchOptions options;
        options.cell_m = 0.5f;
        options.rays = 32;
        patches = scene::build_patches(tracer, options);
        renderer->load(ground, {});
        shape = std::make_shared<PlaceShape>();
        shape->grid = scene::table_grid(patches);
        shape->table = patches.table;
        auto place = dry();
        for (std::uint32_t i = 0; i < patches.count; ++i) {
            place->states[i * PLACE_STATE_TEXELS].x = patches.material[i] == 0 ? 1.0f : 0.0f;
            place->states[i * PLACE_STATE_TEXELS + 3].w = static_cast<float>(patches.material[i]);
        }
        const RenderResult r = renderer->render(from_above(place));
        std::size_t pixels[2] = {0, 0};
        for (int y = 8; y < 56; ++y) {
            for (int x = 8; x < 56; ++x) {
                const float px = aov(r, "position", x, y, 0);
                if (std::abs(px - border) < 0.01f) continue;
                const bool lawn = px > border;
                ++pixels[lawn ? 1 : 0];
                EXPECT_NEAR(aov(r, "film", x, y), lawn ? 0.0f : 1.0f, 0.01f) << px << " of " << border;
            }
        }
        EXPECT_GT(std::min(pixels[0], pixels[1]), 400u);
    }
}

// Ground around a well is cut coarsely, that within finely: none of the dry ground within shows outside.
TEST_F(PlaceTest, GroundAroundAWellHasNothingOfTheGroundWithin)
{
    load_floor();
    std::vector<Primitive> walls{quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})};
    const auto box = [&](float half, float sign) {
        const glm::vec3 corners[] = {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
        for (int k = 0; k < 4; ++k) {
            const glm::vec3 a = corners[k], b = corners[(k + 1) % 4];
            walls.push_back(sign > 0.0f ? quad(a, b - a, {0, 0.5f, 0}) : quad(b, a - b, {0, 0.5f, 0}));
        }
    };
    box(0.6f, 1.0f);
    box(0.5f, -1.0f);
    const Scene well = scene_of(walls, {plain_material(glm::vec3(0.3f))});
    const scene::Triangles triangles(well, {});
    const scene::Tracer tracer(triangles);
    scene::PatchOptions options;
    options.cell_m = 0.175f;
    options.rays = 32;
    patches = scene::build_patches(tracer, options);
    renderer->load(well, {});
    shape->grid = scene::table_grid(patches);
    shape->table = patches.table;
    auto place = dry();
    std::size_t within = 0;
    for (std::uint32_t i = 0; i < patches.count; ++i) {
        const glm::vec3 p = patches.position_m[i];
        const bool inside = std::abs(p.x) < 0.55f && std::abs(p.z) < 0.55f;
        within += inside ? 1 : 0;
        place->states[i * PLACE_STATE_TEXELS].x = inside ? 0.0f : 1.0f;
    }
    ASSERT_GT(within, 4u);
    Frame frame = from_above(place);
    frame.settings.width = frame.settings.height = 256;
    const RenderResult r = renderer->render(frame);
    std::size_t outside = 0;
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const float px = aov(r, "position", x, y, 0), pz = aov(r, "position", x, y, 2);
            if (aov(r, "position", x, y, 1) > 0.01f) continue;
            if (std::max(std::abs(px), std::abs(pz)) < 0.75f) continue;
            ++outside;
            EXPECT_GT(aov(r, "film", x, y), 0.99f) << px << " " << pz;
        }
    }
    EXPECT_GT(outside, 10000u);
}

TEST_F(PlaceTest, PondsAreFlatAndAsDeepAsTheirLevel)
{
    load_floor();
    shape->basin_corner_m = {-2.0f, -2.0f};
    shape->basin_cell_m = 1.0f;
    shape->basin_width = shape->basin_depth = 4;
    shape->labels.assign(16, 0);
    for (std::size_t z = 0; z < 4; ++z) shape->labels[z * 4 + 3] = 1;
    auto place = dry();
    place->levels_m = {0.0f, 0.02f};
    const RenderResult r = renderer->render(from_above(place));
    EXPECT_NEAR(aov(r, "water_depth", 56, 32), 0.02f, 1e-4f);
    EXPECT_EQ(aov(r, "water", 56, 32), 1.0f);
    EXPECT_EQ(aov(r, "water_depth", 14, 32), 0.0f);
    EXPECT_EQ(aov(r, "water", 14, 32), 0.0f);
    auto low = std::make_shared<PlaceWeather>(*place);
    low->levels_m[1] = -0.01f;
    EXPECT_EQ(aov(renderer->render(from_above(low)), "water", 56, 32), 0.0f);
}

// Its colour is that of the water the more the deeper it is: light stones are seen through two centimetres, hardly through twenty. Truth
// of the pixel (film, cover) does not tell how its depth is kept.
TEST_F(PlaceTest, ADeepPondHasAColourOfItsOwn)
{
    load_floor();
    shape->basin_corner_m = {-2.0f, -2.0f};
    shape->basin_cell_m = 1.0f;
    shape->basin_width = shape->basin_depth = 4;
    shape->labels.assign(16, 1);
    const auto seen = [&](SurfacePath path, float level_m, float grey) {
        floor.materials[0].base_color = {grey, grey, grey, 1.0f};
        renderer->load(floor, {});
        auto place = dry();
        place->levels_m = {0.0f, level_m};
        Frame frame = from_above(place);
        frame.settings.surface_path = path;
        frame.sky.sun_illuminance = 0.0f;
        const RenderResult r = renderer->render(frame);
        EXPECT_EQ(aov(r, "water", 20, 44), 1.0f);
        EXPECT_EQ(aov(r, "film", 20, 44), 1.0f);
        return pixel(r, 20, 44);
    };
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        const auto contrast = [&](float level_m) {
            const glm::vec3 dark = seen(path, level_m, 0.05f), light = seen(path, level_m, 0.8f);
            return (light - dark) / dark;
        };
        const glm::vec3 shallow = contrast(0.02f), deep = contrast(0.2f);
        EXPECT_GT(shallow.g, 1.0f);
        EXPECT_LT(deep.g, 0.08f * shallow.g);
        EXPECT_LT(deep.b / shallow.b, 0.6f * deep.r / shallow.r) << "blue goes first";
    }
}

// Every third patch in three parts, along its diagonal.
std::shared_ptr<PlaceShape> with_parts(const PlaceShape& shape, std::uint32_t patches)
{
    auto parted = std::make_shared<PlaceShape>(shape);
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i < patches; i += 3, first += 3) {
        PlaceParts parts{i, first, 3, {}};
        for (std::size_t k = 0; k < parts.of_cell.size(); ++k)
            parts.of_cell[k] = static_cast<std::uint8_t>((k % 8 + k / 8) / 5);
        append_parts(parted->table, parts);
    }
    return parted;
}

// Each pixel has the weather of the very patch that the C++ text of the lookup names.
TEST_F(PlaceTest, PixelsFindThePatchThatTheirFormulaNames)
{
    load_floor();
    const Scene street = place_street::street();
    const scene::Triangles triangles(street, {});
    const scene::Tracer tracer(triangles);
    scene::PatchOptions options;
    options.cell_m = 0.3f;
    options.rays = 32;
    patches = scene::build_patches(tracer, options);
    renderer->load(street, {});
    shape->grid = scene::table_grid(patches);
    shape->table = patches.table;
    const auto film_of = [](std::uint32_t patch) { return static_cast<float>(patch % 251) / 255.0f; };
    for (const bool parted : {false, true}) {
        if (parted) shape = with_parts(*shape, patches.count);
        auto place = dry();
        std::vector<std::uint32_t> materials = patches.material;
        for (const PlaceParts& parts : parts_of(shape->table, shape->grid))
            for (std::uint32_t k = 0; k < parts.count; ++k) materials.push_back(patches.material[parts.patch]);
        place->states.resize(materials.size() * PLACE_STATE_TEXELS);
        for (std::uint32_t i = 0; i < materials.size(); ++i) {
            place->states[i * PLACE_STATE_TEXELS].x = film_of(i);
            place->states[i * PLACE_STATE_TEXELS + 3].w = static_cast<float>(materials[i]);
        }
        const PlaceTree tree = place_tree(shape->grid, shape->table, materials);
        Frame frame = from_above(place);
        frame.camera = look({5, 4, 6}, {0, 0.5f, 0}, 1.0f);
        frame.settings.width = frame.settings.height = 96;
        frame.settings.aovs = {"depth", "position", "normal", "film", "material"};
        for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
            frame.settings.surface_path = path;
            const RenderResult r = renderer->render(frame);
            std::size_t seen = 0, wrong = 0, beside = 0, in_parts = 0;
            for (int y = 0; y < 96; ++y) {
                for (int x = 0; x < 96; ++x) {
                    if (std::isinf(aov(r, "depth", x, y))) continue;
                    const glm::vec3 at(aov(r, "position", x, y, 0), aov(r, "position", x, y, 1), aov(r, "position", x, y, 2));
                    const glm::vec3 n(aov(r, "normal", x, y, 0), aov(r, "normal", x, y, 1), aov(r, "normal", x, y, 2));
                    const auto material = static_cast<std::uint32_t>(aov(r, "material", x, y));
                    const glm::vec3 turn = shared::place_turn({x, y}, 0);
                    const shared::PlaceFound found = place_found(tree, at, n, turn, material);
                    if (found.number == shared::kNoPatch) continue;
                    ++seen;
                    in_parts += found.number >= patches.count ? 1 : 0;
                    wrong += std::abs(aov(r, "film", x, y) - film_of(found.number)) > 1.5e-3f ? 1 : 0;
                    beside += found.number != shared::place_leaf_patch(place_leaves(tree, at, n, glm::vec3(0.0f)).own) ? 1 : 0;
                }
            }
            EXPECT_GT(seen, 4000u);
            EXPECT_GT(beside, 1000u);
            if (parted) {
                EXPECT_GT(in_parts, 1000u);
            }
            // What lies on a border to the last bit, or between two materials.
            EXPECT_LT(wrong, seen / 100);
        }
    }
}

// Where nothing is wet, white or frozen no pixel asks its patch: to the byte the picture without patches, as that of patches
// of which one out of sight is wet.
TEST_F(PlaceTest, WhereAllIsDryThePictureIsThatWithoutPlaces)
{
    load_floor();
    renderer->load(scene_of({quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), quad({20, 0, 22}, {4, 0, 0}, {0, 0, -4})},
                            {plain_material(glm::vec3(0.3f))}),
                   {});
    shape->basin_corner_m = {20.0f, 18.0f};
    shape->basin_cell_m = 4.0f;
    shape->basin_width = shape->basin_depth = 1;
    shape->labels = {1};
    auto place = dry();
    place->levels_m = {0.0f, scene::kDry_m};
    Frame frame = from_above(place);
    frame.settings.aovs = {"depth", "film", "water", "position"};
    const RenderResult asked = renderer->render(frame);
    frame.place = nullptr;
    EXPECT_EQ(renderer->render(frame).beauty, asked.beauty);
    auto pond = std::make_shared<PlaceWeather>(*place);
    pond->levels_m = {0.0f, 0.02f};
    frame.place = pond;
    const RenderResult beside = renderer->render(frame);
    EXPECT_EQ(aov(beside, "water", 32, 32), 0.0f);
    for (int x = 4; x < 60; x += 5) EXPECT_NEAR(luminance(pixel(beside, x, 32)), luminance(pixel(asked, x, 32)), 1e-3f * luminance(pixel(asked, x, 32)));
    frame.camera = look({22, 6, 20}, {22, 0, 20}, 0.7f);
    EXPECT_EQ(aov(renderer->render(frame), "water", 32, 32), 1.0f);
}

TEST_F(PlaceTest, WhatDoesNotBelongTogetherIsRefused)
{
    load_floor();
    auto place = dry();
    place->states.pop_back();
    EXPECT_THROW(renderer->render(from_above(place)), Error);
    auto other = dry();
    other->levels_m.clear();
    EXPECT_THROW(renderer->render(from_above(other)), Error);
    EXPECT_NO_THROW(renderer->render(from_above(dry())));
}

}  // namespace
}  // namespace petrichor::gpu
