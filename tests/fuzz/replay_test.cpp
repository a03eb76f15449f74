// A fuzzer's corpus in the normal build: every file whole, cut short and with bytes changed goes
// through the fuzzer's own function, which lets nothing but Error pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace petrichor {
namespace {

void read(const std::string& bytes)
{
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::vector<std::string> corpus()
{
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(PETRICHOR_FUZZ_CORPUS))
        files.push_back(read_file(entry.path(), "corpus", 1 << 20));
    std::sort(files.begin(), files.end());
    return files;
}

TEST(PETRICHOR_FUZZ_SUITE, IsThereAndSmall)
{
    std::size_t bytes = 0;
    for (const std::string& file : corpus()) bytes += file.size();
    EXPECT_GT(bytes, 500u);
    EXPECT_LT(bytes, 256u * 1024u);
}

TEST(PETRICHOR_FUZZ_SUITE, EveryFileIsAnswered)
{
    std::uint64_t random = 0x9E3779B97F4A7C15u;
    for (const std::string& file : corpus()) {
        EXPECT_NO_THROW(read(file));
        for (int i = 1; i < 8; ++i)
            EXPECT_NO_THROW(read(file.substr(0, file.size() * static_cast<std::size_t>(i) / 8)));
        for (int i = 0; i < 8 && !file.empty(); ++i) {
            std::string changed = file;
            random = random * 6364136223846793005u + 1442695040888963407u;
            changed[(random >> 33) % changed.size()] = static_cast<char>(random >> 20);
            EXPECT_NO_THROW(read(changed));
        }
    }
}

}  // namespace
}  // namespace petrichor
