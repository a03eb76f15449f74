// Images and buffers of a frame's size.
#include <algorithm>

#include "gpu/renderer_impl.h"
#include "gpu/surface_path.h"

namespace petrichor::gpu {

void Renderer::Impl::prepare_targets(TargetSet& set, const FrameSettings& s,
                     const std::vector<AovGroup>& aov_groups)
{
    FrameTargets& targets = set.targets;
    const int words = static_cast<int>(light_table.words());
    if (targets.width != s.width || targets.height != s.height || words > set.words) {
        targets = {};
        set.arena = std::make_unique<MemoryArena>(device);
        targets = make_frame_targets(device, *set.arena, s.width, s.height, words);
        set.words = words;
    }
    if (s.ambient_occlusion && s.bent_normals && !targets.keeps_bent) make_occlusion(targets, *set.arena, true);
    const auto pixels =
        static_cast<VkDeviceSize>(s.width) * static_cast<VkDeviceSize>(s.height);
    if (s.exposed_light && targets.display->size < pixels * 8)
        targets.display = set.arena->buffer({.name = "display",
                                             .size = pixels * 8,
                                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                             .host = true});
    for (std::size_t i = 0; i < aov_groups.size(); ++i) {
        const VkDeviceSize size = aov_groups[i].numbers * pixels * sizeof(float);
        if (i >= targets.aovs.size()) targets.aovs.emplace_back();
        if (targets.aovs[i] && targets.aovs[i]->size >= size) continue;
        targets.aovs[i] = set.arena->buffer({.name = "aov", .size = size, .host = true});
    }
}

bool Renderer::Impl::prepare_resolve(TargetSet& set, const Frame& frame, const FrameSettings& whole)
{
    const FrameSettings& s = frame.settings;
    ResolveTables& resolve = set.resolve;
    if (chosen_surface_path(s.surface_path, device, *scene, whole.width, whole.height,
                            is_adaptive(frame)) != SurfacePath::Visibility) {
        return false;
    }
    const bool shares = scene->layer_shares();
    if (!resolve.ids || resolve.ids->width != s.width || resolve.ids->height != s.height ||
        (shares && (resolve.shares->width != s.width || resolve.shares->height != s.height))) {
        resolve = {};
        set.resolve_arena = std::make_unique<MemoryArena>(device);
        resolve = make_resolve_tables(device, *set.resolve_arena, *scene, s.width, s.height);
    }
    update_draws(device, resolve, *scene);
    return true;
}

bool Renderer::Impl::prepare_transparent(TargetSet& set, const FrameSettings& s)
{
    const auto& materials = scene->materials();
    const bool any = std::any_of(materials.begin(), materials.end(),
                                 [](const GpuMaterial& m) { return m.blended; });
    if (!any || s.transparent_layers == 0) return false;
    const int words = static_cast<int>(light_table.words());
    const FrameTargets& now = set.transparent.layer;
    const bool bends = std::any_of(materials.begin(), materials.end(), [](const GpuMaterial& m) { return m.bends; });
    if (now.width != s.width || now.height != s.height || words > set.transparent_words || (bends && !set.transparent.bends)) {
        set.transparent = {};
        set.transparent_arena = std::make_unique<MemoryArena>(device);
        set.transparent = make_transparent_targets(device, *set.transparent_arena, s.width,
                                                   s.height, words, bends);
        set.transparent_words = words;
    }
    return true;
}

bool Renderer::Impl::prepare_decals(TargetSet& set, const FrameSettings& s)
{
    if (scene->decals().empty()) return false;
    const GpuImage* now = set.decals.color.get();
    if (!now || now->width != s.width || now->height != s.height) {
        set.decals = {};
        set.decal_arena = std::make_unique<MemoryArena>(device);
        set.decals = make_decal_targets(*set.decal_arena, s.width, s.height);
    }
    return true;
}

void Renderer::Impl::prepare_parts(TargetSet& set, const FrameSettings& s, const std::vector<std::size_t>& rows,
                   bool layered, bool adaptive)
{
    if (!set.parts_arena || set.parts_width != s.width || set.parts_height != s.height) {
        set.parts = {};
        set.parts_arena = std::make_unique<MemoryArena>(device);
        set.parts_width = s.width;
        set.parts_height = s.height;
    }
    prepare_light_parts(set.parts, *set.parts_arena, rows, s.width, s.height, layered,
                        adaptive);
}

bool Renderer::Impl::prepare_adaptive(TargetSet& set, const Frame& frame)
{
    if (!is_adaptive(frame)) return false;
    const FrameSettings& s = frame.settings;
    const GpuImage* now = set.adaptive.seen.get();
    if (!now || now->width != s.width || now->height != s.height) {
        set.adaptive = {};
        set.adaptive_arena = std::make_unique<MemoryArena>(device);
        set.adaptive = make_adaptive_targets(*set.adaptive_arena, s.width, s.height);
    }
    return true;
}

}  // namespace petrichor::gpu
