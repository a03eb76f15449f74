// Films hold still: where nothing moves no bit changes, and under a camera that moves surfaces keep their light.
//
// PETRICHOR_STEADY_FRAMES=48 looks at so many frames of the demo in place of a few; the table is printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "film/jobs/render_job.h"
#include "film/jobs/scene_source.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::film {
namespace {

using gpu::luminance;
using gpu::pixel;

constexpr int kWidth = 320, kHeight = 180;

struct State {
    const char* name;
    const char* weather;  // a state of the artist model, set by hand; it neither rains nor blows
    bool water = false;   // stands somewhere and is not frozen: its surface trembles
};

// At half a degree above freezing, where no hoar grows.
constexpr State kStates[] = {
    {"dry", "temperature_c = 16, cloud_cover = 0.25, wetness = 0, cracks = 0, puddles = 0"},
    {"damp", "temperature_c = 11, cloud_cover = 0.8, wetness = 0.45, cracks = 0.15, puddles = 0"},
    {"flooded", "temperature_c = 12, cloud_cover = 0.9, wetness = 1, cracks = 1, puddles = 1", true},
    {"ice", "temperature_c = 0.5, cloud_cover = 0, wetness = 0.35, cracks = 0.5, puddles = 0.3, water_to_snow = 1"},
    {"first snow", "temperature_c = 0.5, cloud_cover = 1, wetness = 0, cracks = 0, puddles = 0, water_to_snow = 1, snow = 0.42"},
    {"deep snow", "temperature_c = 0.5, cloud_cover = 0.2, wetness = 0, cracks = 0, puddles = 0, water_to_snow = 1, snow = 0.97"},
};

int frames()
{
    const char* set = std::getenv("PETRICHOR_STEADY_FRAMES");
    return set ? std::clamp(std::atoi(set), 2, 1000) : 2;
}

Sequence film(const State& state, const char* camera)
{
    Scenario scenario = parse_scenario(
        "[scene]\nfile = \"demo:street\"\n[camera]\nev100 = 13.5\nkeys = [" + std::string(camera) +
            "]\n[sun]\nelevation_degrees = 24.0\nazimuth_degrees = 205.0\n[lights]\nlamps = \"off\"\n"
            "[weather]\nkeys = [{ time_s = 0, script_controlled = 0, rainfall = 0, wind_m_s = 0, visibility_m = 20000, " +
            state.weather + " }]\n[output]\nwidth = " + std::to_string(kWidth) + "\nheight = " +
            std::to_string(kHeight) + "\nsamples = 8\nfps = 24\nframes = " + std::to_string(frames()) + "\n",
        "s.toml");
    Sequence sequence = make_sequence(std::move(scenario));
    load_sequence_scene(sequence, 2);
    return sequence;
}

const std::vector<float>& aov(const gpu::RenderResult& r, const char* name)
{
    const auto found = std::find_if(r.aovs.begin(), r.aovs.end(), [&](const gpu::AovImage& a) { return a.name == name; });
    EXPECT_NE(found, r.aovs.end()) << name;
    return found->pixels;
}

// The picture at a place between pixels; of nothing but surfaces near `position`.
struct Seen {
    bool same = false;
    float light = 0.0f;
};
Seen seen_at(const gpu::RenderResult& r, glm::vec2 at, const glm::vec3& position, float near_m)
{
    const glm::vec2 low = glm::floor(at - 0.5f);
    const glm::vec2 part = at - 0.5f - low;
    Seen seen{true, 0.0f};
    const std::vector<float>& places = aov(r, "position");
    for (int k = 0; k < 4; ++k) {
        const int x = static_cast<int>(low.x) + (k & 1), y = static_cast<int>(low.y) + (k >> 1);
        if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) return {};
        const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
        if (glm::distance(glm::vec3(places[3 * i], places[3 * i + 1], places[3 * i + 2]), position) > near_m) return {};
        const float weight = ((k & 1) ? part.x : 1.0f - part.x) * ((k >> 1) ? part.y : 1.0f - part.y);
        seen.light += weight * luminance(pixel(r, x, y));
    }
    return seen;
}

class Steadiness : public gpu::GpuTest {
public:
    static std::vector<gpu::RenderResult> render(Sequence sequence, std::vector<scene::Camera>* cameras = nullptr)
    {
        RenderRequest request;
        RenderReport report;
        gpu::Renderer renderer = sequence_renderer(sequence, request, report);
        std::vector<gpu::RenderResult> all;
        for (int i = 0; i < frames(); ++i) {
            gpu::Frame frame = frame_at(sequence, {i, "", ""}).frame;
            frame.settings.aovs = {"position", "water"};
            if (cameras) cameras->push_back(frame.camera);
            all.push_back(renderer.render(frame));
        }
        return all;
    }
};

// Cameras, weather and wind stand: every byte stands, but where water does, which trembles and is mirrored.
TEST_F(Steadiness, WhereNothingMovesNoByteChanges)
{
    std::printf("  %-11s %8s  of 255: %7s %7s\n", "state", "changed", "mean", "largest");
    for (const State& state : kStates) {
        const auto all = render(film(state, "{ time_s = 0, position_m = [0.9, 1.5, 6.0], look_at_m = [0.16, 1.4, -1.0] }"));
        double changed = 0.0, mean = 0.0;
        int largest = 0, count = 0;
        for (std::size_t f = 1; f < all.size(); ++f) {
            for (std::size_t i = 0; i < all[f].display.size(); ++i) {
                const int by = std::abs(int(all[f].display[i]) - int(all[f - 1].display[i]));
                changed += by != 0;
                mean += by;
                largest = std::max(largest, by);
                ++count;
            }
        }
        std::printf("  %-11s %6.2f %%          %7.3f %7d\n", state.name, 100.0 * changed / count, mean / count, largest);
        if (state.water) {
            EXPECT_LT(mean / count, 1.0) << state.name;
        } else {
            EXPECT_EQ(largest, 0) << state.name;
        }
    }
}

// The camera goes on by a hand's breadth; each point of a surface is looked up in the picture before. What its light
// changes by is what pictures of it are told apart by: samples, resampling, and what swims.
TEST_F(Steadiness, SurfacesKeepTheirLightUnderAMovingCamera)
{
    std::map<std::string, double> change;
    std::printf("  %-11s %8s  %s\n", "state", "compared", "root mean square change of light a frame, over its mean");
    for (const State& state : kStates) {
        std::vector<scene::Camera> cameras;
        const auto all = render(film(state,
                                     "{ time_s = 0, position_m = [0.9, 1.5, 6.0], look_at_m = [0.16, 1.4, -1.0] }, "
                                     "{ time_s = 2, position_m = [0.3, 1.5, 5.2], look_at_m = [0.16, 1.4, -1.0] }"),
                                &cameras);
        double sum = 0.0, light = 0.0;
        int count = 0;
        for (std::size_t f = 1; f < all.size(); ++f) {
            const glm::mat4 before = scene::clip_projection(cameras[f - 1], kWidth, kHeight, 1000.0f) *
                                     glm::inverse(cameras[f - 1].to_world);
            const std::vector<float>& places = aov(all[f], "position");
            const std::vector<float>& water = aov(all[f], "water");
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
                    const glm::vec3 p(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
                    const float far_m = glm::distance(p, glm::vec3(cameras[f].to_world[3]));
                    if (p == glm::vec3(0.0f) || far_m > 25.0f || water[i] > 0.05f) continue;
                    const glm::vec4 clip = before * glm::vec4(p, 1.0f);
                    if (clip.w <= 0.0f) continue;
                    const glm::vec2 at((clip.x / clip.w * 0.5f + 0.5f) * kWidth, (0.5f - clip.y / clip.w * 0.5f) * kHeight);
                    // Not over outlines: there a pixel is of two things.
                    const Seen own = seen_at(all[f], {float(x) + 1.0f, float(y) + 1.0f}, p, 0.012f * far_m);
                    const Seen was = seen_at(all[f - 1], at, p, 0.012f * far_m);
                    if (!own.same || !was.same) continue;
                    const auto l = static_cast<double>(luminance(pixel(all[f], x, y)));
                    sum += (l - double(was.light)) * (l - double(was.light));
                    light += l;
                    ++count;
                }
            }
        }
        ASSERT_GT(count, kWidth * kHeight / 6) << state.name;
        change[state.name] = std::sqrt(sum / count) / (light / count);
        std::printf("  %-11s %6.1f %%  %.4f\n", state.name,
                    100.0 * count / (double(kWidth) * kHeight * (frames() - 1)), change[state.name]);
    }
    // Set after seeing 0.021 to 0.033: what is wet is mirrored, snow in patches has more outlines than the ground.
    for (const auto& [name, found] : change) EXPECT_LT(found, 1.8 * change["dry"]) << name;
}

}  // namespace
}  // namespace petrichor::film
