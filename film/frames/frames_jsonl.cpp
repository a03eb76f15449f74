#include "film/frames/frames_jsonl.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "gpu/frame/sun.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kName = "frames.jsonl";
constexpr std::uint64_t kMostBytes = 1ull << 30;  // half a million frames

// A float as the shortest decimal that reads back as the same float, not as its widened double.
double shortest(float value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    for (int digits = 1; digits < 9; ++digits) {
        char shorter[32];
        std::snprintf(shorter, sizeof shorter, "%.*g", digits, static_cast<double>(value));
        if (std::strtof(shorter, nullptr) == value) return std::strtod(shorter, nullptr);
    }
    return std::strtod(text, nullptr);
}

Json rows(const glm::mat4& matrix)
{
    Json result = Json::array();
    for (int row = 0; row < 4; ++row) {
        Json line = Json::array();
        for (int column = 0; column < 4; ++column) line.push_back(shortest(matrix[column][row]));
        result.push_back(line);
    }
    return result;
}

// What a reader needs to find a point of the world in the picture, without a look into our code.
constexpr const char* kPerspective =
    "view takes the world to x right, y up, -z ahead, metres; u = cx + fx x / -z, v = cy - fy y / -z, pixels from the "
    "upper left corner of the picture";
constexpr const char* kOrthographic =
    "view takes the world to x right, y up, -z ahead, metres; u = cx + fx x, v = cy - fy y, pixels from the upper left "
    "corner of the picture";

Json camera_json(const scene::Camera& camera, int width, int height)
{
    Json json;
    json["name"] = camera.name;
    json["to_world"] = rows(camera.to_world);
    json["view"] = rows(glm::inverse(camera.to_world));
    const bool orthographic = camera.orthographic_height_m > 0.0f;
    double focal_px = 0.0;  // of a parallel view: pixels a metre
    if (orthographic) {
        json["orthographic_height_m"] = shortest(camera.orthographic_height_m);
        focal_px = shortest(static_cast<float>(height) / camera.orthographic_height_m);
    } else {
        const glm::mat4 projection = scene::clip_projection(camera, width, height, 0.0f);
        json["projection"] = rows(projection);
        json["vertical_fov_rad"] = shortest(camera.vertical_fov_rad);
        focal_px = shortest(0.5f * static_cast<float>(height) * projection[1][1]);
    }
    json["intrinsics"] = {{"fx", focal_px}, {"fy", focal_px}, {"cx", shortest(0.5f * static_cast<float>(width) * (1.0f - camera.shift.x))},
                          {"cy", shortest(0.5f * static_cast<float>(height) * (1.0f + camera.shift.y))}};
    json["conventions"] = orthographic ? kOrthographic : kPerspective;
    json["near_m"] = shortest(camera.near_m);
    return json;
}

Json sun_json(const gpu::Sky& sky)
{
    const glm::vec3 towards = gpu::sun_direction(sky);
    return {{"elevation_rad", shortest(sky.sun_elevation_rad)},
            {"azimuth_rad", shortest(sky.sun_azimuth_rad)},
            {"towards", {shortest(towards.x), shortest(towards.y), shortest(towards.z)}},
            {"illuminance_lux", shortest(sky.sun_illuminance)},
            {"from_scene", !sky.analytic_sun}};
}

// What lights the scene besides the sky: direct light as it arrives, behind air and clouds, and the number of lamps.
Json light_json(const gpu::LightFacts& light)
{
    using Direct = gpu::LightFacts::Direct;
    Json json{{"lamps", light.lamps}, {"glowing", light.glowing}};
    if (light.direct == Direct::None) return json;
    const char* of = light.direct == Direct::Sun ? "sun" : light.direct == Direct::Moon ? "moon" : "scene";
    const float luminance = glm::dot(light.lux, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    json["direct"] = {{"of", of},
                      {"towards", {shortest(light.towards.x), shortest(light.towards.y), shortest(light.towards.z)}},
                      {"illuminance_lux", shortest(luminance)},
                      {"rgb_lux", {shortest(light.lux.r), shortest(light.lux.g), shortest(light.lux.b)}}};
    return json;
}

Json moon_json(const gpu::Sky& sky)
{
    const glm::vec3 towards = gpu::moon_direction(sky);
    return {{"elevation_rad", shortest(sky.moon_elevation_rad)},
            {"azimuth_rad", shortest(sky.moon_azimuth_rad)},
            {"towards", {shortest(towards.x), shortest(towards.y), shortest(towards.z)}},
            {"illuminance_lux", shortest(sky.moon_lux)},
            {"illuminated", shortest(sky.moon_illuminated)}};
}

Json sky_json(const gpu::Sky& sky)
{
    return {{"cloud_cover", shortest(sky.cloud_cover)},
            {"turbidity", shortest(sky.turbidity)},
            {"ground_albedo", shortest(sky.ground_albedo)}};
}

Json weather_json(const FrameFacts& facts)
{
    const shared::WeatherMoment& moment = facts.input.weather;
    Json json{{"name", facts.weather}};
    for (const shared::MomentRow& row : shared::kMomentRows) {
        const float* numbers = shared::numbers_of(moment, row);
        const auto value = [&](std::size_t i) {
            const bool unknown = row.may_be_unknown && numbers[i] < 0.0f;
            return unknown ? Json(nullptr) : Json(shortest(numbers[i]));
        };
        Json& entry = json[row.name];
        if (row.numbers == 1) {
            entry = value(0);
        } else {
            for (std::size_t i = 0; i < row.numbers; ++i) entry.push_back(value(i));
        }
    }
    return json;
}

// Of those seen, what is not drawn is part of the air's extinction.
Json falling_json(const gpu::FallingFacts& falling)
{
    return {{"drawn", falling.drawn},
            {"extinguished", std::round(std::max(falling.seen - falling.drawn, 0.0))},
            {"per_m3", shortest(falling.per_m3)},
            {"extinction_per_m", shortest(falling.extinction_per_m)},
            {"drawn_reach_m", shortest(falling.drawn_reach_m)},
            {"visibility_m", shortest(falling.visibility_m)}};
}

// Holds the folder itself locked, so that no lock file is left behind.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder)
        : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
        // Where locks do not work (some network folders) the merge is still whole, only not shared.
        if (descriptor_ >= 0) (void)!::flock(descriptor_, LOCK_EX);
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

private:
    int descriptor_;
};

}  // namespace

std::string fingerprint_of(const FrameParts& parts)
{
    Hasher hasher;
    for (const auto& [name, hash] : parts) {
        hasher.add(name);
        hasher.add(hash);
    }
    return hasher.text();
}

std::string frame_line(const FrameFacts& facts)
{
    const gpu::FrameSettings& settings = facts.input.settings;
    Json json;
    json["frame"] = facts.job.frame;
    if (!facts.job.variant.empty()) json["variant"] = facts.job.variant;
    if (!facts.job.view.empty()) json["view"] = facts.job.view;
    json["time_s"] = facts.time_s;
    if (facts.moment.utc_us) json["utc"] = weather::iso_from_us(*facts.moment.utc_us);
    if (facts.moment.latitude_deg && facts.moment.longitude_deg) {
        json["place"] = {{"latitude_deg", *facts.moment.latitude_deg},
                         {"longitude_deg", *facts.moment.longitude_deg}};
        if (facts.moment.elevation_m) json["place"]["elevation_m"] = *facts.moment.elevation_m;
    }
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["samples"] = settings.samples;
    json["seed"] = settings.seed;
    json["exposure"] = shortest(facts.exposure);
    json["exposure_mode"] = facts.exposure_by.mode;
    // The same as a camera's setting: what the scale is 1 / (1.2 2^EV100) of, bias included.
    json["ev100"] = shortest(-std::log2(1.2f * facts.exposure));
    if (facts.exposure_by.metered_ev100) {
        json["metered_ev100"] = shortest(*facts.exposure_by.metered_ev100);
    }
    if (facts.exposure_by.metered_light) {
        const glm::vec3 light = *facts.exposure_by.metered_light;
        json["white_balance"] = {{"light_rgb", {shortest(light.r), shortest(light.g), shortest(light.b)}},
                                 {"share", shortest(settings.white_share)}};
    }
    json["camera"] = camera_json(facts.input.camera, settings.width, settings.height);
    json["sun"] = sun_json(facts.input.sky);
    if (const gpu::SunCookie& cookie = facts.input.sun_cookie; cookie.first_texel >= 0) {
        json["sun"]["cookie"] = {
            {"size_m", shortest(cookie.size_m)},
            {"mean", {shortest(cookie.mean.r), shortest(cookie.mean.g), shortest(cookie.mean.b)}}};
    }
    if (facts.input.sky.moon_lux > 0.0f) json["moon"] = moon_json(facts.input.sky);
    json["light"] = light_json(facts.light);
    json["sky"] = sky_json(facts.input.sky);
    json["weather"] = weather_json(facts);
    if (facts.falling.per_m3 > 0.0f) json["falling"] = falling_json(facts.falling);
    for (const auto& [name, sum] : facts.ground) json["ground"][name] = sum;
    json["lamps"] = shortest(facts.input.scene_light_scale);
    json["aovs"] = settings.aovs;
    json["beauty_hash"] = facts.beauty_hash;
    json["settings"] = fingerprint_of(facts.made_from);
    json["made_from"] = facts.made_from;
    Json hashes = Json::object();
    for (const auto& [name, mark] : facts.files) {
        json["files"][name] = mark.bytes;
        hashes[name] = mark.hash;
    }
    json["file_hashes"] = hashes;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::map<Job, FrameRecord> read_frame_records(const fs::path& folder)
{
    std::map<Job, FrameRecord> records;
    std::error_code failed;
    if (!fs::exists(fs::symlink_status(folder / kName, failed))) return records;
    std::istringstream in(read_file(folder / kName, "frames", kMostBytes));
    std::string line;
    while (std::getline(in, line)) {
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object() || !json.contains("frame") || !json["frame"].is_number_integer())
            continue;
        FrameRecord record;
        record.line = line;
        if (json.contains("made_from") && json["made_from"].is_object()) {
            for (const auto& [name, hash] : json["made_from"].items())
                if (hash.is_string()) record.made_from[name] = hash;
        }
        if (json.contains("files") && json["files"].is_object()) {
            for (const auto& [name, bytes] : json["files"].items()) {
                // Only names that lie in this folder: the file may have been edited.
                if (bytes.is_number_unsigned() && name.find('/') == std::string::npos)
                    record.files[name].bytes = bytes.get<std::uintmax_t>();
            }
        }
        if (json.contains("file_hashes") && json["file_hashes"].is_object()) {
            for (const auto& [name, hash] : json["file_hashes"].items()) {
                const auto file = record.files.find(name);
                if (file != record.files.end() && hash.is_string()) file->second.hash = hash;
            }
        }
        const auto part = [&](const char* key) {
            return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
        };
        record.beauty_hash = part("beauty_hash");
        records[{json["frame"].get<int>(), part("variant"), part("view")}] = std::move(record);
    }
    return records;
}

FileMark file_mark(const fs::path& file)
{
    const InputFile in = open_regular_file(file, "frame");
    Hasher hasher;
    std::vector<std::byte> piece(1 << 20);
    FileMark mark;
    while (const std::size_t got = in.read(piece)) {
        hasher.add_bytes({piece.data(), got});
        mark.bytes += got;
    }
    mark.hash = hasher.text();
    return mark;
}

std::string wrong_with_files(const FrameRecord& record, const fs::path& folder)
{
    if (record.files.empty()) return "no files of it are known";
    for (const auto& [name, mark] : record.files) {
        std::error_code failed;
        const auto bytes = fs::file_size(folder / name, failed);
        if (failed) return name + " is missing";
        if (mark.hash.empty()) return name + " was written by an older version, without a hash";
        if (bytes != mark.bytes || file_mark(folder / name).hash != mark.hash)
            return name + " is not the file that was written";
    }
    return "";
}

void merge_frame_lines(const fs::path& folder, const std::map<Job, std::string>& lines)
{
    const FolderLock lock(folder);
    std::map<Job, std::string> all;
    for (auto& [job, record] : read_frame_records(folder)) all[job] = std::move(record.line);
    for (const auto& [job, line] : lines) all[job] = line;
    std::string text;
    for (const auto& [job, line] : all) text += line + "\n";
    write_text_file(folder / kName, text);
}

}  // namespace petrichor::film
