#ifndef PETRICHOR_CLI_PROGRESS_H
#define PETRICHOR_CLI_PROGRESS_H

#include <chrono>
#include <string>

namespace petrichor::cli {

/// "1:02:03", "4:05", "12 s".
std::string duration_text(double seconds);

/// Tells on stderr how far a row of equal pieces of work is and how long it still takes: a bar that
/// redraws itself on a terminal, now and then a plain line in a log.
class Progress {
public:
    Progress(std::string what, int total);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();  ///< leaves the cursor on a fresh line

    /// `done` pieces are finished.
    void update(int done);
    /// What goes on now. In a log it is told where the last line is a second old, or at once.
    void stage(const std::string& name, bool at_once = false);

private:
    void draw(const std::string& time);
    using Clock = std::chrono::steady_clock;
    std::string what_;
    int total_;
    bool terminal_;
    bool drawn_ = false;
    int done_ = 0;
    std::string stage_;
    Clock::time_point start_;
    Clock::time_point last_;
};

}  // namespace petrichor::cli

#endif
