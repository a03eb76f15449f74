# What every target of the project shares: the include root, warnings, floating point, sanitizers.
add_library(petrichor_options INTERFACE)
target_include_directories(petrichor_options INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_definitions(petrichor_options INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE)
# The same bits everywhere: a * b + c is never contracted to one rounding.
target_compile_options(petrichor_options INTERFACE -ffp-contract=off)

# Warnings are for our own sources only; users of the installed libraries do not inherit them.
add_library(petrichor_warnings INTERFACE)
target_compile_options(petrichor_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 sees overlaps in std::string that are not there
    $<$<BOOL:${PETRICHOR_WERROR}>:-Werror>)

if(PETRICHOR_SANITIZE)
    target_compile_options(petrichor_options INTERFACE
        -fsanitize=${PETRICHOR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(petrichor_options INTERFACE -fsanitize=${PETRICHOR_SANITIZE})
endif()
