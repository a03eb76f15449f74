#include "tests/support/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace petrichor::testing_program {
namespace {

namespace fs = std::filesystem;

scene::Primitive quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v)
{
    scene::Primitive primitive;
    primitive.positions = {corner, corner + u, corner + u + v, corner + v};
    primitive.normals.assign(4, glm::normalize(glm::cross(u, v)));
    primitive.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

// A chequered picture in two colours.
scene::EncodedImage chequers(const std::string& name, std::vector<std::uint8_t> a,
                             std::vector<std::uint8_t> b)
{
    constexpr int kSize = 32;
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const auto& color = (x / 4 + y / 4) % 2 == 0 ? a : b;
            pixels.insert(pixels.end(), color.begin(), color.end());
        }
    }
    scene::EncodedImage image;
    image.name = name;
    image.bytes = texproc::encode_png8(kSize, kSize, 3, pixels);
    return image;
}

}  // namespace

Workplace::Workplace(const std::string& name)
    : path_(fs::temp_directory_path() /
            ("petrichor-test-" + name + "-" + std::to_string(::getpid())))
{
    fs::remove_all(path_);
    fs::create_directories(path_);
}

Workplace::~Workplace()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Outcome run_petrichor(const Run& run, const fs::path& folder)
{
    const fs::path out = folder / ".stdout";
    const fs::path err = folder / ".stderr";
    const pid_t child = ::fork();
    if (child == 0) {
        const int out_fd = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int err_fd = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(out_fd, 1);
        ::dup2(err_fd, 2);
        if (::chdir(folder.c_str()) != 0) ::_exit(125);
        for (const std::string& entry : run.environment) {
            const std::size_t equals = entry.find('=');
            ::setenv(entry.substr(0, equals).c_str(), entry.substr(equals + 1).c_str(), 1);
        }
        if (run.file_limit_bytes > 0) {
            const rlimit limit{static_cast<rlim_t>(run.file_limit_bytes),
                               static_cast<rlim_t>(run.file_limit_bytes)};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        std::vector<char*> argv{const_cast<char*>("petrichor")};
        for (const std::string& argument : run.arguments)
            argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        ::execv(PETRICHOR_PROGRAM, argv.data());
        ::_exit(126);
    }
    int status = 0;
    if (!run.interrupt_when.empty()) {
        for (int i = 0; i < 6000 && !fs::exists(run.interrupt_when); ++i) {
            if (::waitpid(child, &status, WNOHANG) == child) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        ::kill(child, SIGINT);
    }
    ::waitpid(child, &status, 0);
    Outcome outcome;
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = read_file(out);
    outcome.err = read_file(err);
    return outcome;
}

std::string read_file(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_file(const fs::path& file, const std::string& content)
{
    std::ofstream(file, std::ios::binary) << content;
}

std::string tiny_scene_glb()
{
    scene::Scene scene;
    scene.name = "tiny";
    scene.textures = {chequers("color", {200, 180, 150}, {90, 80, 70}),
                      chequers("normal", {148, 128, 252}, {108, 128, 252}),
                      chequers("surface", {255, 60, 0}, {255, 160, 0})};
    scene::Material stone;
    stone.name = "stone";
    stone.metallic = 1.0f;
    stone.base_color_texture.texture = 0;
    stone.normal_texture.texture = 1;
    stone.metallic_roughness_texture.texture = 2;
    scene.materials = {stone};
    scene::Mesh mesh;
    mesh.name = "court";
    mesh.primitives = {quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                       quad({-2, 0, -2}, {4, 0, 0}, {0, 2, 0})};
    scene.meshes = {mesh};
    scene.instances = {{"court", 0, glm::mat4(1.0f)}};
    const auto bytes = write_glb(scene);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace petrichor::testing_program
