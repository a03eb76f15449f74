// The picture as a studio's OpenColorIO config shows it, in place of the tone curves of our own.
#ifndef PETRICHOR_FILM_COLOR_DISPLAY_TRANSFORM_H
#define PETRICHOR_FILM_COLOR_DISPLAY_TRANSFORM_H

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace petrichor::film {

/// What [render] says of it; without a config the rest is "".
struct ColorManagement {
    std::string config = {};       ///< a file, relative to the scenario, or ocio://..; "": curves of our own
    std::string display = {};      ///< "": the config's default
    std::string view = {};         ///< "": the display's default
    std::string scene_space = {};  ///< what our light is read as; "": looked for, see DisplayTransform
    std::string look = {};         ///< in place of the view's looks; "": those

    bool operator==(const ColorManagement&) const = default;
};

/// Whether this program was built with OpenColorIO's library.
bool has_color_management();
/// Its version, "2.1.2"; "" without it.
std::string color_management_version();

/// From exposed light (linear, Rec. 709 primaries, D65) to the codes of a display, by a view of a config. Immutable:
/// pictures may be made from several threads.
class DisplayTransform {
public:
    /// Reads the config and all that the view needs. Light is read as the first space of the config whose name is known
    /// to mean linear Rec. 709, else as its role scene_linear, which notes() then says. The environment variable OCIO
    /// is not read.
    ///
    ///   folder  that a relative config is looked for in
    ///   throws  Error: this program has no OpenColorIO; a missing or damaged config; a display, view, look or space that
    ///           it has not, with those that it has.
    DisplayTransform(const ColorManagement& asked, const std::filesystem::path& folder);

    /// RGBA8 for RGBA half bits, row by row, alpha 255. `dither`: by half a step, as the renderer's own pictures.
    /// `first_row`: of the picture, where only some of its rows are given.
    std::vector<std::uint8_t> picture(std::span<const std::uint16_t> light, int width, bool dither, int first_row = 0) const;

    const std::string& display() const { return display_; }
    const std::string& view() const { return view_; }
    const std::string& scene_space() const { return scene_space_; }
    /// Of all that decides the picture: the config, the files that the view reads, the choices, the library's version.
    const std::string& fingerprint() const { return fingerprint_; }
    /// For the log.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Processor;
    std::shared_ptr<const Processor> processor_;
    std::string display_, view_, scene_space_, fingerprint_;
    std::vector<std::string> notes_;
};

}  // namespace petrichor::film

#endif
