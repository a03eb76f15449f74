// The formulas as others take them (docs/shaders.md): every language takes them, and they give the same numbers.
#include "gpu/shader_library/shader_library.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "formulas/weather/fair_weather.h"
#include "gpu/compiler/compiler.h"
#include "gpu/shader_library/tokens.h"
#include "tests/gpu/formula_bench.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/hlsl_law.h"

namespace petrichor::gpu {
namespace {

constexpr ShaderLanguage kGlsl = ShaderLanguage::Glsl;
constexpr ShaderLanguage kHlsl = ShaderLanguage::Hlsl;

// ---- compiling ---------------------------------------------------------------------------------

using Includes = std::map<std::string, std::string>;

class Includer : public glslang::TShader::Includer {
public:
    explicit Includer(const Includes& texts) : texts_(&texts) {}
    IncludeResult* includeLocal(const char* name, const char*, std::size_t) override
    {
        const auto found = texts_->find(name);
        if (found == texts_->end()) return nullptr;
        return new IncludeResult(name, found->second.data(), found->second.size(), nullptr);
    }
    void releaseInclude(IncludeResult* result) override { delete result; }

private:
    const Includes* texts_;
};

struct Compiled {
    std::string errors;  // "": none
    std::vector<unsigned int> words;
    std::vector<std::string> objections;  // of the law, where it was asked for
};

struct Source {
    std::string text;
    ShaderLanguage language = kGlsl;
    bool desktop = true;  // OpenGL or ES without Vulkan's rules otherwise
    EShLanguage stage = EShLangCompute;
};

Compiled compiled(const Source& source, const Includes& includes = {}, bool law = false)
{
    static const bool ready = glslang::InitializeProcess();
    EXPECT_TRUE(ready);
    Compiled result;
    glslang::TShader shader(source.stage);
    const char* text = source.text.c_str();
    shader.setStrings(&text, 1);
    const bool hlsl = source.language == kHlsl;
    int messages = EShMsgDefault;
    if (source.desktop || hlsl) {
        messages = EShMsgSpvRules | EShMsgVulkanRules;
        shader.setEnvInput(hlsl ? glslang::EShSourceHlsl : glslang::EShSourceGlsl, source.stage,
                           glslang::EShClientVulkan, 100);
        // HLSL's buffers that are written are "uniform" to glslang 12, which later versions do not know.
        shader.setEnvClient(glslang::EShClientVulkan,
                            hlsl ? glslang::EShTargetVulkan_1_0 : glslang::EShTargetVulkan_1_3);
        shader.setEnvTarget(glslang::EShTargetSpv, hlsl ? glslang::EShTargetSpv_1_0 : glslang::EShTargetSpv_1_6);
    }
    if (hlsl) {
        messages |= EShMsgReadHlsl;
        shader.setEntryPoint("main");
        shader.setSourceEntryPoint("main");
    }
    Includer includer(includes);
    glslang::TProgram program;
    const auto rules = static_cast<EShMessages>(messages);
    if (!shader.parse(GetDefaultResources(), 110, false, rules, includer)) {
        result.errors = shader.getInfoLog();
        return result;
    }
    if (law) result.objections = objections_of(*shader.getIntermediate());
    program.addShader(&shader);
    if (!program.link(rules)) {
        result.errors = program.getInfoLog();
        return result;
    }
    if (source.desktop || hlsl) glslang::GlslangToSpv(*program.getIntermediate(source.stage), result.words);
    return result;
}

std::string fragment_main(ShaderLanguage language)
{
    return language == kHlsl ? "float4 main() : SV_Target { return float4(0.0, 0.0, 0.0, 1.0); }\n"
                             : "void main() {}\n";
}

TEST(ShaderLibrary, IsGlslOfEveryVersionFrom330AndEs300On)
{
    const std::string library = shader_library(kGlsl);
    for (const char* version : {"330 core", "400 core", "450", "300 es", "310 es"}) {
        const std::string head = std::string("#version ") + version +
                                 "\nprecision highp float;\nprecision highp int;\n";
        const Compiled result =
            compiled({head + library + fragment_main(kGlsl), kGlsl, false, EShLangFragment});
        EXPECT_EQ(result.errors, "") << version;
    }
    EXPECT_EQ(compiled({"#version 460\n" + library + fragment_main(kGlsl), kGlsl, true, EShLangFragment}).errors, "");
}

TEST(ShaderLibrary, IsHlsl)
{
    const std::string library = shader_library(kHlsl);
    // Twice, as when two files that each include it come together.
    EXPECT_EQ(compiled({library + library + fragment_main(kHlsl), kHlsl, true, EShLangFragment}).errors, "");
    EXPECT_EQ(library.find("vec3"), std::string::npos);
}

TEST(ShaderLibrary, EveryHeaderIsGlslAndHlsl)
{
    Includes includes;
    for (const ShaderText& one : formula_headers()) includes[one.name] = one.text;
    EXPECT_GT(includes.size(), 50u);
    for (const auto& [name, text] : includes) {
        if (!name.ends_with(".h")) continue;
        const std::string include = "#include \"" + name + "\"\n";
        EXPECT_EQ(compiled({"#version 460\n#extension GL_GOOGLE_include_directive : require\n" + include +
                                fragment_main(kGlsl), kGlsl, true, EShLangFragment}, includes).errors, "") << name;
        EXPECT_EQ(compiled({"#define PETRICHOR_HLSL\n" + include + fragment_main(kHlsl), kHlsl, true,
                            EShLangFragment}, includes).errors, "") << name;
    }
}

// ---- what Microsoft's compilers refuse ---------------------------------------------------------

TEST(ShaderLibrary, HasNothingThatHlslCompilersRefuse)
{
    for (const std::string& one : objections_of(shader_library(kHlsl))) ADD_FAILURE() << one;

    // The headers as GLSL, where a splat by its name is told from a vector made of one number.
    Includes includes;
    std::string all = "#version 460\n#extension GL_GOOGLE_include_directive : require\n";
    for (const ShaderText& one : formula_headers()) {
        includes[one.name] = one.text;
        if (one.name.ends_with(".h")) all += "#include \"" + one.name + "\"\n";
    }
    std::string& bridge = includes["base/interop.h"];
    for (const auto& [splat, parts] : {std::pair{"vec2(x)\n", "vec2(x, x)\n"}, {"vec3(x)\n", "vec3(x, x, x)\n"},
                                       {"vec4(x)\n", "vec4(x, x, x, x)\n"}}) {
        const std::size_t at = bridge.find(splat);
        ASSERT_NE(at, std::string::npos) << splat;
        bridge.replace(at, std::strlen(splat), parts);
    }
    const Compiled result = compiled({all + fragment_main(kGlsl), kGlsl, true, EShLangFragment}, includes, true);
    EXPECT_EQ(result.errors, "");
    for (const std::string& one : result.objections) ADD_FAILURE() << one;
}

TEST(HlslLaw, FindsWhatItLooksFor)
{
    const auto of_text = [](const std::string& text) { return objections_of(text).size(); };
    EXPECT_EQ(of_text("float f(float x) { return x; }"), 0u);
    EXPECT_EQ(of_text("float f(float linear) { return linear; }"), 2u);
    EXPECT_EQ(of_text("float f(float a) { b.point = a; }"), 1u);
    EXPECT_EQ(of_text("// linear point\nfloat f(float a) { return a; }"), 0u);
    EXPECT_EQ(of_text("vec3 f() { return vec3(1.0f); }"), 1u);
    EXPECT_EQ(of_text("float3 f() { return float3(petrichor_kPi * 2.0f); }"), 1u);
    EXPECT_EQ(of_text("vec3 f() { return vec3(1.0f, 2.0f, 3.0f); }"), 0u);
    EXPECT_EQ(of_text("float f() { for (int i = 0; i < 3; ++i) {} for (int i = 0; i < 3; ++i) {} return 1.0f; }"), 0u);
    EXPECT_EQ(of_text("float f() { for (int i = 0; i < 3; ++i) {} int i = 3; return 1.0f; }"), 1u);

    const auto of_tree = [](const std::string& body) {
        const Compiled result = compiled({"#version 450\nlayout(location = 0) in vec4 a;\n"
                                          "layout(location = 0) out vec4 o;\nstruct S { vec2 v; float all[3]; };\n"
                                          "void main() { " + body + " }\n", kGlsl, true, EShLangFragment}, {}, true);
        EXPECT_EQ(result.errors, "");
        return result.objections.size();
    };
    EXPECT_EQ(of_tree("o = vec4(a.x, a.y, a.z, 1.0) + 2.0 * a;"), 0u);
    EXPECT_EQ(of_tree("ivec2 i = ivec2(a.xy); o = vec4(vec2(i), 1.0, 1.0);"), 0u);
    EXPECT_EQ(of_tree("S s; s.v = a.xy; s.all[1] = a.z; o = vec4(s.v, s.all[1], 1.0);"), 0u);
    EXPECT_EQ(of_tree("uint u = uint(a.x); o = a * float(u >> 3u);"), 0u);
    EXPECT_EQ(of_tree("uint u = uint(a.x); u ^= u >> 3; o = a * float(u);"), 1u);
    EXPECT_EQ(of_tree("o = vec4(a.x);"), 1u);
    EXPECT_EQ(of_tree("o = vec4(vec3(a), 1.0);"), 1u);
    EXPECT_EQ(of_tree("o = a.xy == a.zw ? a : -a;"), 1u);
    EXPECT_EQ(of_tree("float all[2] = float[2](a.x, a.y); o = a * all[int(a.z)];") > 0u, true);
    EXPECT_EQ(of_tree("mat2 m = mat2(a.x, a.y, a.z, a.w); o = vec4(m * a.xy, 1.0, 1.0);") > 0u, true);
}

TEST(FlattenedTexts, RefuseWhatTheyCannotRead)
{
    const auto flat = [](const std::string& text) {
        return flattened_texts(std::vector<ShaderText>{{"formulas/NAME.h", text, ""}}, {"formulas/NAME.h"}, kGlsl);
    };
    EXPECT_NE(flat("float f(float x)\n{\n    return x;\n}\n").find("float petrichor_f(float x)"), std::string::npos);
    for (const char* text : {"#if 1\n#endif\n", "#ifdef A\n", "#endif\n", "#pragma once\n", "#include \"b.h\"\n",
                             "#define TWICE(x) ((x) + (x))\n", "#define SWAPPED(x, y) pow(y, x)\n"}) {
        EXPECT_THROW(flat(text), Error) << text;
    }
}

TEST(FlattenedTexts, RenameWhatIsGlobalAndNothingElse)
{
    const std::string text =
        "#define SIDE 4  // of it\n"
        "SHARED_CONST float kHalf = 0.5f;\n"
        "struct Wave { float lean; float height; };\n"
        "SHARED_FN float height(Wave w, float lean)\n{\n"
        "    const float x = w.height * kHalf;\n    return x + lean + float(SIDE);\n}\n";
    const std::vector<ShaderText> texts{
        {"base/interop.h", "#define SHARED_FN\n#ifdef PETRICHOR_HLSL\n#define SHARED_CONST static const\n#else\n"
                           "#define SHARED_CONST const\n#endif\n", ""},
        {"formulas/NAME.h", "#include \"base/interop.h\"\n" + text, ""}};
    EXPECT_EQ(flattened_texts(texts, {"formulas/NAME.h"}, kHlsl),
              "\n// ---- formulas/NAME.h\n\n"
              "#define PETRICHOR_SIDE 4  // of it\n"
              "static const float petrichor_kHalf = 0.5f;\n"
              "struct petrichor_Wave { float lean; float height; };\n"
              "float petrichor_height(petrichor_Wave w, float lean)\n{\n"
              "    const float x = w.height * petrichor_kHalf;\n    return x + lean + float(PETRICHOR_SIDE);\n}\n");
    const std::string glsl = flattened_texts(texts, {"formulas/NAME.h"}, kGlsl);
    EXPECT_NE(glsl.find("\nconst float petrichor_kHalf"), std::string::npos);
    EXPECT_NE(glsl.find("\n    float x = w.height"), std::string::npos);
}

// ---- numbers -----------------------------------------------------------------------------------

// `before` and a main that writes `call`, made of kind, a, b and c.
std::string around(ShaderLanguage language, const std::string& before, const std::string& call)
{
    if (language == kHlsl) {
        return before +
               "[[vk::binding(0)]] Buffer<float4> numbers;\n"
               "[[vk::binding(1)]] RWStructuredBuffer<float4> results;\n"
               "[[vk::push_constant]] cbuffer Push { int kind; };\n"
               "[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID)\n{\n"
               "    const int i = int(id.x);\n    const float4 a = numbers[3 * i];\n"
               "    const float4 b = numbers[3 * i + 1];\n    const float4 c = numbers[3 * i + 2];\n"
               "    float4 r;\n    " + call + "\n    results[i] = r;\n}\n";
    }
    return "#version 460\n#extension GL_EXT_scalar_block_layout : require\n"
           "#extension GL_GOOGLE_include_directive : require\n" + before +
           "layout(local_size_x = 64) in;\nlayout(binding = 0) uniform samplerBuffer numbers;\n"
           "layout(binding = 1, scalar) writeonly buffer Results { vec4 results[]; };\n"
           "layout(push_constant, scalar) uniform Push { int kind; };\nvoid main()\n{\n"
           "    const int i = int(gl_GlobalInvocationID.x);\n    const vec4 a = texelFetch(numbers, 3 * i);\n"
           "    const vec4 b = texelFetch(numbers, 3 * i + 1);\n    const vec4 c = texelFetch(numbers, 3 * i + 2);\n"
           "    vec4 r;\n    " + call + "\n    results[i] = r;\n}\n";
}

class ShaderLibraryParity : public GpuTest, public testing::WithParamInterface<ShaderLanguage> {};

TEST_P(ShaderLibraryParity, GivesWhatTheCpuGives)
{
    const std::string text = flattened_texts(embedded_texts(), {"formulas/formula_probe.h"}, GetParam());
    Compiled probe = compiled({around(GetParam(), text, "r = petrichor_probe(kind, a, b, c);"), GetParam()});
    ASSERT_EQ(probe.errors, "");
    FormulaBench bench;
    bench.load("flattened_probe", std::move(probe.words));
    for (int kind = 0; kind < shared::kProbeKinds; ++kind) expect_as_on_cpu(kind, bench.run("flattened_probe", kind));
}

INSTANTIATE_TEST_SUITE_P(Languages, ShaderLibraryParity, testing::Values(kGlsl, kHlsl),
                         [](const auto& one) { return one.param == kHlsl ? "Hlsl" : "Glsl"; });

// ---- the page ----------------------------------------------------------------------------------

// Its examples, by the name in their first line.
Includes examples()
{
    std::ifstream in(std::string(PETRICHOR_SOURCE_DIR) + "/docs/shaders.md");
    const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    Includes found;
    for (const std::string fence : {"```glsl\n// ", "```hlsl\n// "}) {
        for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
            const std::size_t name = at + fence.size();
            const std::size_t line = page.find('\n', name);
            found[page.substr(name, line - name)] = page.substr(line, page.find("```", line) - line);
        }
    }
    return found;
}

struct Job {
    const char* glsl;
    const char* glsl_call;
    const char* hlsl;
    const char* hlsl_call;
};
constexpr Job kJobs[] = {
    {"wet_surface.glsl",
     "vec3 albedo, f0; wet_surface(a.xyz, step(0.7, a.w), b.x, b.y, 1.0 - 0.3 * b.z, b.w, c.x, c.y, c.z, albedo, f0, r.z, "
     "r.w); r.x = albedo.x + f0.y; r.y = albedo.z;",
     "WetSurface.hlsl",
     "float3 albedo, f0; WetSurface_float(a.xyz, step(0.7, a.w), b.x, b.y, 1.0 - 0.3 * b.z, b.w, c.x, c.y, c.z, albedo, "
     "f0, r.z, r.w); r.x = albedo.x + f0.y; r.y = albedo.z;"},
    {"puddle_normal.glsl", "r = vec4(puddle_normal(40.0 * a.xy, a.z, 10.0 * a.w, b.x), 0.0);", "puddle_normal.ush",
     "r = float4(PuddleNormal(float3(40.0 * a.x, 40.0 * a.y, b.y), a.z, 10.0 * a.w, b.x).xzy, 0.0);"},
    {"snow_cover.glsl",
     "vec3 albedo, f0; snow_on_surface(a.xyz, step(0.7, a.w), b.x, normalize(vec3(b.y, b.z, 0.2)), b.w, max(2.0 * c.x - 1.0, 0.0), c.y, c.z, "
     "albedo, f0, r.z, r.w); r.x = albedo.x + f0.y; r.y = albedo.z;",
     "SnowCover.hlsl",
     "float3 albedo, f0; SnowOnSurface_float(a.xyz, step(0.7, a.w), b.x, normalize(float3(b.y, b.z, 0.2)), b.w, max(2.0 * c.x - 1.0, 0.0), "
     "c.y, c.z, albedo, f0, r.z, r.w); r.x = albedo.x + f0.y; r.y = albedo.z;"},
};

Includes library_files()
{
    const std::string hlsl = shader_library(kHlsl);
    return {{"petrichor.glsl", shader_library(kGlsl)}, {"petrichor.hlsl", hlsl}, {"petrichor.ush", hlsl}};
}

class ShaderPage : public GpuTest {};

TEST_F(ShaderPage, ExamplesGiveTheSameInBothLanguages)
{
    const Includes texts = examples();
    EXPECT_EQ(texts.size(), 2 * std::size(kJobs)) << "an example of the page that is not run";
    const Includes files = library_files();
    FormulaBench bench;
    std::vector<std::vector<glm::vec4>> all;
    for (const Job& job : kJobs) {
        ASSERT_TRUE(texts.count(job.glsl)) << job.glsl;
        ASSERT_TRUE(texts.count(job.hlsl)) << job.hlsl;
        Compiled glsl = compiled({around(kGlsl, texts.at(job.glsl), job.glsl_call), kGlsl}, files);
        Compiled hlsl = compiled({around(kHlsl, texts.at(job.hlsl), job.hlsl_call), kHlsl}, files);
        ASSERT_EQ(glsl.errors, "") << job.glsl;
        ASSERT_EQ(hlsl.errors, "") << job.hlsl;
        bench.load(job.glsl, std::move(glsl.words));
        bench.load(job.hlsl, std::move(hlsl.words));
        const std::vector<glm::vec4> first = bench.run(job.glsl, 0);
        const std::vector<glm::vec4> second = bench.run(job.hlsl, 0);
        int different = 0;
        for (std::size_t i = 0; i < kBenchCases; ++i) {
            for (int c = 0; c < 4; ++c) {
                if (near_enough(second[i][c], first[i][c])) continue;
                if (++different <= 3) {
                    ADD_FAILURE() << job.glsl << " case " << i << " part " << c << ": GLSL " << first[i][c]
                                  << ", HLSL " << second[i][c];
                }
            }
        }
        EXPECT_EQ(different, 0) << job.glsl;
        all.push_back(first);
    }
    // And they do their work: water closes over some and not over all, rings lean, snow whitens what it covers.
    const auto count = [&all](std::size_t job, const auto& is) {
        return std::count_if(all[job].begin(), all[job].end(), is);
    };
    EXPECT_GT(count(0, [](const glm::vec4& r) { return r.w > 0.9f && r.z < 0.1f; }), kBenchCases / 20);
    EXPECT_GT(count(0, [](const glm::vec4& r) { return r.w < 0.1f; }), kBenchCases / 20);
    EXPECT_GT(count(1, [](const glm::vec4& r) { return r.y < 0.9999f; }), kBenchCases / 20);
    EXPECT_EQ(count(1, [](const glm::vec4& r) { return r.y < 0.5f; }), 0);
    EXPECT_GT(count(2, [](const glm::vec4& r) { return r.w > 0.9f && r.y > 0.8f; }), kBenchCases / 20);
    EXPECT_GT(count(2, [](const glm::vec4& r) { return r.w < 0.1f; }), kBenchCases / 20);
}

// ---- where others begin ------------------------------------------------------------------------

// Names of the members of a struct and of those that a function sets, in their order.
std::vector<std::string> members_of(const Tokens& tokens, const std::string& name)
{
    std::vector<std::string> members;
    bool inside = false;
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
        inside = inside || (tokens[i - 1].text == "struct" && tokens[i].text == name);
        if (inside && tokens[i].text == "}") break;
        if (inside && tokens[i].kind == Token::Word && tokens[i + 1].text == ";") members.push_back(tokens[i].text);
    }
    return members;
}
std::vector<std::string> set_by(const Tokens& tokens, const std::string& name)
{
    std::vector<std::string> members;
    bool inside = false;
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
        inside = inside || (tokens[i].text == name && tokens[i + 1].text == "(");
        if (inside && tokens[i].text == "}") break;
        if (inside && tokens[i - 1].text == "." && tokens[i + 1].text == "=") members.push_back(tokens[i].text);
    }
    return members;
}

TEST(FairWeather, SetsEveryMember)
{
    const Tokens tokens = tokens_of(shader_library(kGlsl));
    const std::pair<const char*, const char*> made[] = {{"petrichor_WeatherMoment", "petrichor_fair_weather"},
                                                        {"petrichor_WeatherLook", "petrichor_usual_look"},
                                                        {"petrichor_DryMaterial", "petrichor_plain_material"},
                                                        {"petrichor_SurfaceState", "petrichor_open_surface"}};
    for (const auto& [type, function] : made) {
        EXPECT_GT(members_of(tokens, type).size(), 4u);
        EXPECT_EQ(members_of(tokens, type), set_by(tokens, function)) << function;
    }
}

TEST(FairWeather, IsWhatMomentAndLookBeginWith)
{
    const shared::WeatherMoment fair = shared::fair_weather(), moment;
    const shared::WeatherLook usual = shared::usual_look(), look;
    EXPECT_EQ(std::memcmp(&fair, &moment, sizeof moment), 0);
    EXPECT_EQ(std::memcmp(&usual, &look, sizeof look), 0);
}

}  // namespace
}  // namespace petrichor::gpu
