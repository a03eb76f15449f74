#include "gpu/compiler/own_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.h"
#include "base/input_file.h"
#include "base/words.h"

namespace petrichor::gpu {

namespace {

constexpr std::size_t kLargestFile = 256u << 10;

bool is_identifier(const std::string& word)
{
    const auto letter = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    return !word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) == 0 &&
           std::all_of(word.begin(), word.end(), letter) && word.find("__") == std::string::npos;
}

}  // namespace

OwnText read_own_text(const std::string& path, const std::string& what,
                      const std::vector<std::string>& parts, const std::vector<std::string>& taken,
                      const std::string& example)
{
    OwnText own{path, std::filesystem::path(path).stem().string(), ""};
    if (!is_identifier(own.name) || own.name.rfind("gl_", 0) == 0 ||
        std::find(taken.begin(), taken.end(), own.name) != taken.end()) {
        throw Error(what + " " + path + ": \"" + own.name +
                        "\" cannot name its functions: letters, digits and _ can, once a scene, and "
                        "not the name of a built-in one",
                    "Rename the file.");
    }
    own.text = read_file(path, what, kLargestFile);
    std::vector<std::string> names;
    for (const std::string& part : parts) names.push_back("NAME" + part);
    for (const std::string& part : parts) {
        if (own.text.find(own.name + part) == std::string::npos) {
            throw Error(what + " " + path + ": it does not define " + own.name + part,
                        "Define " + join_words(names) + ", as " + example + " does.");
        }
    }
    return own;
}

}  // namespace petrichor::gpu
