#include "gpu/passes/lighting/lighting.h"

namespace petrichor::gpu {

namespace {

constexpr int kTile = 8;

}  // namespace

void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants)
{
    graph.add({.name = "ambient_occlusion",
               .uses = {{targets.gbuffer.depth, Use::Sampled},
                        {targets.gbuffer.normals, Use::Sampled},
                        {targets.occlusion, Use::StorageWrite}},
               .record = [=, &targets](PassContext& pass) {
                   pass.bind_compute(
                       "ambient_occlusion.comp", {},
                       {frame_binding(constants), sampled(*targets.gbuffer.depth, targets.nearest),
                        sampled(*targets.gbuffer.normals, targets.nearest),
                        storage(*targets.occlusion)});
                   pass.dispatch_over(targets.width, targets.height, kTile);
               }});
}

void add_lighting(FrameGraph& graph, FrameTargets& targets, LightTable& lights, SkyMaps& sky,
                  DepthMaps& depth_maps, const ConstantsRange& constants,
                  const LightingVariant& variant)
{
    GBuffer& g = targets.gbuffer;
    graph.add({.name = "lighting",
               .uses = {{g.depth, Use::Sampled},
                        {g.color, Use::Sampled},
                        {g.normals, Use::Sampled},
                        {g.material, Use::Sampled},
                        {g.weather, Use::Sampled},
                        {g.emission, Use::Sampled},
                        {targets.occlusion, Use::Sampled},
                        {depth_maps.shadow, Use::Sampled},
                        {depth_maps.sky, Use::Sampled},
                        {targets.radiance, Use::StorageWrite},
                        {targets.mirror_weight, Use::StorageWrite},
                        {targets.mirror_shape, Use::StorageWrite},
                        {sky.specular, Use::Sampled},
                        {sky.env_brdf, Use::Sampled},
                        {sky.cube, Use::Sampled},
                        {sky.light, Use::UniformRead},
                        {lights.texels, Use::TexelRead},
                        {targets.light_lists, Use::TexelRead},
                        {targets.accumulated, Use::StorageWrite}},
               .record = [=, &targets, &lights, &sky, &depth_maps](PassContext& pass) {
                   const GBuffer& in = targets.gbuffer;
                   const SamplerHandle& s = targets.nearest;
                   pass.bind_compute("lighting.comp",
                                     {{0, variant.weather ? 1u : 0u},
                                      {1, variant.shadows ? 1u : 0u},
                                      {2, variant.image_based_light ? 1u : 0u},
                                      {3, variant.ambient_occlusion ? 1u : 0u},
                                      {4, variant.emission ? 1u : 0u},
                                      {5, variant.all_lights ? 1u : 0u}},
                                     {frame_binding(constants),
                                      uniform(*sky.light, 0, sizeof(shared::SkyLight)),
                                      sampled(*in.depth, s),
                                      sampled(*in.color, s),
                                      sampled(*in.normals, s),
                                      sampled(*in.material, s),
                                      sampled(*in.weather, s),
                                      sampled(*in.emission, s),
                                      sampled(*targets.occlusion, s),
                                      sampled(*depth_maps.shadow, depth_maps.compare),
                                      sampled(*sky.specular, sky.linear),
                                      sampled(*sky.env_brdf, sky.linear),
                                      sampled(*sky.cube, sky.linear),
                                      texels(*lights.texels),
                                      texels(*targets.light_lists),
                                      storage(*targets.accumulated),
                                      sampled(*depth_maps.sky, depth_maps.compare),
                                      storage(*targets.radiance),
                                      storage(*targets.mirror_weight),
                                      storage(*targets.mirror_shape)});
                   pass.dispatch_over(targets.width, targets.height, kTile);
               }});
}

void add_reflections(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                     const ConstantsRange& constants)
{
    graph.add({.name = "reflections",
               .uses = {{targets.gbuffer.depth, Use::Sampled},
                        {targets.radiance, Use::Sampled},
                        {targets.mirror_weight, Use::Sampled},
                        {targets.mirror_shape, Use::Sampled},
                        {sky.specular, Use::Sampled},
                        {targets.accumulated, Use::StorageWrite}},
               .record = [=, &targets, &sky](PassContext& pass) {
                   const SamplerHandle& s = targets.nearest;
                   pass.bind_compute(
                       "reflections.comp", {},
                       {frame_binding(constants), sampled(*targets.gbuffer.depth, s),
                        sampled(*targets.radiance, s), sampled(*targets.mirror_weight, s),
                        sampled(*targets.mirror_shape, s), sampled(*sky.specular, sky.linear),
                        storage(*targets.accumulated)});
                   pass.dispatch_over(targets.width, targets.height, kTile);
               }});
}

void add_resolve(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                 const ConstantsRange& constants)
{
    graph.add({.name = "resolve",
               .uses = {{targets.accumulated, Use::StorageRead},
                        {sky.light, Use::UniformRead},
                        {targets.beauty, Use::StorageWrite},
                        {targets.display, Use::StorageWrite}},
               .record = [=, &targets, &sky](PassContext& pass) {
                   pass.bind_compute(
                       "resolve.comp", {},
                       {frame_binding(constants), uniform(*sky.light, 0, sizeof(shared::SkyLight)),
                        storage(*targets.accumulated), storage_buffer(*targets.beauty),
                        storage_buffer(*targets.display)});
                   pass.dispatch_over(targets.width, targets.height, kTile);
               }});
    graph.add({.name = "read_back",
               .uses = {{targets.beauty, Use::HostRead},
                        {targets.display, Use::HostRead},
                        {targets.light_lists, Use::HostRead},
                        {sky.light, Use::HostRead}},
               .record = {}});
}

void add_aov(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants,
             std::size_t slot, std::uint32_t kind, const LightingVariant& variant)
{
    const GBuffer& g = targets.gbuffer;
    graph.add(
        {.name = "aov",
         .uses = {{g.depth, Use::Sampled},
                  {g.color, Use::Sampled},
                  {g.normals, Use::Sampled},
                  {g.material, Use::Sampled},
                  {g.weather, Use::Sampled},
                  {g.emission, Use::Sampled},
                  {targets.aovs[slot], Use::StorageWrite}},
         .record = [=, &targets](PassContext& pass) {
             const GBuffer& in = targets.gbuffer;
             pass.bind_compute(
                 "aov.comp", {},
                 {frame_binding(constants), sampled(*in.depth, targets.nearest),
                  sampled(*in.color, targets.nearest), sampled(*in.normals, targets.nearest),
                  sampled(*in.material, targets.nearest), sampled(*in.weather, targets.nearest),
                  sampled(*in.emission, targets.nearest), storage_buffer(*targets.aovs[slot])});
             pass.push(glm::uvec3(kind, variant.weather ? 1u : 0u, variant.emission ? 1u : 0u));
             pass.dispatch_over(targets.width, targets.height, kTile);
         }});
    graph.add({.name = "read_back", .uses = {{targets.aovs[slot], Use::HostRead}}, .record = {}});
}

}  // namespace petrichor::gpu
