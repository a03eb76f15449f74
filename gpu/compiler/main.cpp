// petrichor-glsl: compiles a compute shader in a program of its own, so that a text from anywhere
// can neither loop, nor eat the memory, nor crash the renderer. The first text is the shader, the
// others are what it may include; nothing is read from the disk.
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <map>
#include <memory>

#include "base/confine.h"
#include "base/error.h"
#include "gpu/compiler/pack.h"

namespace petrichor::gpu {
namespace {

constexpr std::size_t kDeepestInclude = 32;

class Texts : public glslang::TShader::Includer {
public:
    explicit Texts(const std::vector<ShaderText>& texts)
    {
        for (const ShaderText& one : texts) by_name_[one.name] = &one;
    }
    IncludeResult* includeSystem(const char* name, const char* from, std::size_t depth) override
    {
        return includeLocal(name, from, depth);
    }
    IncludeResult* includeLocal(const char* name, const char*, std::size_t depth) override
    {
        const auto found = by_name_.find(name);
        if (found == by_name_.end() || depth > kDeepestInclude) return nullptr;
        const ShaderText& one = *found->second;
        return new IncludeResult(one.place.empty() ? one.name : one.place, one.text.data(),
                                 one.text.size(), nullptr);
    }
    void releaseInclude(IncludeResult* result) override { delete result; }

private:
    std::map<std::string, const ShaderText*> by_name_;
};

// The first lines that name an error.
std::string errors_in(const std::string& log)
{
    std::string errors;
    int count = 0;
    for (std::size_t at = 0; at < log.size() && count < 4;) {
        const std::size_t end = std::min(log.find('\n', at), log.size());
        std::string line = log.substr(at, end - at);
        at = end + 1;
        if (line.rfind("ERROR: ", 0) != 0) continue;
        line = line.substr(7);
        if (line.find("compilation errors") != std::string::npos) continue;
        errors += (errors.empty() ? "" : "; ") + line;
        ++count;
    }
    return errors.empty() ? log : errors;
}

std::vector<std::byte> compiled(const HelperInput& input)
{
    const std::vector<ShaderText> texts = unpack_texts(input.bytes);
    if (texts.empty()) throw Error("no text was given", "Report this.");
    const EShLanguage stage = texts[0].name.ends_with(".frag.glsl") ? EShLangFragment : EShLangCompute;
    glslang::TShader shader(stage);
    const char* text = texts[0].text.data();
    const int length = static_cast<int>(texts[0].text.size());
    const char* name = texts[0].name.c_str();
    shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    Texts includer(texts);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    const char* const fix = "Mend the shader.";
    if (!shader.parse(GetDefaultResources(), 460, false, messages, includer)) {
        throw Error(errors_in(shader.getInfoLog()), fix);
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages)) throw Error(errors_in(program.getInfoLog()), fix);
    std::vector<unsigned int> words;
    glslang::SpvOptions options;
    glslang::GlslangToSpv(*program.getIntermediate(stage), words, &options);
    const auto bytes = std::as_bytes(std::span(words));
    return {bytes.begin(), bytes.end()};
}

}  // namespace
}  // namespace petrichor::gpu

int main(int argc, char** argv)
{
    return petrichor::run_helper(argc, argv, petrichor::gpu::compiled,
                                 [] { glslang::InitializeProcess(); });
}
