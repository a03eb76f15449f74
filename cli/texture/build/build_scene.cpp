#include "cli/texture/build/build_scene.h"

#include <cstdio>
#include <iostream>

#include "base/error.h"
#include "base/output_file.h"
#include "cli/signals.h"
#include "cli/texture/build/build.h"
#include "texproc/gltf/rewrite.h"
#include "texproc/gltf/scene_materials.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::cli {

namespace {

const char* text_of(texproc::ImageMeaning meaning)
{
    switch (meaning) {
        case texproc::ImageMeaning::Color:
            return "colour";
        case texproc::ImageMeaning::Normal:
            return "normals";
        case texproc::ImageMeaning::Surface:
            return "roughness";
        case texproc::ImageMeaning::SecondLobe:
            return "2nd lobe";
        case texproc::ImageMeaning::Data:
            break;
    }
    return "data";
}

// An engine's files beside a scene, which stays as it is.
bool is_for_engines(const SceneBuild& build)
{
    const std::vector<std::string>& engines = build.choice.engines;
    return !engines.empty() && engines != std::vector<std::string>{"gltf"};
}

void check(const SceneBuild& build)
{
    if (!build.choice.format.empty() && build.choice.format != "ktx2") {
        throw Error(
            "texture build: a scene holds its levels in ktx2, not in " + build.choice.format,
            "Leave --format out.");
    }
    if (build.choice.lobes == 2) {
        if (build.choice.quality != "full" || (!build.choice.rule.empty() && build.choice.rule != "picture")) {
            throw Error("texture build: a second lobe is fitted by the rule picture in full quality alone",
                        "Add --quality full, or leave --lobes out.");
        }
        if (build.fallback) {
            throw Error("texture build: --fallback is for readers that know no KTX2, which know no second lobe",
                        "Leave --fallback or --lobes out.");
        }
    }
    if (build.out.empty() && !build.dry_run) {
        throw Error("texture build: no output scene",
                    "Give -o better" + build.in.extension().string() + ".");
    }
}

void list_plan(const SceneBuild& build)
{
    const texproc::GltfFile file = texproc::read_gltf_file(build.in);
    const texproc::ImagePlan plan = texproc::plan_images(file, !build.fallback, build.choice.lobes);
    for (const texproc::ImageRecipe& recipe : plan.recipes) {
        std::printf("image %zu as %s%s\n", recipe.image, text_of(recipe.meaning),
                    recipe.normal >= 0
                        ? (", with the normals of image " + std::to_string(recipe.normal)).c_str()
                        : "");
    }
    for (const std::string& note : plan.notes) std::cout << "note: " << note << "\n";
}

double percent(double now, double before)
{
    return before > 0.0 ? 100.0 * (now / before - 1.0) : 0.0;
}

void report(const texproc::GltfBuildReport& made)
{
    std::uint64_t before = 0, after = 0;
    for (const auto& image : made.images) {
        std::printf("%-36s %-9s %5d x %-5d %2d levels  %8.1f -> %8.1f KiB%s\n", image.name.c_str(),
                    text_of(image.meaning), image.width, image.height, image.levels,
                    static_cast<double>(image.bytes_before) / 1024.0,
                    static_cast<double>(image.bytes) / 1024.0,
                    image.resampled ? "  resampled to whole blocks" : "");
        before += image.bytes_before;
        after += image.bytes;
    }
    if (!made.materials.empty())
        std::cout << "pictures of lit floors against the truth, plain mips -> as written:\n";
    for (const auto& material : made.materials) {
        const auto& [shipped, plain] = material.picture;
        std::printf("%-36s RMSE %.4f -> %.4f (%+.1f %%)  flicker %.4f -> %.4f (%+.1f %%)%s\n",
                    material.name.c_str(), plain.rmse, shipped.rmse,
                    percent(shipped.rmse, plain.rmse), plain.flicker, shipped.flicker,
                    percent(shipped.flicker, plain.flicker), material.lobes == 2 ? "  two lobes" : "");
    }
    for (const std::string& note : made.notes) std::cout << "note: " << note << "\n";
    std::printf("%zu images, %.1f -> %.1f MiB; wrote %s\n", made.images.size(),
                static_cast<double>(before) / 1048576.0, static_cast<double>(after) / 1048576.0,
                made.files.back().string().c_str());
}

// Materials by their maps; images inside the scene are files for as long as it takes.
bool build_for_engines(const SceneBuild& build)
{
    if (build.fallback) {
        throw Error("texture build: --fallback is for scenes that are written again",
                    "Leave it or --engine out.");
    }
    if (build.out.empty() && !build.dry_run)
        throw Error("texture build: no output folder", "Give -o FOLDER.");
    const ScratchFolder images(build.out.empty() ? std::filesystem::temp_directory_path()
                                                 : build.out);
    const texproc::SceneMaterials found =
        texproc::scene_materials(texproc::read_gltf_file(build.in), images.path());
    for (const std::string& note : found.notes) std::cout << "note: " << note << "\n";
    const std::vector<texproc::PlannedMaterial> plan =
        plan_materials(found.materials, build.choice);
    if (plan.empty()) {
        throw Error("texture build: no material of " + build.in.string() + " has maps",
                    "Choose another scene.");
    }
    BuildOptions options;
    options.out = build.out;
    options.threads = build.threads;
    options.dry_run = build.dry_run;
    options.force = true;
    const BuildResult result = petrichor::cli::build(plan, options);
    std::printf("%d materials built (%d files), %zu failed\n", result.built, result.files,
                result.failures.size());
    for (const std::string& note : result.notes) std::cout << "note: " << note << "\n";
    for (const std::string& failure : result.failures) std::cerr << "error " << failure << "\n";
    return result.failures.empty();
}

}  // namespace

bool build_scene(const SceneBuild& build)
{
    if (is_for_engines(build)) return build_for_engines(build);
    check(build);
    if (build.dry_run) {
        list_plan(build);
        return true;
    }
    texproc::GltfBuildOptions options;
    options.images.size = build.choice.size;
    options.images.threads = build.threads;
    options.fallback = build.fallback;
    options.score = !build.choice.no_score;
    options.stop = [] { return interrupted(); };
    if (!build.choice.rule.empty()) options.images.prefilter.rule = build.choice.rule;
    options.images.rdo = build.choice.rdo;
    if (build.choice.rdo_most) options.images.rdo_most = *build.choice.rdo_most;
    if (!build.choice.quality.empty())
        options.images.prefilter.quick = build.choice.quality == "quick";
    options.images.prefilter.lobes = build.choice.lobes == 2 ? 2 : 1;
    if (options.images.prefilter.rule != "none") texproc::rule_named(options.images.prefilter.rule);
    report(texproc::build_gltf(build.in, build.out, options));
    return true;
}

}  // namespace petrichor::cli
