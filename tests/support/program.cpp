#include "tests/support/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
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

using Clock = std::chrono::steady_clock;

double thread_cpu_s()
{
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Measures from its making on, in threads of its own.
class MachineLateness {
public:
    explicit MachineLateness(const fs::path& folder)
        : file_(folder / ".lateness"),
          thread_([this] {
              while (!done_) measure();
          }),
          background_([this] {
              // The driver keeps a thread like this one; a process is gone when its last one is.
              ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 19);
              while (!done_) background_s_ = std::max(background_s_, overslept());
          })
    {
    }
    ~MachineLateness() { end(); }
    double seconds() const
    {
        end();
        const double stretch = cpu_s_ > 0.0 ? wall_s_ / cpu_s_ : 1.0;
        return overslept_s_ + background_s_ + disk_s_ + 0.2 * std::max(0.0, stretch - 1.0);
    }

private:
    using Seconds = std::chrono::duration<double>;

    static double overslept()
    {
        const auto slept = Clock::now();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return Seconds(Clock::now() - slept).count() - 0.005;
    }
    void measure()
    {
        overslept_s_ = std::max(overslept_s_, overslept());
        const auto wrote = Clock::now();
        write_file(file_, "x");
        fs::remove(file_);
        disk_s_ = std::max(disk_s_, Seconds(Clock::now() - wrote).count());
        const auto begin = Clock::now();
        const double before_s = thread_cpu_s();
        while (thread_cpu_s() - before_s < 0.005) {
        }
        cpu_s_ += thread_cpu_s() - before_s;
        wall_s_ += Seconds(Clock::now() - begin).count();
    }
    void end() const
    {
        done_ = true;
        if (thread_.joinable()) thread_.join();
        if (background_.joinable()) background_.join();
    }

    const fs::path file_;
    // The threads' own, until they have ended.
    double overslept_s_ = 0.0, disk_s_ = 0.0, cpu_s_ = 0.0, wall_s_ = 0.0, background_s_ = 0.0;
    mutable std::atomic<bool> done_{false};
    mutable std::thread thread_, background_;
};

void wait_for_moment(const Run& run, pid_t child)
{
    if (run.interrupt_after_s >= 0.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(run.interrupt_after_s));
        return;
    }
    for (int i = 0; i < 6000 && !fs::exists(run.interrupt_when); ++i) {
        siginfo_t ended{};
        ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
        if (ended.si_pid == child) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
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
    Outcome outcome;
    if (!run.interrupt_when.empty() || run.interrupt_after_s >= 0.0) {
        wait_for_moment(run, child);
        const auto asked = Clock::now();
        const MachineLateness lateness(folder);
        ::kill(child, run.signal);
        ::waitpid(child, &status, 0);
        outcome.stopping_s = std::chrono::duration<double>(Clock::now() - asked).count();
        outcome.machine_late_s = lateness.seconds();
    } else {
        ::waitpid(child, &status, 0);
    }
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = read_file(out);
    outcome.err = read_file(err);
    return outcome;
}

Outcome run(const std::vector<std::string>& arguments, const Workplace& place)
{
    return run_petrichor({.arguments = arguments}, place.path());
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
