// GLSL of a user's own: a folder for the files, and a cache of its own for what is compiled of them, so that each test is
// cold. The renderer, made before, keeps our own shaders where all programs do.
#ifndef PETRICHOR_TESTS_GPU_OWN_TEXT_FIXTURE_H
#define PETRICHOR_TESTS_GPU_OWN_TEXT_FIXTURE_H

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {

class OwnTextTest : public GpuTest {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() /
                 ("petrichor-own-texts-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder);
        GpuTest::SetUp();
        setenv("PETRICHOR_CACHE", (folder / "cache").c_str(), 1);
    }
    void TearDown() override
    {
        GpuTest::TearDown();
        unsetenv("PETRICHOR_CACHE");
        std::filesystem::remove_all(folder);
    }
    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
    }
    /// What load() says of a floor of that material; "" when it takes it.
    std::string refusal_of(const Material& material) const
    {
        try {
            renderer->load(scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {material}), {});
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    std::filesystem::path folder;
};

}  // namespace petrichor::gpu

#endif
