// petrichor headers: what it writes is whole, and it says what it cannot do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "tests/support/program.h"

namespace petrichor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace testing_program;

std::set<std::string> files_in(const fs::path& folder)
{
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).generic_string();
        if (entry.is_regular_file() && name[0] != '.') files.insert(name);  // .stdout is the test's own
    }
    return files;
}

TEST(Headers, WriteEveryLanguageAndNameWhatTheyWrote)
{
    const Workplace place("headers");
    const Outcome outcome = run({"headers", "-o", "new/out"}, place);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("new/out/petrichor.hlsl"));
    const std::string glsl = read_file(place / "new/out/petrichor.glsl");
    const std::string hlsl = read_file(place / "new/out/petrichor.hlsl");
    EXPECT_THAT(glsl, HasSubstr("vec3 petrichor_wet_albedo(vec3 dry)"));
    EXPECT_THAT(hlsl, HasSubstr("float3 petrichor_wet_albedo(float3 dry)"));
    for (const std::string& text : {glsl, hlsl}) {
        EXPECT_THAT(text, Not(HasSubstr("#include"))) << "it must stand alone";
        EXPECT_TRUE(text.ends_with("\n#endif\n"));
    }

    // Each of the headers finds what it includes below the folder that goes into the include path.
    const fs::path root = place / "new/out/petrichor";
    const std::set<std::string> headers = files_in(root);
    EXPECT_GT(headers.size(), 50u);
    const std::regex include("#include \"([^\"]+)\"");
    for (const std::string& header : headers) {
        const std::string text = read_file(root / header);
        for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
            EXPECT_TRUE(headers.count((*i)[1].str())) << header << " includes " << (*i)[1];
        }
    }
}

TEST(Headers, WriteOnlyTheLanguageThatIsAsked)
{
    const Workplace place("headers_one");
    EXPECT_EQ(run({"headers", "--language", "hlsl", "-o", "."}, place).exit_code, 0);
    EXPECT_EQ(files_in(place.path()), std::set<std::string>{"petrichor.hlsl"});
    // What is there by the name is replaced, and the bytes are the same.
    const std::string first = read_file(place / "petrichor.hlsl");
    write_file(place / "petrichor.hlsl", "old");
    EXPECT_EQ(run({"headers", "--language", "hlsl", "glsl", "-o", "."}, place).exit_code, 0);
    EXPECT_EQ(read_file(place / "petrichor.hlsl"), first);
    EXPECT_EQ(files_in(place.path()), (std::set<std::string>{"petrichor.glsl", "petrichor.hlsl"}));
}

TEST(Headers, SayWhatIsWrong)
{
    const Workplace place("headers_wrong");
    write_file(place / "file", "mine");
    const std::pair<std::vector<std::string>, const char*> mistakes[] = {
        {{"headers"}, "no folder"},
        {{"headers", "-o", ""}, "no folder"},
        {{"headers", "-o", "file"}, "is no folder"},
        {{"headers", "-o", "file/below"}, "file"},
        {{"headers", "-o", "out", "--language", "metal"}, "metal"},
        {{"headers", "-o", "out", "--language"}, "--language"},
        {{"headers", "-o", "out", "more"}, "more"}};
    for (const auto& [arguments, message] : mistakes) {
        const Outcome outcome = run(arguments, place);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(outcome.err, HasSubstr(message));
        EXPECT_THAT(outcome.out, IsEmpty());
    }
    EXPECT_EQ(read_file(place / "file"), "mine");
    EXPECT_EQ(files_in(place.path()), std::set<std::string>{"file"});
}

}  // namespace
}  // namespace petrichor
