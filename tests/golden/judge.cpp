#include "tests/golden/judge.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "base/error.h"

namespace petrichor::golden {
namespace {

namespace fs = std::filesystem;

enum class Mode { Compare, Exact, Accept };

Mode mode()
{
    const char* set = std::getenv("PETRICHOR_GOLDEN");
    const std::string word = set ? set : "";
    if (word.empty()) return Mode::Compare;
    if (word == "exact") return Mode::Exact;
    if (word == "accept") return Mode::Accept;
    throw Error("PETRICHOR_GOLDEN is \"" + word + "\"; it may be accept, exact or unset",
                "Use tests/golden/accept to accept pictures.");
}

fs::path left_behind(const std::string& name)
{
    return fs::path(PETRICHOR_GOLDEN_OUTPUT) / name;
}

void leave_pictures(const std::string& name, const Picture& actual)
{
    const fs::path folder = left_behind(name);
    fs::create_directories(folder);
    write_picture(folder / "actual.exr", actual);
    write_pngs(folder, "actual", actual);
}

// What all cases of this run came to, printed at its end.
class Totals : public testing::Environment {
public:
    void add(const std::string& name, const Comparison& comparison)
    {
        ++cases_;
        if (comparison.equal()) return;
        ++differ_;
        if (largest_name_.empty() || comparison.largest > largest_) {
            largest_ = comparison.largest;
            largest_name_ = name;
        }
    }
    void TearDown() override
    {
        if (cases_ == 0) return;
        std::printf("golden: %d of %d pictures differ", differ_, cases_);
        if (differ_ > 0) {
            std::printf("; the largest difference is %.3g, in %s", static_cast<double>(largest_),
                        largest_name_.c_str());
        }
        std::printf("\n");
    }

private:
    int cases_ = 0;
    int differ_ = 0;
    float largest_ = 0.0f;
    std::string largest_name_;
};

Totals* const totals =
    static_cast<Totals*>(testing::AddGlobalTestEnvironment(new Totals));  // gtest deletes it

}  // namespace

fs::path accepted_file(const std::string& name)
{
    return fs::path(PETRICHOR_GOLDEN_ACCEPTED) / (name + ".exr");
}

const std::vector<std::string>& demo_names()
{
    static const std::vector<std::string> names{"demo_rain", "demo_snow"};
    return names;
}

void judge(const std::string& name, const Picture& actual, const Tolerance& stated)
{
    const fs::path file = accepted_file(name);
    const std::string accept = "tests/golden/accept " + name;
    if (mode() == Mode::Accept) {
        leave_pictures(name, actual);
        if (fs::exists(file) && compare(actual, read_picture(file), kExact).equal()) {
            std::printf("golden %s: kept, nothing differs\n", name.c_str());
            return;
        }
        write_picture(file, actual);
        std::printf("golden %s: accepted; look at %s\n", name.c_str(),
                    (left_behind(name) / "actual.png").c_str());
        return;
    }
    if (!fs::exists(file)) {
        leave_pictures(name, actual);
        FAIL() << "golden " << name << ": there is no " << file << "\n  Look at "
               << left_behind(name) / "actual.png"
               << "; to accept it: " << accept;
    }
    const Tolerance tolerance = mode() == Mode::Exact ? kExact : stated;
    const Picture expected = read_picture(file);
    const Comparison comparison = compare(actual, expected, tolerance);
    totals->add(name, comparison);
    std::printf("golden %s: %s\n", name.c_str(), summary(comparison).c_str());
    if (passes(comparison, tolerance)) return;
    leave_pictures(name, actual);
    const fs::path folder = left_behind(name);
    write_pngs(folder, "expected", expected);
    if (comparison.mismatch.empty()) {
        write_picture(folder / "diff.exr", comparison.relative);
        write_difference_png(folder / "diff.png", comparison, tolerance);
    }
    ADD_FAILURE() << "golden " << name << ": " << summary(comparison) << "\n  Look at "
                  << (folder / "actual.png").string() << ", expected.png and diff.png beside it."
                  << "\n  To accept the new picture: " << accept;
}

}  // namespace petrichor::golden
