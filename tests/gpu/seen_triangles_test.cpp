// What is left out before it is drawn shows nothing.
#include "gpu/upload/seen_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gpu/frame/depth_view.h"
#include "gpu/frame/frame_constants.h"
#include "gpu/frame/view.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSide = 96;

// A bumpy ball of many small triangles.
Primitive ball(int rings)
{
    Primitive p;
    const int across = 2 * rings;
    for (int y = 0; y <= rings; ++y) {
        for (int x = 0; x <= across; ++x) {
            const double a = 3.14159265358979 * y / rings, b = 2.0 * 3.14159265358979 * x / across;
            const double r = 1.0 + 0.06 * std::sin(9.0 * a) * std::cos(11.0 * b);
            const glm::vec3 at(r * std::sin(a) * std::cos(b), r * std::cos(a),
                               -r * std::sin(a) * std::sin(b));
            p.positions.push_back(at);
            p.normals.push_back(glm::normalize(at));
            p.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            p.uv0.emplace_back(0.0f);
        }
    }
    for (int y = 0; y < rings; ++y) {
        for (int x = 0; x < across; ++x) {
            const auto i = static_cast<std::uint32_t>(y * (across + 1) + x);
            const auto below = i + static_cast<std::uint32_t>(across) + 1;
            for (const std::uint32_t k : {i, below, i + 1, i + 1, below, below + 1})
                p.indices.push_back(k);
        }
    }
    return p;
}

Scene balls(bool double_sided)
{
    Material material = plain_material(glm::vec3(0.5f));
    material.double_sided = double_sided;
    Scene scene = scene_of({ball(60)}, {material});
    for (int i = 0; i < 3; ++i) {
        glm::mat4 m = glm::translate(glm::mat4(1.0f), {2.2f * static_cast<float>(i - 1), 0.3f, -1.5f});
        m = glm::scale(m, glm::vec3(i == 1 ? -0.7f : 0.9f, 1.2f, 0.8f));  // one is mirrored
        scene.instances.push_back({"other", 0, m});
    }
    return scene;
}

struct Point {
    double x = 0, y = 0, w = 0;
};

Point on_screen(const glm::mat4& clip, const Draw& draw, const glm::vec3& position)
{
    const glm::dvec4 at = glm::dmat4(clip) * (glm::dmat4(draw.to_world) * glm::dvec4(position, 1.0));
    return {(at.x / at.w * 0.5 + 0.5) * kSide, (at.y / at.w * 0.5 + 0.5) * kSide, at.w};
}

double cross(const Point& a, const Point& b, double x, double y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Some sample lies within the triangle.
bool is_met(const Point (&t)[3], const std::vector<glm::vec2>& offsets)
{
    const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int y = std::max(0, static_cast<int>(low_y) - 2); y < std::min<double>(kSide, high_y + 2); ++y) {
        for (int x = std::max(0, static_cast<int>(low_x) - 2); x < std::min<double>(kSide, high_x + 2);
             ++x) {
            for (const glm::vec2& offset : offsets) {
                const double px = x + 0.5 + double{offset.x}, py = y + 0.5 + double{offset.y};
                const double a = cross(t[0], t[1], px, py), b = cross(t[1], t[2], px, py),
                             c = cross(t[2], t[0], px, py);
                if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return true;
            }
        }
    }
    return false;
}

class SeenTrianglesTest : public GpuTest {
protected:
    // Lists a scene; checks each triangle that was left out; returns the share that is left.
    double check(const Scene& scene, const Camera& camera, bool back_faces, const char* what)
    {
        const Device device(RendererOptions{.device = "", .validation = false});
        if (device.info().kind != "cpu") return -1.0;
        const GpuScene on_device(device, scene, {});
        Frame frame;
        frame.camera = camera;
        frame.settings.width = frame.settings.height = kSide;
        const shared::FrameConstants c = frame_constants(frame, Sun{}, on_device.bounds(), 0);
        SampledView view{c.world_to_clip, kSide, kSide, {}, 0, {}};
        for (std::uint32_t i = 0; i < 4; ++i) view.offsets.push_back(sample_offset(i, 3));
        SeenTriangles triangles(device);
        triangles.reset(on_device);
        const auto seen =
            triangles.list(on_device, view, back_faces, [](const Draw&) { return true; });
        if (!seen) {
            ADD_FAILURE() << what << ": nothing was listed";
            return -1.0;
        }
        const auto* indices = reinterpret_cast<const std::uint32_t*>(seen->indices->mapped);
        const auto* numbers = reinterpret_cast<const std::uint32_t*>(seen->numbers->mapped);
        const Primitive& mesh = scene.meshes[0].primitives[0];
        std::size_t all = 0, left = 0, wrong = 0;
        for (const Draw& draw : on_device.draws()) {
            const SeenRange range =
                seen->ranges[static_cast<std::size_t>(&draw - on_device.draws().data())];
            if (range.whole()) {
                ADD_FAILURE() << what << ": a draw stayed whole";
                return -1.0;
            }
            std::set<std::uint32_t> listed;
            for (std::uint32_t k = 0; k < range.index_count / 3; ++k) {
                const std::uint32_t number = numbers[range.first_index / 3 + k];
                EXPECT_TRUE(listed.empty() || number > *listed.rbegin()) << "order of the draw";
                listed.insert(number);
                for (std::uint32_t j = 0; j < 3; ++j)
                    EXPECT_EQ(indices[range.first_index + 3 * k + j], mesh.indices[3 * number + j]);
            }
            for (std::uint32_t n = 0; n < draw.index_count / 3; ++n) {
                ++all;
                if (listed.count(n) != 0) {
                    ++left;
                    continue;
                }
                Point t[3];
                for (std::uint32_t j = 0; j < 3; ++j)
                    t[j] = on_screen(view.clip_from_world, draw, mesh.positions[mesh.indices[3 * n + j]]);
                if (t[0].w <= 0.0 && t[1].w <= 0.0 && t[2].w <= 0.0) continue;
                if (t[0].w <= 0.0 || t[1].w <= 0.0 || t[2].w <= 0.0) {
                    ++wrong;
                    continue;
                }
                const double area = cross(t[0], t[1], t[2].x, t[2].y);
                const bool front = draw.mirrored ? area > 0.0 : area < 0.0;
                const bool shown = front || back_faces || scene.materials[0].double_sided;
                wrong += shown && is_met(t, view.offsets) ? 1 : 0;
            }
        }
        EXPECT_EQ(wrong, 0u) << what;
        return static_cast<double>(left) / static_cast<double>(all);
    }
};

TEST_F(SeenTrianglesTest, NoneThatASampleMeetsIsLeftOut)
{
    const Camera outside = look({0.5f, 1.5f, 5.0f}, {0, 0, 0});
    const double one_sided = check(balls(false), outside, false, "one-sided");
    if (one_sided < 0.0) GTEST_SKIP() << "a device that shades vertices itself needs no such list";
    EXPECT_LT(one_sided, 0.5);  // half of a ball is turned away
    const double both = check(balls(true), outside, false, "both sides");
    EXPECT_GT(both, one_sided);
    EXPECT_EQ(check(balls(false), outside, true, "shadows"), both);
    // From within a ball, some lie behind the eye and some on both sides of it.
    EXPECT_LT(check(balls(true), look({0.1f, 0.2f, 0.1f}, {0, 0, -3}), false, "within"), 0.9);
    // Far away most lie between the samples.
    EXPECT_LT(check(balls(true), look({0, 0, 60.0f}, {0, 0, 0}), false, "far"), 0.3);
    Camera flat = look({0, 3, 4}, {0, 0, 0});
    flat.orthographic_height_m = 5.0f;
    EXPECT_LT(check(balls(false), flat, false, "orthographic"), 0.5);
    Scene there = balls(false);
    for (Instance& instance : there.instances)
        instance.to_world = glm::translate(glm::mat4(1.0f), {1.0e5f, 0, 1.0e5f}) * instance.to_world;
    check(there, look({1.0e5f, 1.5f, 1.0e5f + 5.0f}, {1.0e5f, 0, 1.0e5f}), false, "far from the origin");
}

// A wall of two triangles before z = -3, wide enough for some of the balls that stand behind it.
Scene balls_behind_a_wall(bool wall)
{
    Primitive quad;
    for (const glm::vec2 at : {glm::vec2(-4, -4), glm::vec2(0.4f, -4), glm::vec2(0.4f, 4), glm::vec2(-4, 4)}) {
        quad.positions.emplace_back(at.x, at.y, -3.0f);
        quad.normals.emplace_back(0.0f, 0.0f, 1.0f);
        quad.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        quad.uv0.emplace_back(0.0f);
    }
    quad.indices = {0, 1, 2, 0, 2, 3};
    Scene scene = scene_of({ball(60)}, {plain_material(glm::vec3(0.5f))});
    scene.instances.clear();
    for (const glm::vec3 at : {glm::vec3(-2, 0, -6), glm::vec3(0.4f, 0, -6), glm::vec3(2.5f, 0, -6), glm::vec3(-2, 0, 0)})
        scene.instances.push_back({"ball", 0, glm::translate(glm::mat4(1.0f), at)});
    if (!wall) return scene;
    scene.meshes.push_back({});
    scene.meshes.back().primitives.push_back(quad);
    scene.instances.push_back({"wall", 1, glm::mat4(1.0f)});
    return scene;
}

TEST_F(SeenTrianglesTest, MapsLeaveOutWhatStandsBehindAWall)
{
    const Device device(RendererOptions{.device = "", .validation = false});
    if (device.info().kind != "cpu") GTEST_SKIP() << "a device that shades vertices itself needs no such list";
    constexpr int kMap = 512;
    const DepthView from = orthographic_view({0.0f, 0.0f, -1.0f}, {0.0f, 0.0f, 0.0f}, 5.0f,
                                             {glm::vec3(-9.0f), glm::vec3(9.0f)}, kMap);
    const auto listed = [&](bool wall, bool maps) {
        const GpuScene scene(device, balls_behind_a_wall(wall), {});
        SeenTriangles triangles(device);
        triangles.reset(scene);
        const auto seen = triangles.list(scene, {from.clip_from_world, kMap, kMap, {glm::vec2(0.0f)}, 0, {}}, maps,
                                         [](const Draw&) { return true; });
        std::map<std::uint32_t, std::set<std::uint32_t>> numbers;  // by instance
        for (const Draw& draw : scene.draws()) {
            const SeenRange range = seen->ranges[static_cast<std::size_t>(&draw - scene.draws().data())];
            if (range.whole()) continue;
            const auto* first = reinterpret_cast<const std::uint32_t*>(seen->numbers->mapped) + range.first_index / 3;
            numbers[draw.instance_id].insert(first, first + range.index_count / 3);
        }
        return numbers;
    };
    auto alone = listed(false, true), walled = listed(true, true);
    EXPECT_TRUE(walled[0].empty());
    EXPECT_LT(walled[1].size(), alone[1].size());
    EXPECT_FALSE(walled[1].empty());
    EXPECT_EQ(walled[2], alone[2]);
    EXPECT_EQ(walled[3], alone[3]) << "it stands before the wall";
    // What is missing lies behind the wall with all of it.
    const Scene scene = balls_behind_a_wall(false);
    const Primitive& mesh = scene.meshes[0].primitives[0];
    for (const std::uint32_t n : alone[1]) {
        if (walled[1].count(n) != 0) continue;
        for (std::uint32_t k = 0; k < 3; ++k) EXPECT_LT(mesh.positions[mesh.indices[3 * n + k]].x + 0.4f, 0.4f);
    }
    // An eye that sees one side of things may look through the back of the wall.
    EXPECT_EQ(listed(true, false)[0], listed(false, false)[0]);
}

TEST_F(SeenTrianglesTest, BothPathsShowWhatIsListed)
{
    // A ball drawn as one mesh is listed; in slivers of a hundred triangles it is drawn whole.
    const Scene listed = scene_of({ball(40)}, {plain_material(glm::vec3(0.6f, 0.4f, 0.3f))});
    Scene whole = scene_of({}, listed.materials);
    const Primitive all = listed.meshes[0].primitives[0];
    for (std::size_t at = 0; at < all.indices.size(); at += 300) {
        Primitive part = all;
        part.indices.assign(all.indices.begin() + static_cast<std::ptrdiff_t>(at),
                            all.indices.begin() + static_cast<std::ptrdiff_t>(
                                                      std::min(at + 300, all.indices.size())));
        whole.meshes[0].primitives.push_back(std::move(part));
    }
    for (const SurfacePath path : {SurfacePath::Fragment, SurfacePath::Visibility}) {
        Frame frame;
        frame.camera = look({1, 2, 3}, {0, 0, 0});
        frame.settings.width = frame.settings.height = kSide;
        frame.settings.samples = 3;
        frame.settings.surface_path = path;
        renderer->load(listed, {});
        const auto a = renderer->render(frame).beauty;
        renderer->load(whole, {});
        EXPECT_EQ(a, renderer->render(frame).beauty);
    }
}

}  // namespace
}  // namespace petrichor::gpu
