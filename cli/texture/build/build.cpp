#include "cli/texture/build/build.h"

#include <algorithm>
#include <atomic>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "base/words.h"
#include "cli/progress.h"
#include "cli/rooms.h"
#include "cli/signals.h"
#include "cli/texture/build/sha256.h"
#include "cli/texture/build/state.h"
#include "film/data/folders.h"
#include "texproc/material/import_settings.h"
#include "texproc/material/material.h"

namespace petrichor::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Part of every key: raise it when the bytes of an output change for the same input.
constexpr int kEncoder = 8;

std::string program()
{
    return "petrichor " PETRICHOR_VERSION " encoder " + std::to_string(kEncoder);
}

BuildState::SetName set_name(const texproc::PlannedMaterial& material)
{
    return {material.name, join_words(material.recipe->engines)};
}

// Sources, options and program decide the outputs, and so the key.
std::string key_of(const texproc::PlannedMaterial& material, BuildState& state)
{
    std::string text = program() + "\n" + material.name + "\n" +
                       texproc::options_text(*material.recipe) + "green " +
                       std::to_string(static_cast<int>(material.files.green)) + "\n";
    for (const auto& [role, map] : material.files.inputs) {
        text += role + " " + state.hash_of(map.path) + " " + map.channels + "\n";
    }
    return sha256(text);
}

ordered_json error_json(const texproc::RangeScore& range)
{
    return {{"levels", range.levels},
            {"plain", range.plain},
            {"best_isotropic", range.best},
            {"shipped", range.tested}};
}

std::vector<std::string> files_of(const texproc::MadeOutput& output)
{
    std::vector<std::string> files = output.files;
    files.insert(files.end(), output.settings.begin(), output.settings.end());
    return files;
}

std::string manifest_entry(const texproc::PlannedMaterial& material,
                           const texproc::MadeMaterial& made, BuildState& state,
                           const fs::path& out)
{
    ordered_json entry{{"name", material.name}, {"engines", material.recipe->engines}};
    for (const texproc::MadeSource& source : made.sources) {
        const texproc::InputMap& map = material.files.inputs.at(source.role);
        entry["sources"].push_back({{"role", source.role},
                                    {"file", printable(map.path.filename().string())},
                                    {"part", map.channels.empty() ? "all" : map.channels},
                                    {"sha256", state.hash_of(map.path)},
                                    {"width", source.width},
                                    {"height", source.height},
                                    {"channels", source.channels},
                                    {"bits", source.bits}});
    }
    for (const std::string& note : made.notes) entry["notes"].push_back(note);
    if (!made.green.empty()) entry["normal_green"] = made.green;
    entry["baked"] = material.baked;
    entry["options"] = texproc::options_text(*material.recipe);
    for (std::size_t i = 0; i < made.outputs.size(); ++i) {
        const texproc::OutputRule& rule = material.outputs[i].rule;
        ordered_json output{{"format", rule.format},
                            {"compression", rule.compression},
                            {"bits", rule.bits},
                            {"use", texproc::name_of(texproc::use_of(material.outputs[i]))},
                        {"srgb", rule.srgb()},
                            {"channels", rule.channels.channels},
                            {"width", made.outputs[i].width},
                            {"height", made.outputs[i].height},
                            {"levels", made.outputs[i].levels},
                            {"prefiltered", material.outputs[i].prefiltered}};
        for (const std::string& file : files_of(made.outputs[i])) {
            output["files"].push_back({{"file", file},
                                       {"bytes", fs::file_size(out / file)},
                                       {"sha256", state.hash_of(out / file)}});
        }
        entry["outputs"].push_back(output);
    }
    if (made.lobe_error) {
        entry["lobe_error"] = {{"rule", material.recipe->prefilter.rule},
                               {"levels_1_to_5", error_json(made.lobe_error->fine())},
                               {"levels_6_up", error_json(made.lobe_error->coarse())}};
    }
    if (made.picture_error) {
        const auto numbers = [](const texproc::PictureScore& score) {
            return ordered_json{{"rmse", score.rmse}, {"flicker", score.flicker}};
        };
        entry["picture_error"] = {{"rule", material.recipe->prefilter.rule},
                                  {"lobes", material.recipe->prefilter.lobes},
                                  {"shipped", numbers(made.picture_error->shipped)},
                                  {"plain", numbers(made.picture_error->plain)}};
    }
    return entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    if (from.empty()) return text;
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

class Builder {
public:
    Builder(const std::vector<texproc::PlannedMaterial>& plan, const BuildOptions& options)
        : plan_(plan), options_(options), state_(options.out)
    {
    }

    BuildResult run()
    {
        for (const texproc::PlannedMaterial& material : plan_) check(material);
        if (options_.dry_run) return result_;
        if (!waiting_.empty()) require_writable_folder(options_.out);
        work();
        finish();
        return result_;
    }

private:
    struct Waiting {
        const texproc::PlannedMaterial* material;
        std::string key;
    };

    void check(const texproc::PlannedMaterial& material)
    {
        std::string status = "up to date";
        try {
            const std::string key = key_of(material, state_);
            if (options_.force || !state_.is_current(set_name(material), key)) {
                waiting_.push_back({&material, key});
                status = "to build";
            } else {
                ++result_.current;
            }
        } catch (const Error& error) {
            fail(material, error);
            status = "cannot be built";
        }
        if (options_.dry_run) std::cout << texproc::to_text(material) << "  " << status << "\n";
    }

    void work()
    {
        const std::size_t cores = options_.threads > 0
                                      ? static_cast<std::size_t>(options_.threads)
                                      : std::max(1u, std::thread::hardware_concurrency());
        const std::size_t workers = std::min(cores, waiting_.size());
        if (workers == 0) return;
        // Cores that have no material of their own help inside the others.
        const int inner = static_cast<int>(std::max<std::size_t>(1, cores / workers));
        Progress progress("texture build", static_cast<int>(waiting_.size()));
        std::atomic<std::size_t> next{0};
        std::atomic<int> done{0};
        const auto loop = [&] {
            for (std::size_t i = next++; i < waiting_.size() && !interrupted(); i = next++) {
                make(i, inner);
                const std::lock_guard lock(mutex_);
                progress.update(++done);
            }
        };
        std::vector<std::thread> pool;
        for (std::size_t t = 1; t < workers; ++t) pool.emplace_back(loop);
        loop();
        for (std::thread& thread : pool) thread.join();
        result_.stopped = done < static_cast<int>(waiting_.size());
    }

    void make(std::size_t number, int threads)
    {
        const texproc::PlannedMaterial& material = *waiting_[number].material;
        std::string scratch;
        try {
            ScratchFolder staging(options_.out);
            scratch = staging.path().string();
            const texproc::MadeMaterial made =
                texproc::make_material(material, staging.path(), threads);
            BuiltSet set{waiting_[number].key, {}, ""};
            for (const texproc::MadeOutput& output : made.outputs) {
                const std::vector<std::string> files = files_of(output);
                set.outputs.insert(set.outputs.end(), files.begin(), files.end());
            }
            staging.publish(set.outputs);
            const std::lock_guard lock(mutex_);
            set.manifest = manifest_entry(material, made, state_, options_.out);
            result_.files += static_cast<int>(set.outputs.size());
            ++result_.built;
            for (const std::string& note : made.notes)
                result_.notes.push_back(material.name + ": " + note);
            state_.remember(set_name(material), std::move(set));
        } catch (const Error& error) {
            // People know the folder they named, not the one that files pass through.
            const std::lock_guard lock(mutex_);
            fail(material,
                 Error(replaced(error.what(), scratch, options_.out.string()), error.fix()));
        }
    }

    void fail(const texproc::PlannedMaterial& material, const Error& error)
    {
        result_.failures.push_back(material.name + ": " + error.what() + "\n  " + error.fix());
    }

    void finish()
    {
        std::vector<BuildState::SetName> names;
        for (const texproc::PlannedMaterial& material : plan_) names.push_back(set_name(material));
        std::sort(result_.failures.begin(), result_.failures.end());
        std::stable_sort(result_.notes.begin(), result_.notes.end());
        if (result_.built == 0 && state_.sets().empty()) return;
        const bool changed = state_.save(names);
        ordered_json manifest{{"program", program()}, {"sets", ordered_json::array()}};
        for (const auto& [name, set] : state_.sets()) {
            manifest["sets"].push_back(ordered_json::parse(set.manifest));
        }
        const fs::path file = options_.out / "manifest.json";
        if (changed || !fs::exists(file))
            write_text_file(
                file,
                manifest.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        write_scripts();
    }

    // Engines that are told how to import by a program of their own read the manifest with it.
    void write_scripts() const
    {
        std::set<std::string> engines;
        for (const texproc::PlannedMaterial& material : plan_)
            engines.insert(material.recipe->engines.begin(), material.recipe->engines.end());
        for (const std::string& engine : engines) {
            const fs::path from = data_folder() / "recipes" / ("import_" + engine + ".py");
            const fs::path to = options_.out / from.filename();
            if (!fs::exists(from)) continue;
            const std::string text = read_file(from, "script", 1 << 20);
            if (!fs::exists(to) || read_file(to, "script", 1 << 20) != text)
                write_text_file(to, text);
        }
    }

    const std::vector<texproc::PlannedMaterial>& plan_;
    const BuildOptions& options_;
    BuildState state_;
    std::vector<Waiting> waiting_;
    BuildResult result_;
    std::mutex mutex_;
};

}  // namespace

BuildResult build(const std::vector<texproc::PlannedMaterial>& plan, const BuildOptions& options)
{
    return Builder(plan, options).run();
}

}  // namespace petrichor::cli
