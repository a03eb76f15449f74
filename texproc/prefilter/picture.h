#ifndef PETRICHOR_TEXPROC_PREFILTER_PICTURE_H
#define PETRICHOR_TEXPROC_PREFILTER_PICTURE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "texproc/prefilter/prefilter.h"

namespace petrichor::texproc {

namespace detail {
struct Level;
struct MapSurface;
}

// The picture yardstick (docs/textures.md, 7): a lit floor under a moving camera, as a renderer
// draws it from the mips (trilinear, several taps along a long footprint, diffuse and specular
// light, shaded once a pixel), beside the same floor with many samples a pixel of level 0.

/// Light on the floor. The x axis points to the right, y ahead, z up.
struct PictureLight {
    std::string name;
    std::array<float, 3> to_light{0.0f, 0.0f, 1.0f};  ///< need not be of unit length
    float alpha = 0.0f;  ///< widens every lobe: 0 the sun, 0.1 a window
    float sun = 1.0f;    ///< irradiance across its direction
    float sky = 0.0f;    ///< radiance of the horizon; the zenith is half as bright
};

/// Where the camera looks from. The material is repeated every metre.
struct PictureView {
    std::string name;
    double height_m = 1.5, pitch_deg = 16.0;  ///< above the floor; down from the horizon
    double field_of_view_deg = 34.0;          ///< over the width
    int width = 300, rows = 110;
    /// Of the place of a pixel, how much it covers across and down. Below 1 this is a sample of a picture of
    /// as many more pixels: few of them, of the size that they have there.
    double covers = 1.0;
    double step_right_m = 0.004, step_ahead_m = 0.021;  ///< from frame to frame
    int taps = 16;  ///< at most so many samples along a footprint; 1 is plain trilinear filtering
};

/// What is rendered: the light is tried in turn on paint (F0 0.04, albedo 0.3) or metal (F0 0.9).
struct PictureCase {
    int view = 0, light = 0;
    bool metal = false;
};

struct PictureOptions {
    std::vector<PictureView> views;
    std::vector<PictureLight> lights;
    std::vector<PictureCase> cases;
    int frames = 5;
    int samples = 14;  ///< of the truth, along each side of a pixel
    std::uint32_t seed = 1;
    int threads = 0;
};
/// The cases of docs/textures.md, 7: a floor to the horizon under the sun ahead, from the left and
/// from behind and under a window ahead, and metal under the sun ahead.
PictureOptions reference_pictures();
/// Those, with the light of the sky beside the sun, a sky alone, metal from the side and behind, a
/// floor from above, and plain trilinear filtering.
PictureOptions all_pictures();
/// Twelve with views and lights drawn from a seed: none is among those that a rule looks at, or was chosen
/// with. Two thirds on paint, the others on metal. Where a metre of the material has fewer than some 250 texels,
/// some of them see level 0 alone.
PictureOptions drawn_pictures(std::uint32_t seed);
/// Small ones with other lights, views and places: what the rule picture checks itself on. A ring of
/// suns, low and high, some with a sky, a window and a sky alone, on paint and on metal, and one view
/// of one tap; quick: four suns on paint and a window, two views less, of any class.
PictureOptions design_pictures(bool quick = false, SurfaceClass surface = SurfaceClass::Both);

/// Small ones of sixteen views that are drawn, each under eight lights (of metal seven): suns from all sides at a
/// height that is drawn, on paint some of them and on metal all beside a sky, and a window. With them the rule
/// picture pays for what it fitted where that is worse than plain mips: a price, no promise. The seeds of
/// drawn_pictures() draw others.
PictureOptions guard_pictures(SurfaceClass surface);

/// Pictures of whole floors, a few pixels of each, with which two lobes are weighed at last: 24 views like that of
/// reference_pictures() and suns from all sides, 18 to 58 degrees high, and windows ahead, all drawn from a seed:
/// every material has its own. kHeldOutViews cases one after another have the same light. One view in six has pixels
/// four times as large, for levels that the others do not see.
inline constexpr int kHeldOutViews = 4;
PictureOptions held_out_pictures(SurfaceClass surface, std::uint32_t seed);

/// One case of one material: display-referred, 0..1.
struct PictureScore {
    std::string name;      ///< view, light and material
    double rmse = 0.0;     ///< over pixels and frames
    double flicker = 0.0;  ///< mean over the pixels of the standard deviation of the error in time
};

/// Of each case, for x steps: error + 2 slope x + x square x. Of all it is the mean of the squares over pixels and
/// frames; of what moves a bound of the mean over the pixels of the deviation in time, which touches it at x = 0 but for
/// pixels where hardly anything moves.
struct PictureForms {
    std::size_t count = 0;
    struct Form {
        double error = 0.0;
        std::vector<float> slope, square;  ///< count; count times count
    };
    struct Case {
        Form all, moving;
    };
    std::vector<Case> cases;
};

/// Truth of one material, rendered once and kept, against which any number of chains is held.
class PictureBench {
public:
    /// A chain between plain mips and another one, held against the truth again and again.
    class Blend;
    /// A chain of which few levels change from one score to the next.
    class Retake;

    /// normal, roughness: level 0 as `input` names it. Throws Error when sizes do not fit.
    PictureBench(const RawImage& normal, const RawImage& roughness, const PrefilterOptions& input,
                 PictureOptions options);
    /// The same from maps that are decoded row by row.
    PictureBench(const detail::MapSurface& surface, const PrefilterOptions& input,
                 PictureOptions options);
    /// Other pictures of the same maps, which are held once.
    PictureBench(const PictureBench& of_maps, PictureOptions options);
    ~PictureBench();
    PictureBench(PictureBench&&) noexcept;
    PictureBench& operator=(PictureBench&&) noexcept;

    /// A row a case. Levels of the chain that are empty, and level 0, come from the maps; a chain
    /// without normals gets the mean ones. Same numbers at any thread count.
    std::vector<PictureScore> score(const Prefiltered& chain) const;

    /// Levels of the plain mips: mean of the roughness as stored. Level 0 is empty.
    std::vector<Image> plain_roughness() const;

    /// The picture of a case as it is shown, one channel 0..1; with no chain the truth.
    Image picture(std::size_t which, int frame, const Prefiltered* chain) const;

    /// The maps and their plain mips, as they are rendered.
    const std::vector<detail::Level>& levels() const;

    const PictureOptions& options() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// What lies between plain mips and a chain of the same normals is linear, level by level, so each
/// pixel is filtered once, and only shaded for every mixture that is tried.
class PictureBench::Blend {
public:
    /// chain: its roughness and base_share, all levels from 1 on; metal keeps its colour. `bench` must outlive this.
    Blend(const PictureBench& bench, const Prefiltered& chain);
    ~Blend();

    /// Which share of the chain's roughness, and of its darkening of the base colour, a level has:
    /// 0 the plain mip, 1 the chain. As many as the chain has levels.
    struct Shares {
        std::vector<float> roughness, base;
    };
    /// A row a case, as PictureBench::score() gives it. Only rows of pixels that see a level whose
    /// shares have changed are shaded again.
    std::vector<PictureScore> score(const Shares& shares);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Scores a chain as PictureBench::score() does, but shades only rows of pixels that see a level which
/// has changed since. `bench` must outlive this.
class PictureBench::Retake {
public:
    explicit Retake(const PictureBench& bench);
    ~Retake();
    Retake(Retake&&) noexcept;

    /// changed: a bit for each level, set where the chain is not what it was; the first time all are.
    std::vector<PictureScore> score(const Prefiltered& chain, std::uint32_t changed);

    /// The squared error of each case about the chain that was scored last, as a square form of small changes of
    /// `count` numbers, for which errors are taken for linear. vary(i) changes `chain` by a step of number i alone
    /// and returns the one level that this changes; vary(count) takes the last one back.
    PictureForms forms(const Prefiltered& chain, std::size_t count,
                       const std::function<std::size_t(std::size_t)>& vary) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace petrichor::texproc

#endif
