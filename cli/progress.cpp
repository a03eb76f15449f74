#include "cli/progress.h"

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <utility>

namespace petrichor::cli {

std::string duration_text(double seconds)
{
    const long whole = static_cast<long>(seconds + 0.5);
    char text[32];
    if (whole < 60) {
        std::snprintf(text, sizeof text, "%ld s", whole);
    } else if (whole < 3600) {
        std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
    } else {
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                      whole % 60);
    }
    return text;
}

Progress::Progress(std::string what, int total)
    : what_(std::move(what)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_)
{
}

Progress::~Progress()
{
    if (drawn_) std::cerr << "\n";
}

void Progress::stage(const std::string& name, bool at_once)
{
    if (name == stage_) return;
    stage_ = name;
    const auto now = Clock::now();
    if (!at_once && std::chrono::duration<double>(now - last_).count() < (terminal_ ? 0.1 : 1.0)) return;
    last_ = now;
    if (terminal_) draw("");
    else std::cerr << "info " << what_ << ": " << stage_ << std::endl;
}

void Progress::update(int done)
{
    done_ = done;
    const auto now = Clock::now();
    const double between_s = std::chrono::duration<double>(now - last_).count();
    const bool last = done == total_;
    if (!last && between_s < (terminal_ ? 0.1 : 5.0)) return;
    last_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double left_s = done > 0 ? elapsed_s / done * (total_ - done) : 0.0;
    const std::string time = last       ? ", in " + duration_text(elapsed_s)
                             : done > 0 ? ", " + duration_text(left_s) + " left"
                                        : "";
    if (last) stage_.clear();
    if (terminal_) return draw(time);
    const std::string of = stage_.empty() ? "" : ", " + stage_;
    std::cerr << "info " << what_ << ": " << done << "/" << total_ << of << time << std::endl;
}

void Progress::draw(const std::string& time)
{
    constexpr int kWidth = 30;
    const int filled = total_ > 0 ? kWidth * done_ / total_ : kWidth;
    const std::string count = std::to_string(done_) + "/" + std::to_string(total_);
    const std::string of = stage_.empty() ? "" : ", " + stage_;
    std::cerr << "\r" << what_ << " [" << std::string(static_cast<std::size_t>(filled), '#')
              << std::string(static_cast<std::size_t>(kWidth - filled), '.') << "] " << count
              << of << time << "\x1b[K" << std::flush;
    drawn_ = true;
}

}  // namespace petrichor::cli
