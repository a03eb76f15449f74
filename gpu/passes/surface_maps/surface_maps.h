#ifndef PETRICHOR_GPU_PASSES_SURFACE_MAPS_SURFACE_MAPS_H
#define PETRICHOR_GPU_PASSES_SURFACE_MAPS_SURFACE_MAPS_H

#include "gpu/device/graph.h"
#include "gpu/frame/weather_maps.h"

namespace petrichor::gpu {

/// Tileable maps of the weather that every surface samples.
struct SurfaceMaps {
    /// ripple_size: texels a side of the rings where their drops are drawn, a power of two.
    SurfaceMaps(const Device& device, MemoryArena& arena, int ripple_size, const WeatherMaps& given);
    /// Other tracks in the same place. Throws Error for a map of another size.
    void set_tracks(const Device& device, const TrackMap& given);

    std::unique_ptr<GpuImage> ripple_source;  ///< drops: envelope, direction, time offset
    std::unique_ptr<GpuImage> ripple;         ///< rings at this moment: normal xy, and the mean of their squares
    std::unique_ptr<GpuImage> flow;           ///< normals of small waves at this moment
    std::unique_ptr<GpuImage> snow;           ///< normal xy, mask, smoothness
    std::unique_ptr<GpuBuffer> flow_quads;    ///< red and green of `flow` (map_quads.glsl)
    std::unique_ptr<GpuImage> tracks;         ///< as TrackMap; one texel of nothing without any
    TrackMap track_area;                      ///< without its texels
    SamplerHandle clamped;
    int ripple_size = 0;
    bool drops_given = false;
    bool snow_given = false;
    bool water_given = false;
    SamplerHandle trilinear;
    bool generated = false;  ///< what is made once is

private:
    void make_tracks(const Device& device, MemoryArena& arena, const TrackMap& given);
};

// Draws the drops and the snow mask where none are given, and the mips of those that are; once.
//
//   writes   ripple_source, snow, flow and its quads
void add_surface_map_sources(FrameGraph& graph, SurfaceMaps& maps);

// Rings of rain drops at `time_s`; speed 1 is as photographed. drop_spread: how much those drops differ (ring_drop_spread).
//
//   reads    ripple_source
//   writes   ripple, with mips
void add_ripple(FrameGraph& graph, SurfaceMaps& maps, float rain, float time_s, float speed, float drop_spread);

// Waves of flowing and wind-blown water at `time_s`, unless a map of them is given.
//
//   writes   flow, with mips, and its quads
void add_flow(FrameGraph& graph, SurfaceMaps& maps, float time_s);

}  // namespace petrichor::gpu

#endif
