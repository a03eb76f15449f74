#ifndef PETRICHOR_TESTS_SUPPORT_PROGRAM_H
#define PETRICHOR_TESTS_SUPPORT_PROGRAM_H

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "scene/gltf/glb_writer.h"
#include "scene/scene.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::testing_program {

/// A folder of its own for each test, removed at the end.
class Workplace {
public:
    explicit Workplace(const std::string& name);
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    ~Workplace();
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

struct Run {
    std::vector<std::string> arguments;
    std::vector<std::string> environment = {};  ///< "NAME=value", added to the test's own
    std::filesystem::path interrupt_when = {};  ///< the signal once this file exists
    double interrupt_after_s = -1.0;            ///< or so long after the start, where >= 0
    int signal = SIGINT;
    long file_limit_bytes = 0;  ///< > 0: no file may grow beyond it, like a full disk
};

struct Outcome {
    int exit_code = -1;  ///< 128 + signal when a signal ended it
    std::string out;
    std::string err;
    double stopping_s = 0.0;  ///< from the signal to the end
    /// How much longer that took because other programs had the machine: the latest that a sleep of
    /// 5 ms ended meanwhile (and one in a thread of lowest priority), the longest that a small file
    /// took to be made and removed, and what 0.2 s of work took above 0.2 s.
    double machine_late_s = 0.0;
};

/// Runs the petrichor that was built with the tests, in a folder.
Outcome run_petrichor(const Run& run, const std::filesystem::path& folder);

/// The same with arguments alone.
Outcome run(const std::vector<std::string>& arguments, const Workplace& place);

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& content);

/// A floor and a wall with textures, as .glb: small, but it has all that weather needs.
std::string tiny_scene_glb();

}  // namespace petrichor::testing_program

#endif
