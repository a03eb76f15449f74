#include "film/jobs/exposure.h"

#include <algorithm>
#include <cmath>

#include "formulas/light/exposure.h"

namespace petrichor::film {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMostNeighbours = 48;  // on each side

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
    if (camera.exposure_mode != Exposure::Auto) return {};
    const ScenarioOutput& output = sequence.scenario.output;
    const double frames = std::round(camera.exposure_smoothing_s * output.fps);
    const int n = static_cast<int>(std::min<double>(frames, kMostNeighbours));
    std::vector<MeteredJob> jobs;
    double sum = 0.0;
    for (int k = -n; k <= n; ++k) {
        Job other = job;
        other.frame += k;
        if (k != 0 && (other.frame < 0 || other.frame >= output.frames)) continue;
        const double c = std::cos(kPi * k / (2.0 * (n + 1)));
        jobs.push_back({other, c * c});
        sum += c * c;
    }
    for (MeteredJob& one : jobs) one.weight /= sum;
    return jobs;
}

MeteredSetting metered_setting(const ScenarioCamera& camera, const std::vector<MeteredJob>& jobs,
                               const std::vector<std::optional<float>>& ev100)
{
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (!ev100[i]) continue;
        sum += jobs[i].weight * static_cast<double>(*ev100[i]);
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

ExposureFacts Meter::expose(gpu::Renderer& renderer, const Job& job, gpu::Frame& frame)
{
    const ScenarioCamera& camera = camera_of(*sequence_, job);
    if (camera.exposure_mode == Exposure::Fixed) return {"fixed", {}};
    if (camera.exposure_mode == Exposure::Incident) return {"incident", {}};
    const auto jobs = metered_jobs(*sequence_, job);
    std::vector<std::optional<float>> ev100;
    for (const MeteredJob& one : jobs) {
        auto found = metered_.find(one.job);
        if (found == metered_.end()) {
            const gpu::Frame other = frame_at(*sequence_, one.job).frame;
            found = metered_.emplace(one.job, renderer.meter(other)).first;
        }
        ev100.push_back(found->second);
    }
    const MeteredSetting setting = metered_setting(camera, jobs, ev100);
    frame.settings.exposure = shared::exposure_of_ev100(static_cast<float>(setting.ev100));
    ExposureFacts facts{"auto", {}};
    if (setting.metered_ev100) facts.metered_ev100 = static_cast<float>(*setting.metered_ev100);
    return facts;
}

}  // namespace petrichor::film
