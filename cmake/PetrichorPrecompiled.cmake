# The headers that every test reads, compiled once: a third of the work of building the tests.
# Not beside ccache, which then finds less than it could; so whoever builds often also compiles every
# test with nothing but what it includes itself.
option(PETRICHOR_PRECOMPILED "Precompile the headers that all tests read" ON)
set(CMAKE_PCH_WARN_INVALID OFF)  # a test with flags of its own reads the headers as they are

# petrichor_precompile(TEST): the first test to ask compiles them, with its flags; the others reuse them.
function(petrichor_precompile test)
    if(NOT PETRICHOR_PRECOMPILED OR PETRICHOR_CCACHE)
        return()
    endif()
    get_property(first GLOBAL PROPERTY petrichor_first_test)
    if(first)
        target_precompile_headers(${test} REUSE_FROM ${first})
        return()
    endif()
    set_property(GLOBAL PROPERTY petrichor_first_test ${test})
    target_precompile_headers(${test} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream>
        <functional> <map> <optional> <set> <span> <sstream> <string> <vector> <gtest/gtest.h>)
endfunction()
