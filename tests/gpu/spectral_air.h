#ifndef PETRICHOR_TESTS_GPU_SPECTRAL_AIR_H
#define PETRICHOR_TESTS_GPU_SPECTRAL_AIR_H

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace petrichor::gpu {

/// The light of clear air by many wavelengths (382.5 to 777.5 nm, every 5) in double: the truth for the four
/// bands of formulas/light/atmosphere.h. Densities, phase functions and the series for light scattered more than
/// once are those; spectra, steps, sums and tables are its own. Colours are linear sRGB in which the sun above
/// the air is white, none clipped.
class SpectralAir {
public:
    SpectralAir(double turbidity, double ground_albedo);

    glm::dvec3 sun(double sun_up) const;  ///< share of sunlight that reaches the ground
    glm::dvec3 level(double sun_up) const;  ///< of the whole sky on level ground
    glm::dvec3 radiance(double up, double sun_up, double sun_angle) const;

private:
    struct Line {
        double molecules, haze, ozone;  // per metre at unit density: scattered, scattered, absorbed
        glm::dvec3 rgb;                 // share in the colour
        std::vector<double> depths;     // to space, by height and cosine
        std::vector<double> again;      // logarithm of the radiance from all sides, by height and sun
    };

    static double extinction(const Line& line, double height);
    static double scattering(const Line& line, double height);
    static double depth(const Line& line, double height, double up);
    static double transmittance(const Line& line, double height, double up);
    static double scattered_again(const Line& line, double height, double sun_up);
    static double radiance_of(const Line& line, double up, double sun_up, double sun_angle);
    static void fill(Line& line, double ground_albedo);

    template <typename Light>
    glm::dvec3 color(const Light& light) const
    {
        glm::dvec3 sum(0.0);
        for (const Line& line : lines_) sum += line.rgb * light(line);
        return sum;
    }

    std::vector<Line> lines_;
};

}  // namespace petrichor::gpu

#endif
