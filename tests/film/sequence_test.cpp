#include "film/jobs/sequence.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "film/jobs/camera.h"
#include "film/jobs/sun.h"
#include "gpu/frame/sun.h"

namespace petrichor::film {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

TEST(FrameRange, ReadsEveryForm)
{
    EXPECT_EQ(parse_frame_range("3:7", 10).first, 3);
    EXPECT_EQ(parse_frame_range("3:7", 10).last, 7);
    EXPECT_EQ(parse_frame_range("5:", 10).last, 9);
    EXPECT_EQ(parse_frame_range(":4", 10).first, 0);
    EXPECT_EQ(parse_frame_range("6", 10).first, 6);
    EXPECT_EQ(parse_frame_range("6", 10).last, 6);
    for (const char* bad :
         {"", ":", "a:b", "7:3", "-1", "1:2:3", "10", "0:10", "1.5", "99999999999"}) {
        EXPECT_THROW(parse_frame_range(bad, 10), Error) << bad;
    }
}

TEST(Size, AcceptsWhatCanBeRendered)
{
    EXPECT_EQ(parse_size("640x360").width, 640);
    EXPECT_EQ(parse_size("1X2").height, 2);
    EXPECT_EQ(parse_size("16384x16384").height, 16384);
    for (const char* bad :
         {"", "640", "0x1", "1x0", "-4x4", "4x4x4", "16385x1", "1x16385", "1e3x1"}) {
        EXPECT_THROW(parse_size(bad), Error) << bad;
    }
}

Sequence sequence_of(const std::string& text)
{
    Sequence sequence = make_sequence(parse_scenario(text, "s.toml"));
    sequence.framing.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    sequence.duration_s = 48.0;
    sequence.variants[0].weather.at = [](double time_s) {
        weather::Moment moment;
        moment.values.rain = static_cast<float>(time_s / 48.0);
        moment.values.cloud_fraction = 0.4f;
        return moment;
    };
    sequence.content = "content";
    return sequence;
}

TEST(FrameAt, TimesRunFromTheStartOverTheDuration)
{
    const Sequence sequence = sequence_of("[output]\nframes = 24\nstart_s = 10\nfps = 8\n");
    EXPECT_DOUBLE_EQ(frame_time_s(sequence, 0), 10.0);
    EXPECT_DOUBLE_EQ(frame_time_s(sequence, 12), 34.0);
    EXPECT_DOUBLE_EQ(frame_at(sequence, {12}).frame.settings.time_s, 1.5);
}

TEST(FrameAt, CloudsComeFromTheWeatherUnlessGiven)
{
    EXPECT_FLOAT_EQ(frame_at(sequence_of(""), {0}).frame.sky.cloud_cover, 0.4f);
    EXPECT_FLOAT_EQ(frame_at(sequence_of("[sky]\ncloud_cover = 0.9\n"), {0}).frame.sky.cloud_cover,
                    0.9f);
}

TEST(FrameAt, LampsComeOnAtDusk)
{
    const Sequence sequence = sequence_of(
        "[sun]\nelevation_degrees = [[0, 12], [48, 0]]\n[lights]\nlamps = \"dusk\"\ndusk_degrees = "
        "4\n"
        "dusk_fade_degrees = 4\nscale = 2\n");
    EXPECT_EQ(frame_at(sequence, {0}).frame.scene_light_scale, 0.0f);
    EXPECT_EQ(frame_at(sequence, {47}).frame.scene_light_scale, 2.0f);
    float before = 0.0f;
    for (int i = 0; i < 48; ++i) {
        const float lamps = frame_at(sequence, {i}).frame.scene_light_scale;
        EXPECT_GE(lamps, before);
        before = lamps;
    }
}

// The aperture of 24 mm of sensor behind 45 degrees: a focal length of 29 mm.
TEST(FrameAt, ALensHasTheApertureOfItsFStop)
{
    EXPECT_EQ(frame_at(sequence_of(""), {0}).frame.lens.radius_m, 0.0f);
    const std::string still = "position_m = [0, 1, 4]\nlook_at_m = [0, 1, 0]\nfov_degrees = 45\n";
    const auto lens = [&](const std::string& keys) {
        return frame_at(sequence_of("[camera]\n" + still + keys), {0}).frame.lens;
    };
    EXPECT_NEAR(lens("f_stop = 2\n").radius_m, 0.5f * 0.0289706f / 2.0f, 1e-5f);
    EXPECT_NEAR(lens("f_stop = 2\nsensor_mm = 48\n").radius_m, 0.0289706f / 2.0f, 1e-5f);
    EXPECT_FLOAT_EQ(lens("f_stop = 2\nfocus_m = 7\n").focus_m, 7.0f);
    EXPECT_THROW(lens("f_stop = 2\nfocus_m = 0.02\n"), Error);
}

// A camera that goes 0.5 m in a second of the film, behind a shutter of a tenth of a second.
TEST(FrameAt, AShutterSeesTheWayOfTheCamera)
{
    const std::string path =
        "[camera]\nshutter_s = 0.1\ninterpolation = \"linear\"\nkeys = [{ time_s = 0, position_m = [0, 1, "
        "4], look_at_m = [0, 1, 0] }, { time_s = 48, position_m = [24, 1, 4], look_at_m = [24, 1, 0] }]\n"
        "[output]\nsamples = 16\n";
    EXPECT_TRUE(frame_at(sequence_of(path), {20}).frame.shutter.empty());
    const Sequence sequence = sequence_of(path + "[render]\nmotion_blur = true\n");
    const gpu::Frame frame = frame_at(sequence, {20}).frame;
    ASSERT_EQ(frame.shutter.size(), 16u);
    EXPECT_EQ(frame.shutter[0].camera.to_world, frame.camera.to_world);
    float low = 1e9f, high = -1e9f;
    for (const gpu::ShutterMoment& moment : frame.shutter) {
        low = std::min(low, moment.camera.to_world[3].x);
        high = std::max(high, moment.camera.to_world[3].x);
    }
    // So long is a second of the film on the clock of its keys.
    const double clock = sequence.duration_s * sequence.scenario.output.fps / sequence.scenario.output.frames;
    EXPECT_NEAR(high - low, 0.1 * 0.5 * clock, 0.15 * 0.1 * 0.5 * clock);
    EXPECT_NEAR(0.5f * (high + low), frame.camera.to_world[3].x, 0.1 * 0.05 * clock);
}

TEST(FrameFingerprint, ChangesWithWhatChangesThePicture)
{
    const auto print = [](const std::string& text, int frame) {
        const Sequence sequence = sequence_of(text);
        return fingerprint_of(frame_parts(sequence, frame_at(sequence, {frame})));
    };
    const std::string base = print("", 5);
    EXPECT_EQ(print("", 5), base);
    EXPECT_EQ(print("[output]\nfilm = false\n", 5), base) << "the film is not in the picture";
    EXPECT_EQ(base.size(), 32u);
    for (const char* other :
         {"[output]\nwidth = 641\n", "[output]\nseed = 2\n", "[output]\nsamples = 9\n",
          "[sun]\nelevation_degrees = 3\n", "[sky]\ncloud_cover = 0.41\n",
          "[render]\nshadows = false\n", "[lights]\nscale = 1.5\n", "[camera]\nnear_m = 0.2\n",
          "[camera]\nf_stop = 2\n", "[render]\nmotion_blur = true\n",
          "[render]\nsoft_shadows = true\n", "[render]\nadaptive = 0.0\n",
          "[camera]\nshutter_s = 0.01\n", "[render]\nfalling = false\n",
          "[render]\nfalling_budget = 10\n", "[render]\nfalling_density = 2\n",
          "[render]\nlamp_glow = false\n",
          "[output]\naovs = [\"depth\"]\n", "[scene]\nmax_texture = 512\n",
          "[scene]\ntexture_rule = \"none\"\n",
          "[materials.\"x\"]\nporosity = 0.5\n", "[sun]\nsource = \"scene\"\n"}) {
        EXPECT_NE(print(other, 5), base) << other;
    }
    EXPECT_NE(print("", 6), base);
    Sequence sequence = sequence_of("");
    sequence.content = "another scene";
    EXPECT_NE(fingerprint_of(frame_parts(sequence, frame_at(sequence, {5}))), base);
}

// Every corner of the bounds lies inside the frame, and one touches its edge (within the margin).
TEST(FramingCamera, SeesAllOfTheBounds)
{
    for (const double aspect : {0.5, 1.0, 16.0 / 9.0}) {
        const scene::Bounds bounds{{-3.0f, 0.0f, -1.0f}, {5.0f, 2.0f, 9.0f}};
        const scene::Camera camera = framing_camera({bounds, {}}, aspect);
        const glm::mat4 view = glm::inverse(camera.to_world);
        const float tan_y = std::tan(0.5f * camera.vertical_fov_rad);
        float widest = 0.0f;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec4 p = view * glm::vec4(corner & 1 ? bounds.high.x : bounds.low.x,
                                                 corner & 2 ? bounds.high.y : bounds.low.y,
                                                 corner & 4 ? bounds.high.z : bounds.low.z, 1.0f);
            ASSERT_LT(p.z, -camera.near_m);
            widest = std::max({widest, std::abs(p.y / p.z) / tan_y,
                               std::abs(p.x / p.z) / (tan_y * static_cast<float>(aspect))});
        }
        EXPECT_LE(widest, 1.0f);
        EXPECT_GT(widest, 0.85f);
    }
}

TEST(FramingCamera, HasTheHorizonInThePictureOfALandLowerThanOfAThing)
{
    // Height of the horizon over the middle of the picture, as a share of the way to its edge.
    const auto horizon = [](const scene::Bounds& bounds) {
        const scene::Camera camera = framing_camera({bounds, {}}, 16.0 / 9.0);
        const glm::vec3 back(camera.to_world[2]);
        return back.y / std::hypot(back.x, back.z) / std::tan(0.5f * camera.vertical_fov_rad);
    };
    EXPECT_NEAR(horizon({{-150, 0, -100}, {150, 30, 100}}), 0.62f, 1e-3f);
    EXPECT_NEAR(horizon({{-1.5f, 0, -1.0f}, {1.5f, 0.1f, 1.0f}}), 0.79f, 1e-2f) << "a table is no land";
    EXPECT_NEAR(horizon({{-50, 0, -40}, {50, 90, 40}}), 0.79f, 1e-2f) << "nor a tower";
    EXPECT_NEAR(horizon({}), 0.79f, 1e-2f);
}

TEST(FramingCamera, OfALandStandsAmongWhatIsThere)
{
    // A village of 60 m, at one side of a plain with a few posts.
    Framing framing{{{-200, 0, -150}, {200, 12, 150}}, {}};
    for (int i = 0; i < 900; ++i) {
        framing.points.emplace_back(70.0f + static_cast<float>(i % 30) * 2.0f, static_cast<float>(i % 7),
                                    -30.0f + static_cast<float>(i / 30) * 2.0f);
    }
    for (int i = 0; i < 100; ++i) {
        framing.points.emplace_back(-200.0f + 4.0f * static_cast<float>(i), 0.0f, i % 2 ? -150.0f : 150.0f);
    }
    const auto shown = [&](const scene::Camera& camera) {
        const glm::mat4 view = glm::inverse(camera.to_world);
        const float tan_y = std::tan(0.5f * camera.vertical_fov_rad);
        std::size_t seen = 0;
        for (const glm::vec3& point : framing.points) {
            const glm::vec4 p = view * glm::vec4(point, 1.0f);
            seen += p.z < 0.0f && std::abs(p.y) < -p.z * tan_y && std::abs(p.x) < -p.z * tan_y * 16.0f / 9.0f;
        }
        return static_cast<double>(seen) / static_cast<double>(framing.points.size());
    };
    const scene::Camera camera = framing_camera(framing, 16.0 / 9.0);
    EXPECT_GT(shown(camera), 0.7);
    const float near_m = glm::distance(glm::vec3(camera.to_world[3]), {100.0f, 3.0f, 0.0f});
    EXPECT_LT(near_m, 140.0f);
    const scene::Camera all = framing_camera({framing.bounds, {}}, 16.0 / 9.0);
    EXPECT_GT(glm::distance(glm::vec3(all.to_world[3]), {0.0f, 6.0f, 0.0f}), 300.0f);

    // A tower in the camera's place: it stands back.
    const glm::vec3 eye(camera.to_world[3]);
    for (int i = 0; i < 40; ++i) framing.points.emplace_back(eye.x + 1.0f, static_cast<float>(i), eye.z + 1.0f);
    const glm::vec3 back(framing_camera(framing, 16.0 / 9.0).to_world[3]);
    EXPECT_GT(std::hypot(back.x - eye.x, back.z - eye.z), 5.0f);
}

TEST(ContentBounds, ALargeGroundDoesNotHideTheTown)
{
    scene::Scene scene;
    scene::Primitive town;
    for (int i = 0; i < 1000; ++i) {
        town.positions.emplace_back(static_cast<float>(i % 10), static_cast<float>(i / 100),
                                    static_cast<float>(i / 10 % 10));
    }
    scene::Primitive ground;
    ground.positions = {{-500, 0, -500}, {500, 0, -500}, {500, 0, 500}, {-500, 0, 500}};
    scene.meshes = {{"m", {town, ground}}};
    scene.instances = {{"i", 0, glm::mat4(1.0f)}};
    const scene::Bounds bounds = content_bounds(scene);
    EXPECT_LE(bounds.high.x, 9.0f);
    EXPECT_GE(bounds.low.z, 0.0f);
    scene.meshes[0].primitives.pop_back();
    EXPECT_FLOAT_EQ(content_bounds(scene).high.x, 9.0f);
}

TEST(CameraAt, NamesTheCamerasThereAre)
{
    scene::Scene scene;
    scene.cameras.resize(1);
    scene.cameras[0].name = "main";
    EXPECT_EQ(camera_at({}, scene, {}, 1.0, 0.0).name, "main");
    ScenarioCamera misspelt;
    misspelt.name = "mian";
    try {
        camera_at(misspelt, scene, {}, 1.0, 0.0);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("Did you mean \"main\"?"), std::string::npos);
    }
}

TEST(CameraTowards, LooksAtThePointWithYUp)
{
    const scene::Camera camera = camera_towards({3, 2, 1}, {0, 2, -3}, 0.8);
    const glm::vec4 target = glm::inverse(camera.to_world) * glm::vec4(0, 2, -3, 1);
    EXPECT_NEAR(target.x, 0.0f, 1e-5f);
    EXPECT_NEAR(target.y, 0.0f, 1e-5f);
    EXPECT_NEAR(target.z, -5.0f, 1e-5f);
    EXPECT_GT(camera.to_world[1].y, 0.99f);
    EXPECT_NEAR(glm::determinant(glm::mat3(camera.to_world)), 1.0f, 1e-5f);
}

// Noon at the equinox: the sun stands in the south at 90 degrees minus the latitude.
TEST(SunBySolarTime, KnownMoments)
{
    const weather::SunAngles noon = weather::sun_angles_by_solar_time(80.0, 12.0, 50.0);
    EXPECT_NEAR(noon.elevation_rad / kDegree, 40.0, 0.5);
    EXPECT_NEAR(noon.azimuth_rad / kDegree, 180.0, 0.5);
    const weather::SunAngles morning = weather::sun_angles_by_solar_time(80.0, 6.0, 50.0);
    EXPECT_NEAR(morning.elevation_rad / kDegree, 0.0, 0.5);
    EXPECT_NEAR(morning.azimuth_rad / kDegree, 90.0, 0.5);
    EXPECT_NEAR(weather::sun_angles_by_solar_time(172.0, 12.0, 50.0).elevation_rad / kDegree, 63.44,
                0.02);
    EXPECT_LT(weather::sun_angles_by_solar_time(172.0, 0.0, 50.0).elevation_rad, 0.0);
}

TEST(SunAt, FollowsTheScenesLightUnlessTold)
{
    scene::Scene scene;
    scene::Light light;
    light.kind = scene::LightKind::Directional;
    light.direction =
        glm::normalize(glm::vec3(-1.0f, -1.0f, 0.0f));  // from the east, 45 degrees high
    scene.lights = {light};
    EXPECT_NEAR(sun_at({}, scene, {}, 0.0, 0.0).elevation_rad / kDegree, 45.0, 1e-4);
    EXPECT_NEAR(sun_at({}, scene, {}, 0.0, 0.0).azimuth_rad / kDegree, 90.0, 1e-4);
    const Scenario told = parse_scenario("[sun]\nelevation_degrees = 10\n", "s.toml");
    EXPECT_NEAR(sun_at(told.sun, scene, {}, 0.0, 0.0).elevation_rad / kDegree, 10.0, 1e-9);
    EXPECT_NEAR(sun_at(told.sun, scene, {}, 0.0, 0.0).azimuth_rad / kDegree, 90.0, 1e-4);
}

// A sun of 2000 lux under the sky of one of 100 000 would not be seen.
TEST(SunAt, TheSkyIsAsBrightAsTheScenesSun)
{
    Sequence sequence = sequence_of("[sun]\nsource = \"scene\"\n");
    scene::Light light;
    light.kind = scene::LightKind::Directional;
    light.direction = glm::normalize(glm::vec3(-1.0f, -1.0f, 0.0f));
    light.intensity = 2000.0f;
    light.color = glm::vec3(1.0f);
    sequence.scene.lights = {light};
    const auto ground_lux = [](const gpu::Sky& sky) {
        return glm::dot(gpu::sunlight_at_ground(sky), glm::vec3(0.2126f, 0.7152f, 0.0722f));
    };
    EXPECT_NEAR(ground_lux(frame_at(sequence, {0}).frame.sky), 2000.0f, 1.0f);
    sequence.scene.lights[0].intensity = 1e30f;
    EXPECT_EQ(frame_at(sequence, {0}).frame.sky.sun_illuminance, 200000.0f);
    sequence.scene.lights[0].intensity = 0.0f;
    EXPECT_EQ(frame_at(sequence, {0}).frame.sky.sun_illuminance, 100000.0f);
    Sequence told = sequence_of("[sun]\nsource = \"scene\"\nilluminance_lux = 300\n");
    told.scene.lights = {light};
    EXPECT_EQ(frame_at(told, {0}).frame.sky.sun_illuminance, 300.0f);
    Sequence sky = sequence_of("");
    sky.scene.lights = {light};
    EXPECT_EQ(frame_at(sky, {0}).frame.sky.sun_illuminance, 100000.0f);
}

}  // namespace
}  // namespace petrichor::film
