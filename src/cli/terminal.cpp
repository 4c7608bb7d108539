#include "cli/terminal.h"

#include "base/control_characters.h"
#include "base/error.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <unistd.h>

namespace knead {

namespace {

// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t stop_asked = 0;

// Names come from files. Words and data are made of lines and columns.
std::string shown(std::string_view text) {
    return without_controls(text, "\n\t");
}

void ask_to_stop(int /*signal*/) {
    stop_asked = 1;
}

} // namespace

Terminal::Terminal() : is_terminal_(::isatty(STDERR_FILENO) != 0) {
    struct sigaction action {};
    action.sa_handler = ask_to_stop;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal, &action, nullptr);
    // Writing fails with words instead: to a pipe that nobody reads, and beyond a limit on files (ulimit -f).
    for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_IGN);
}

Terminal::~Terminal() {
    clear_bar();
}

void Terminal::say(const std::string& words) {
    clear_bar();
    std::fprintf(stderr, "%s\n", shown(words).c_str());
}

void Terminal::warn(const std::string& words) {
    say(without_controls("warning: " + words));
}

void Terminal::report(std::string_view stage, double fraction) {
    if (!is_terminal_) return;
    const double now = since_start_.seconds();
    if (stage != stage_) {
        stage_ = stage;
        stage_began_ = now;
    }
    if (now - stage_began_ < 1.0 || now - last_drawn_ < 0.1) return;
    last_drawn_ = now;
    constexpr int width = 30;
    const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
    std::fprintf(stderr, "\r\033[K%-28s [%s%s] %3.0f %%", stage_.c_str(),
                 std::string(static_cast<std::size_t>(filled), '#').c_str(),
                 std::string(static_cast<std::size_t>(width - filled), ' ').c_str(),
                 std::clamp(fraction, 0.0, 1.0) * 100);
    std::fflush(stderr);
    bar_is_shown_ = true;
}

bool Terminal::cancelled() const {
    return stop_asked != 0;
}

void Terminal::clear_bar() {
    if (!bar_is_shown_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    bar_is_shown_ = false;
}

void Terminal::flush_data() {
    clear_bar();
    const std::string text = shown(out.str()); // JSON is ASCII with no other control characters: unchanged
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) // of what CLI11 wrote, too
        throw Error(Trouble::output, "standard output", "cannot be written");
}

} // namespace knead
