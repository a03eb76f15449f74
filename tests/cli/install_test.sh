#!/bin/sh
# Installs into a folder of its own, runs the program from there, and builds and runs a program that
# uses the installed libraries.   install_test.sh BUILD_FOLDER SCRATCH_FOLDER CXX
set -eu
build=$1 scratch=$2 cxx=$3
rm -rf "$scratch"
mkdir -p "$scratch/consumer"
cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/install.log"

"$scratch/prefix/bin/petrichor" --version
# The data is found beside the installed program, from any folder.
data=$(cd / && "$scratch/prefix/bin/petrichor" doctor --json | grep -c "$scratch/prefix/share/petrichor")
[ "$data" = 1 ] || { echo "the installed program does not find its data"; exit 1; }

# The formulas for other engines are those that the program writes.
"$scratch/prefix/bin/petrichor" headers -o "$scratch/headers" >/dev/null
for file in petrichor.glsl petrichor.hlsl base/interop.h formulas/weather/fair_weather.h; do
    written=$scratch/headers/petrichor/$file
    [ -e "$written" ] || written=$scratch/headers/$file
    cmp "$written" "$scratch/prefix/include/petrichor/$file" || { echo "$file is not installed as it is written"; exit 1; }
done
rm -r "$scratch/headers"

# Every installed header compiles alone, and every shader text that one of them names is installed.
# Where a header is the first that its own source includes, the build has shown it already.
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
include=$scratch/prefix/include/petrichor
(cd "$include" && find . -name '*.h' | sed 's|^\./||' | sort) >"$scratch/installed"
[ "$(wc -l <"$scratch/installed")" -gt 80 ] || { echo "too few headers are installed"; exit 1; }
while read -r header; do
    own=$source/${header%.h}.cpp
    [ -e "$own" ] && [ "$(grep -m1 '^#include' "$own")" = "#include \"$header\"" ] || echo "$header"
done <"$scratch/installed" >"$scratch/headers"
check='printf "#include \"%s\"\n" "$1" | "$2" -std=c++20 -fsyntax-only -DGLM_FORCE_DEPTH_ZERO_TO_ONE -I"$3" -x c++ - ||
    { echo "$1 does not compile alone"; exit 1; }'
xargs -P "$(nproc)" -I{} sh -c "$check" sh {} "$cxx" "$include" <"$scratch/headers"
(cd "$include" && grep -rhoE '^#include "[^"]+"' . | sort -u | cut -d'"' -f2) | while read -r named; do
    # The run-time compiler makes this one, of a user's own models.
    case $named in gpu/lighting/own_models.glsl | gpu/passes/surface/own_surfaces.glsl) continue ;; esac
    [ -e "$include/$named" ] || { echo "$named is included by an installed text, but not installed"; exit 1; }
done

cat >"$scratch/consumer/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(petrichor REQUIRED)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE petrichor::weather petrichor::texproc petrichor::gpu)
END
cat >"$scratch/consumer/main.cpp" <<'END'
#include "gpu/renderer.h"
#include "texproc/filter/mips.h"
#include "weather/models/artist/model.h"
int main()
{
    const auto wet = petrichor::weather::step({.rain = 1.0}, {}, 12.0, 0.8, 0.02);
    const petrichor::Image image(8, 4, 1, petrichor::ColorSpace::Data, 0.5f);
    const bool mips = petrichor::texproc::mip_chain(image).size() == 4;
    return wet.wetness > 0.0 && mips && !petrichor::gpu::aov_table().empty() ? 0 : 1;
}
END
cmake -G Ninja -S "$scratch/consumer" -B "$scratch/consumer/build" -DCMAKE_CXX_COMPILER="$cxx" \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" >"$scratch/configure.log" 2>&1 || { cat "$scratch/configure.log"; exit 1; }
cmake --build "$scratch/consumer/build"
"$scratch/consumer/build/consumer"
rm -rf "$scratch"
