// The main of a program of tests, which is one test of ctest: ctest is told by an exit code of its own that tests were
// skipped and none failed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

int main(int count, char** arguments)
{
    testing::InitGoogleMock(&count, arguments);
    const int code = RUN_ALL_TESTS();
    constexpr int kSkipped = 77;
    return code == 0 && testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? kSkipped : code;
}
