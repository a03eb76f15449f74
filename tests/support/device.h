// Tests that need a GPU: they skip without one, or fail where PETRICHOR_REQUIRE_GPU is 1.
#ifndef PETRICHOR_TESTS_SUPPORT_DEVICE_H
#define PETRICHOR_TESTS_SUPPORT_DEVICE_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "gpu/device/device_info.h"

namespace petrichor::testing_device {

/// Of SetUp: false, and the test is skipped or has failed, when there is no usable device.
inline bool device_is_there()
{
    for (const gpu::DeviceInfo& device : gpu::list_devices()) {
        if (device.usable) return true;
    }
    const char* required = std::getenv("PETRICHOR_REQUIRE_GPU");
    const bool fails = required && std::string(required) == "1";
    [fails] {
        if (fails) FAIL() << "no usable Vulkan 1.3 device";
        GTEST_SKIP() << "no usable Vulkan 1.3 device on this machine";
    }();
    return false;
}

}  // namespace petrichor::testing_device

#endif
