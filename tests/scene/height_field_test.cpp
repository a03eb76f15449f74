// The ground of a scene: what is ground without a word about it, and what odd scenes give.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/basins/height_field.h"
#include "scene/basins/hierarchy.h"

namespace petrichor::scene {
namespace {

struct Yard {
    Scene scene;

    Yard()
    {
        scene.materials.emplace_back();
        scene.meshes.emplace_back();
    }
    Primitive& piece()
    {
        scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size() - 1), {}});
        scene.instances.back().to_world = glm::mat4(1.0f);
        scene.meshes.back().primitives.emplace_back();
        return scene.meshes.back().primitives.back();
    }
    void next() { scene.meshes.emplace_back(); }
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d)
    {
        Primitive& p = scene.meshes.back().primitives.back();
        const auto first = static_cast<std::uint32_t>(p.positions.size());
        p.positions.insert(p.positions.end(), {a, b, c, d});
        p.indices.insert(p.indices.end(),
                         {first, first + 1, first + 2, first, first + 2, first + 3});
    }
    // A sheet that faces up, at a height.
    void sheet(float x0, float z0, float x1, float z1, float y)
    {
        piece();
        quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
        next();
    }
    void box(glm::vec3 l, glm::vec3 h, bool inside_out = false)
    {
        piece();
        quad({l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z});
        quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
        quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
        quad({h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
        quad({l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z});
        quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
        if (inside_out) {
            auto& i = scene.meshes.back().primitives.back().indices;
            for (std::size_t k = 0; k + 2 < i.size(); k += 3) std::swap(i[k + 1], i[k + 2]);
        }
        next();
    }
    HeightField field(const GroundOptions& options = {.most_cells = 64})
    {
        return ground_height_field(scene, options);
    }
};

float at(const HeightField& field, double x, double z)
{
    const std::size_t cell = cell_at(field, x, z);
    return cell < field.cells() ? field.height_m[cell] : -1e9f;
}

TEST(HeightField, TheLowestSurfaceThatFacesUpIsGround)
{
    Yard yard;
    yard.sheet(0, 0, 16, 16, 0.0f);
    yard.box({2, 3, 2}, {6, 3.2f, 6});         // an awning with air below
    yard.box({8, 0, 8}, {9, 0.15f, 9});        // a kerb
    yard.box({10, 0.2f, 10}, {13, 1.4f, 12});  // a car
    yard.box({1, -0.5f, 10}, {5, 8, 14});      // a house
    const HeightField field = yard.field();
    EXPECT_DOUBLE_EQ(field.cell_m, 0.25);
    EXPECT_EQ(at(field, 4, 4), 0.0f);
    EXPECT_EQ(at(field, 8.5, 8.5), 0.15f);
    EXPECT_EQ(at(field, 11, 11), 0.0f);
    EXPECT_EQ(at(field, 3, 12), kSolid_m);
    EXPECT_EQ(at(field, 15, 1), 0.0f);
    EXPECT_TRUE(field.notes.empty());
}

TEST(HeightField, StepsAreGroundAndSingleSheetsHighAboveItAreNot)
{
    Yard yard;
    yard.sheet(0, 0, 8, 8, 0.0f);
    for (int i = 1; i <= 4; ++i) {
        const auto f = static_cast<float>(i);
        yard.box({f, 0, 1}, {f + 1, 0.17f * f, 2});
    }
    yard.sheet(1, 5, 3, 7, 2.5f);   // a roof of one sheet
    yard.sheet(5, 5, 7, 7, 0.04f);  // a carpet
    const HeightField field = yard.field();
    for (int i = 1; i <= 4; ++i)
        EXPECT_FLOAT_EQ(at(field, i + 0.5, 1.5), 0.17f * static_cast<float>(i));
    EXPECT_EQ(at(field, 2, 6), 0.0f);
    EXPECT_EQ(at(field, 6, 6), 0.04f);
}

TEST(HeightField, InsideOutMeshesAndGroundThatFacesDownAreTurned)
{
    Yard yard;
    yard.sheet(0, 0, 8, 8, 0.0f);
    yard.box({2, 0, 2}, {4, 0.2f, 4}, true);
    const HeightField field = yard.field();
    EXPECT_EQ(at(field, 3, 3), 0.2f);
    ASSERT_EQ(field.notes.size(), 1u);

    Yard below;
    below.piece();
    below.quad({0, 1, 0}, {8, 1, 0}, {8, 1, 8}, {0, 1, 8});  // faces down
    const HeightField turned = below.field();
    EXPECT_EQ(at(turned, 4, 4), 1.0f);
    ASSERT_EQ(turned.notes.size(), 1u);

    // A valley faces its own middle and is not inside-out.
    Yard valley;
    valley.piece();
    valley.quad({0, 4, 0}, {0, 4, 8}, {4, 0, 8}, {4, 0, 0});
    valley.quad({4, 0, 0}, {4, 0, 8}, {8, 4, 8}, {8, 4, 0});
    EXPECT_NEAR(at(valley.field(), 2, 4), 2.0f, 0.1f);
    EXPECT_TRUE(valley.field().notes.empty());
}

TEST(HeightField, ATriangleOfTenKilometresLeavesTheGridWhereTheHousesAre)
{
    Yard yard;
    yard.sheet(-5000, -5000, 5000, 5000, 0.0f);
    for (int i = 0; i < 20; ++i) {
        const auto f = static_cast<float>(i);
        yard.box({2 * f, 0, 0}, {2 * f + 1, 0.1f, 30});
    }
    const HeightField field = yard.field({.most_cells = 256});
    EXPECT_LE(field.width, 256u);
    EXPECT_LT(field.cell_m, 1.0);
    EXPECT_EQ(at(field, 2.5, 10), 0.1f);
    ASSERT_EQ(field.notes.size(), 1u);

    Yard lone;
    lone.sheet(-5000, -5000, 5000, 5000, 2.0f);
    const HeightField plain = lone.field();
    EXPECT_LE(plain.cells(), 64u * 64u);
    EXPECT_EQ(find_basins(plain).pits, 0u);
}

TEST(HeightField, ScenesWithoutGroundHaveNone)
{
    Yard empty;
    EXPECT_TRUE(empty.field().empty());
    EXPECT_EQ(empty.field().notes.size(), 1u);
    Yard wall;
    wall.piece();
    wall.quad({0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0});
    EXPECT_TRUE(wall.field().empty());
    EXPECT_EQ(find_basins(wall.field()).pits, 0u);
}

TEST(HeightField, BrokenTrianglesAreLeftOutAndCounted)
{
    Yard yard;
    yard.sheet(0, 0, 8, 8, 0.0f);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    yard.piece();
    yard.quad({0, nan, 0}, {0, 1, 8}, {8, 1, 8}, {8, 1, 0});
    yard.quad({2, 5, 2}, {2, 5, 2}, {2, 5, 2}, {2, 5, 2});
    const HeightField field = yard.field();
    EXPECT_EQ(at(field, 4, 4), 0.0f);
    ASSERT_EQ(field.notes.size(), 1u);
    EXPECT_NE(field.notes[0].find("2 triangles"), std::string::npos);
}

TEST(HeightField, KeysSayWhatIsGround)
{
    Yard yard;
    yard.sheet(0, 0, 8, 8, 0.0f);
    yard.box({2, 3, 2}, {6, 3.2f, 6});
    yard.scene.materials.emplace_back();
    yard.scene.meshes[1].primitives[0].material = 1;
    GroundOptions options{.most_cells = 64};
    options.use = {GroundUse::Auto, GroundUse::Ground};
    EXPECT_FLOAT_EQ(at(yard.field(options), 4, 4), 3.2f);
    options.use = {GroundUse::Never};
    EXPECT_FLOAT_EQ(at(yard.field(options), 4, 4), 3.2f);
    EXPECT_TRUE(std::isnan(at(yard.field(options), 2.1, 2.1)) ||
                at(yard.field(options), 2.1, 2.1) == 3.2f);
    options.most_cells = 1;
    EXPECT_THROW(yard.field(options), Error);
}

}  // namespace
}  // namespace petrichor::scene
