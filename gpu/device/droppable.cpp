#include "gpu/device/droppable.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <unordered_map>
#include <unordered_set>

namespace petrichor::gpu {

namespace {

// Instructions, as the specification of SPIR-V numbers them.
constexpr std::uint32_t kTypeInt = 21, kConstant = 43, kFunction = 54, kBitFieldUExtract = 203, kShuffle = 345;
constexpr std::size_t kHead = 5, kBound = 3;
constexpr std::uint32_t kSubgroup = 3;  // the scope
// So many bits no shader takes: it marks what was a shuffle.
constexpr std::uint32_t kMark = 0x70657472u;

using Words = std::vector<std::uint32_t>;
using Instruction = std::span<const std::uint32_t>;

std::uint32_t op(const Instruction& one)
{
    return one[0] & 0xffffu;
}

std::uint32_t head_of(std::size_t words, std::uint32_t number)
{
    return static_cast<std::uint32_t>(words) << 16 | number;
}

// False for what is no SPIR-V.
bool each(std::span<const std::uint32_t> code, const std::function<void(const Instruction&)>& see)
{
    if (code.size() < kHead) return false;
    for (std::size_t at = kHead; at < code.size();) {
        const std::size_t size = code[at] >> 16;
        if (size == 0 || size > code.size() - at) return false;
        see(code.subspan(at, size));
        at += size;
    }
    return true;
}

// Of a shader: unsigned words of 32 bits and constants of that type, by their value.
struct Numbers {
    std::unordered_set<std::uint32_t> words;
    std::unordered_map<std::uint32_t, std::uint32_t> value_of;

    void see(const Instruction& one)
    {
        if (op(one) == kTypeInt && one.size() == 4 && one[2] == 32 && one[3] == 0) words.insert(one[1]);
        if (op(one) == kConstant && one.size() == 4 && words.count(one[1]) != 0) value_of[one[2]] = one[3];
    }
    bool is(std::uint32_t id, std::uint32_t value) const
    {
        const auto found = value_of.find(id);
        return found != value_of.end() && found->second == value;
    }
};

bool is_shuffle(const Instruction& one, const Numbers& numbers)
{
    return op(one) == kShuffle && one.size() == 6 && numbers.words.count(one[1]) != 0 &&
           numbers.is(one[3], kSubgroup);
}

bool was_shuffle(const Instruction& one, const Numbers& numbers)
{
    return op(one) == kBitFieldUExtract && one.size() == 6 && numbers.is(one[5], kMark);
}

// The shader with `turned` in place of each instruction that `wanted` names; its constant of this value, as `constant`,
// is declared before the functions.
template <class Wanted, class Turned>
Words rewritten(std::span<const std::uint32_t> code, std::uint32_t constant, const Wanted& wanted, const Turned& turned)
{
    Numbers numbers;
    std::uint32_t type = 0;
    const bool holds = each(code, [&](const Instruction& one) {
        numbers.see(one);
        if (type == 0 && wanted(one, numbers)) type = one[1];
    });
    if (!holds || type == 0) return {code.begin(), code.end()};
    Words out(code.begin(), code.begin() + kHead);
    out.reserve(code.size() + 4);
    const std::uint32_t id = out[kBound]++;
    bool declared = false;
    each(code, [&](const Instruction& one) {
        if (op(one) == kFunction && !declared) {
            out.insert(out.end(), {head_of(4, kConstant), type, id, constant});
            declared = true;
        }
        if (wanted(one, numbers)) {
            turned(one, id, out);
        } else {
            out.insert(out.end(), one.begin(), one.end());
        }
    });
    return out;
}

}  // namespace

std::vector<std::uint32_t> with_droppable_shuffles(std::span<const std::uint32_t> code)
{
    return rewritten(code, kMark, is_shuffle, [](const Instruction& one, std::uint32_t mark, Words& out) {
        out.insert(out.end(), {head_of(6, kBitFieldUExtract), one[1], one[2], one[4], one[5], mark});
    });
}

std::vector<std::uint32_t> with_shuffles_again(std::span<const std::uint32_t> code)
{
    return rewritten(code, kSubgroup, was_shuffle, [](const Instruction& one, std::uint32_t scope, Words& out) {
        out.insert(out.end(), {head_of(6, kShuffle), one[1], one[2], scope, one[3], one[4]});
    });
}

}  // namespace petrichor::gpu
