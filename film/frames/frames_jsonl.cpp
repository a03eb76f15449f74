#include "film/frames/frames_jsonl.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/output_file.h"
#include "gpu/frame/sun.h"
#include "weather/readers/text.h"

namespace petrichor::film {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kName = "frames.jsonl";

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

Json camera_json(const scene::Camera& camera, int width, int height)
{
    Json json;
    json["name"] = camera.name;
    json["to_world"] = rows(camera.to_world);
    json["view"] = rows(glm::inverse(camera.to_world));
    if (camera.orthographic_height_m > 0.0f) {
        json["orthographic_height_m"] = shortest(camera.orthographic_height_m);
    } else {
        const glm::mat4 projection = scene::clip_projection(camera, width, height, 0.0f);
        json["projection"] = rows(projection);
        json["vertical_fov_rad"] = shortest(camera.vertical_fov_rad);
        const double focal_px = shortest(0.5f * static_cast<float>(height) * projection[1][1]);
        json["intrinsics"] = {
            {"fx", focal_px}, {"fy", focal_px}, {"cx", 0.5 * width}, {"cy", 0.5 * height}};
    }
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
    json["camera"] = camera_json(facts.input.camera, settings.width, settings.height);
    json["sun"] = sun_json(facts.input.sky);
    json["sky"] = sky_json(facts.input.sky);
    json["weather"] = weather_json(facts);
    json["lamps"] = shortest(facts.input.scene_light_scale);
    json["aovs"] = settings.aovs;
    json["beauty_hash"] = facts.beauty_hash;
    json["settings"] = facts.settings;
    json["files"] = facts.files;
    return json.dump();
}

std::map<Job, FrameRecord> read_frame_records(const fs::path& folder)
{
    std::map<Job, FrameRecord> records;
    std::ifstream in(folder / kName);
    std::string line;
    while (std::getline(in, line)) {
        const Json json = Json::parse(line, nullptr, false);
        if (!json.is_object() || !json.contains("frame") || !json["frame"].is_number_integer())
            continue;
        FrameRecord record;
        record.line = line;
        if (json.contains("settings") && json["settings"].is_string())
            record.settings = json["settings"];
        if (json.contains("files") && json["files"].is_object()) {
            for (const auto& [name, bytes] : json["files"].items()) {
                if (bytes.is_number_unsigned()) record.files[name] = bytes.get<std::uintmax_t>();
            }
        }
        const auto part = [&](const char* key) {
            return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
        };
        records[{json["frame"].get<int>(), part("variant"), part("view")}] = std::move(record);
    }
    return records;
}

bool files_are_whole(const FrameRecord& record, const fs::path& folder)
{
    for (const auto& [name, bytes] : record.files) {
        std::error_code failed;
        if (fs::file_size(folder / name, failed) != bytes || failed) return false;
    }
    return !record.files.empty();
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
