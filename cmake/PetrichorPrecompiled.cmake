# Headers that nearly every source reads, compiled once: a third of the work of building rooms and tests.
# Not beside ccache, which then finds less than it could; so whoever builds often also compiles every
# source with nothing but what it includes itself.
option(PETRICHOR_PRECOMPILED "Precompile the headers that all sources read" ON)
set(CMAKE_PCH_WARN_INVALID OFF)  # a source with flags of its own reads the headers as they are

# GCC looks for memory to free less often: a tenth less work for large sources, for a third more memory.
set(petrichor_free_less $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=1000 --param=ggc-min-heapsize=400000>)

# petrichor_precompile_rooms(FIRST TARGET ...): the first compiles them, with its flags; the others, which link it,
# reuse them.
function(petrichor_precompile_rooms first)
    if(NOT PETRICHOR_PRECOMPILED OR PETRICHOR_CCACHE)
        return()
    endif()
    target_precompile_headers(${first} PRIVATE <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem>
        <functional> <limits> <map> <memory> <optional> <span> <string> <string_view> <utility> <vector>
        <glm/glm.hpp>)
    target_compile_options(${first} PRIVATE ${petrichor_free_less})
    foreach(target IN LISTS ARGN)
        target_precompile_headers(${target} REUSE_FROM ${first})
        # GCC 12 warns of lengths inside std::string that cannot be, which it does not where it has read the text.
        target_compile_options(${target} PRIVATE ${petrichor_free_less}
            $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread>)
        # What is compiled for another processor or another arithmetic cannot use them.
        get_target_property(folder ${target} SOURCE_DIR)
        get_target_property(files ${target} SOURCES)
        list(FILTER files INCLUDE REGEX "^[^/<$][^<$]*[.]cpp$")
        foreach(file IN LISTS files)
            get_source_file_property(options ${folder}/${file} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
            if(options MATCHES "-[fm]")
                set_source_files_properties(${folder}/${file} TARGET_DIRECTORY ${target} PROPERTIES
                    SKIP_PRECOMPILE_HEADERS ON)
            endif()
        endforeach()
    endforeach()
endfunction()

# petrichor_precompile(TEST): the first test to ask compiles them with those of tests; the others reuse them.
function(petrichor_precompile test)
    if(NOT PETRICHOR_PRECOMPILED OR PETRICHOR_CCACHE)
        return()
    endif()
    target_compile_options(${test} PRIVATE ${petrichor_free_less})
    get_property(first GLOBAL PROPERTY petrichor_first_test)
    if(first)
        target_precompile_headers(${test} REUSE_FROM ${first})
        return()
    endif()
    set_property(GLOBAL PROPERTY petrichor_first_test ${test})
    target_precompile_headers(${test} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream>
        <functional> <map> <optional> <set> <span> <sstream> <string> <vector> <gtest/gtest.h>)
endfunction()
