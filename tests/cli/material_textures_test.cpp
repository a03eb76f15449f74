// Texture slots as keys of a scenario, through whole renders: files, colour space, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "film/frames/frames_jsonl.h"
#include "scene/gltf/gltf.h"
#include "scene/material_table.h"
#include "tests/support/tiny_render.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace testing_program;

class MaterialTextures : public TinyRender {
protected:
    MaterialTextures() : TinyRender("material-textures-cli", R"([lights]
lamps = "on"
[materials."stone"]
emissive_factor = [1, 1, 1]
emissive_strength = 3000
)")
    {
    }
};

// Stripes in all four channels, neither white nor what the scene brings.
std::string striped_png()
{
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool band = x / 8 % 2 == 0;
            const std::array<int, 4> light{30, 90, 210, 70}, dark{200, 160, 225, 255};
            for (const int value : band ? light : dark)
                pixels.push_back(static_cast<std::uint8_t>(value));
        }
    }
    const auto bytes = texproc::encode_png8(32, 32, 4, pixels);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Courts like that of the tiny scene, each of a material of its own, in rows before a camera far off.
struct Court {
    std::string name;         // of its material
    std::string with, asked;  // keys of its material: the slot, and what is asked for beside it
};
constexpr int kColumns = 8;
constexpr float kAcross_m = 4.5f, kAlong_m = 7.0f;
constexpr int kCourt = 38;       // pixels that are looked at, across; down three quarters of it
constexpr float kPixel_m = 0.1f;  // where the camera looks

std::string courts_glb(const std::vector<Court>& courts)
{
    const std::string tiny = tiny_scene_glb();
    scene::Scene scene = scene::load_gltf(std::as_bytes(std::span(tiny)), "tiny", {});
    const scene::Material stone = scene.materials.at(0);
    const scene::Mesh mesh = scene.meshes.at(0);
    scene.materials.clear();
    scene.meshes.clear();
    scene.instances.clear();
    for (std::size_t i = 0; i < courts.size(); ++i) {
        scene.materials.push_back(stone);
        scene.materials.back().name = courts[i].name;
        scene.meshes.push_back(mesh);
        for (scene::Primitive& part : scene.meshes.back().primitives) part.material = static_cast<std::uint32_t>(i);
        const auto at = static_cast<int>(i);
        const glm::vec3 offset(kAcross_m * static_cast<float>(at % kColumns), 0.0f, -kAlong_m * static_cast<float>(at / kColumns));
        scene.instances.push_back({courts[i].name, static_cast<std::uint32_t>(i), glm::translate(glm::mat4(1.0f), offset)});
    }
    const auto bytes = write_glb(scene);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What a slot needs of other keys to be seen.
std::string asked_beside(const std::string& slot)
{
    const auto of = [&](const char* first) { return slot.starts_with(first); };
    if (of("emissive")) return "emissive_factor = [1, 1, 1]\nemissive_strength = 3000\n";
    if (of("clearcoat")) return "clearcoat_factor = 1\nclearcoat_roughness_factor = 0.5\n";
    if (of("sheen")) return "sheen_color_factor = [0.8, 0.8, 0.8]\nsheen_roughness_factor = 1\n";
    if (of("anisotropy")) return "anisotropy_strength = 0.9\n";
    if (of("diffuse_transmission")) return "diffuse_transmission_factor = 0.8\n";
    if (of("transmission")) return "transmission_factor = 0.9\n";
    if (of("thickness"))
        return "transmission_factor = 0.9\nthickness_factor = 0.5\nattenuation_distance = 0.2\nattenuation_color = [0.3, 0.6, 0.9]\n";
    if (of("iridescence")) return "iridescence_factor = 1\nroughness_factor = 0.3\nmetallic_roughness_texture = \"\"\niridescence_thickness_maximum = 800\n";
    if (of("specular_glossiness")) return "specular_workflow = true\nworkflow_specular_factor = [0.6, 0.6, 0.6]\n";
    if (of("translucency")) return "translucency = 0.6\n";
    if (of("skin_curvature")) return "lighting_model = \"skin\"\nskin_curvature = 1\n";
    if (of("height")) return "height_scale_m = 0.1\nparallax = \"occlusion\"\n";
    if (of("snow_mask_normal")) return "snow_mask_texture = \"stripes.png\"\n";
    if (of("third_") || of("fourth_") || of("far_"))
        return "second_set = \"layers\"\nmix_mask_texture = \"stripes.png\"\nfar_start_m = 0\n";
    if (of("second_lobe")) return "";
    if (of("second_") || of("mix_")) return "second_set = \"mix\"\nmix_factor = 0.5\nsecond_color_factor = [0.9, 0.2, 0.2]\n";
    return "";
}

class MaterialSlots : public testing::Test {
protected:
    // The picture of all courts, with what their slots are given or without.
    Image picture(const std::vector<Court>& courts, bool with)
    {
        const int rows = (static_cast<int>(courts.size()) + kColumns - 1) / kColumns;
        const glm::vec3 middle(0.5f * kAcross_m * (kColumns - 1), 0.5f, -0.5f * kAlong_m * static_cast<float>(rows - 1));
        const glm::vec3 eye = middle + glm::vec3(0.0f, kAway_m, kAway_m);
        const int width = 52 * kColumns, height = 56 * rows;
        const float fov = 2.0f * std::atan(0.5f * static_cast<float>(height) * kPixel_m / (std::sqrt(2.0f) * kAway_m));
        std::ostringstream text;
        text << "[scene]\nfile = \"scene.glb\"\nground = \"none\"\n[weather]\n"
             << "keys = [{ time_s = 0, temperature_c = 5, rainfall = 0.8, script_controlled = 0, wetness = 0.5, cracks = 0.5, "
                "puddles = 0.7, snow = 0.4 }]\n[sky]\ncloud_cover = 0\n"
             << "[output]\nwidth = " << width << "\nheight = " << height << "\nsamples = 1\nframes = 1\nfilm = false\nexr = false\n"
             << "[render]\nindirect = \"ambient\"\n[lights]\nemissive = false\n"  // no court lights another
             << "[camera]\nexposure = 1.5e-4\nbloom = 0\nwet_lens = 0\nposition_m = [" << eye.x << ", " << eye.y << ", " << eye.z << "]\nlook_at_m = ["
             << middle.x << ", " << middle.y << ", " << middle.z << "]\nfov_degrees = " << glm::degrees(fov) << "\n";
        for (const Court& court : courts)
            text << "[materials.\"" << court.name << "\"]\n" << court.asked << (with ? court.with : "");
        write_file(place_ / "scene.glb", courts_glb(courts));
        write_file(place_ / "s.toml", text.str());
        const Outcome outcome = run_petrichor({.arguments = {"render", "s.toml", "-o", with ? "with" : "without"}}, place_.path());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        to_clip_ = glm::perspective(fov, static_cast<float>(width) / static_cast<float>(height), 1.0f, 10.0f * kAway_m) *
                   glm::lookAt(eye, middle, glm::vec3(0, 1, 0));
        return texproc::read_image(place_ / (with ? "with" : "without") / "frame_0000.png");
    }

    // How many pixels of a court differ.
    int changed(const Image& a, const Image& b, int court) const
    {
        const glm::vec4 clip = to_clip_ * glm::vec4(kAcross_m * static_cast<float>(court % kColumns), 0.4f,
                                                    -kAlong_m * static_cast<float>(court / kColumns), 1.0f);
        const int x0 = static_cast<int>((0.5f + 0.5f * clip.x / clip.w) * static_cast<float>(a.width)) - kCourt / 2;
        const int y0 = static_cast<int>((0.5f - 0.5f * clip.y / clip.w) * static_cast<float>(a.height)) - kCourt * 3 / 8;
        int count = 0;
        for (int y = y0; y < y0 + kCourt * 3 / 4; ++y) {
            for (int x = x0; x < x0 + kCourt; ++x) {
                bool same = true;
                for (int c = 0; c < 3; ++c) same = same && a.at(x, y, c) == b.at(x, y, c);
                count += !same;
            }
        }
        return count;
    }

    Workplace place_{"material-slots-cli"};

private:
    static constexpr float kAway_m = 80.0f;
    glm::mat4 to_clip_{1.0f};
};

// All slots in two pictures: a court for each, and courts between them that are given nothing and stay as they are.
TEST_F(MaterialSlots, EachTakesAFileThatChangesItsMaterialAlone)
{
    if (!testing_device::device_is_there()) return;
    write_file(place_ / "stripes.png", striped_png());
    // In this light and this snow the first two change no code of a pixel (MaterialRows.EveryTextureChangesThePicture sees
    // them).
    const std::set<std::string> unseen{"snow_mask_normal_texture", "skin_curvature_texture"};
    std::vector<Court> courts{{"bare", "base_color_texture = \"\"\n", ""}};
    for (const scene::MaterialTexture& slot : scene::material_textures()) {
        const std::string name(slot.name);
        if (courts.size() % 5 == 4) courts.push_back({"control " + std::to_string(courts.size()), "", ""});
        courts.push_back({name, name + " = \"stripes.png\"\n", asked_beside(name)});
    }
    const Image without = picture(courts, false), with = picture(courts, true);
    ASSERT_EQ(without.pixels.size(), with.pixels.size());
    int untouched = 0;
    for (std::size_t i = 0; i < courts.size(); ++i) {
        const int pixels = changed(without, with, static_cast<int>(i));
        if (courts[i].with.empty()) {
            EXPECT_EQ(pixels, 0) << courts[i].name << " changes with others";
            ++untouched;
        } else if (!unseen.contains(courts[i].name)) {
            EXPECT_GT(pixels, 0) << courts[i].name;
        }
    }
    EXPECT_GT(untouched, 8);
}

TEST_F(MaterialTextures, AFileThatChangesIsRenderedAgain)
{
    write_file(place_ / "map.png", striped_png());
    const std::string key = "base_color_texture = \"map.png\"\n";
    const std::string before = picture(key, "out");
    const auto made_from = film::read_frame_records(place_ / "out").begin()->second.made_from;
    write_file(place_ / "map.png", [] {
        const std::vector<std::uint8_t> red(8 * 8 * 3, 120);
        const auto bytes = texproc::encode_png8(8, 8, 3, red);
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }());
    const Outcome again = run_petrichor(
        {.arguments = {"render", "s.toml", "-o", "out", "--resume"}}, place_.path());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(film::read_frame_records(place_ / "out").begin()->second.made_from, made_from);
    EXPECT_NE(read_file(place_ / "out" / "frame_0000.png"), before);
}

TEST_F(MaterialTextures, WhatCannotBeReadIsAnErrorAndLeavesNothing)
{
    write_file(place_ / "broken.png", striped_png().substr(0, 40));
    for (const std::string file : {"missing.png", "broken.png", "."}) {
        const Outcome outcome = render("height_texture = \"" + file + "\"\n", "none");
        EXPECT_EQ(outcome.exit_code, 2) << file << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(file == "." ? "s.toml" : file));
        EXPECT_FALSE(fs::exists(place_ / "none" / "frame_0000.png"));
    }
    const Outcome outcome = render("base_colour_texture = \"a.png\"\n", "none");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("base_color_texture"));
}

}  // namespace
}  // namespace petrichor::cli
