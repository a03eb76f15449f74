// The main of tests that run in one process because they share what takes long to make (petrichor_test .. ONCE):
// ctest is told of a test that was skipped among them by an exit code of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

int main(int count, char** arguments)
{
    testing::InitGoogleMock(&count, arguments);
    const int code = RUN_ALL_TESTS();
    constexpr int kSkipped = 77;
    return code == 0 && testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? kSkipped : code;
}
