#ifndef PETRICHOR_TEXPROC_MATERIAL_PREFILTERED_MAPS_H
#define PETRICHOR_TEXPROC_MATERIAL_PREFILTERED_MAPS_H

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "texproc/material/material.h"
#include "texproc/material/source_maps.h"
#include "texproc/prefilter/prefilter.h"
#include "texproc/prefilter/stored_guard.h"
#include "texproc/study/score.h"

namespace petrichor::texproc {

/// The prefiltered levels of a material on their way into its files. Normals are written first;
/// where a file changes them (blocks, few bits), the roughness that goes with it is chosen anew for
/// the normals that came out.
class PrefilteredMaps {
public:
    /// Throws Error when normal and roughness differ in size. Both references must outlive this.
    PrefilteredMaps(const PlannedMaterial& plan, const SourceMaps& maps, int threads);

    /// Numbers of the outputs in the order to write them: normals before roughness.
    std::vector<std::size_t> order() const;
    /// To be called before output `number` is written, with what was made so far.
    void aim(std::size_t number, const std::vector<MadeOutput>& made,
             const std::filesystem::path& folder);

    /// Looks at output `number` as it was written, and makes levels plain that its file makes worse
    /// than plain mips in the same file. write() writes the output anew, as levels() are then.
    void guard(std::size_t number, std::vector<MadeOutput>& made,
               const std::filesystem::path& folder, const std::function<MadeOutput()>& write);

    bool has_second_lobe() const { return !chains_.second.share.empty(); }
    /// Level 0 of kSecondLobe, where both lobes are those of the maps.
    RawImage second_lobe_of_maps() const;

    /// Level 0 of a role for an output where it is not the map as it came: normals of more than 8 bits in files
    /// of 8, rounded before their levels were made. Else nullptr.
    const RawImage* level0(std::size_t number, const std::string& role) const;
    /// Levels 1.. of a role for an output; nullptr where they are plain mips.
    const std::vector<Image>* levels(std::size_t number, const std::string& role) const;
    /// What the base colour is to be multiplied by (apply_base_shares); empty: by nothing.
    const std::vector<Image>& base_share() const { return chains_.base_share; }
    const std::vector<Image>& metal_share() const { return chains_.metal_share; }
    /// For TextureWriteOptions::texel_weights of an output whose first level is `first`: a
    /// prefiltered map alone in BC4 or BC5; empty for others.
    std::vector<Image> texel_weights(std::size_t number, std::size_t first) const;
    /// What engines read from the first outputs that hold the maps; nothing where the recipe asks
    /// for no scores.
    std::optional<Prefiltered> shipped(const std::vector<MadeOutput>& made,
                                       const std::filesystem::path& folder) const;
    /// The lobe error of a chain, and how far pictures with it are from the truth.
    Score lobe_error(const Prefiltered& shipped) const;
    PictureError picture_error(const Prefiltered& shipped,
                               const std::vector<MadeOutput>& made) const;

private:
    void choose_options(int threads);
    const RawImage& normal() const;  // level 0 as the levels were made of it, and as scores see it
    const RawImage& rough() const;
    const PictureBench& bench() const;
    bool is_guarded(const PlannedOutput& output) const;
    Prefiltered as_read(std::size_t number, const std::vector<MadeOutput>& made,
                        const std::filesystem::path& folder) const;
    bool holds(const PlannedOutput& output, const std::string& role) const;
    bool changes_normals(const PlannedOutput& output) const;
    std::optional<std::size_t> normals_of(std::size_t number) const;
    SecondLobe second_with(const std::vector<Image>& roughness) const;
    const std::vector<Image>& second_levels(std::size_t number) const;
    void read_second(const std::vector<MadeOutput>& made, const std::filesystem::path& folder, std::size_t rough,
                     Prefiltered& read) const;
    std::vector<Image> read_back(std::size_t number, const std::string& role,
                                 const std::vector<MadeOutput>& made,
                                 const std::filesystem::path& folder) const;

    const PlannedMaterial& plan_;
    const SourceMaps& maps_;
    std::string rough_role_;  // empty: nothing is prefiltered
    PrefilterOptions options_;
    int bits_ = 8;  // of the finest file
    std::optional<RawImage> normal_, rough_;  // level 0 in 8 bits, where levels are made of that
    Prefiltered chains_;
    std::map<std::size_t, std::vector<Image>> aimed_;    // roughness, by the output of its normals
    std::map<std::size_t, std::vector<Image>> guarded_;  // roughness with plain levels, by output
    std::map<std::size_t, PictureScore> plain_scores_;   // of plain mips in the files of an output
    mutable std::optional<PictureBench> bench_;
    mutable std::map<std::size_t, std::vector<Image>> second_;  // packed levels of the second lobe, by output
};

}  // namespace petrichor::texproc

#endif
