#ifndef PETRICHOR_FILM_JOBS_EXPOSURE_H
#define PETRICHOR_FILM_JOBS_EXPOSURE_H

#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "film/frames/frames_jsonl.h"
#include "film/jobs/sequence.h"
#include "gpu/renderer.h"

namespace petrichor::film {

/// The linear scale that a camera fixes at a time, by number or by EV100; 0 when it fixes none.
double fixed_exposure(const ScenarioCamera& camera, double time_s);

/// A frame that has a say in a picture's exposure.
struct MeteredJob {
    Job job;
    double weight = 0.0;  ///< of all 1
};

/// The frames that are metered for a job whose camera has exposure = "auto" or white_balance_k = "auto", in order;
/// none for the others. With n = exposure_smoothing_s times the frames a second (rounded, at most 48, an eighth of
/// the sequence, and half an hour on the clock of a weather file): those of the n before and after it,
/// within the sequence, that lie on a grid of about an eighth of a second
/// (every frame where n is less), weighted by cos^2(pi k / (2 (n + 1))). A step of brightness so
/// spreads over 2 n + 1 frames, and no frame depends on how it was reached.
std::vector<MeteredJob> metered_jobs(const Sequence& sequence, const Job& job);

/// What to say where the sequence is too short, or its frames too far apart, for the exposure_smoothing_s that a camera
/// asks for beyond the default; nothing else.
std::vector<std::string> smoothing_notes(const Sequence& sequence);

/// EV100 to set for what those frames were metered to (black ones: nothing, left out), and that
/// mean itself. Within the camera's limits; the lower one when all are black.
struct MeteredSetting {
    double ev100 = 0.0;
    std::optional<double> metered_ev100;
};
MeteredSetting metered_setting(const ScenarioCamera& camera, const std::vector<MeteredJob>& jobs,
                               const std::vector<gpu::MeterReading>& readings);

/// The mean of the colours of light that those frames were metered to, of luminance 1; black when none has any.
glm::vec3 metered_white(const std::vector<MeteredJob>& jobs, const std::vector<gpu::MeterReading>& readings);

/// Finds exposures and white balances of a sequence's frames; keeps what it has metered, so that neighbours share it.
/// Several threads may ask, each with a renderer of its own.
class Meter {
public:
    explicit Meter(const Sequence& sequence) : sequence_(&sequence) {}

    /// Sets the exposure and the white balance of a job's frame where its picture decides. The renderer holds the scene
    /// and the environment of the job's variant.
    ExposureFacts expose(gpu::Renderer& renderer, const Job& job, gpu::Frame& frame);

private:
    using Metered = std::shared_future<gpu::MeterReading>;
    /// places: pictures of that variant have weather of places.
    Metered metered(gpu::Renderer& renderer, const Job& job, gpu::MeterOf what, bool places);

    const Sequence* sequence_;
    std::mutex mutex_;
    std::map<Job, Metered> metered_;
};

}  // namespace petrichor::film

#endif
