// The main of a program of tests, which is one test of ctest: ctest is told by an exit code of its own that tests were
// skipped and none failed. With --of=NAME,NAME (files of tests) only tests of these sources run: a part of a program of many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <string_view>

namespace {

// Adds every test that is not of the sources to those that the filter leaves out, and returns how many are.
int keep_only(const std::string& sources)
{
    std::string others;
    int kept = 0;
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *all.GetTestSuite(i);
        for (int j = 0; j < suite.total_test_count(); ++j) {
            const testing::TestInfo& test = *suite.GetTestInfo(j);
            const std::string_view path = test.file();
            const std::string name(path.substr(path.rfind('/') + 1));
            if (("," + sources + ",").find("," + name + ",") != std::string::npos)
                ++kept;
            else
                others += std::string(":") + suite.name() + "." + test.name();
        }
    }
    std::string filter = testing::GTEST_FLAG(filter);
    if (!others.empty()) filter += filter.find('-') == std::string::npos ? "-" + others.substr(1) : others;
    testing::GTEST_FLAG(filter) = filter;
    return kept;
}

}  // namespace

int main(int count, char** arguments)
{
    testing::InitGoogleMock(&count, arguments);
    for (int i = 1; i < count; ++i) {
        const std::string_view argument = arguments[i];
        if (!argument.starts_with("--of=")) continue;
        if (keep_only(std::string(argument.substr(5))) > 0) continue;
        std::cerr << "No tests are of " << argument.substr(5) << '\n';
        return 1;
    }
    const int code = RUN_ALL_TESTS();
    constexpr int kSkipped = 77;
    return code == 0 && testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? kSkipped : code;
}
