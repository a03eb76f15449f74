
#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "base/content_cache.h"
#include "base/error.h"
#include "film/scenes/demo_scene.h"
#include "film/scenes/scene_textures.h"
#include "scene/gltf/glb_writer.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;

class Cache : public testing::Test {
protected:
    Cache()
        : folder(fs::path(testing::TempDir()) / ("petrichor_cache_" + std::to_string(::getpid())))
    {
        fs::remove_all(folder);
    }
    ~Cache() override { fs::remove_all(folder); }

    fs::path folder;
};

std::vector<std::byte> bytes_of(std::size_t count, int value)
{
    return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

std::vector<std::byte> copy_of(const CachedBytes& bytes)
{
    return {bytes.begin(), bytes.end()};
}

std::vector<std::vector<std::byte>> copy_of(const gpu::Texture& texture)
{
    std::vector<std::vector<std::byte>> levels;
    for (const auto& level : texture.levels()) levels.emplace_back(level.begin(), level.end());
    EXPECT_FALSE(levels.empty()) << texture.name;
    return levels;
}

std::vector<fs::path> files_in(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

TEST_F(Cache, GivesBackWhatWasKept)
{
    const ContentCache cache(folder, 1 << 20);
    EXPECT_FALSE(cache.find("things", "a"));
    const auto first = bytes_of(3, 1), second = bytes_of(5, 2);
    cache.keep("things", "a", {first, second});
    const auto found = cache.find("things", "a");
    ASSERT_TRUE(found);
    auto wanted = first;
    wanted.insert(wanted.end(), second.begin(), second.end());
    EXPECT_EQ(copy_of(*found), wanted);
    EXPECT_FALSE(cache.find("things", "b"));
    EXPECT_FALSE(cache.find("others", "a"));
}

TEST_F(Cache, OffKeepsNothing)
{
    const ContentCache cache(folder, 0);
    cache.keep("things", "a", {bytes_of(3, 1)});
    EXPECT_FALSE(cache.find("things", "a"));
    EXPECT_FALSE(fs::exists(folder));
}

// Every byte of an entry, and every length shorter than it.
TEST_F(Cache, DamagedEntriesCountAsNoneAndGo)
{
    const ContentCache cache(folder, 1 << 20);
    const auto content = bytes_of(40, 7);
    cache.keep("things", "a", {content});
    const fs::path file = files_in(folder).at(0);
    const auto size = fs::file_size(file);
    for (std::uintmax_t at = 0; at < size; ++at) {
        cache.keep("things", "a", {content});
        {
            std::fstream open(file, std::ios::in | std::ios::out | std::ios::binary);
            open.seekg(static_cast<std::streamoff>(at));
            const int old = open.get();
            open.seekp(static_cast<std::streamoff>(at));
            open.put(static_cast<char>(old ^ 1));
        }
        EXPECT_FALSE(cache.find("things", "a")) << at;
        EXPECT_FALSE(fs::exists(file)) << at;
        cache.keep("things", "a", {content});
        fs::resize_file(file, at);
        EXPECT_FALSE(cache.find("things", "a")) << at;
    }
}

TEST_F(Cache, WhatWasLongestNotUsedGoesFirst)
{
    const ContentCache cache(folder, 1000);
    for (const char* key : {"a", "b", "c"}) {
        cache.keep("things", key, {bytes_of(200, 1)});
        const fs::path file = folder / "things" / (std::string(key) + ".bin");
        fs::last_write_time(file, fs::file_time_type::clock::now() -
                                      std::chrono::hours(std::string(key) == "a" ? 3 : 5));
    }
    EXPECT_TRUE(cache.find("things", "b")) << "used just now";
    cache.keep("things", "d", {bytes_of(200, 1)});
    EXPECT_LE(cache.size(), 1000u);
    cache.keep("things", "e", {bytes_of(200, 1)});
    EXPECT_LE(cache.size(), 1000u);
    EXPECT_FALSE(cache.find("things", "c"));
    EXPECT_TRUE(cache.find("things", "b"));
    EXPECT_TRUE(cache.find("things", "e"));
    cache.keep("things", "huge", {bytes_of(600, 1)});
    EXPECT_FALSE(cache.find("things", "huge")) << "would push out all others";
}

TEST_F(Cache, SeveralWritersAndReadersAgree)
{
    const ContentCache cache(folder, 20000);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&cache, t] {
            for (int i = 0; i < 50; ++i) {
                const int number = (i + 13 * t) % 50;
                const std::string key = std::to_string(number);
                if (const auto found = cache.find("things", key)) {
                    EXPECT_EQ(copy_of(*found), bytes_of(900, number));
                } else if (t == number % 4) {  // two programs would have two temporary names
                    cache.keep("things", key, {bytes_of(900, number)});
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_LE(cache.size(), 20000u);
}

TEST_F(Cache, AFolderThatCannotBeWrittenIsNamed)
{
    std::ofstream(folder.string()) << "a file in its place";
    const ContentCache cache(folder, 1 << 20);
    try {
        cache.keep("things", "a", {bytes_of(3, 1)});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(folder.string()), std::string::npos);
    }
    fs::remove(folder);
}

TEST_F(Cache, TheLimitIsANumber)
{
    ::setenv("PETRICHOR_CACHE_MIB", "much", 1);
    EXPECT_THROW(user_cache(), Error);
    ::setenv("PETRICHOR_CACHE_MIB", "3", 1);
    EXPECT_EQ(user_cache().max_bytes(), 3u << 20);
    ::setenv("PETRICHOR_CACHE_MIB", "0", 1);
    EXPECT_FALSE(user_cache().on());
    ::unsetenv("PETRICHOR_CACHE_MIB");
    EXPECT_EQ(user_cache().max_bytes(), 2048u << 20);
}

// The street and its textures: without a cache, cold, warm, and after damage.
TEST_F(Cache, TheStreetIsTheSameWithAndWithoutIt)
{
    const demo::DemoOptions options{.texture_size = 16, .threads = 2};
    const auto textures_of = [](scene::Scene scene, const ContentCache& cache) {
        TextureOptions finishing;
        finishing.cache = cache;
        return prepare_textures(scene, finishing);
    };
    const LoadedScene without = load_demo_street(options, {});
    const auto wanted = textures_of(without.scene, {});
    const auto wanted_glb = scene::write_glb(without.scene);
    const ContentCache cache(folder, 64 << 20);
    for (const char* what : {"cold", "warm", "damaged"}) {
        if (std::string(what) == "damaged") {
            for (const fs::path& file : files_in(folder)) fs::resize_file(file, 60);
        }
        const LoadedScene loaded = load_demo_street(options, cache);
        EXPECT_EQ(loaded.fingerprint, without.fingerprint) << what;
        EXPECT_TRUE(scene::write_glb(loaded.scene) == wanted_glb) << what;
        const auto textures = textures_of(loaded.scene, cache);
        ASSERT_EQ(textures.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_EQ(textures[i].name, wanted[i].name);
            EXPECT_EQ(textures[i].format, wanted[i].format);
            EXPECT_EQ(textures[i].width, wanted[i].width);
            EXPECT_TRUE(copy_of(textures[i]) == copy_of(wanted[i])) << what << " " << wanted[i].name;
        }
    }
}

// What a texture is made from is part of its key.
TEST_F(Cache, OtherOptionsAreOtherTextures)
{
    const ContentCache cache(folder, 64 << 20);
    const LoadedScene street = load_demo_street({.texture_size = 16, .threads = 2}, {});
    const auto count = [&](auto change) {
        scene::Scene scene = street.scene;
        TextureOptions options;
        options.cache = cache;
        change(scene, options);
        prepare_textures(scene, options);
        return files_in(folder).size();
    };
    const auto nothing = [](scene::Scene&, TextureOptions&) {};
    const std::size_t first = count(nothing);
    EXPECT_EQ(count(nothing), first);
    const std::size_t smaller =
        count([](scene::Scene&, TextureOptions& options) { options.max_size = 8; });
    EXPECT_EQ(smaller, 2 * first);
    const std::size_t median =
        count([](scene::Scene&, TextureOptions& options) { options.prefilter.rule = "median"; });
    EXPECT_GT(median, smaller);
    const std::size_t rougher =
        count([](scene::Scene& scene, TextureOptions&) { scene.materials[0].roughness = 0.5f; });
    EXPECT_EQ(rougher, median + 1);
}

}  // namespace
}  // namespace petrichor::film
