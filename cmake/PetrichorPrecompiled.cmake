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

# Sources that can be compiled as one are (together.py says which), eight at most: what they include is read once, which is
# most of the work of a small source. Not beside ccache either.
option(PETRICHOR_TOGETHER "Compile several sources as one" ON)
if(PETRICHOR_CCACHE)
    set(PETRICHOR_TOGETHER OFF)
endif()
if(PETRICHOR_TOGETHER)
    find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
    if(NOT Python3_Interpreter_FOUND)
        message(STATUS "No Python 3.9: each source is compiled alone, which takes twice as long")
        set(PETRICHOR_TOGETHER OFF)
    endif()
endif()

function(petrichor_compile_together)
    if(NOT PETRICHOR_TOGETHER)
        return()
    endif()
    foreach(target IN LISTS ARGN)
        get_target_property(folder ${target} SOURCE_DIR)
        get_target_property(sources ${target} SOURCES)
        set(files ${sources})
        list(FILTER files INCLUDE REGEX "^[^/<$][^<$]*[.]cpp$")
        list(LENGTH files number)
        if(number LESS 2)
            continue()
        endif()
        list(REMOVE_ITEM sources ${files})
        execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/together.py 8 ${files}
            WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
        string(REGEX MATCHALL "[^\n]+" groups "${groups}")
        set(files)
        foreach(row IN LISTS groups)
            string(REGEX MATCH "^([0-9]+) (.*)$" row "${row}")
            list(APPEND files ${CMAKE_MATCH_2})
            if(CMAKE_MATCH_1)
                set_source_files_properties(${folder}/${CMAKE_MATCH_2} TARGET_DIRECTORY ${target}
                    PROPERTIES UNITY_GROUP together_${CMAKE_MATCH_1})
            endif()
        endforeach()
        # GCC takes a source that another includes for a header.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
        set_target_properties(${target} PROPERTIES SOURCES "${files};${sources}" UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
        list(TRANSFORM files PREPEND ${folder}/)
        set_property(DIRECTORY ${folder} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
    endforeach()
endfunction()
