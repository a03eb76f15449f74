#include "tests/gpu/hlsl_law.h"

#include <glslang/Public/ShaderLang.h>
#include <glslang/MachineIndependent/localintermediate.h>

#include <set>

#include "gpu/shader_library/tokens.h"

namespace petrichor::gpu {
namespace {

using Names = std::set<std::string>;

// Keywords and reserved words of HLSL (Microsoft: Keywords; Reserved Words), and those of GLSL ES 3.00 and GLSL 4.60
// that are no keywords here.
const Names& reserved_names()
{
    static const Names names{
        "AppendStructuredBuffer", "asm", "asm_fragment", "auto", "BlendState", "Buffer", "ByteAddressBuffer", "case",
        "catch", "cbuffer", "centroid", "char", "class", "column_major", "compile", "compile_fragment", "const_cast",
        "ConstantBuffer", "ConsumeStructuredBuffer", "ComputeShader", "decl", "default", "delete", "discard", "double",
        "DomainShader", "dword", "dynamic_cast", "enum", "explicit", "export", "extern", "friend", "fxgroup",
        "GeometryShader", "globallycoherent", "goto", "groupshared", "half", "HullShader", "in", "indices", "inline",
        "inout", "InputPatch", "interface", "line", "lineadj", "linear", "LineStream", "long", "matrix", "min10float",
        "min12int", "min16float", "min16int", "min16uint", "mutable", "namespace", "new", "nointerpolation",
        "noperspective", "NULL", "operator", "out", "OutputPatch", "packoffset", "pass", "pixelfragment", "PixelShader",
        "point", "PointStream", "precise", "private", "protected", "public", "RasterizerState", "register",
        "reinterpret_cast", "RenderTargetView", "row_major", "RWBuffer", "RWByteAddressBuffer", "RWStructuredBuffer",
        "RWTexture2D", "sample", "sampler", "sampler1D", "sampler2D", "sampler3D", "samplerCUBE", "sampler_state",
        "SamplerComparisonState", "SamplerState", "shared", "short", "signed", "sizeof", "snorm", "stateblock",
        "stateblock_state", "static_cast", "string", "StructuredBuffer", "tbuffer", "technique", "technique10",
        "technique11", "template", "texture", "Texture1D", "Texture2D", "Texture3D", "TextureCube", "this", "throw",
        "triangle", "triangleadj", "TriangleStream", "try", "typedef", "typename", "uniform", "union", "unorm",
        "unsigned", "using", "vector", "vertexfragment", "VertexShader", "vertices", "virtual", "volatile",
        // GLSL
        "active", "attribute", "buffer", "cast", "coherent", "common", "external", "filter", "fixed", "flat", "highp",
        "input", "invariant", "layout", "lowp", "mediump", "noinline", "output", "partition", "patch", "readonly",
        "resource", "restrict", "smooth", "subroutine", "superp", "varying", "writeonly"};
    return names;
}

// 0 of what is no constructor of a vector, else its size.
int vector_size(const std::string& name)
{
    static const Names bases{"vec", "ivec", "uvec", "bvec", "float", "int", "uint", "bool"};
    const char last = name.empty() ? ' ' : name.back();
    if (last < '2' || last > '4' || !bases.count(name.substr(0, name.size() - 1))) return 0;
    return last - '0';
}

bool is_type(const std::string& name)
{
    static const Names scalars{"float", "int", "uint", "bool"};
    return scalars.count(name) != 0 || vector_size(name) != 0;
}

// Whether the call at `at` has one argument, made of numbers and constants alone.
bool of_one_known_number(const Tokens& tokens, std::size_t at)
{
    int depth = 0;
    for (std::size_t i = at + 1; i < tokens.size(); ++i) {
        const std::string& text = tokens[i].text;
        if (text == "(") ++depth;
        if (text == ")" && --depth == 0) return true;
        if (text == "," && depth == 1) return false;
        const bool constant = text.find("kPi") != std::string::npos || text.starts_with("petrichor_k") ||
                              text.starts_with("PETRICHOR_");
        if (tokens[i].kind == Token::Word && !constant) return false;
    }
    return false;
}

void look_at_counters(const Tokens& tokens, std::vector<std::string>& objections)
{
    int depth = 0;
    Names counters, others;
    for (std::size_t i = 2; i < tokens.size(); ++i) {
        if (tokens[i].text == "{") ++depth;
        if (tokens[i].text == "}" && --depth == 0) {
            for (const std::string& name : counters) {
                if (others.count(name)) objections.push_back("declared by a for and once more: " + name);
            }
            counters.clear();
            others.clear();
        }
        if (depth == 0 || tokens[i].kind != Token::Word || !is_type(tokens[i - 1].text)) continue;
        (tokens[i - 2].text == "(" ? counters : others).insert(tokens[i].text);
    }
}

class Walk : public glslang::TIntermTraverser {
public:
    std::vector<std::string> objections;

    bool visitAggregate(glslang::TVisit, glslang::TIntermAggregate* node) override
    {
        const glslang::TOperator what = node->getOp();
        if (what == glslang::EOpConstructStruct) object(*node, "a struct is made by a constructor");
        const bool construct = what > glslang::EOpConstructGuardStart && what < glslang::EOpConstructGuardEnd;
        if (construct && node->isArray()) object(*node, "an array is made");
        if (construct && node->isVector() && node->getSequence().size() == 1) {
            const glslang::TIntermTyped* from = node->getSequence()[0]->getAsTyped();
            const int size = from->isVector() ? from->getVectorSize() : 1;
            if (size != node->getVectorSize()) object(*node, "a vector is made of one number or of a longer vector");
        }
        if (node->isMatrix()) object(*node, "a matrix");
        return true;
    }
    bool visitBinary(glslang::TVisit, glslang::TIntermBinary* node) override
    {
        const glslang::TOperator what = node->getOp();
        const bool compares = what == glslang::EOpEqual || what == glslang::EOpNotEqual ||
                              what == glslang::EOpVectorEqual || what == glslang::EOpVectorNotEqual;
        if (compares && !node->getLeft()->isScalar()) object(*node, "vectors or structs are compared as a whole");
        const bool shifts = what == glslang::EOpLeftShift || what == glslang::EOpRightShift ||
                            what == glslang::EOpLeftShiftAssign || what == glslang::EOpRightShiftAssign;
        if (shifts && node->getLeft()->getBasicType() != node->getRight()->getBasicType()) {
            object(*node, "a shift of one type by another");
        }
        return true;
    }
    void visitSymbol(glslang::TIntermSymbol* node) override
    {
        if (node->isMatrix()) object(*node, "a matrix");
        if (node->isArray() && node->getName().compare(0, 3, "gl_") != 0) object(*node, "an array that is no member");
    }

private:
    template <class Node>
    void object(const Node& node, const char* what)
    {
        const glslang::TSourceLoc& at = node.getLoc();
        objections.push_back(at.getStringNameOrNum() + ":" + std::to_string(at.line) + ": " + what);
    }
};

}  // namespace

std::vector<std::string> objections_of(const std::string& text)
{
    Tokens tokens;
    for (Token& one : tokens_of(text)) {
        if (one.kind != Token::Comment) tokens.push_back(std::move(one));
    }
    std::vector<std::string> objections;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].kind != Token::Word) continue;
        const std::string& name = tokens[i].text;
        if (reserved_names().count(name)) objections.push_back("a reserved name: " + name);
        const bool call = i + 1 < tokens.size() && tokens[i + 1].text == "(";
        if (call && vector_size(name) != 0 && of_one_known_number(tokens, i)) {
            objections.push_back("a vector is made of one number: " + name);
        }
    }
    look_at_counters(tokens, objections);
    return objections;
}

std::vector<std::string> objections_of(glslang::TIntermediate& tree)
{
    Walk walk;
    tree.getTreeRoot()->traverse(&walk);
    return walk.objections;
}

}  // namespace petrichor::gpu
