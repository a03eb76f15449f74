#ifndef PETRICHOR_TEXPROC_PREFILTER_PREFILTER_H
#define PETRICHOR_TEXPROC_PREFILTER_PREFILTER_H

#include <functional>
#include <string>
#include <vector>

#include "base/image.h"
#include "texproc/image/raw_image.h"

namespace petrichor::texproc {

/// What the maps are the surface of: light falls off a highlight otherwise where nothing is diffuse.
enum class SurfaceClass { Both, Paint, Metal };

struct PrefilterOptions {
    std::string rule = "moments";  ///< a name of rules()
    bool smoothness = false;  ///< the second map holds smoothness instead of perceptual roughness
    int threads = 0;          ///< 0: all cores; the bytes do not depend on it

    bool alpha = false;              ///< the second map holds alpha = p^2 (or 1 - alpha)
    bool green_down = false;         ///< the normal map has +y down, in and out
    bool rebuild_z = false;          ///< z from x and y, whatever the third channel holds
    int normal_x = 0, normal_y = 1;  ///< channels of x and y
    int channel = 0;                 ///< of the second map

    float design_light = 0.0f;  ///< overlap, student-t, median: alpha of the light to fit for
    /// overlap, picture in full: may re-aim the normals; else only roughness changes.
    bool joint = true;
    bool anisotropic = false;   ///< overlap: elliptic lobes where they help
    bool quick = false;         ///< overlap, picture: less search
    SurfaceClass surface = SurfaceClass::Both;  ///< picture in full: what it is fitted to
    /// Picture in full: the base colour of levels is written as it is fitted: metal gets a share of it
    /// (Prefiltered::metal_share), and with two lobes that of paint is fitted with them.
    bool base_colors = true;
    /// Picture in full: 2 gives a texel of the levels from 1 on a second lobe of its own (SecondLobe).
    int lobes = 1;
    int bits = 0;               ///< of the files: 8 lets overlap choose the codes; 0 or 16: floats

    std::function<void(double)> progress{};  ///< called now and then with the share done, 0..1
};

/// A second lobe of each texel: what shines is (1 - share) of the lobe of normal and roughness and
/// `share` of this one; what is diffuse has the mean of both normals, by share, made unit length
/// (formulas/light/second_lobe.h). Level 0 is empty: there both lobes are the same.
struct SecondLobe {
    std::vector<Image> normal;     ///< as Prefiltered::normal
    std::vector<Image> roughness;  ///< as Prefiltered::roughness
    std::vector<Image> share;      ///< 1 channel, 0..1
};

/// Mip chains that agree: level k of normal and of roughness belong together.
struct Prefiltered {
    std::vector<Image> normal;     ///< 3 channels, unit length, encoded 0.5 + 0.5 n
    std::vector<Image> roughness;  ///< 1 channel, same meaning as the input
    /// Only with anisotropic: R G = 0.5 + 0.5 the direction of largest roughness in tangent space,
    /// B = strength as glTF defines it: alpha along = mix(alpha across, 1, strength^2); roughness
    /// then holds the one across.
    std::vector<Image> anisotropy;
    /// Only with the rule picture, 1 channel, 0..1: what the base colour of anything but metal is
    /// multiplied by on each level. It is the length of the mean normal, which a normal of unit
    /// length forgets: slopes that face away make a surface darker from afar.
    std::vector<Image> base_share;
    /// Only with the rule picture in full, 1 channel, 0..1: the same of metal, whose base colour is
    /// what it mirrors. Slopes that mirror the ground or shine elsewhere make it darker from afar.
    std::vector<Image> metal_share;
    SecondLobe second{};  ///< only with lobes = 2
};

// A texel is made from its exact area of level 0 and never looks past an edge: maps that wrap,
// mirror or clamp give the same levels, so there is nothing to choose.

/// Builds both chains down to 1 x 1 so that what minification takes from the normals is added to
/// the roughness. normal: 3 channels encoded 0.5 + 0.5 n; roughness: 1 channel of the same size.
/// Throws Error when the sizes differ or a channel is missing. Same bytes at any thread count.
Prefiltered prefilter(const Image& normal, const Image& roughness,
                      const PrefilterOptions& options = {});

/// The same from the numbers of files, which need less memory. Level 0 is left empty in the result:
/// it is the input.
Prefiltered prefilter_raw(const RawImage& normal, const RawImage& roughness,
                          const PrefilterOptions& options = {});

/// Several variants of the same maps in one walk, filling only the texels for which
/// wanted(level, x, y) holds, which is all that a score looks at; the others stay 0. All variants
/// must read the maps alike. wanted is called from several threads. The rule lux needs every texel;
/// picture leaves out its last look at whole pictures.
std::vector<Prefiltered> prefilter_some(const RawImage& normal, const RawImage& roughness,
                                        const std::vector<PrefilterOptions>& variants,
                                        const std::function<bool(int, int, int)>& wanted);

}  // namespace petrichor::texproc

#endif
