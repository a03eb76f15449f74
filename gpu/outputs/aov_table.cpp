#include "gpu/outputs/aov_table.h"

#include "base/error.h"
#include "gpu/outputs/aov_table_io.h"
#include "gpu/outputs/light_parts_io.h"

namespace petrichor::gpu {

namespace {

struct Counts {
    std::size_t count;
    std::size_t suffixes;
};
constexpr Counts kCounts[] = {
#define ROW(name, count, channels, unit, precision, meaning, value, background) \
    {count, sizeof(channels) - 1},
    AOV_TABLE(ROW)
#undef ROW
};
constexpr bool every_number_has_its_channel()
{
    for (const Counts& c : kCounts) {
        if (c.count != c.suffixes || c.count < 1 || c.count > 4) return false;
    }
    return true;
}
static_assert(every_number_has_its_channel());
static_assert(std::size(kCounts) <= 64, "the asked rows are two words of bits (aov_io.h)");

}  // namespace

const std::vector<AovInfo>& aov_table()
{
    static const std::vector<AovInfo> table{
#define ROW(name, count, channels, unit, precision, meaning, value, background) \
    {#name, channels, unit, AovPrecision::precision, meaning},
        AOV_TABLE(ROW)
#undef ROW
#define ROW(layer, name, meaning) {#name, "RGB", "cd/m2", AovPrecision::HALF, meaning},
        LIGHT_PARTS_TABLE(ROW)
#undef ROW
        {"reflection", "IA", "1", AovPrecision::FLOAT,
         "what is mirrored most: I number of the material, -1 nothing, -2 the sky, -3 a probe's "
         "surroundings; A share of its light that is mirrored"},
    };
    return table;
}

std::size_t gbuffer_aov_count()
{
    return std::size(kCounts);
}

std::size_t aov_row(const std::string& name)
{
    const auto& table = aov_table();
    std::string known;
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (table[i].name == name) return i;
        known += (known.empty() ? "" : ", ") + table[i].name;
    }
    throw Error("render: there is no output \"" + name + "\"; there are " + known,
                "Choose among these for --aov.");
}

}  // namespace petrichor::gpu
