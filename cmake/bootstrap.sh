# What ./petrichor and ./test share: the packages of the system, the build, and a check that costs
# milliseconds when nothing changed. Sourced with `root` set to the checkout. Everything is printed
# on stderr: stdout belongs to the program.

build=$root/build/release
program=$build/cli/petrichor
sources=(base formulas weather texproc scene gpu demo film cli cmake CMakeLists.txt CMakePresets.json)

# To build and run the program. openimageio-tools is there because the CMake package of the image
# library stops without it.
packages_to_build=(g++ cmake ninja-build python3 libvulkan-dev mesa-vulkan-drivers glslang-tools glslang-dev spirv-tools
    libopenimageio-dev openimageio-tools libopenexr-dev libimath-dev zlib1g-dev libpng-dev libzstd-dev libseccomp-dev libglm-dev
    libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libnetcdf-dev libeccodes-dev libdraco-dev libastcenc-dev libopencolorio-dev
    ffmpeg)
packages_to_test=(libgtest-dev libgmock-dev vulkan-validationlayers)

say() { printf '%s\n' "$*" >&2; }

missing_packages() {
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null)" = "ii " ] ||
            printf '%s ' "$package"
    done
}

explain_other_distribution() {
    say "petrichor: this is not a Debian system, so nothing is installed for you. If the build stops, install:"
    say "  a C++20 compiler, CMake 3.25, Ninja, glslang, the Vulkan headers, loader and a driver"
    say "  (Mesa's lavapipe will do), OpenImageIO 2.4, OpenEXR 3, Imath, zlib, libpng, zstd, libseccomp, GLM, CLI11 2, toml++ 3,"
    say "  nlohmann-json, ffmpeg; for the tests GoogleTest and the Vulkan validation layers."
    if command -v dnf >/dev/null; then
        say "  Fedora: dnf install gcc-c++ cmake ninja-build vulkan-loader-devel vulkan-headers \\"
        say "    mesa-vulkan-drivers glslang OpenImageIO-devel OpenImageIO-utils openexr-devel \\"
        say "    imath-devel zlib-devel libpng-devel libzstd-devel libseccomp-devel glm-devel cli11-devel tomlplusplus-devel json-devel gtest-devel gmock-devel \\"
        say "    vulkan-validation-layers"
    elif command -v pacman >/dev/null; then
        say "  Arch: pacman -S gcc cmake ninja vulkan-headers vulkan-icd-loader vulkan-swrast glslang \\"
        say "    openimageio openexr imath zlib libpng zstd libseccomp glm cli11 tomlplusplus nlohmann-json ffmpeg gtest \\"
        say "    vulkan-validation-layers"
    fi
}

# Installs what is missing of "$@" with apt-get, through sudo when not root.
install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        explain_other_distribution
        return 0
    fi
    local missing
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    if [ "${PETRICHOR_NO_INSTALL:-}" = 1 ]; then
        say "petrichor: not installed (PETRICHOR_NO_INSTALL=1): $missing"
        return 0
    fi
    local as_root=()
    if [ "$(id -u)" != 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "petrichor: these Debian packages are missing: $missing"
            say "  Run as root: apt-get install --no-install-recommends $missing"
            return 1
        fi
        as_root=(sudo)
    fi
    say "petrichor: installing $missing"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
    if ! compgen -G '/var/lib/apt/lists/*_Packages*' >/dev/null; then
        "${apt[@]}" update >&2 || say "petrichor: apt-get update failed; trying with the lists there are"
    fi
    # shellcheck disable=SC2086  # a list of names
    if ! "${apt[@]}" install --no-install-recommends $missing >&2; then
        say "petrichor: refreshing the package lists and trying again"
        "${apt[@]}" update >&2 &&
            "${apt[@]}" install --no-install-recommends $missing >&2 || {
            say "petrichor: could not install the packages above."
            say "  Install them by hand, or set PETRICHOR_NO_INSTALL=1 to build with what is there."
            return 1
        }
    fi
}

# True when the last successful build of $1 (a name) is newer than every file in the folders after it.
# A file that was removed or renamed shows in the time of its folder.
up_to_date() {
    local stamp=$build/.built-$1
    shift
    [ -e "$stamp" ] && [ -x "$program" ] || return 1
    local newer
    newer=$(cd "$root" && find "$@" -newer "$stamp" -print -quit 2>/dev/null) || return 1
    [ -z "$newer" ]
}

# build_target NAME "PACKAGES" "CMAKE OPTIONS" TARGET FOLDERS...: one build at a time in this folder.
build_target() {
    local name=$1 packages=$2 options=$3 target=$4
    shift 4
    up_to_date "$name" "$@" && return 0
    mkdir -p "$build"
    # Without flock (not everywhere) two first runs at once are on their own.
    if command -v flock >/dev/null; then
        exec 9>"$build/.lock"
        flock -n 9 || { say "petrichor: waiting for another build to end"; flock 9; }
    fi
    if ! up_to_date "$name" "$@"; then
        # shellcheck disable=SC2086  # lists of names
        install_packages $packages || return 1
        : >"$build/.building-$name"  # edits made while it builds count for the next run
        if [ -e "$build/CMakeCache.txt" ] &&
            ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
            say "petrichor: the folder was moved; configuring it anew"
            rm -f "$build/CMakeCache.txt" "$build/build.ninja"
        fi
        local configure=(ninja -C "$build" build.ninja) first=
        if [ ! -e "$build/build.ninja" ] || [ -n "$options" ]; then
            # shellcheck disable=SC2206  # a list of options
            configure=(cmake --preset release $options)
        fi
        if ! (cd "$root" && "${configure[@]}") >"$build/configure.log" 2>&1; then
            cat "$build/configure.log" >&2
            say "petrichor: configuring failed; this log is in $build/configure.log"
            return 1
        fi
        [ -x "$program" ] || first=" (the first time takes some minutes)"
        if ! ninja -C "$build" -n "$target" 2>/dev/null | grep -q 'no work to do'; then
            say "petrichor: building$first"
            if ! cmake --build "$build" --target "$target" >&2; then
                say "petrichor: the build failed; see above."
                return 1
            fi
        fi
        mv "$build/.building-$name" "$build/.built-$name"
    fi
    { exec 9>&-; } 2>/dev/null || true  # not `exec ... 2>`: that would silence the program too
}
