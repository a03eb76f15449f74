#include "texproc/material/material_names.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

struct Phrase {
    std::vector<std::string> words;
    std::vector<std::pair<std::string, std::string>> roles;  // role, channels
    Green green = Green::Auto;
};

const std::vector<Phrase>& phrases()
{
    static const std::vector<Phrase> all = [] {
        std::vector<Phrase> list;
        const auto add = [&](const std::string& role,
                             const std::vector<std::vector<std::string>>& names) {
            for (const auto& words : names) list.push_back({words, {{role, ""}}});
        };
        add("albedo", {{"albedo"},
                       {"base", "color"},
                       {"basecolor"},
                       {"base", "colour"},
                       {"color"},
                       {"colour"},
                       {"col"},
                       {"diff"},
                       {"diffuse"},
                       {"alb"},
                       {"base", "map"},
                       {"basemap"},
                       {"albedo", "map"},
                       {"diffuse", "map"},
                       {"color", "map"}});
        add("normal", {{"normal"},
                       {"normals"},
                       {"nor"},
                       {"nrm"},
                       {"norm"},
                       {"lux", "nrm"},
                       {"normal", "map"}});
        for (const char* normal : {"normal", "nor", "nrm"}) {
            for (const char* gl : {"gl", "ogl", "opengl"}) {
                list.push_back({{normal, gl}, {{"normal", ""}}, Green::Up});
            }
            for (const char* dx : {"dx", "directx"}) {
                list.push_back({{normal, dx}, {{"normal", ""}}, Green::Down});
            }
        }
        list.push_back({{"normal", "open", "gl"}, {{"normal", ""}}, Green::Up});
        list.push_back({{"normal", "direct", "x"}, {{"normal", ""}}, Green::Down});
        add("roughness", {{"roughness"}, {"rough"}, {"rgh"}, {"roughness", "map"}});
        add("smoothness", {{"smoothness"}, {"smooth"}, {"gloss"}, {"glossiness"}});
        add("height",
            {{"height"}, {"displacement"}, {"disp"}, {"bump"}, {"height", "map"}, {"bump", "map"}});
        add("occlusion",
            {{"ao"}, {"occlusion"}, {"occ"}, {"ambient", "occlusion"}, {"ambientocclusion"}});
        add("metallic", {{"metallic"}, {"metalness"}, {"metal"}});
        add("specular", {{"specular"}, {"spec"}, {"refl"}, {"reflection"}, {"specular", "color"}});
        add("emission", {{"emission"}, {"emissive"}, {"emit"}, {"emissive", "color"}});
        add("opacity", {{"opacity"}, {"alpha"}, {"transparency"}, {"alphamasked"}});
        add("porosity", {{"porosity"}});
        add("cavity", {{"cavity"}});
        add("puddle", {{"puddle"}, {"puddles"}});
        const std::vector<std::pair<std::string, std::string>> orm{
            {"occlusion", "r"}, {"roughness", "g"}, {"metallic", "b"}};
        list.push_back({{"arm"}, orm});
        list.push_back({{"orm"}, orm});
        list.push_back({{"rma"}, {{"roughness", "r"}, {"metallic", "g"}, {"occlusion", "b"}}});
        list.push_back({{"mra"}, {{"metallic", "r"}, {"roughness", "g"}, {"occlusion", "b"}}});
        list.push_back(
            {{"mask", "map"},
             {{"metallic", "r"}, {"occlusion", "g"}, {"detail", "b"}, {"smoothness", "a"}}});
        list.push_back({{"metallic", "smoothness"}, {{"metallic", "r"}, {"smoothness", "a"}}});
        list.push_back({{"specular", "smoothness"}, {{"specular", "rgb"}, {"smoothness", "a"}}});
        list.push_back({{"lux", "spec"}, {{"specular", "rgb"}, {"smoothness", "a"}}});
        for (const char* base : {"albedo", "base"}) {
            list.push_back({{base, "transparency"}, {{"albedo", "rgb"}, {"opacity", "a"}}});
            list.push_back({{base, "opacity"}, {{"albedo", "rgb"}, {"opacity", "a"}}});
            list.push_back({{base, "smoothness"}, {{"albedo", "rgb"}, {"smoothness", "a"}}});
        }
        list.push_back({{"base", "color", "opacity"}, {{"albedo", "rgb"}, {"opacity", "a"}}});
        list.push_back({{"occlusion", "roughness", "metallic"}, orm});
        list.push_back({{"occlusion", "rough", "metal"}, orm});
        list.push_back({{"occlusion", "roughness", "metalness"}, orm});
        list.push_back({{"ao", "roughness", "metallic"}, orm});
        list.push_back({{"ao", "rough", "metal"}, orm});
        list.push_back({{"roughness", "metallic"}, {{"roughness", "g"}, {"metallic", "b"}}});
        list.push_back({{"metallic", "roughness"}, {{"roughness", "g"}, {"metallic", "b"}}});
        list.push_back({{"metal", "rough"}, {{"roughness", "g"}, {"metallic", "b"}}});
        list.push_back({{"metal", "roughness"}, {{"roughness", "g"}, {"metallic", "b"}}});
        list.push_back({{"ordp"}, {{"occlusion", "r"}, {"roughness", "g"}, {"height", "b"}}});
        list.push_back({{"specular", "glossiness"}, {{"specular", "rgb"}, {"smoothness", "a"}}});
        list.push_back({{"spec", "gloss"}, {{"specular", "rgb"}, {"smoothness", "a"}}});
        list.push_back({{"mixed", "ao"}, {{"occlusion", ""}}});
        list.push_back({{"alb", "ht"}, {{"albedo", "rgb"}, {"height", "a"}}});
        list.push_back({{"nrm", "rgh"}, {{"normal", "rgb"}, {"roughness", "a"}}});
        return list;
    }();
    return all;
}

// A word of a name and where it stands.
struct Word {
    std::string text;  // lower case
    std::size_t begin, end;
};

// Every byte of a letter beyond ASCII is one.
bool is_letter_or_digit(char c)
{
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) != 0;
}
bool is_upper(char c)
{
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_lower(char c)
{
    return std::islower(static_cast<unsigned char>(c)) != 0;
}

// Splits at everything that is no letter or digit, and where a capital follows a small letter.
std::vector<Word> words_of(const std::string& stem)
{
    std::vector<Word> words;
    for (std::size_t i = 0; i < stem.size(); ++i) {
        if (!is_letter_or_digit(stem[i])) continue;
        const bool starts = i == 0 || !is_letter_or_digit(stem[i - 1]) ||
                            (is_upper(stem[i]) && is_lower(stem[i - 1]));
        if (starts) words.push_back({"", i, i});
        words.back().text += static_cast<char>(std::tolower(static_cast<unsigned char>(stem[i])));
        words.back().end = i + 1;
    }
    return words;
}

// "2k", "4096", "jpg": marks of resolution and format that are no part of a material's name.
bool is_mark(const std::string& word)
{
    static const std::set<std::string> formats{"jpg", "jpeg", "png", "exr", "tif", "tiff", "tga"};
    if (formats.count(word)) return true;
    const std::size_t digits = word.find_first_not_of("0123456789");
    return digits == word.size() - 1 && digits > 0 && word[digits] == 'k';
}

// "2k", "8192", "hires": how large a map is.
bool is_resolution(const std::string& word)
{
    static const std::set<std::string> sizes{"256",  "512",  "1024",  "2048",
                                             "4096", "8192", "16384", "hires"};
    if (sizes.count(word)) return true;
    const std::size_t digits = word.find_first_not_of("0123456789");
    return digits != std::string::npos && digits > 0 && digits + 1 == word.size() &&
           word[digits] == 'k';
}

// How many words say what the file holds. What libraries add behind is none of it: Poliigon's
// workflow behind the resolution ("GLOSS_2K_SPECULAR").
std::size_t told_words(const std::vector<Word>& words)
{
    if (words.size() < 3 || !is_resolution(words[words.size() - 2].text)) return words.size();
    const std::string& last = words.back().text;
    return last == "metalness" || last == "specular" ? words.size() - 1 : words.size();
}

// "NRM16", "DISP16": the depth belongs to the file, not to the word.
std::string without_depth(const std::string& word)
{
    for (const char* depth : {"16", "32", "8"}) {
        if (word.size() > 2 && word.ends_with(depth) &&
            word.find_first_of("0123456789") == word.size() - std::string(depth).size())
            return word.substr(0, word.size() - std::string(depth).size());
    }
    return word;
}

// Pictures of a material, and of light.
bool is_no_map(const std::vector<Word>& words)
{
    static const std::set<std::string> others{
        "preview", "previews", "thumb",  "thumbnail", "matcap", "render",   "sphere",
        "hdri",    "swatch",   "sample", "icon",      "popup",  "billboard"};
    return std::any_of(words.begin(), words.end(),
                       [&](const Word& word) { return others.count(word.text) != 0; });
}

std::string trimmed(const std::string& text)
{
    std::size_t a = 0, b = text.size();
    while (a < b && !is_letter_or_digit(text[a])) ++a;
    while (b > a && !is_letter_or_digit(text[b - 1])) --b;
    return text.substr(a, b - a);
}

std::string without_marks(const std::string& name)
{
    std::vector<Word> words = words_of(name);
    std::size_t end = name.size();
    while (words.size() > 1 && is_mark(words.back().text)) {
        end = words.back().begin;
        words.pop_back();
    }
    return trimmed(name.substr(0, end));
}

int rank_of(const fs::path& path)
{
    static const std::vector<std::string> best{".exr", ".tif", ".tiff", ".png", ".tga", ".psd"};
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return static_cast<int>(std::find(best.begin(), best.end(), extension) - best.begin());
}

bool is_image(const fs::path& path)
{
    static const std::set<std::string> known{".png",  ".jpg", ".jpeg", ".tga", ".tif",
                                             ".tiff", ".exr", ".hdr",  ".psd", ".bmp",
                                             ".webp", ".dds", ".ktx2"};
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return known.count(extension) != 0;
}

// A map of its own is better than a channel of a packed one, green up better than down, and a file
// format that loses nothing better than one that does.
struct Candidate {
    InputMap map;
    Green green;
    auto order() const
    {
        return std::tuple(map.channels.size() == 1, green == Green::Down, rank_of(map.path),
                          map.path);
    }
};

struct Group {
    std::string short_name;
    std::map<std::string, std::vector<Candidate>> roles;
};

// Unreal's names, T_Wall_BC: the last word is a letter or two, which elsewhere may mean anything.
bool is_of_unreal(const std::vector<Word>& words)
{
    return words.size() >= 3 && words.front().text == "t";
}

NamedMaps named_as_in_unreal(const std::string& stem)
{
    static const std::map<std::string, std::string> kRoles{
        {"d", "albedo"},   {"bc", "albedo"},   {"b", "albedo"},    {"c", "albedo"},
        {"n", "normal"},   {"r", "roughness"}, {"m", "metallic"},  {"h", "height"},
        {"s", "specular"}, {"e", "emission"},  {"o", "occlusion"}, {"a", "opacity"}};
    std::vector<Word> words = words_of(stem);
    if (!is_of_unreal(words)) return {};
    const auto role = kRoles.find(words.back().text);
    if (role == kRoles.end()) return {};
    NamedMaps named;
    named.material = trimmed(stem.substr(words[1].begin, words.back().begin - words[1].begin));
    named.short_name = without_marks(named.material);
    named.roles[role->second] = "";
    return named;
}

// "Wall [Albedo] [Smoothness]": what stands in the channels, colour before alpha.
NamedMaps named_in_brackets(const std::string& stem)
{
    const std::size_t open = stem.find('[');
    if (open == std::string::npos || stem.back() != ']') return {};
    std::vector<std::string> roles;
    for (std::size_t at = open; at != std::string::npos; at = stem.find('[', at + 1)) {
        const std::size_t close = stem.find(']', at);
        if (close == std::string::npos) return {};
        const NamedMaps one = maps_named("x_" + stem.substr(at + 1, close - at - 1));
        if (one.roles.size() != 1) return {};
        roles.push_back(one.roles.begin()->first);
    }
    if (roles.size() > 2) return {};
    NamedMaps named;
    named.material = trimmed(stem.substr(0, open));
    named.short_name = without_marks(named.material);
    named.roles[roles[0]] = roles.size() > 1 ? "rgb" : "";
    if (roles.size() > 1) named.roles[roles[1]] = "a";
    return named;
}

// What `generate` makes for weather belongs to no material.
bool is_weather_texture(const std::string& stem)
{
    return stem == "ripple" || stem == "snow_mask" || stem == "snow_water_bump" ||
           stem == "skin_ring";
}

// Every image below a folder, but for hidden ones and those made for weather.
std::vector<fs::path> images_below(const fs::path& folder)
{
    std::error_code failed;
    if (!fs::is_directory(folder, failed)) {
        throw Error("texture build: " + folder.string() + " is not a folder",
                    "Name a folder with maps, or a recipe (.toml).");
    }
    fs::recursive_directory_iterator walk(folder, fs::directory_options::skip_permission_denied,
                                          failed);
    if (failed) {
        throw Error(
            "texture build: cannot read the folder " + folder.string() + ": " + failed.message(),
            "Make it readable, or name another.");
    }
    std::vector<fs::path> images;
    for (const fs::directory_entry& entry : walk) {
        const fs::path& path = entry.path();
        if (path.filename().string().front() == '.') {
            if (entry.is_directory(failed)) walk.disable_recursion_pending();
        } else if (is_image(path) && entry.is_regular_file(failed) &&
                   !is_weather_texture(path.stem().string())) {
            images.push_back(path);
        }
    }
    return images;
}

}  // namespace

InputMap parse_input_map(const std::string& text)
{
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) return {text, ""};
    const std::string letters = text.substr(colon + 1);
    if (letters.find_first_not_of("rgba") != std::string::npos) return {text, ""};
    return {text.substr(0, colon), letters};
}

const std::vector<std::string>& map_roles()
{
    static const std::vector<std::string> roles{"albedo",     "normal",   "height",    "roughness",
                                                "smoothness", "metallic", "occlusion", "specular",
                                                "detail",     "porosity", "puddle",    "crack",
                                                "flow",       "cavity",   "emission",  "opacity"};
    return roles;
}

namespace {

// The longest phrase among the words, and where; of equals the one that ends last.
std::pair<const Phrase*, std::size_t> best_phrase(const std::vector<Word>& words)
{
    const Phrase* best = nullptr;
    std::size_t best_at = 0;
    for (const Phrase& phrase : phrases()) {
        for (std::size_t at = 0; at + phrase.words.size() <= words.size(); ++at) {
            const bool here =
                std::equal(phrase.words.begin(), phrase.words.end(),
                           words.begin() + static_cast<std::ptrdiff_t>(at),
                           [](const std::string& a, const Word& b) { return a == b.text; });
            if (!here) continue;
            const std::size_t longest = best ? best->words.size() : 0;
            const std::size_t end = at + phrase.words.size();
            if (phrase.words.size() > longest ||
                (phrase.words.size() == longest && end > best_at + longest)) {
                best = &phrase;
                best_at = at;
            }
        }
    }
    return {best, best_at};
}


// The number of a UDIM tile at the end of a stem, "wall_albedo.1001" or "wall_albedo_1001" (behind
// an underscore 1024 is a size), and the stem without it.
std::pair<std::string, std::string> without_tile(const std::string& stem)
{
    if (stem.size() < 6) return {"", stem};
    const std::string tile = stem.substr(stem.size() - 4);
    const char before = stem[stem.size() - 5];
    const bool number = tile[0] == '1' && tile.find_first_not_of("0123456789") == std::string::npos;
    if (!number || tile == "1000" || !(before == '.' || (before == '_' && tile != "1024")))
        return {"", stem};
    return {tile, stem.substr(0, stem.size() - 5)};
}

NamedMaps untiled_maps_named(const std::string& stem)
{
    std::vector<Word> words = words_of(stem);
    if (is_no_map(words)) return {};
    if (NamedMaps unreal = named_as_in_unreal(stem); !unreal.roles.empty()) return unreal;
    if (NamedMaps lux = named_in_brackets(stem); !lux.roles.empty()) return lux;
    for (Word& word : words) word.text = without_depth(word.text);
    // "vdbobcm_2K_Specular" is a map, "GLOSS_2K_SPECULAR" says how Poliigon's gloss is meant.
    std::vector<Word> told = words;
    told.resize(told_words(words));
    auto [best, best_at] = best_phrase(told);
    if (best) {
        words = std::move(told);
    } else {
        std::tie(best, best_at) = best_phrase(words);
    }
    if (!best) return {};
    NamedMaps named;
    const std::size_t from = is_of_unreal(words) && best_at > 0 ? words[1].begin : 0;
    const std::string before =
        trimmed(stem.substr(from, words[best_at].begin - std::min(from, words[best_at].begin)));
    const std::size_t behind = words[best_at + best->words.size() - 1].end;
    const std::string after = trimmed(stem.substr(behind, words.back().end - behind));
    named.material = before + (before.empty() || after.empty() ? "" : "_") + after;
    named.short_name = without_marks(named.material);
    if (words_of(named.short_name).size() == 1 && is_mark(words_of(named.short_name)[0].text)) {
        named.short_name.clear();
    }
    for (const auto& [role, channels] : best->roles) named.roles[role] = channels;
    named.green = best->green;
    return named;
}

}  // namespace

NamedMaps maps_named(const std::string& stem)
{
    const auto [tile, rest] = without_tile(stem);
    NamedMaps named = untiled_maps_named(rest);
    if (!named.roles.empty()) named.tile = tile;
    return named;
}

std::vector<MaterialFiles> find_materials(const fs::path& folder)
{
    std::error_code failed;
    std::map<std::tuple<fs::path, std::string, std::string>, Group> groups;  // folder, name, tile
    for (const fs::path& path : images_below(folder)) {
        const NamedMaps named = maps_named(path.stem().string());
        if (named.roles.empty()) continue;
        Group& group = groups[{path.parent_path(), named.material, named.tile}];
        group.short_name = named.short_name;
        for (const auto& [role, channels] : named.roles) {
            group.roles[role].push_back({{path, channels}, named.green});
        }
    }
    if (groups.empty()) {
        throw Error(
            "texture build: no map in " + folder.string() + " has a name that says what it is",
            "Name them as X_albedo.png, X_normal.png, X_roughness.png, ..., or write a recipe.");
    }
    std::map<std::tuple<fs::path, std::string, std::string>, int> uses;
    for (const auto& [key, group] : groups)
        ++uses[{std::get<0>(key), group.short_name, std::get<2>(key)}];
    std::vector<MaterialFiles> found;
    for (auto& [key, group] : groups) {
        MaterialFiles material;
        const auto& [place, name, tile] = key;
        const bool alone = uses[{place, group.short_name, tile}] == 1;
        material.name = alone ? group.short_name : name;
        material.tile = tile;
        if (material.name.empty()) {
            material.name = fs::weakly_canonical(place).filename().string();
        }
        material.folder = fs::relative(place, folder, failed);
        if (material.folder == ".") material.folder.clear();
        for (auto& [role, candidates] : group.roles) {
            std::sort(candidates.begin(), candidates.end(),
                      [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });
            material.inputs[role] = candidates.front().map;
            if (role == "normal") material.green = candidates.front().green;
            for (std::size_t i = 1; i < candidates.size(); ++i) {
                material.notes.push_back(
                    candidates[i].map.path.filename().string() + " is left out: " +
                    candidates.front().map.path.filename().string() + " is the " + role + " map");
            }
        }
        found.push_back(std::move(material));
    }
    return found;
}

std::vector<MaterialFiles> udim_tiles(const MaterialFiles& set)
{
    static const std::string kMark = "<UDIM>";
    std::set<std::string> tiles;
    bool marked = false;
    for (const auto& [role, map] : set.inputs) {
        const std::string name = map.path.filename().string();
        const std::size_t mark = name.find(kMark);
        if (mark == std::string::npos) continue;
        marked = true;
        const std::string before = name.substr(0, mark), after = name.substr(mark + kMark.size());
        std::error_code failed;
        const fs::path folder = map.path.has_parent_path() ? map.path.parent_path() : ".";
        for (const auto& entry : fs::directory_iterator(folder, failed)) {
            const std::string file = entry.path().filename().string();
            if (file.size() != before.size() + 4 + after.size() || !file.starts_with(before) ||
                !file.ends_with(after))
                continue;
            const std::string tile = file.substr(before.size(), 4);
            if (tile.find_first_not_of("0123456789") == std::string::npos && tile > "1000" &&
                tile < "2000")
                tiles.insert(tile);
        }
        if (tiles.empty()) {
            throw Error("texture build: there is no file " + map.path.string() +
                            " with 1001 to 1999 for <UDIM>",
                        "Correct the path; it is relative to the recipe.");
        }
    }
    if (!marked) return {set};
    std::vector<MaterialFiles> all;
    for (const std::string& tile : tiles) {
        MaterialFiles one = set;
        one.tile = tile;
        for (auto& [role, map] : one.inputs) {
            std::string name = map.path.filename().string();
            const std::size_t mark = name.find(kMark);
            if (mark == std::string::npos) continue;
            map.path = map.path.parent_path() / name.replace(mark, kMark.size(), tile);
        }
        all.push_back(std::move(one));
    }
    return all;
}

std::vector<fs::path> unnamed_images(const fs::path& folder)
{
    std::vector<fs::path> images = images_below(folder);
    std::erase_if(images, [](const fs::path& path) {
        return !maps_named(path.stem().string()).roles.empty();
    });
    std::sort(images.begin(), images.end());
    return images;
}

}  // namespace petrichor::texproc
