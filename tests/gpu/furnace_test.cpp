// Every lighting model between white walls, dry and wet: none of ours sends out more than comes in.
#include <map>

#include "gpu/lighting/lighting_models.h"
#include "tests/gpu/furnace_frame.h"

namespace petrichor::gpu {
namespace {

class Furnace : public GpuTest {
protected:
    // Of a plate of that material, seen under that cosine.
    float light(float up, bool wet)
    {
        Frame frame = furnace_frame(up);
        if (wet) {
            frame.weather.film_albedo = 0.85f;
            frame.weather.film_smoothness = 0.5f;
        }
        return pixel(renderer->render(frame), 8, 8).g;
    }
};

// Those that are kept as their documents have them do: 1.28 and 1.23 seen at grazing angles. What is unlit is as
// bright as it says.
const std::map<std::string, float> kMost = {{"lwrp", 1.3f}, {"lux", 1.25f}};

TEST_F(Furnace, NoModelOutshinesIt)
{
    renderer->set_environment(constant_environment(1.0f));
    float brightest = 0.0f;
    for (const std::string& model : built_in_lighting_models()) {
        if (model.starts_with("unlit")) continue;
        const float most = kMost.contains(model) ? kMost.at(model) : 1.03f;
        for (const float roughness : {0.1f, 0.5f, 1.0f}) {
            for (const float metallic : {0.0f, 1.0f}) {
                Material white = plain_material(glm::vec3(1.0f), roughness, metallic);
                white.lighting_model = model;
                renderer->load(scene_of({quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})}, {white}), {});
                for (const bool wet : {false, true}) {
                    for (const float up : {1.0f, 0.25f}) {
                        const float out = light(up, wet);
                        EXPECT_LT(out, most) << model << ", roughness " << roughness << ", metal " << metallic
                                             << (wet ? ", wet, " : ", dry, ") << up;
                        brightest = std::max(brightest, out);
                    }
                }
            }
        }
    }
    EXPECT_GT(brightest, 0.95f);
}

// The same by lamps alone, alike from all sides: a white metal sends all of it on, however rough it is and wherever it is
// seen from, in one lobe and in the layered model.
TEST_F(Furnace, AWhiteMetalSendsTheLightOfLampsOn)
{
    constexpr int kLamps = 600;
    std::vector<Light> around;
    for (int i = 0; i < kLamps; ++i) {
        const float up = (static_cast<float>(i) + 0.5f) / kLamps;
        const float turn = 2.3999632f * static_cast<float>(i);
        const float level = std::sqrt(1.0f - up * up);
        Light lamp;
        lamp.kind = LightKind::Directional;
        lamp.direction = -glm::vec3(level * std::cos(turn), up, level * std::sin(turn));
        lamp.intensity = 6.2831853f / kLamps;
        around.push_back(lamp);
    }
    for (const std::string model : {"standard", "layered"}) {
        for (const float roughness : {0.45f, 0.7f, 1.0f}) {
            Material white = plain_material(glm::vec3(1.0f), roughness, 1.0f);
            white.lighting_model = model;
            renderer->load(scene_of({quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12})}, {white}), {});
            for (const float up : {1.0f, 0.6f, 0.25f}) {
                Frame frame = furnace_frame(up);
                frame.settings.image_based_light = false;
                frame.settings.exposure = 1.0f;
                frame.extra_lights = around;
                EXPECT_NEAR(pixel(renderer->render(frame), 8, 8).g, 1.0f, 0.025f) << model << " " << roughness << " " << up;
            }
        }
    }
}

}  // namespace
}  // namespace petrichor::gpu
