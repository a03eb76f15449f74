#include "film/scenario/shape_keys.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "formulas/geometry/shapes.h"
#include "scene/shapes.h"

namespace petrichor::film {
namespace {

struct ShapeRule {
    ScenarioKey key;
    std::vector<int> kinds;  // that have it; empty: all
    void (*apply)(ScenarioShape&, const TomlValue&);
};

std::vector<std::string> kind_names()
{
    std::vector<std::string> names;
    for (const scene::ShapeKind& kind : scene::shape_kinds()) names.push_back(kind.name);
    return names;
}

const std::vector<ShapeRule>& shape_rules()
{
    static const std::vector<ShapeRule> rules{
        {{"shapes", "kind", "\"menger\"",
          "mandelbulb, sierpinski (a tetrahedron of tetrahedra), menger (a sponge), sphere, box or torus"},
         {},
         [](ScenarioShape& s, const TomlValue& v) { s.kind = v.choice(kind_names()); }},
        {{"shapes", "material", "\"stone\"",
          "a material of the scene, or one that [materials.\"stone\"] describes; opaque; without it the name of "
          "the table. A texture lies over it a repeat a metre, from its six sides"},
         {},
         [](ScenarioShape& s, const TomlValue& v) { s.material = v.text(); }},
        {{"shapes", "center_m", "[0.0, 1.0, 0.0]", "its middle: x, y (up), z", true},
         {},
         [](ScenarioShape& s, const TomlValue& v) { s.center_m = v.keyed_numbers(3, -1e6, 1e6); }},
        {{"shapes", "size_m", "2.0",
          "edge of a sponge, tetrahedron or box, width of a sphere or torus, of a mandelbulb that of the unit "
          "sphere; 0.001 to 10000",
          true},
         {},
         [](ScenarioShape& s, const TomlValue& v) { s.size_m = v.keyed(0.001, 10000.0); }},
        {{"shapes", "turn_degrees", "[0.0, 0.0, 0.0]",
          "about x, then y, then z of the world, counter-clockwise seen from their tips; -36000 to 36000 each", true},
         {},
         [](ScenarioShape& s, const TomlValue& v) { s.turn_degrees = v.keyed_numbers(3, -36000.0, 36000.0); }},
        {{"shapes", "iterations", "5",
          "levels: of a mandelbulb 1 to 16 (8), of a sierpinski 1 to 16 (8), of a menger 1 to 10 (5); levels finer "
          "than a pixel are left out"},
         {SHAPE_MANDELBULB, SHAPE_SIERPINSKI, SHAPE_MENGER},
         [](ScenarioShape& s, const TomlValue& v) { s.iterations = v.integer(1, 16); }},
        {{"shapes", "power", "8.0",
          "of a mandelbulb, 2 to 12; between whole numbers it has a seam along -x, where angles begin again", true},
         {SHAPE_MANDELBULB},
         [](ScenarioShape& s, const TomlValue& v) { s.power = v.keyed(2.0, 12.0); }},
        {{"shapes", "sides", "[1.0, 1.0, 1.0]", "of a box: its edges, as shares of size_m; 0.001 to 1000 each"},
         {SHAPE_BOX},
         [](ScenarioShape& s, const TomlValue& v) {
             const auto n = v.numbers(3, 0.001, 1000.0);
             s.sides = {n[0], n[1], n[2]};
         }},
        {{"shapes", "tube", "0.25", "of a torus: how wide its tube is, as a share of size_m; 0.001 to 0.5"},
         {SHAPE_TORUS},
         [](ScenarioShape& s, const TomlValue& v) { s.tube = v.number(0.001, 0.5); }},
    };
    return rules;
}

}  // namespace

std::vector<ScenarioKey> shape_keys()
{
    std::vector<ScenarioKey> keys;
    for (const ShapeRule& rule : shape_rules()) keys.push_back(rule.key);
    return keys;
}

bool has_key(int kind, const std::string& key)
{
    for (const ShapeRule& rule : shape_rules()) {
        if (rule.key.name == key)
            return rule.kinds.empty() || std::find(rule.kinds.begin(), rule.kinds.end(), kind) != rule.kinds.end();
    }
    return false;
}

std::vector<ScenarioShape> read_shapes(const toml::table& shapes, const std::string& file)
{
    std::vector<std::string> known;
    for (const ShapeRule& rule : shape_rules()) known.push_back(rule.key.name);
    std::vector<std::pair<std::uint32_t, ScenarioShape>> found;
    for (const auto& [name, node] : shapes) {
        const TomlValue value(node, file, "[shapes.\"" + std::string(name.str()) + "\"]");
        ScenarioShape one;
        one.name = one.material = std::string(name.str());
        one.place = value.place();
        for (const auto& [key, entry] : value.entries(known)) {
            one.given.push_back(key);
            for (const ShapeRule& rule : shape_rules()) {
                if (rule.key.name == key) rule.apply(one, entry);
            }
        }
        found.emplace_back(node.source().begin.line, std::move(one));
    }
    // toml++ sorts by name; the file's order is what the user sees.
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<ScenarioShape> out;
    for (auto& [line, one] : found) out.push_back(std::move(one));
    return out;
}

}  // namespace petrichor::film
