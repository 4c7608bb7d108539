#pragma once
// A display of the test's own with a hand on it: Xvfb, and the editor worked by xdotool as by a person.

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace knead::test {

// A child process; killed and waited for when the test is over.
class Process {
public:
    Process() = default;
    // `environment`: what is set beside the test's own. Output goes to `log`.
    Process(const std::vector<std::string>& command, const std::vector<std::string>& environment,
            const std::filesystem::path& log);
    ~Process();
    Process(Process&& other) noexcept
        : id_(std::exchange(other.id_, -1)), code_(std::exchange(other.code_, std::nullopt)) {}
    Process& operator=(Process&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(code_, other.code_);
        return *this;
    }

    bool runs();
    std::vector<std::string> threads() const;     // their names, by /proc
    void kill_hard();                             // SIGKILL, and waits
    std::optional<int> exit_code(double seconds); // waits so long for its end; 128 + n after signal n

private:
    pid_t id_ = -1;           // -1: there is none, or it was waited for
    std::optional<int> code_; // of one that ended by itself
};

// Waits for a condition, so many seconds at most.
bool wait_until(const std::function<bool()>& condition, double seconds = 60);
void pause(double seconds);

// Xvfb on a display number that was free.
class Desktop {
public:
    // Nothing if Xvfb or xdotool are not installed or do not start; `why` says so.
    static std::optional<Desktop> start(const std::filesystem::path& folder, std::string& why);

    Process open_editor(const std::vector<std::string>& arguments);
    std::filesystem::path state_folder() const { return folder_ / "state" / "knead"; }

    // The title of the editor's window; empty without one.
    std::string title() const;
    bool wait_for_title(const std::string& part) const;

    // --- The hand ---
    void focus() const;
    void
    keys(std::initializer_list<const char*> names) const; // as xdotool calls them: "r", "Return", "ctrl+s"
    void burst(std::initializer_list<const char*> names) const; // the same, as fast as they can be sent
    void type(const std::string& text) const;
    void move(double x, double y) const;
    void move_on(int x, int y) const; // from where it is
    void press(int button) const;
    void release(int button) const;
    void drag(int button, const std::vector<std::pair<double, double>>& path,
              const char* held = nullptr) const;

private:
    Desktop(std::filesystem::path folder, std::string display, Process server)
        : folder_(std::move(folder)), display_(std::move(display)), server_(std::move(server)) {}
    std::string xdotool(const std::vector<std::string>& arguments) const;

    std::filesystem::path folder_;
    std::string display_; // ":99"
    Process server_;
};

} // namespace knead::test
