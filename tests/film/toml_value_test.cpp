#include "film/toml/toml_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

std::string repeated(const std::string& piece, int times)
{
    std::string text;
    for (int i = 0; i < times; ++i) text += piece;
    return text;
}

std::string problem_of(const std::string& text)
{
    try {
        parse_toml(text, "x.toml");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// Each of these ran the parser, or the destructor of what it made, out of stack.
TEST(Toml, DepthIsBoundedBeforeTheParser)
{
    constexpr int kMany = 40000;
    EXPECT_THAT(problem_of("\n\na" + repeated(".a", kMany) + " = 1"),
                HasSubstr("x.toml:3: a key of more parts than 64"));
    EXPECT_THAT(problem_of("[a" + repeated(".a", kMany) + "]"), HasSubstr("more parts than 64"));
    EXPECT_THAT(problem_of("'a'" + repeated(".\"a\"", kMany) + " = 1"),
                HasSubstr("more parts than 64"));
    EXPECT_THAT(problem_of("a = " + repeated("[", kMany)), HasSubstr("nested deeper than 64"));
    EXPECT_THAT(problem_of("a = " + repeated("{a = ", kMany)), HasSubstr("nested deeper than 64"));
    EXPECT_THAT(problem_of("a = \"\"\"" + repeated("x", 9 << 20) + "\"\"\""),
                HasSubstr("at most 8388608 are read"));
}

// What looks deep and is not: strings, comments, numbers, many keys after each other.
TEST(Toml, PlainFilesAreNotTakenForDeepOnes)
{
    const std::string dots = repeated(".", 200), open = repeated("[{", 200);
    for (const std::string& text :
         {"a = \"" + dots + open + "\\\"" + open + "\"", "a = '" + open + "'",
          "a = \"\"\"" + open + "\n\"\" " + open + "\"\"\"\"\"", "a = '''\n" + open + "'''''",
          "# " + open + dots + "\na = 1 # " + open, "a = [" + repeated("1.5, ", 500) + "]",
          "a = [" + repeated("[0, 1.25], ", 500) + "]", "a" + repeated(".a", 63) + " = 1",
          repeated("[[t]]\nx = { y = 1.5 }\n", 300), "\"" + dots + "\" = 1"}) {
        EXPECT_EQ(problem_of(text), "") << text.substr(0, 60);
    }
}

TEST(Toml, QuotedTextComesBack)
{
    for (const std::string& text :
         {std::string("plain"), std::string("we\"ird\\.glb"), std::string("a\nb\tc\x1b[2J\x7f"),
          std::string("水 ü"), std::string(), std::string("'''\"\"\"")}) {
        const toml::table table = parse_toml("x = " + toml_quoted(text), "x.toml");
        EXPECT_EQ(table["x"].value<std::string>(), text);
    }
    EXPECT_THROW(toml_quoted("b\xff"), Error);
}

}  // namespace
}  // namespace petrichor::film
