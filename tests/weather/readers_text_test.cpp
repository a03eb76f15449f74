#include "weather/readers/text.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

namespace petrichor::weather {
namespace {

// Same numbers on every run; good enough to shuffle digits.
struct Dice {
    std::uint64_t state = 1;
    unsigned below(unsigned n)
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<unsigned>(state >> 33) % n;
    }
};

std::uint64_t bits_by_from_chars(const std::string& text)
{
    double value = 0.0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_EQ(end, text.data() + text.size()) << text;
    EXPECT_EQ(failed, std::errc{}) << text;
    return std::bit_cast<std::uint64_t>(value);
}

TEST(Numbers, ShortDecimalsHaveTheBitsOfTheStandardLibrary)
{
    Dice dice;
    for (int i = 0; i < 200000; ++i) {
        std::string text(dice.below(2), '-');
        const unsigned whole = 1 + dice.below(10), fraction = dice.below(11);
        for (unsigned k = 0; k < whole; ++k) text += static_cast<char>('0' + dice.below(10));
        if (fraction) text += '.';
        for (unsigned k = 0; k < fraction; ++k) text += static_cast<char>('0' + dice.below(10));
        const auto number = to_number(text);
        ASSERT_TRUE(number) << text;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(*number), bits_by_from_chars(text)) << text;
    }
}

TEST(Numbers, EdgesOfTheShortForm)
{
    for (const char* text :
         {"0", "-0", "-0.0", "999999999999999", "9999999999999999", "99999999999999999999",
          "0.00000000000001", "0.000000000000001", "1e3", "-1.5E-3", "5.", ".5", "-.5"}) {
        const auto number = to_number(text);
        ASSERT_TRUE(number) << text;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(*number), bits_by_from_chars(text)) << text;
    }
    EXPECT_EQ(to_number(" +12.5\t"), 12.5);
    for (const char* text : {"", " ", "-", "+", ".", "-.", "1.2.3", "1-2", "--1", "1,5", "12x",
                             "0x10", "nan", "inf", "1e999", "1 2"}) {
        EXPECT_FALSE(to_number(text)) << text;
    }
}

std::vector<std::string> lines_of(std::string_view text)
{
    std::vector<std::string> out;
    Lines lines(text);
    while (const auto line = lines.next()) {
        out.emplace_back(*line);
        EXPECT_EQ(lines.number(), out.size());
    }
    return out;
}

TEST(LinesOfText, EveryEndOfLine)
{
    using Expected = std::vector<std::string>;
    EXPECT_EQ(lines_of(""), Expected{});
    EXPECT_EQ(lines_of("a"), Expected{"a"});
    EXPECT_EQ(lines_of("a\nb\n"), (Expected{"a", "b"}));
    EXPECT_EQ(lines_of("a\r\nb\r\n"), (Expected{"a", "b"}));
    EXPECT_EQ(lines_of("a\rb\rc"), (Expected{"a", "b", "c"}));
    EXPECT_EQ(lines_of("a\r\r\nb\n\nc\r"), (Expected{"a", "", "b", "", "c"}));
    EXPECT_EQ(lines_of("\n\r"), (Expected{"", ""}));
}

TEST(Fields, SeparatorsQuotesAndBlanks)
{
    using Expected = std::vector<std::string_view>;
    EXPECT_EQ(split("", ','), Expected{""});
    EXPECT_EQ(split("a,,b,", ','), (Expected{"a", "", "b", ""}));
    EXPECT_EQ(split(" a ;\tb\r", ';'), (Expected{"a", "b"}));
    EXPECT_EQ(split("\"a,b\",\" c \",d\"e,f\"", ','), (Expected{"a,b", "c", "d\"e,f\""}));
    EXPECT_EQ(split("a,b,c", ',', 2), (Expected{"a", "b"}));
    std::vector<std::string_view> fields{"left", "over"};
    split("x", ',', fields);
    EXPECT_EQ(fields, Expected{"x"});
    words("  p  q\t", fields);
    EXPECT_EQ(fields, (Expected{"p", "q"}));
}

}  // namespace
}  // namespace petrichor::weather
