// The fuzzer's corpus in the normal build: every file alone, cut short, and with bytes changed, so
// that the target keeps working and what was once found stays found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/fuzz/read_bytes.h"
#include "weather/readers/formats.h"

namespace petrichor::weather {
namespace {

std::vector<std::filesystem::path> corpus()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_FUZZ_CORPUS))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

TEST(ReadersCorpus, HoldsEveryKindOfFile)
{
    std::set<std::string> kinds;
    for (const auto& file : corpus()) {
        try {
            kinds.insert(recognise_weather(bytes_of(file)).name);
        } catch (const Error&) {  // files that were found by the fuzzer need not be recognised
        }
    }
    for (const Reader* reader : weather_readers())
        EXPECT_TRUE(kinds.count(reader->name)) << reader->name;
}

TEST(ReadersCorpus, IsSmall)
{
    std::uintmax_t bytes = 0;
    for (const auto& file : corpus()) bytes += std::filesystem::file_size(file);
    EXPECT_LT(bytes, 64u * 1024u);
}

TEST(ReadersCorpus, EveryFileKeepsThePromises)
{
    for (const auto& file : corpus())
        EXPECT_NO_THROW(testing_fuzz::read_bytes(bytes_of(file))) << file;
}

TEST(ReadersCorpus, SoDoesEveryFileCutShort)
{
    for (const auto& file : corpus()) {
        const std::string whole = bytes_of(file);
        const std::size_t stride = std::max<std::size_t>(1, whole.size() / 61);
        for (std::size_t length = 0; length < whole.size(); length += stride) {
            EXPECT_NO_THROW(testing_fuzz::read_bytes(std::string_view(whole).substr(0, length)))
                << file << " to " << length;
        }
    }
}

TEST(ReadersCorpus, SoDoesEveryFileWithBytesChanged)
{
    constexpr char kBytes[] = {'9', '-', '.', ',', ' ', '\n', 'e', '\xff'};
    std::uint64_t random = 0x9E3779B97F4A7C15u;
    for (const auto& file : corpus()) {
        const std::string whole = bytes_of(file);
        if (whole.empty()) continue;
        for (int i = 0; i < 100; ++i) {
            std::string changed = whole;
            for (int n = 0; n < 3; ++n) {
                random = random * 6364136223846793005u + 1442695040888963407u;
                changed[(random >> 33) % changed.size()] = kBytes[(random >> 20) % sizeof kBytes];
            }
            EXPECT_NO_THROW(testing_fuzz::read_bytes(changed)) << file << " change " << i << ":\n"
                                                               << changed;
        }
    }
}

}  // namespace
}  // namespace petrichor::weather
