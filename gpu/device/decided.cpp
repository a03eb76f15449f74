#include "gpu/device/decided.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace petrichor::gpu {

namespace {

// Instructions and a decoration, as the specification of SPIR-V numbers them.
constexpr std::uint32_t kName = 5, kLine = 8, kTypeBool = 20, kTypeInt = 21, kTypeFloat = 22, kConstantTrue = 41, kConstantFalse = 42, kConstant = 43,
                        kConstantComposite = 44, kConstantNull = 46, kSpecTrue = 48, kSpecFalse = 49, kSpec = 50, kSpecComposite = 51,
                        kSpecOp = 52, kFunction = 54, kFunctionEnd = 56, kCall = 57, kStore = 62, kCopyMemory = 63, kExtract = 81,
                        kDecorate = 71, kDecorationGroup = 73, kGroupMemberDecorate = 75, kImageWrite = 99,
                        kControlBarrier = 224, kMemoryBarrier = 225, kAtomicStore = 228, kPhi = 245, kLoopMerge = 246,
                        kSelectionMerge = 247, kLabel = 248, kBranch = 249, kBranchConditional = 250, kSwitch = 251,
                        kUnreachable = 255, kNoLine = 317, kDecorateId = 332, kEntryPoint = 15, kTerminateInvocation = 4416,
                        kDemote = 5380, kDecorateString = 5632;
constexpr std::uint32_t kSpecId = 1;
constexpr std::size_t kHead = 5;

using Instruction = std::span<const std::uint32_t>;
using Words = std::vector<std::uint32_t>;

std::uint32_t op(const Instruction& one)
{
    return one[0] & 0xffffu;
}

void write(Words& out, std::uint32_t number, std::initializer_list<std::uint32_t> operands)
{
    out.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | number);
    out.insert(out.end(), operands);
}

void write(Words& out, const Instruction& one)
{
    out.insert(out.end(), one.begin(), one.end());
}

// Capabilities, entry points, how they run, names, decorations.
bool comes_before_types(std::uint32_t number)
{
    constexpr std::uint32_t kTypeVoid = 19, kMemberDecorate = 72, kModuleProcessed = 330, kExecutionModeId = 331, kMemberDecorateString = 5633;
    constexpr std::uint32_t kUndef = 1;
    return (number < kTypeVoid && number != kUndef) || number == kDecorate || number == kMemberDecorate || number == kModuleProcessed ||
           number == kExecutionModeId || number == kDecorateId || number == kDecorateString || number == kMemberDecorateString;
}

// Within a function: has it a result, which is its third word?
bool has_result(std::uint32_t number)
{
    switch (number) {
        case kLine:
        case kStore:
        case kCopyMemory:
        case kImageWrite:
        case kControlBarrier:
        case kMemoryBarrier:
        case kAtomicStore:
        case kLoopMerge:
        case kSelectionMerge:
        case kLabel:
        case kNoLine:
        case kTerminateInvocation:
        case kDemote:
        case 218:  // of geometry: vertices and primitives, with streams or without
        case 219:
        case 220:
        case 221:
        case kFunctionEnd:
            return false;
        default:
            return number < kBranch || number > kUnreachable;
    }
}

using Known = std::optional<std::uint32_t>;

// What an instruction makes of numbers of 32 bits and of truths, as far as they are known. It says by itself which operands are
// whole numbers; nothing is reckoned with those that are not.
Known value_of(std::uint32_t number, std::span<const Known> of)
{
    const auto both = [&](auto f) -> Known {
        if (of.size() != 2 || !of[0] || !of[1]) return std::nullopt;
        return static_cast<std::uint32_t>(f(*of[0], *of[1]));
    };
    const auto with_sign = [&](auto f) {
        return both([&](std::uint32_t a, std::uint32_t b) { return f(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)); });
    };
    const auto one_is = [&](std::uint32_t value) { return of.size() == 2 && (of[0] == Known(value) || of[1] == Known(value)); };
    switch (number) {
        case 126: return of.size() == 1 && of[0] ? Known(0u - *of[0]) : std::nullopt;
        case 128: return both([](auto a, auto b) { return a + b; });
        case 130: return both([](auto a, auto b) { return a - b; });
        case 132: return both([](auto a, auto b) { return a * b; });
        case 134: return of.size() == 2 && of[1] && *of[1] != 0 ? both([](auto a, auto b) { return a / b; }) : std::nullopt;
        case 164:
        case 170: return both([](auto a, auto b) { return a == b; });
        case 165:
        case 171: return both([](auto a, auto b) { return a != b; });
        case 166: return one_is(1) ? Known(1u) : both([](auto a, auto b) { return a | b; });
        case 167: return one_is(0) ? Known(0u) : both([](auto a, auto b) { return a & b; });
        case 168: return of.size() == 1 && of[0] ? Known(1u - *of[0]) : std::nullopt;
        case 169: return of.size() == 3 && of[0] ? (*of[0] != 0 ? of[1] : of[2]) : std::nullopt;
        case 172: return both([](auto a, auto b) { return a > b; });
        case 173: return with_sign([](auto a, auto b) { return a > b; });
        case 174: return both([](auto a, auto b) { return a >= b; });
        case 175: return with_sign([](auto a, auto b) { return a >= b; });
        case 176: return both([](auto a, auto b) { return a < b; });
        case 177: return with_sign([](auto a, auto b) { return a < b; });
        case 178: return both([](auto a, auto b) { return a <= b; });
        case 179: return with_sign([](auto a, auto b) { return a <= b; });
        case 194: return of.size() == 2 && of[1] && *of[1] < 32 ? both([](auto a, auto b) { return a >> b; }) : std::nullopt;
        case 196: return of.size() == 2 && of[1] && *of[1] < 32 ? both([](auto a, auto b) { return a << b; }) : std::nullopt;
        case 197: return both([](auto a, auto b) { return a | b; });
        case 198: return both([](auto a, auto b) { return a ^ b; });
        case 199: return both([](auto a, auto b) { return a & b; });
        case 200: return of.size() == 1 && of[0] ? Known(~*of[0]) : std::nullopt;
        default: return std::nullopt;
    }
}

// What is known of a shader's constants, and which types are counted with here.
class Values {
public:
    explicit Values(const std::vector<Specialization>& constants)
    {
        for (const Specialization& constant : constants) given_[constant.id] = constant.value;
    }

    void see_decoration(const Instruction& one)
    {
        if (one.size() == 4 && one[2] == kSpecId) spec_id_[one[1]] = one[3];
    }

    // A type or a constant, with no constant of specialization in it where that can be said.
    void see(const Instruction& one, Words& out)
    {
        const std::uint32_t number = op(one);
        if (number == kTypeBool && one.size() == 2) truths_.insert(one[1]);
        if ((number == kTypeInt || number == kTypeFloat) && one.size() > 2 && one[2] == 32) numbers_.insert(one[1]);
        if (one.size() < 3) return write(out, one);
        const std::uint32_t type = one[1], id = one[2];
        if (number == kConstantTrue || number == kConstantFalse) known_[id] = number == kConstantTrue;
        if (number == kConstant && one.size() == 4 && numbers_.count(type) != 0) known_[id] = one[3];
        if (number == kConstantNull && counts(type)) known_[id] = 0;
        if (number == kSpecTrue || number == kSpecFalse) return constant(type, id, given(id).value_or(number == kSpecTrue), out);
        if (number == kSpec && one.size() == 4) {
            const std::uint32_t value = given(id).value_or(one[3]);
            if (numbers_.count(type) != 0) known_[id] = value;
            return write(out, kConstant, {type, id, value});
        }
        if (number == kSpecOp && one.size() > 4 && counts(type)) {
            const Known value = one[3] == kExtract ? part_of(one.subspan(4)) : value_of(one[3], of(one.subspan(4)));
            if (value) return constant(type, id, *value, out);
        }
        if (number == kConstantComposite || number == kSpecComposite) parts_[id] = one.subspan(3);
        if (number == kSpecComposite && std::ranges::none_of(one.subspan(3), [&](std::uint32_t part) { return left_.count(part) != 0; })) {
            const std::size_t begun = out.size();
            write(out, one);
            out[begun] = one[0] - kSpecComposite + kConstantComposite;
            return;
        }
        if (number == kSpec || number == kSpecOp || number == kSpecComposite) left_.insert(id);
        write(out, one);
    }

    // An instruction of a function.
    void see_result(const Instruction& one)
    {
        if (one.size() < 4 || !counts(one[1]) || known_.count(one[2]) != 0) return;
        if (const Known value = value_of(op(one), of(one.subspan(3)))) known_[one[2]] = *value;
    }

    Known of(std::uint32_t id) const
    {
        const auto found = known_.find(id);
        return found == known_.end() ? Known() : Known(found->second);
    }
    bool all() const { return left_.empty(); }
    bool is_set(std::uint32_t id) const { return spec_id_.count(id) != 0 && left_.count(id) == 0; }

private:
    bool counts(std::uint32_t type) const { return truths_.count(type) != 0 || numbers_.count(type) != 0; }
    std::vector<Known> of(std::span<const std::uint32_t> ids) const
    {
        std::vector<Known> values;
        if (ids.size() > 3) return values;
        for (const std::uint32_t id : ids) values.push_back(of(id));
        return values;
    }
    Known part_of(std::span<const std::uint32_t> operands) const
    {
        const auto whole = parts_.find(operands[0]);
        return operands.size() == 2 && whole != parts_.end() && operands[1] < whole->second.size() ? of(whole->second[operands[1]]) : Known();
    }
    Known given(std::uint32_t id) const
    {
        const auto spec = spec_id_.find(id);
        if (spec == spec_id_.end()) return std::nullopt;
        const auto found = given_.find(spec->second);
        return found == given_.end() ? Known() : Known(found->second);
    }
    void constant(std::uint32_t type, std::uint32_t id, std::uint32_t value, Words& out)
    {
        if (numbers_.count(type) != 0) {
            known_[id] = value;
            return write(out, kConstant, {type, id, value});
        }
        known_[id] = value != 0;
        write(out, value != 0 ? kConstantTrue : kConstantFalse, {type, id});
    }

    std::unordered_map<std::uint32_t, std::uint32_t> given_, spec_id_, known_;
    std::unordered_set<std::uint32_t> truths_, numbers_, left_;
    std::unordered_map<std::uint32_t, std::span<const std::uint32_t>> parts_;
};

struct Block {
    std::size_t first = 0, last = 0;  // instructions: its label, what ends it
    std::uint32_t label = 0;
    std::vector<std::uint32_t> next;  // where it goes, as decided when it was looked at
    bool live = false;
    bool decided = false;  // it goes to one place, where it might have gone to others
};

// A function: instructions from its head to its end.
class Body {
public:
    explicit Body(std::vector<Instruction> all) : all_(std::move(all)) {}

    // Finds the blocks that are reached, and what they call. False for what is better left to passes.
    bool walk(Values& values)
    {
        if (!find_blocks()) return false;
        if (blocks_.empty()) return true;
        blocks_[0].live = true;
        std::vector<bool> seen(blocks_.size(), false);
        for (bool again = true; again;) {
            again = false;
            for (std::size_t b = 0; b < blocks_.size(); ++b) {
                if (!blocks_[b].live || seen[b]) continue;
                seen[b] = again = true;
                if (!look_at(b, values)) return false;
            }
        }
        for (const Block& block : blocks_) {
            if (!block.live) continue;
            for (const std::uint32_t to : block.next) edges_.insert({block.label, to});
        }
        return find_needed();
    }

    // The functions that live blocks call.
    std::vector<std::uint32_t> calls() const
    {
        std::vector<std::uint32_t> all;
        for (const Block& block : blocks_) {
            for (std::size_t i = block.first; block.live && i < block.last; ++i) {
                if (op(all_[i]) == kCall && all_[i].size() > 3) all.push_back(all_[i][3]);
            }
        }
        return all;
    }

    std::uint32_t id() const { return all_[0][2]; }

    // What is left of it. The results of what is not are added to `gone`.
    void write_live(Words& out, std::unordered_set<std::uint32_t>& gone) const
    {
        const std::size_t begun = blocks_.empty() ? all_.size() - 1 : blocks_[0].first;
        for (std::size_t i = 0; i < begun; ++i) write(out, all_[i]);
        for (const Block& block : blocks_) {
            if (block.live) {
                write_block(block, out);
                continue;
            }
            lose(block.first, block.last + 1, gone);
            const auto header = continues_.find(block.label);
            if (header != continues_.end()) {
                write(out, kLabel, {block.label});
                write(out, kBranch, {header->second});
            } else if (merges_.count(block.label) != 0) {
                write(out, kLabel, {block.label});
                write(out, kUnreachable, {});
            } else {
                gone.insert(block.label);
            }
        }
        write(out, all_.back());
    }
    void lose_all(std::unordered_set<std::uint32_t>& gone) const { lose(0, all_.size(), gone); }

private:
    bool find_blocks()
    {
        for (std::size_t i = 1; i + 1 < all_.size(); ++i) {
            const std::uint32_t number = op(all_[i]);
            const std::size_t size = all_[i].size();
            if ((number == kLabel && size != 2) || (number == kSelectionMerge && size != 3) || (number == kLoopMerge && size < 4) ||
                (number == kPhi && (size < 5 || size % 2 == 0)))
                return false;
            if (number == kLabel) {
                number_of_[all_[i][1]] = blocks_.size();
                blocks_.push_back({i, i, all_[i][1], {}, false, false});
            }
            if (!blocks_.empty()) blocks_.back().last = i;
            // Goes on to a merge without one of its own: it leaves a selection from within.
            const bool merge_before = op(all_[i - 1]) == kSelectionMerge || op(all_[i - 1]) == kLoopMerge;
            if (number == kBranchConditional && !merge_before && size >= 4) {
                left_within_.insert(all_[i][2]);
                left_within_.insert(all_[i][3]);
            }
        }
        return true;
    }

    bool look_at(std::size_t b, Values& values)
    {
        Block& block = blocks_[b];
        for (std::size_t i = block.first + 1; i < block.last; ++i) values.see_result(all_[i]);
        const Instruction& end = all_[block.last];
        if (op(end) == kBranch && end.size() == 2) block.next = {end[1]};
        if (op(end) == kBranchConditional) {
            if (end.size() < 4) return false;
            block.next = {end[2], end[3]};
            if (const Known value = values.of(end[1]); value && may_go(b)) block.next = {*value != 0 ? end[2] : end[3]};
            block.decided = block.next.size() == 1;
        }
        if (op(end) == kSwitch) {
            if (end.size() < 3 || end.size() % 2 != 1) return false;
            const Known value = values.of(end[1]);
            block.next = {end[2]};
            for (std::size_t i = 3; i < end.size(); i += 2) {
                if (!value) block.next.push_back(end[i + 1]);
                if (value && *value == end[i]) block.next = {end[i + 1]};
            }
            block.decided = value.has_value();
        }
        for (const std::uint32_t to : block.next) {
            const auto found = number_of_.find(to);
            if (found == number_of_.end()) return false;
            blocks_[found->second].live = true;
        }
        return true;
    }

    // Can the branch at the end of a block be one to a single place?
    bool may_go(std::size_t b) const
    {
        const Block& block = blocks_[b];
        const Instruction& end = all_[block.last];
        for (std::size_t i = 2; i < 4; ++i) {  // a loop keeps its way back
            const auto to = number_of_.find(end[i]);
            if (to == number_of_.end() || to->second <= b) return false;
        }
        const Instruction& before = all_[block.last - 1];
        return op(before) != kSelectionMerge || left_within_.count(before[1]) == 0;
    }

    // Blocks that nothing reaches but that live ones name as where they meet or go on.
    bool find_needed()
    {
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const Block& block = blocks_[b];
            if (!block.live || block.last == block.first) continue;
            const Instruction& before = all_[block.last - 1];
            if (op(before) == kSelectionMerge && !(block.decided && op(all_[block.last]) == kBranchConditional)) merges_.insert(before[1]);
            if (op(before) != kLoopMerge) continue;
            merges_.insert(before[1]);
            const auto way_on = number_of_.find(before[2]);
            if (way_on == number_of_.end()) return false;
            bool returns = false, enters = false;
            for (const Block& from : blocks_) {
                if (edges_.count({from.label, block.label}) == 0) continue;
                (number_of_.at(from.label) >= b ? returns : enters) = true;
            }
            const bool goes_on = blocks_[way_on->second].live;
            if (returns != goes_on || !enters) return false;
            if (!goes_on) {
                if (!continues_.emplace(before[2], block.label).second) return false;
                ends_at_once_.insert(block.label);
            }
        }
        return true;
    }

    void write_block(const Block& block, Words& out) const
    {
        for (std::size_t i = block.first; i < block.last; ++i) {
            const std::uint32_t number = op(all_[i]);
            if (number == kPhi)
                write_phi(block, all_[i], out);
            else if (number != kSelectionMerge || !block.decided || op(all_[block.last]) == kSwitch)
                write(out, all_[i]);
        }
        const Instruction& end = all_[block.last];
        if (!block.decided)
            write(out, end);
        else if (op(end) == kSwitch)  // what leaves it from within needs it
            write(out, kSwitch, {end[1], block.next[0]});
        else
            write(out, kBranch, {block.next[0]});
    }

    void write_phi(const Block& block, const Instruction& one, Words& out) const
    {
        const std::size_t begun = out.size();
        write(out, one.first(3));
        for (std::size_t i = 3; i + 1 < one.size(); i += 2) {
            if (edges_.count({one[i + 1], block.label}) != 0) out.insert(out.end(), {one[i], one[i + 1]});
        }
        if (ends_at_once_.count(block.label) != 0) {  // the way back is never taken: any value will do
            const std::uint32_t value = out.size() > begun + 3 ? out[begun + 3] : one[3];
            for (const auto& [way_on, header] : continues_) {
                if (header == block.label) out.insert(out.end(), {value, way_on});
            }
        }
        out[begun] = static_cast<std::uint32_t>(out.size() - begun) << 16 | kPhi;
    }

    void lose(std::size_t first, std::size_t last, std::unordered_set<std::uint32_t>& gone) const
    {
        for (std::size_t i = first; i < last; ++i) {
            if (op(all_[i]) == kLabel && first == 0) gone.insert(all_[i][1]);
            if (all_[i].size() > 2 && has_result(op(all_[i]))) gone.insert(all_[i][2]);
        }
    }

    std::vector<Instruction> all_;
    std::vector<Block> blocks_;
    std::unordered_map<std::uint32_t, std::size_t> number_of_;  // of a block, by its label
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges_;   // from, to: between live blocks
    std::unordered_set<std::uint32_t> left_within_, merges_, ends_at_once_;
    std::unordered_map<std::uint32_t, std::uint32_t> continues_;  // dead ones: the loop's head
};

// The words if the shader has the form that is looked for.
std::optional<Words> cut(std::span<const std::uint32_t> code, Values& values)
{
    if (code.size() < kHead) return std::nullopt;
    std::vector<Instruction> notes;  // before types and constants: capabilities, entry points, names, decorations
    Words constants;
    std::vector<Body> bodies;
    std::vector<Instruction> body;
    std::vector<std::uint32_t> called;
    for (std::size_t at = kHead; at < code.size();) {
        const std::size_t size = code[at] >> 16;
        if (size == 0 || size > code.size() - at) return std::nullopt;
        const Instruction one = code.subspan(at, size);
        const std::uint32_t number = op(one);
        at += size;
        if (number >= kDecorationGroup && number <= kGroupMemberDecorate) return std::nullopt;
        if (number == kEntryPoint && size > 2) called.push_back(one[2]);
        if (number == kDecorate) values.see_decoration(one);
        if (number == kFunction && size < 5) return std::nullopt;
        if (body.empty() && (number == kLine || number == kNoLine)) continue;
        if (number == kFunction || !body.empty()) {
            body.push_back(one);
            if (number == kFunctionEnd) bodies.emplace_back(std::exchange(body, {}));
        } else if (comes_before_types(number)) {
            notes.push_back(one);
        } else {
            values.see(one, constants);
        }
    }
    if (!body.empty()) return std::nullopt;

    std::unordered_map<std::uint32_t, std::size_t> by_id;
    for (std::size_t i = 0; i < bodies.size(); ++i) by_id[bodies[i].id()] = i;
    std::vector<bool> wanted(bodies.size(), false);
    while (!called.empty()) {
        const auto found = by_id.find(called.back());
        called.pop_back();
        if (found == by_id.end()) return std::nullopt;
        if (wanted[found->second]) continue;
        wanted[found->second] = true;
        if (!bodies[found->second].walk(values)) return std::nullopt;
        for (const std::uint32_t id : bodies[found->second].calls()) called.push_back(id);
    }

    Words functions;
    std::unordered_set<std::uint32_t> gone;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (wanted[i])
            bodies[i].write_live(functions, gone);
        else
            bodies[i].lose_all(gone);
    }
    Words out(code.begin(), code.begin() + kHead);
    for (const Instruction& note : notes) {
        const std::uint32_t number = op(note);
        const bool of_one = number == kName || number == kDecorate || number == kDecorateId || number == kDecorateString;
        if (of_one && note.size() > 2) {
            if (gone.count(note[1]) != 0) continue;
            if (number == kDecorate && note[2] == kSpecId && values.is_set(note[1])) continue;
        }
        write(out, note);
    }
    out.insert(out.end(), constants.begin(), constants.end());
    out.insert(out.end(), functions.begin(), functions.end());
    return out;
}

}  // namespace

Decided with_constants(std::span<const std::uint32_t> code, const std::vector<Specialization>& constants)
{
    Values values(constants);
    std::optional<Words> words = cut(code, values);
    if (!words) return {{code.begin(), code.end()}, false};
    return {std::move(*words), values.all()};
}

}  // namespace petrichor::gpu
