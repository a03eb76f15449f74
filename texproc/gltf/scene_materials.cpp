#include "texproc/gltf/scene_materials.h"

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/output_file.h"
#include "texproc/gltf/image_plan.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

const JsonText& list(const JsonText& json, std::string_view key)
{
    static const JsonText none = JsonText::array();
    const JsonText* found = json.find(key);
    return found && found->kind() == JsonText::Kind::Array ? *found : none;
}

const JsonText* member(const JsonText* json, std::string_view key)
{
    return json ? json->find(key) : nullptr;
}

std::optional<std::size_t> index_of(const JsonText* json, std::string_view key)
{
    const JsonText* found = member(json, key);
    return found ? found->as_index() : std::nullopt;
}

// A name that every file system takes.
std::string file_name(const std::string& text)
{
    std::string name;
    for (const char c : text) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '_';
        name += plain ? c : '_';
    }
    return name;
}

const char* extension_of(const std::vector<std::byte>& bytes)
{
    const auto starts = [&](std::string_view magic) {
        if (bytes.size() < magic.size()) return false;
        for (std::size_t i = 0; i < magic.size(); ++i) {
            if (static_cast<char>(bytes[i]) != magic[i]) return false;
        }
        return true;
    };
    return starts("\xff\xd8") ? ".jpg" : starts("RIFF") ? ".webp" : ".png";
}

Edge edge_of(const JsonText* sampler, std::string_view key)
{
    constexpr std::size_t kClamp = 33071, kMirror = 33648;
    const std::size_t mode = index_of(sampler, key).value_or(0);
    return mode == kClamp ? Edge::Clamp : mode == kMirror ? Edge::Mirror : Edge::Wrap;
}

class Reader {
public:
    Reader(const GltfFile& file, const fs::path& folder) : file_(file), folder_(folder) {}

    SceneMaterials read()
    {
        const JsonText& materials = list(file_.json, "materials");
        for (std::size_t i = 0; i < materials.size(); ++i) material(materials.at(i), i);
        return std::move(found_);
    }

private:
    void material(const JsonText& json, std::size_t number)
    {
        MaterialFiles files;
        const JsonText* name = json.find("name");
        files.name = file_name(name ? name->as_string().value_or("") : "");
        if (files.name.empty()) files.name = "material_" + std::to_string(number);
        while (!names_.insert(files.name).second) files.name += "_" + std::to_string(number);
        files.green = Green::Up;

        const JsonText* pbr = json.find("pbrMetallicRoughness");
        map(files, "albedo", member(pbr, "baseColorTexture"), "");
        map(files, "normal", json.find("normalTexture"), "");
        map(files, "roughness", member(pbr, "metallicRoughnessTexture"), "g");
        map(files, "metallic", member(pbr, "metallicRoughnessTexture"), "b");
        map(files, "occlusion", json.find("occlusionTexture"), "r");
        map(files, "emission", json.find("emissiveTexture"), "");
        if (!files.inputs.empty()) found_.materials.push_back(std::move(files));
    }

    void map(MaterialFiles& files, const std::string& role, const JsonText* info,
             const std::string& channels)
    {
        const std::optional<std::size_t> texture = index_of(info, "index");
        if (!texture) return;
        const int image = source_image(file_, *texture);
        if (image < 0) {
            found_.notes.push_back(files.name + ": its " + role +
                                   " brings levels or a format of its own and is left out");
            return;
        }
        files.inputs[role] = {path_of(static_cast<std::size_t>(image)), channels};
        const JsonText& samplers = list(file_.json, "samplers");
        const auto sampler = index_of(&list(file_.json, "textures").at(*texture), "sampler");
        if (!sampler || *sampler >= samplers.size()) return;
        files.edge_u = edge_of(&samplers.at(*sampler), "wrapS");
        files.edge_v = edge_of(&samplers.at(*sampler), "wrapT");
    }

    fs::path path_of(std::size_t image)
    {
        const auto known = paths_.find(image);
        if (known != paths_.end()) return known->second;
        const JsonText& json = list(file_.json, "images").at(image);
        const JsonText* uri = json.find("uri");
        const std::string text = uri ? uri->as_string().value_or("") : "";
        const std::optional<fs::path> beside = text.empty() ? std::nullopt : resource_path(text);
        if (beside) {
            resource_bytes(file_, text);  // refuses what lies outside the folder of the scene
            return paths_[image] = file_.path.parent_path() / *beside;
        }
        const std::optional<std::size_t> view = index_of(&json, "bufferView");
        if (text.empty() && !view) {
            throw Error("glTF " + file_.path.string() + ": image " + std::to_string(image) +
                            " has neither a uri nor a bufferView",
                        "Export the scene again.");
        }
        const std::vector<std::byte> bytes =
            text.empty() ? view_bytes(file_, *view) : resource_bytes(file_, text);
        const fs::path path = folder_ / ("image_" + std::to_string(image) + extension_of(bytes));
        write_text_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        return paths_[image] = path;
    }

    const GltfFile& file_;
    const fs::path folder_;
    SceneMaterials found_;
    std::set<std::string> names_;
    std::map<std::size_t, fs::path> paths_;
};

}  // namespace

SceneMaterials scene_materials(const GltfFile& file, const fs::path& folder)
{
    return Reader(file, folder).read();
}

}  // namespace petrichor::texproc
