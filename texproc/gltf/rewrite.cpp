#include "texproc/gltf/rewrite.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>

#include "base/error.h"
#include "base/interrupted.h"
#include "base/words.h"
#include "texproc/prefilter/detail/picture_cost.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBasis = "KHR_texture_basisu";
constexpr const char* kWebp = "EXT_texture_webp";

std::string extension_of(const fs::path& path)
{
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

const JsonText& list(const JsonText& json, const char* key)
{
    static const JsonText none = JsonText::array();
    const JsonText* found = json.find(key);
    return found && found->kind() == JsonText::Kind::Array ? *found : none;
}

// How often "bufferView": view stands anywhere.
int uses_of_view(const JsonText& value, std::size_t view)
{
    const JsonText* own = value.find("bufferView");
    int uses = own && own->as_index() == view ? 1 : 0;
    for (std::size_t i = 0; i < value.size(); ++i) uses += uses_of_view(value.at(i), view);
    return uses;
}

std::string name_of(const JsonText& object, const std::string& kind, std::size_t number)
{
    const JsonText* name = object.find("name");
    const std::string text = name ? printable(name->as_string().value_or("")) : "";
    return kind + " " + std::to_string(number) + (text.empty() ? "" : " (" + text + ")");
}

void add_word(JsonText& root, const char* key, const char* word)
{
    for (std::size_t i = 0; i < list(root, key).size(); ++i) {
        if (list(root, key).at(i).as_string() == word) return;
    }
    if (!root.find(key)) root.set(key, JsonText::array());
    root.edit(key).append(JsonText::string(word));
}

void remove_word(JsonText& root, const char* key, const char* word)
{
    const JsonText& words = list(root, key);
    JsonText kept = JsonText::array();
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words.at(i).as_string() != word) kept.append(words.at(i));
    }
    if (kept.size() == words.size()) return;
    if (kept.size()) {
        root.set(key, std::move(kept));
    } else {
        root.erase(key);
    }
}

// Factors stay where they are read or moved by something else.
GltfBuildOptions settled(GltfBuildOptions options, const GltfFile& file)
{
    const JsonText& used = list(file.json, "extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used.at(i).as_string() == "KHR_animation_pointer")
            options.images.bake_roughness = false;
    }
    if (options.fallback) options.images.bake_roughness = false;
    return options;
}

class Rewriter {
public:
    Rewriter(const fs::path& input, const fs::path& output, const GltfBuildOptions& options)
        : output_(output),
          file_(read_gltf_file(input)),
          source_(file_),
          options_(settled(options, source_)),
          plan_(plan_images(source_, options_.images.bake_roughness, options_.images.prefilter.lobes,
                            fits_by_class(options_.images.prefilter))),
          maker_(source_, plan_, options_.images)
    {
        report_.notes = plan_.notes;
    }

    GltfBuildReport run()
    {
        make_images();
        find_pairs();
        guard_pairs();
        drop_lobes();
        finish_images();
        place_textures();
        place_images();
        settle_materials();
        settle_extensions();
        write();
        return std::move(report_);
    }

private:
    // A surface with its normals, and the base colours that go with them.
    struct Pair {
        std::string name;  // of the first material that has it
        std::size_t surface = 0, normals = 0;
        std::set<std::size_t> colors{};
        std::optional<std::size_t> second{};  // of two lobes
        std::optional<PictureError> error{};
    };
    void make_images();
    void find_pairs();
    void guard_pairs();
    void guard(Pair& pair);
    void drop_lobes();
    void finish_images();
    void place_textures();
    void place_images();
    void settle_materials();
    void settle_extensions();
    void write();
    JsonText& slot_json(const TextureSlot& slot);
    void put_image(std::size_t entry, std::size_t recipe);
    std::string new_uri(std::size_t recipe);
    bool may_replace(std::size_t image) const;

    fs::path output_;
    GltfFile file_;          // as it will be
    const GltfFile source_;  // as it was
    const GltfBuildOptions options_;
    ImagePlan plan_;
    ImageMaker maker_;
    GltfBuildReport report_;
    std::vector<std::vector<std::byte>> made_;  // files, by recipe
    std::vector<MipTexture> textures_made_;     // by recipe
    std::vector<Pair> pairs_;
    std::map<std::size_t, std::vector<std::size_t>> textures_;  // by recipe: that show it
    std::set<std::size_t> replaced_textures_;               // that no longer show their old image
    std::map<std::size_t, std::size_t> images_;             // recipe -> entry of images
    std::vector<std::pair<fs::path, std::size_t>> beside_;  // files of a .gltf: name, recipe
};

void Rewriter::make_images()
{
    for (std::size_t r = 0; r < plan_.recipes.size(); ++r) {
        if (options_.stop && options_.stop()) throw Interrupted("texture build: stopped");
        textures_made_.push_back(maker_.make(r));
    }
}

void Rewriter::find_pairs()
{
    for (const TextureSlot& surface : plan_.slots) {
        const ImageRecipe& recipe = plan_.recipes[surface.recipe];
        if (recipe.meaning != ImageMeaning::Surface || recipe.normal < 0) continue;
        std::optional<std::size_t> normals, color, second;
        for (const TextureSlot& slot : plan_.slots) {
            if (slot.material != surface.material) continue;
            const bool same = plan_.recipes[slot.recipe].lobes == recipe.lobes;
            if (slot.keys.back() == "normalTexture" && same) normals = slot.recipe;
            if (slot.keys.back() == "secondLobeTexture" && same) second = slot.recipe;
            if (slot.keys.back() == "baseColorTexture") color = slot.recipe;
        }
        if (!normals) continue;
        auto pair = std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& p) {
            return p.surface == surface.recipe && p.normals == *normals;
        });
        if (pair == pairs_.end()) {
            const JsonText& material = source_.json.find("materials")->at(surface.material);
            pair = pairs_.insert(pairs_.end(), {name_of(material, "material", surface.material),
                                                surface.recipe, *normals});
            pair->second = second;
        }
        if (color) pair->colors.insert(*color);
    }
}

// Levels that blocks make worse than plain mips in the same blocks become those.
void Rewriter::guard(Pair& pair)
{
    const auto pictures = maker_.pictures(pair.surface);
    if (!pictures) return;
    const bool darkened =
        !pair.colors.empty() &&
        std::all_of(pair.colors.begin(), pair.colors.end(),
                    [&](std::size_t color) { return plan_.recipes[color].normal >= 0; });
    MipTexture& surface = textures_made_[pair.surface];
    const MipTexture& normals = textures_made_[pair.normals];
    const Prefiltered ours = maker_.as_read(pair.surface, *pictures, surface, normals, darkened,
                                            pair.second ? &textures_made_[*pair.second] : nullptr);
    if (options_.images.prefilter.rule != "picture") {  // another rule is asked for as it is
        pair.error = PictureError{mean_score(pictures->bench.score(ours)),
                                  mean_score(pictures->bench.score({}))};
        return;
    }
    const MipTexture plain = maker_.make(pair.surface, true);
    const StoredGuard chosen =
        guard_stored(pictures->bench, ours,
                     maker_.as_read(pair.surface, *pictures, plain, normals, false).roughness);
    pair.error = PictureError{chosen.score, chosen.plain_score};
    for (std::size_t k = 0; k < surface.levels.size(); ++k) {
        const std::size_t at =
            pictures->level_of(level_extent(surface.width, static_cast<int>(k)),
                               level_extent(surface.height, static_cast<int>(k)));
        if (at < chosen.plain.size() && chosen.plain[at]) surface.levels[k] = plain.levels[k];
    }
    if (pair.second && !chosen.plain.empty()) {
        MipTexture& second = textures_made_[*pair.second];
        const MipTexture one = maker_.make(*pair.second, true);
        for (std::size_t k = 0; k < second.levels.size(); ++k) {
            const std::size_t at = pictures->level_of(level_extent(second.width, static_cast<int>(k)),
                                                      level_extent(second.height, static_cast<int>(k)));
            if (at < chosen.plain.size() && chosen.plain[at]) second.levels[k] = one.levels[k];
        }
    }
    if (chosen.darken) return;
    for (const std::size_t color : pair.colors) plan_.recipes[color].normal = -1;
}

// Pairs that share a base colour with one that must not be darkened are looked at again.
void Rewriter::guard_pairs()
{
    if (!options_.score && options_.images.prefilter.rule != "picture") return;
    const auto darkened = [&](const Pair& pair) {
        std::string each = "pair";
        for (const std::size_t color : pair.colors)
            each += plan_.recipes[color].normal >= 0 ? '+' : '-';
        return each;
    };
    const std::vector<ImageRecipe> planned = plan_.recipes;
    std::vector<std::string> seen(pairs_.size());
    for (bool again = true; again;) {
        again = false;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (options_.stop && options_.stop()) throw Interrupted("texture build: stopped");
            if (seen[i] == darkened(pairs_[i])) continue;
            guard(pairs_[i]);
            seen[i] = darkened(pairs_[i]);
            again = true;
        }
    }
    for (std::size_t r = 0; r < planned.size(); ++r)
        if (planned[r] != plan_.recipes[r]) textures_made_[r] = maker_.make(r);
}

// Two lobes cost three textures: where they do not show by 1 % there is one.
void Rewriter::drop_lobes()
{
    std::string why;
    const auto gains = [&](std::size_t material) {
        why = "two lobes were not looked at, it has one";
        const Pair* one = nullptr;
        const Pair* two = nullptr;
        for (const Pair& pair : pairs_) {
            for (const TextureSlot& slot : plan_.slots)
                if (slot.material == material && slot.recipe == pair.surface) (pair.second ? two : one) = &pair;
        }
        if (!one || !two || !one->error || !two->error) return false;
        const PictureScore &with = two->error->shipped, &without = one->error->shipped;
        // As the fit weighs them: a little more flicker is a fair price for much of the error.
        if (detail::change_of(with.rmse, without.rmse) + detail::kFlickerWeight * detail::change_of(with.flicker, without.flicker) < -0.01)
            return true;
        char text[160];
        std::snprintf(text, sizeof(text), "two lobes gain nothing (RMSE %.4f for %.4f, flicker %.4f for %.4f), it has one",
                      with.rmse, without.rmse, with.flicker, without.flicker);
        why = text;
        return false;
    };
    std::vector<TextureSlot> kept;
    std::set<std::size_t> dropped;
    for (const TextureSlot& slot : plan_.slots) {
        if (slot.like.empty() || gains(slot.material)) {
            kept.push_back(slot);
        } else if (dropped.insert(slot.material).second) {
            report_.notes.push_back("material " + std::to_string(slot.material) + ": " + why);
        }
    }
    if (dropped.empty()) return;
    // Recipes that nothing shows any more go, and all move up.
    std::vector<std::size_t> moved(plan_.recipes.size(), plan_.recipes.size());
    std::vector<ImageRecipe> recipes;
    std::vector<MipTexture> made;
    for (std::size_t r = 0; r < plan_.recipes.size(); ++r) {
        if (std::none_of(kept.begin(), kept.end(), [&](const TextureSlot& s) { return s.recipe == r; })) continue;
        moved[r] = recipes.size();
        recipes.push_back(plan_.recipes[r]);
        made.push_back(std::move(textures_made_[r]));
    }
    for (TextureSlot& slot : kept) slot.recipe = moved[slot.recipe];
    std::erase_if(pairs_, [&](const Pair& pair) { return moved[pair.surface] == moved.size(); });
    plan_.slots = std::move(kept);
    plan_.recipes = std::move(recipes);
    textures_made_ = std::move(made);
}

void Rewriter::finish_images()
{
    for (std::size_t r = 0; r < plan_.recipes.size(); ++r) {
        const ImageRecipe& recipe = plan_.recipes[r];
        const MipTexture& made = textures_made_[r];
        made_.push_back(texture_bytes(made, "ktx2", options_.zstd));
        report_.images.push_back(
            {name_of(source_.json.find("images")->at(recipe.image), "image", recipe.image),
             recipe.meaning, made.width, made.height, static_cast<int>(made.levels.size()),
             image_bytes(source_, recipe.image).size(), made_.back().size(),
             maker_.is_resampled(r)});
        textures_made_[r] = {};
    }
    if (!options_.score) return;
    for (const Pair& pair : pairs_)
        if (pair.error) report_.materials.push_back({pair.name, *pair.error, pair.second ? 2 : 1});
}

JsonText& Rewriter::slot_json(const TextureSlot& slot)
{
    JsonText* json = &file_.json.edit("materials").edit(slot.material);
    for (const std::string& key : slot.keys) json = &json->edit(key);
    return *json;
}

// Textures that show one image keep their place; other uses get textures of their own.
void Rewriter::place_textures()
{
    std::map<std::size_t, std::size_t> first;                           // texture -> recipe
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> others;  // and recipe -> texture
    const auto& kept = plan_.kept_textures;
    for (const TextureSlot& slot : plan_.slots) {
        if (!slot.like.empty()) {
            const JsonText* info = &source_.json.find("materials")->at(slot.material);
            for (const std::string& key : slot.like) info = info->find(key);
            slot_json(slot) = *info;
        }
        const bool stays = std::find(kept.begin(), kept.end(), slot.texture) != kept.end();
        if (!stays && first.emplace(slot.texture, slot.recipe).first->second == slot.recipe) {
            if (replaced_textures_.insert(slot.texture).second)
                textures_[slot.recipe].push_back(slot.texture);
            continue;
        }
        const auto [at, fresh] = others.emplace(std::pair{slot.texture, slot.recipe}, 0);
        if (fresh) {
            JsonText& textures = file_.json.edit("textures");
            at->second = textures.size();
            textures.append(source_.json.find("textures")->at(slot.texture));
            textures_[slot.recipe].push_back(at->second);
        }
        slot_json(slot).set("index", JsonText::number(at->second));
    }
}

// True when nothing but textures that get new images shows an image.
bool Rewriter::may_replace(std::size_t image) const
{
    if (options_.fallback) return false;
    const JsonText* extensions = source_.json.find("extensions");
    if (extensions && extensions->find("EXT_lights_image_based")) return false;
    const JsonText& textures = list(source_.json, "textures");
    for (std::size_t t = 0; t < textures.size(); ++t) {
        if (replaced_textures_.count(t)) continue;
        const JsonText* source = textures.at(t).find("source");
        if (source && source->as_index() == image) return false;
        const JsonText* own = textures.at(t).find("extensions");
        for (std::size_t e = 0; own && e < own->size(); ++e) {
            const JsonText* other = own->at(e).find("source");
            if (other && other->as_index() == image) return false;
        }
    }
    return true;
}

std::string Rewriter::new_uri(std::size_t recipe)
{
    const std::size_t image = plan_.recipes[recipe].image;
    const JsonText* uri = source_.json.find("images")->at(image).find("uri");
    const auto old = uri ? resource_path(uri->as_string().value_or("data:")) : std::nullopt;
    const fs::path base = old ? old->parent_path() / old->stem()
                              : fs::path(output_.stem().string() + "_" + std::to_string(image));
    const auto taken = [&](const fs::path& name) {
        return std::any_of(beside_.begin(), beside_.end(),
                           [&](const auto& other) { return other.first == name; });
    };
    fs::path name = base.string() + ".ktx2";
    for (int k = 2; taken(name); ++k) name = base.string() + "_" + std::to_string(k) + ".ktx2";
    beside_.emplace_back(name, recipe);
    return to_uri(name);
}

void Rewriter::put_image(std::size_t entry, std::size_t recipe)
{
    JsonText& image = file_.json.edit("images").edit(entry);
    if (!file_.binary) {
        image.erase("bufferView");
        image.set("uri", JsonText::string(new_uri(recipe)));
    } else {
        std::optional<std::size_t> reuse;
        if (const JsonText* view = image.find("bufferView")) reuse = view->as_index();
        image.erase("uri");
        image.set("bufferView", JsonText::number(add_to_bin(file_, made_[recipe], reuse)));
    }
    image.set("mimeType", JsonText::string("image/ktx2"));
}

void Rewriter::place_images()
{
    // Entries that the new images take over, and the bytes that nobody needs then.
    std::vector<std::size_t> gone;
    std::set<std::size_t> taken;
    for (std::size_t r = 0; r < plan_.recipes.size(); ++r) {
        const std::size_t image = plan_.recipes[r].image;
        if (!may_replace(image) || !taken.insert(image).second) continue;
        images_[r] = image;
        const JsonText* view = source_.json.find("images")->at(image).find("bufferView");
        if (!view || !view->as_index() || !file_.binary) continue;
        const std::size_t number = *view->as_index();
        const JsonText& json = source_.json.find("bufferViews")->at(number);
        const bool own = uses_of_view(source_.json, number) == 1 && !json.find("extensions") &&
                         json.find("buffer")->as_index() == std::size_t{0};
        if (own) {
            gone.push_back(number);
        } else {
            file_.json.edit("images").edit(image).erase("bufferView");  // a new view, not this
        }
    }
    if (file_.binary) remove_from_bin(file_, gone);
    for (std::size_t r = 0; r < plan_.recipes.size(); ++r) {
        if (!images_.count(r)) {
            JsonText entry = JsonText::object();
            const JsonText& old = source_.json.find("images")->at(plan_.recipes[r].image);
            if (const JsonText* name = old.find("name")) entry.set("name", *name);
            images_[r] = file_.json.find("images")->size();
            file_.json.edit("images").append(std::move(entry));
        }
        put_image(images_[r], r);
    }
    for (const auto& [recipe, textures] : textures_) {
        for (const std::size_t t : textures) {
            JsonText& texture = file_.json.edit("textures").edit(t);
            if (!options_.fallback) texture.erase("source");
            JsonText& extensions = texture.edit("extensions");
            if (!options_.fallback) extensions.erase(kWebp);
            extensions.edit(kBasis).set("source", JsonText::number(images_.at(recipe)));
        }
    }
}

void Rewriter::settle_materials()
{
    for (const std::size_t m : plan_.baked_materials)
        file_.json.edit("materials").edit(m).edit("pbrMetallicRoughness").erase("roughnessFactor");
}

void Rewriter::settle_extensions()
{
    if (plan_.recipes.empty()) return;
    add_word(file_.json, "extensionsUsed", kBasis);
    if (std::any_of(plan_.slots.begin(), plan_.slots.end(), [](const TextureSlot& s) { return !s.like.empty(); }))
        add_word(file_.json, "extensionsUsed", kTwoLobes);
    if (!options_.fallback) add_word(file_.json, "extensionsRequired", kBasis);
    const JsonText& textures = list(file_.json, "textures");
    for (std::size_t t = 0; t < textures.size(); ++t) {
        const JsonText* extensions = textures.at(t).find("extensions");
        if (extensions && extensions->find(kWebp)) return;
    }
    remove_word(file_.json, "extensionsUsed", kWebp);
    remove_word(file_.json, "extensionsRequired", kWebp);
}

// The scene last: it names the others.
void Rewriter::write()
{
    const fs::path to = output_.parent_path(), from = source_.path.parent_path();
    const auto put = [&](const fs::path& name, std::span<const std::byte> bytes) {
        const fs::path path = to / name;
        if (path.has_parent_path()) fs::create_directories(path.parent_path());
        write_bytes(path, bytes);
        report_.files.push_back(path);
    };
    for (const auto& [name, recipe] : beside_) put(name, made_[recipe]);
    for (const char* key : {"buffers", "images"}) {
        const JsonText& all = list(file_.json, key);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const JsonText* uri = all.at(i).find("uri");
            const std::string text = uri ? uri->as_string().value_or("") : "";
            const std::optional<fs::path> name = resource_path(text);
            const bool made = name && std::any_of(beside_.begin(), beside_.end(),
                                                  [&](const auto& b) { return b.first == *name; });
            std::error_code missing;
            if (text.empty() || !name || made || fs::equivalent(to / *name, from / *name, missing))
                continue;
            put(*name, resource_bytes(source_, text));
        }
    }
    put(output_.filename(), to_bytes(file_));
}

}  // namespace

bool is_gltf_name(const fs::path& path)
{
    const std::string extension = extension_of(path);
    return extension == ".glb" || extension == ".gltf";
}

GltfBuildReport build_gltf(const fs::path& input, const fs::path& output,
                           const GltfBuildOptions& options)
{
    if (extension_of(input) != extension_of(output)) {
        throw Error("texture build: the output " + output.string() + " is not a " +
                        extension_of(input) + " as the input is",
                    "Name an output that ends in " + extension_of(input) + ".");
    }
    std::error_code missing;
    if (fs::equivalent(input, output, missing)) {
        throw Error("texture build: " + output.string() + " is the input",
                    "Write to another file; the input stays as it is.");
    }
    return Rewriter(input, output, options).run();
}

}  // namespace petrichor::texproc
