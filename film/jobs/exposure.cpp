#include "film/jobs/exposure.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "formulas/light/exposure.h"
#include "gpu/frame/metering.h"

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMostNeighbours = 48;  // on each side
constexpr double kMetered_s = 0.125;   // about so far apart are the frames that are metered
// A few frames of a long time are pictures of their own, no film: each is exposed for itself.
constexpr int kShareOfFilm = 8;
constexpr double kMostClock_s = 1800.0;

// How far apart a frame and the next are on the clock of a weather file, seconds; 0 without one.
double clock_step_s(const Sequence& sequence, const Job& job)
{
    for (const SequenceVariant& variant : sequence.variants) {
        if (variant.name != job.variant || !variant.weather.utc_us) continue;
        const auto at = [&](int frame) { return variant.weather.utc_us(frame_time_s(sequence, frame)); };
        return std::abs(static_cast<double>(at(job.frame + 1) - at(job.frame))) * 1e-6;
    }
    return 0.0;
}

// The frames on each side that have a say.
int neighbours(const Sequence& sequence, const Job& job)
{
    const ScenarioOutput& output = sequence.scenario.output;
    double most = std::min<double>(kMostNeighbours, output.frames / kShareOfFilm);
    const double step_s = clock_step_s(sequence, job);
    if (step_s > 0.0) most = std::min(most, std::floor(kMostClock_s / step_s));
    return static_cast<int>(std::min(std::round(camera_of(sequence, job).exposure_smoothing_s * output.fps), most));
}

}  // namespace

double fixed_exposure(const ScenarioCamera& camera, double time_s)
{
    if (camera.exposure_mode != Exposure::Fixed) return 0.0;
    if (camera.exposure.given()) return value_at(camera.exposure, time_s);
    return static_cast<double>(
        shared::exposure_of_ev100(static_cast<float>(value_at(camera.ev100, time_s))));
}

std::vector<MeteredJob> metered_jobs(const Sequence& sequence, const Job& job)
{
    const ScenarioCamera& camera = camera_of(sequence, job);
    if (camera.exposure_mode != Exposure::Auto && !camera.white_balance_auto) return {};
    const ScenarioOutput& output = sequence.scenario.output;
    const int n = neighbours(sequence, job);
    const int step = std::clamp(static_cast<int>(std::lround(kMetered_s * output.fps)), 1,
                                std::max(n, 1));
    std::vector<MeteredJob> jobs;
    double sum = 0.0;
    for (int k = -n; k <= n; ++k) {
        Job other = job;
        other.frame += k;
        if (k != 0 && (other.frame < 0 || other.frame >= output.frames)) continue;
        if (n > 0 && other.frame % step != 0) continue;
        const double c = std::cos(kPi * k / (2.0 * (n + 1)));
        jobs.push_back({other, c * c});
        sum += c * c;
    }
    if (jobs.empty()) return {{job, 1.0}};  // a frame outside of the sequence
    for (MeteredJob& one : jobs) one.weight /= sum;
    return jobs;
}

std::vector<std::string> smoothing_notes(const Sequence& sequence)
{
    std::vector<std::string> notes;
    for (const SequenceVariant& variant : sequence.variants) {
        for (const ScenarioView& view : sequence.views) {
            if (view.camera.exposure_mode != Exposure::Auto) continue;
            if (view.camera.exposure_smoothing_s <= ScenarioCamera{}.exposure_smoothing_s) continue;
            const int asked = static_cast<int>(std::lround(view.camera.exposure_smoothing_s * sequence.scenario.output.fps));
            const int taken = neighbours(sequence, {0, variant.name, view.name});
            if (taken >= std::min(asked, kMostNeighbours)) continue;
            notes.push_back("exposure is smoothed over " + std::to_string(taken) + " frames on each side, not the " +
                            std::to_string(asked) + " of exposure_smoothing_s: at most an eighth of the frames, and half an "
                            "hour of a weather file");
        }
    }
    std::sort(notes.begin(), notes.end());
    notes.erase(std::unique(notes.begin(), notes.end()), notes.end());
    return notes;
}

MeteredSetting metered_setting(const ScenarioCamera& camera, const std::vector<MeteredJob>& jobs,
                               const std::vector<gpu::MeterReading>& readings)
{
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (!readings[i].ev100) continue;
        sum += jobs[i].weight * static_cast<double>(*readings[i].ev100);
        weight += jobs[i].weight;
    }
    MeteredSetting setting{camera.ev100_low, std::nullopt};
    if (weight > 0.0) {
        setting.metered_ev100 = sum / weight;
        const float set = shared::metered_setting(static_cast<float>(*setting.metered_ev100));
        setting.ev100 = std::clamp(static_cast<double>(set), camera.ev100_low, camera.ev100_high);
    }
    return setting;
}

glm::vec3 metered_white(const std::vector<MeteredJob>& jobs, const std::vector<gpu::MeterReading>& readings)
{
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (!readings[i].light) continue;
        sum += jobs[i].weight * glm::dvec3(*readings[i].light);
        weight += jobs[i].weight;
    }
    return weight > 0.0 ? glm::vec3(sum / weight) : glm::vec3(0.0f);
}

// Meters it, unless that is done or another thread is at it.
Meter::Metered Meter::metered(gpu::Renderer& renderer, const Job& job, gpu::MeterOf what, bool places)
{
    std::promise<gpu::MeterReading> promise;
    Metered result;
    {
        const std::lock_guard lock(mutex_);
        const auto found = metered_.find(job);
        if (found != metered_.end()) return found->second;
        result = metered_.emplace(job, promise.get_future().share()).first->second;
    }
    try {
        gpu::Frame frame = frame_at(*sequence_, job).frame;
        if (places) frame.place = gpu::no_places();
        promise.set_value(renderer.meter(frame, what));
    } catch (...) {
        promise.set_exception(std::current_exception());
    }
    return result;
}

ExposureFacts Meter::expose(gpu::Renderer& renderer, const Job& job, gpu::Frame& frame)
{
    const ScenarioCamera& camera = camera_of(*sequence_, job);
    ExposureFacts facts{"auto", {}, {}};
    if (camera.exposure_mode == Exposure::Fixed) facts.mode = "fixed";
    if (camera.exposure_mode == Exposure::Incident) facts.mode = "incident";
    const auto jobs = metered_jobs(*sequence_, job);
    if (jobs.empty()) return facts;
    const gpu::MeterOf what = camera.white_balance_auto ? gpu::MeterOf::ExposureAndLight : gpu::MeterOf::Exposure;
    // Its own share first: two threads that waited at once for each other's would never end.
    std::vector<Metered> pending;
    for (const MeteredJob& one : jobs) pending.push_back(metered(renderer, one.job, what, frame.place != nullptr));
    std::vector<gpu::MeterReading> readings;
    for (const Metered& one : pending) readings.push_back(one.get());
    if (camera.exposure_mode == Exposure::Auto) {
        const MeteredSetting setting = metered_setting(camera, jobs, readings);
        frame.settings.exposure = shared::exposure_of_ev100(static_cast<float>(setting.ev100));
        if (setting.metered_ev100) facts.metered_ev100 = static_cast<float>(*setting.metered_ev100);
    }
    if (camera.white_balance_auto) {
        const glm::vec3 white = metered_white(jobs, readings);
        frame.settings.white_light = white;
        if (white != glm::vec3(0.0f)) facts.metered_light = white;
    }
    return facts;
}

}  // namespace petrichor::film
