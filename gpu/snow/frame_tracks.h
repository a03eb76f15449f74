#ifndef PETRICHOR_GPU_SNOW_FRAME_TRACKS_H
#define PETRICHOR_GPU_SNOW_FRAME_TRACKS_H

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "gpu/frame/weather_maps.h"

namespace petrichor::gpu {

/// Tracks of the frame at hand, drawn again where another second of the film is.
class FrameTracks {
public:
    void set(std::shared_ptr<const TrackSource> source)
    {
        if (source == source_) return;
        source_ = std::move(source);
        drawn_s_.reset();
    }

    /// True when they are others than before.
    bool tread(double film_s)
    {
        if (!source_ || drawn_s_ == film_s) return false;
        map_ = (*source_)(film_s);
        drawn_s_ = film_s;
        ++number_;
        return true;
    }

    /// Null: all that there are lie in the shape of the snow already.
    const TrackMap* map() const { return source_ ? &map_ : nullptr; }
    /// Another one with every map.
    std::uint64_t number() const { return number_; }

private:
    std::shared_ptr<const TrackSource> source_;
    std::optional<double> drawn_s_;
    TrackMap map_;
    std::uint64_t number_ = 0;
};

}  // namespace petrichor::gpu

#endif
