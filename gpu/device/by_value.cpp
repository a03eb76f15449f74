#include "gpu/device/by_value.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace petrichor::gpu {

namespace {

// Instructions and the storage class of variables of functions, as the specification of SPIR-V numbers them.
constexpr std::uint32_t kLine = 8, kTypePointer = 32, kTypeFunction = 33, kFunction = 54, kParameter = 55,
                        kFunctionEnd = 56, kCall = 57, kVariable = 59, kLoad = 61, kStore = 62, kAccessChain = 65,
                        kInBoundsAccessChain = 66, kLabel = 248, kNoLine = 317;
constexpr std::uint32_t kOfFunction = 7;
constexpr std::size_t kHead = 5, kBound = 3;

using Words = std::vector<std::uint32_t>;

// One instruction: word 0 is its length and number.
struct Instruction {
    std::span<const std::uint32_t> words;

    std::uint32_t op() const { return words[0] & 0xffffu; }
    std::size_t size() const { return words.size(); }
    std::uint32_t operator[](std::size_t i) const { return words[i]; }
};

std::uint32_t head_of(std::size_t words, std::uint32_t op)
{
    return static_cast<std::uint32_t>(words) << 16 | op;
}

// The fewest words of what is looked into here.
std::size_t least_words(std::uint32_t op)
{
    switch (op) {
        case kFunction:
            return 5;
        case kTypePointer:
        case kLoad:
        case kCall:
        case kAccessChain:
        case kInBoundsAccessChain:
        case kVariable:
            return 4;
        case kTypeFunction:
        case kParameter:
        case kStore:
            return 3;
        default:
            return 1;
    }
}

std::optional<std::vector<Instruction>> instructions_of(std::span<const std::uint32_t> code)
{
    if (code.size() < kHead) return std::nullopt;
    std::vector<Instruction> all;
    for (std::size_t at = kHead; at < code.size();) {
        const std::size_t size = code[at] >> 16;
        if (size == 0 || size > code.size() - at || size < least_words(code[at] & 0xffffu)) return std::nullopt;
        all.push_back({code.subspan(at, size)});
        at += size;
    }
    return all;
}

struct Parameter {
    std::uint32_t type = 0;
    std::uint32_t id = 0;
    std::uint32_t pointee = 0;
    bool value = false;  // can be handed over as one
};

struct Function {
    std::uint32_t id = 0;
    std::uint32_t returns = 0;
    std::uint32_t type = 0;
    std::vector<Parameter> parameters;
    std::size_t first = 0, last = 0;  // instructions
};

class Module {
public:
    explicit Module(std::vector<Instruction> all) : all_(std::move(all))
    {
        std::unordered_map<std::uint32_t, std::uint32_t> pointees;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const Instruction& one = all_[i];
            if (one.op() == kTypePointer && one[2] == kOfFunction) pointees[one[1]] = one[3];
            if (one.op() == kTypeFunction) types_[{one.words.begin() + 2, one.words.end()}] = one[1];
            if (one.op() == kFunction) {
                number_[one[2]] = functions_.size();
                functions_.push_back({one[2], one[1], one[4], {}, i, i});
            }
            if (functions_.empty()) continue;
            if (one.op() == kParameter) {
                const auto found = pointees.find(one[1]);
                const bool pointer = found != pointees.end();
                functions_.back().parameters.push_back({one[1], one[2], pointer ? found->second : 0, pointer});
            }
            if (one.op() == kFunctionEnd) functions_.back().last = i;
        }
        // A function that hands a parameter on reads it only if the next one does.
        for (bool again = true; again;) {
            again = false;
            for (Function& function : functions_) again = keep_read(function) || again;
        }
    }

    Words written(std::span<const std::uint32_t> code)
    {
        Words out(code.begin(), code.begin() + kHead);
        bound_ = code[kBound];
        const Function* in = nullptr;
        Words variables, stores;
        bool stored = true;
        for (const Instruction& one : all_) {
            if (one.op() == kFunction) {
                if (!in) add_types(out);
                in = &functions_[number_.at(one[2])];
                variables.clear();
                stores.clear();
                add(out, one);
                out.back() = in->type;
                continue;
            }
            if (one.op() == kParameter && in) {
                add_parameter(*in, one, out, variables, stores);
                stored = stores.empty();
                continue;
            }
            const bool before = one.op() == kLabel || one.op() == kVariable || one.op() == kLine || one.op() == kNoLine;
            if (!stored && !before) {
                out.insert(out.end(), stores.begin(), stores.end());
                stored = true;
            }
            if (one.op() == kCall) {
                add_call(one, out);
            } else {
                add(out, one);
            }
            if (one.op() == kLabel && !stored) out.insert(out.end(), variables.begin(), variables.end());
        }
        out[kBound] = bound_;
        return out;
    }

private:
    const Parameter* parameter_of(std::uint32_t function, std::size_t i) const
    {
        const auto found = number_.find(function);
        if (found == number_.end()) return nullptr;
        const auto& parameters = functions_[found->second].parameters;
        return i < parameters.size() ? &parameters[i] : nullptr;
    }

    // Of its parameters those that are only read stay values; true when some is none any more.
    bool keep_read(Function& function) const
    {
        std::unordered_map<std::uint32_t, Parameter*> of;  // by what points into them
        for (Parameter& parameter : function.parameters) {
            if (parameter.value) of[parameter.id] = &parameter;
        }
        if (of.empty()) return false;
        bool lost = false;
        const auto is_more_than_read = [&](std::uint32_t id) {
            const auto found = of.find(id);
            if (found == of.end() || !found->second->value) return;
            found->second->value = false;
            lost = true;
        };
        for (std::size_t i = function.first + 1; i < function.last; ++i) {
            const Instruction& one = all_[i];
            std::size_t rest = 1;
            if (one.op() == kParameter) continue;
            if (one.op() == kLoad) rest = 4;
            if (one.op() == kAccessChain || one.op() == kInBoundsAccessChain) {
                if (const auto found = of.find(one[3]); found != of.end()) of[one[2]] = found->second;
                rest = 4;
            }
            if (one.op() == kCall) {
                for (std::size_t k = 4; k < one.size(); ++k) {
                    const Parameter* to = parameter_of(one[3], k - 4);
                    if (!to || !to->value) is_more_than_read(one[k]);
                }
                continue;
            }
            for (std::size_t k = rest; k < one.size(); ++k) is_more_than_read(one[k]);
        }
        return lost;
    }

    static void add(Words& out, const Instruction& one) { out.insert(out.end(), one.words.begin(), one.words.end()); }

    // Types that functions have now, behind all others.
    void add_types(Words& out)
    {
        for (Function& function : functions_) {
            Words key{function.returns};
            bool any = false;
            for (const Parameter& parameter : function.parameters) {
                any = any || parameter.value;
                key.push_back(parameter.value ? parameter.pointee : parameter.type);
            }
            if (!any) continue;
            const auto [type, is_new] = types_.try_emplace(key, bound_);
            function.type = type->second;
            if (!is_new) continue;
            ++bound_;
            out.push_back(head_of(key.size() + 2, kTypeFunction));
            out.push_back(type->second);
            out.insert(out.end(), key.begin(), key.end());
        }
    }

    // The value goes into a variable of the parameter's name, so that nothing else of the function changes.
    void add_parameter(const Function& function, const Instruction& one, Words& out, Words& variables, Words& stores)
    {
        const auto parameter = std::find_if(function.parameters.begin(), function.parameters.end(),
                                            [&](const Parameter& p) { return p.id == one[2]; });
        if (!parameter->value) {
            add(out, one);
            return;
        }
        const std::uint32_t value = bound_++;
        out.insert(out.end(), {head_of(3, kParameter), parameter->pointee, value});
        variables.insert(variables.end(), {head_of(4, kVariable), parameter->type, parameter->id, kOfFunction});
        stores.insert(stores.end(), {head_of(3, kStore), parameter->id, value});
    }

    void add_call(const Instruction& one, Words& out)
    {
        Words call(one.words.begin(), one.words.end());
        for (std::size_t k = 4; k < call.size(); ++k) {
            const Parameter* to = parameter_of(one[3], k - 4);
            if (!to || !to->value) continue;
            const std::uint32_t value = bound_++;
            out.insert(out.end(), {head_of(4, kLoad), to->pointee, value, call[k]});
            call[k] = value;
        }
        out.insert(out.end(), call.begin(), call.end());
    }

    std::vector<Instruction> all_;
    std::vector<Function> functions_;
    std::unordered_map<std::uint32_t, std::size_t> number_;
    std::map<Words, std::uint32_t> types_;  // of functions: what they return and take
    std::uint32_t bound_ = 0;
};

}  // namespace

std::vector<std::uint32_t> by_value(std::span<const std::uint32_t> code)
{
    auto all = instructions_of(code);
    if (!all) return {code.begin(), code.end()};
    return Module(std::move(*all)).written(code);
}

}  // namespace petrichor::gpu
