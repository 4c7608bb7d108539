#pragma once
// What a subcommand sees of the terminal: a place for its data, a place for its words, and a progress bar.

#include "base/progress.h"
#include "base/stopwatch.h"

#include <sstream>
#include <string>

namespace knead {

// Data goes to `out` and reaches stdout only when the command succeeded, so that a failed command leaves it
// empty. Words go to stderr at once. Control characters in either are shown as "?". On a terminal a bar is
// drawn for anything that takes over a second. Ctrl-C, SIGTERM and SIGHUP cancel.
class Terminal final : public Progress {
public:
    Terminal(); // takes over those signals for the rest of the program
    ~Terminal() override;

    std::ostringstream out;

    void say(const std::string& words);  // a line on stderr
    void warn(const std::string& words); // "warning: ..." on stderr

    void report(std::string_view stage, double fraction) override;
    bool cancelled() const override;

    void clear_bar();  // takes the bar off the screen
    void flush_data(); // `out` to stdout; throws Error (output) when it cannot be written

private:
    Stopwatch since_start_;
    double last_drawn_ = 0;
    std::string stage_;
    double stage_began_ = 0;
    bool bar_is_shown_ = false;
    bool is_terminal_ = false;
};

} // namespace knead
