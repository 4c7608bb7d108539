#include "window/desktop.h"

#include "support/run_knead.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <thread>

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace knead::test {

namespace {

// In the child: becomes the command. Never returns.
[[noreturn]] void become(const std::vector<std::string>& command,
                         const std::vector<std::string>& environment) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    for (const std::string& setting : environment) ::putenv(const_cast<char*>(setting.c_str()));
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
}

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

} // namespace

Process::Process(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                 const std::filesystem::path& log) {
    id_ = ::fork();
    if (id_ != 0) return;
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    become(command, environment);
}

Process::~Process() {
    kill_hard();
}

bool Process::runs() {
    int status = 0;
    if (id_ > 0 && ::waitpid(id_, &status, WNOHANG) == id_) {
        code_ = code_of(status);
        id_ = -1;
    }
    return id_ > 0;
}

std::vector<std::string> Process::threads() const {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(id_) + "/task", none)) {
        std::ifstream file(thread.path() / "comm");
        std::getline(file, names.emplace_back());
    }
    return names;
}

void Process::kill_hard() {
    if (!runs()) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
    id_ = -1;
}

std::optional<int> Process::exit_code(double seconds) {
    return wait_until([&] { return !runs(); }, seconds) ? code_ : std::nullopt;
}

bool wait_until(const std::function<bool()>& condition, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        pause(0.02);
    }
    return condition();
}

void pause(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::optional<Desktop> Desktop::start(const std::filesystem::path& folder, std::string& why) {
    for (const char* program : {"Xvfb", "xdotool"})
        if (!is_installed(program)) {
            why = std::string(program) + " is not installed (third_party/install.sh installs it)";
            return std::nullopt;
        }
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return std::nullopt;
    // Without -noreset it starts anew whenever its last client leaves, and refuses whoever comes meanwhile.
    Process server({"Xvfb", "-displayfd", std::to_string(pipe[1]), "-screen", "0", "1280x800x24", "-nolisten",
                    "tcp", "-noreset"},
                   {}, folder / "xvfb.log");
    ::close(pipe[1]);
    std::string number;
    for (char c = 0; ::read(pipe[0], &c, 1) == 1 && c != '\n';) number += c;
    ::close(pipe[0]);
    if (number.empty()) {
        why = "Xvfb did not start";
        return std::nullopt;
    }
    return Desktop(folder, ":" + number, std::move(server));
}

Process Desktop::open_editor(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{knead_binary().string(), "edit", "--size", "1280x800"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return Process(
        command,
        {"DISPLAY=" + display_, "XDG_STATE_HOME=" + (folder_ / "state").string(), "LIBGL_ALWAYS_SOFTWARE=1"},
        folder_ / "editor.log");
}

std::string Desktop::xdotool(const std::vector<std::string>& arguments) const {
    std::string command = "DISPLAY=" + display_ + " xdotool";
    for (const std::string& word : arguments) command += " '" + word + "'";
    FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
    if (!pipe) return {};
    std::string out;
    std::array<char, 256> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) out += buffer.data();
    ::pclose(pipe);
    while (!out.empty() && out.back() == '\n') out.pop_back();
    return out;
}

std::string Desktop::title() const {
    return xdotool({"search", "--onlyvisible", "--name", "knead", "getwindowname"});
}

bool Desktop::wait_for_title(const std::string& part) const {
    return wait_until([&] { return title().find(part) != std::string::npos; });
}

void Desktop::focus() const {
    xdotool({"search", "--onlyvisible", "--name", "knead", "windowfocus", "--sync"});
}

void Desktop::keys(std::initializer_list<const char*> names) const {
    std::vector<std::string> arguments{"key", "--delay", "60"};
    arguments.insert(arguments.end(), names.begin(), names.end());
    xdotool(arguments);
}

void Desktop::burst(std::initializer_list<const char*> names) const {
    std::vector<std::string> arguments{"key", "--delay", "2"};
    arguments.insert(arguments.end(), names.begin(), names.end());
    xdotool(arguments);
}

void Desktop::type(const std::string& text) const {
    xdotool({"type", "--delay", "20", text});
}

void Desktop::move(double x, double y) const {
    xdotool({"mousemove", std::to_string(static_cast<int>(x)), std::to_string(static_cast<int>(y))});
    pause(0.03);
}

void Desktop::move_on(int x, int y) const {
    xdotool({"mousemove_relative", "--", std::to_string(x), std::to_string(y)});
    pause(0.05);
}

void Desktop::press(int button) const {
    xdotool({"mousedown", std::to_string(button)});
    pause(0.05);
}

void Desktop::release(int button) const {
    xdotool({"mouseup", std::to_string(button)});
    pause(0.05);
}

void Desktop::drag(int button, const std::vector<std::pair<double, double>>& path, const char* held) const {
    if (held) xdotool({"keydown", held});
    move(path.front().first, path.front().second);
    press(button);
    for (const auto& [x, y] : path) move(x, y);
    release(button);
    if (held) xdotool({"keyup", held});
}

} // namespace knead::test
