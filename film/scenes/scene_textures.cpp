#include "film/data/source_fingerprint.h"
#include "film/scenes/scene_textures.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "film/scenes/finish_texture.h"
#include "film/scenes/texture_entry.h"
#include "scene/material_table.h"

namespace petrichor::film {
namespace {

constexpr const char* kCacheKind = "textures";

// An image that no material uses stays white and costs nothing.
std::vector<bool> textures_used(const scene::Scene& scene)
{
    std::vector<bool> used(scene.textures.size(), false);
    for (const scene::Material& material : scene.materials) {
        for (const scene::MaterialTexture& slot : scene::material_textures()) {
            const scene::TextureUse& use = slot.get(material);
            if (use.present()) used[static_cast<std::size_t>(use.texture)] = true;
        }
    }
    return used;
}

void add_recipe(Hasher& hasher, const scene::Scene& scene, const TextureRecipe& recipe)
{
    const scene::EncodedImage& image = scene.textures[static_cast<std::size_t>(recipe.image)];
    hasher.add_bytes(image.bytes);
    hasher.add(image.wrap_u);
    hasher.add(image.wrap_v);
    hasher.add(recipe.kind);
    hasher.add(recipe.channel);
    for (const float value : {recipe.alpha_cutoff, recipe.normal_scale, recipe.roughness_factor})
        hasher.add(value);
    hasher.add(recipe.alpha_covers);
    hasher.add(recipe.fades_to_grey);
    hasher.add(recipe.prepared);
    hasher.add(recipe.normal_image >= 0);
    if (recipe.normal_image >= 0)
        hasher.add_bytes(scene.textures[static_cast<std::size_t>(recipe.normal_image)].bytes);
    hasher.add(recipe.metallic_factor);
    const bool metal = recipe.kind == TextureRecipe::Kind::Color && recipe.surface_image >= 0;
    hasher.add(metal);
    if (metal)
        hasher.add_bytes(scene.textures[static_cast<std::size_t>(recipe.surface_image)].bytes);
}

// Everything that decides the bytes of a job: sources, recipe, options, program.
std::string key_of(const scene::Scene& scene, const std::vector<TextureRecipe>& recipes,
                   const TextureJob& job, const TextureOptions& options)
{
    Hasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(options.max_size);
    hasher.add(options.prefilter.rule);
    hasher.add(options.prefilter.quick);
    hasher.add(options.prefilter.design_light);
    const TextureRecipe& recipe = recipes[static_cast<std::size_t>(job.texture)];
    if (recipe.prepared) hasher.add(options.blocks);
    hasher.add(job.normal_texture >= 0);
    add_recipe(hasher, scene, recipe);
    return hasher.text();
}

// What several threads work off, job by job.
class Workshop {
public:
    Workshop(const scene::Scene& scene, const std::vector<TextureRecipe>& recipes,
             const std::vector<TextureJob>& jobs, const TextureOptions& options)
        : scene_(scene),
          recipes_(recipes),
          jobs_(jobs),
          options_(options),
          notes_(jobs.size()),
          textures_(scene.textures.size())
    {
    }

    void run(int threads)
    {
        std::vector<std::thread> workers;
        for (int i = 1; i < threads; ++i) workers.emplace_back([this] { work(); });
        work();
        for (std::thread& worker : workers) worker.join();
        if (problem_) std::rethrow_exception(problem_);
        if (stopped_) throw Interrupted("interrupted while textures were prepared");
    }

    std::vector<gpu::Texture> take() { return std::move(textures_); }
    int made() const { return made_; }
    /// In the order of the jobs, whatever the timing; a cache that fails is said once.
    std::vector<std::string> notes() const
    {
        std::vector<std::string> all;
        for (const auto& notes : notes_) all.insert(all.end(), notes.begin(), notes.end());
        if (!cache_problem_.empty()) all.push_back(cache_problem_);
        return all;
    }

private:
    void work();
    void finish(std::size_t number);
    void keep(const std::string& key, const std::vector<gpu::Texture>& textures);

    const scene::Scene& scene_;
    const std::vector<TextureRecipe>& recipes_;
    const std::vector<TextureJob>& jobs_;
    const TextureOptions& options_;
    std::vector<std::vector<std::string>> notes_;
    std::vector<gpu::Texture> textures_;
    std::atomic<std::size_t> next_{0};
    std::atomic<int> made_{0};
    std::atomic<bool> stopped_{false};
    std::mutex guard_;  // of what follows
    std::exception_ptr problem_;
    std::size_t problem_at_ = static_cast<std::size_t>(-1);
    std::string cache_problem_;
};

void Workshop::work()
{
    for (std::size_t i = next_++; i < jobs_.size() && !stopped_; i = next_++) {
        if (options_.stop && options_.stop()) {
            stopped_ = true;
            return;
        }
        try {
            finish(i);
        } catch (...) {
            const std::lock_guard lock(guard_);
            if (i < problem_at_) {  // report the same one whatever the timing
                problem_at_ = i;
                problem_ = std::current_exception();
            }
        }
    }
}

void Workshop::finish(std::size_t number)
{
    const TextureJob& job = jobs_[number];
    const std::size_t wanted = job.normal_texture >= 0 ? 2 : 1;
    std::string key;
    std::vector<gpu::Texture> textures;
    if (options_.cache.on()) {
        key = key_of(scene_, recipes_, job, options_);
        if (const auto bytes = options_.cache.find(kCacheKind, key)) {
            if (auto kept = textures_in(*bytes, bytes->holder()); kept && kept->size() == wanted)
                textures = std::move(*kept);
        }
    }
    if (textures.empty()) {
        FinishedTextures finished = finish_textures(scene_, recipes_, job, options_);
        notes_[number] = std::move(finished.notes);
        // What a label says is noted at every start: those few are not kept.
        if (options_.cache.on() && !finished.as_stored && notes_[number].empty())
            keep(key, finished.textures);
        if (!finished.as_stored) ++made_;
        textures = std::move(finished.textures);
    }
    const int targets[] = {job.texture, job.normal_texture};
    for (std::size_t k = 0; k < wanted; ++k) {
        const auto at = static_cast<std::size_t>(targets[k]);
        const scene::EncodedImage& source =
            scene_.textures[static_cast<std::size_t>(recipes_[at].image)];
        textures[k].name = source.name;
        textures[k].wrap_u = source.wrap_u;
        textures[k].wrap_v = source.wrap_v;
        textures[k].nearest = source.nearest;
        textures_[at] = std::move(textures[k]);
    }
}

void Workshop::keep(const std::string& key, const std::vector<gpu::Texture>& textures)
{
    try {
        options_.cache.keep(kCacheKind, key, entry_of(textures).parts);
    } catch (const Error& error) {
        const std::lock_guard lock(guard_);
        cache_problem_ = std::string(error.what()) +
                         ": the textures are filtered again at every start. " + error.fix();
    }
}

std::string seconds_text(std::chrono::steady_clock::duration time)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f s", std::chrono::duration<double>(time).count());
    return text;
}

}  // namespace

std::vector<gpu::Texture> prepare_textures(scene::Scene& scene, const TextureOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    const auto recipes = plan_textures(scene, options.moving_roughness);
    const auto jobs = texture_jobs(recipes, textures_used(scene));
    int threads = options.threads;
    if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
    Workshop workshop(scene, recipes, jobs, options);
    workshop.run(std::min({threads, 4, std::max(1, static_cast<int>(jobs.size()))}));
    // An image that is used in two ways says it once.
    for (const std::string& note : workshop.notes()) {
        if (std::find(scene.warnings.begin(), scene.warnings.end(), note) == scene.warnings.end())
            scene.warnings.push_back(note);
    }
    const auto time = std::chrono::steady_clock::now() - start;
    if (options.cache.on() && workshop.made() > 0 && time > std::chrono::seconds(2)) {
        scene.warnings.push_back(
            "textures were filtered in " + seconds_text(time) + " (rule " + options.prefilter.rule +
            (options.prefilter.quick ? ", quick" : "") + "); the next start finds them in " +
            options.cache.folder().string());
    }
    for (scene::EncodedImage& image : scene.textures) {
        image.bytes.clear();
        image.bytes.shrink_to_fit();
    }
    return workshop.take();
}

}  // namespace petrichor::film
