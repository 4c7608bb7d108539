#include "support/child.h"

#include "base/descriptor.h"
#include "base/require.h"
#include "support/scratch_folder.h"

#include <csignal>
#include <exception>

#include <fcntl.h>
#include <grp.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace knead::test {

namespace {

bool write_once(const char* file, const std::string& text) {
    const Descriptor opened(::open(file, O_WRONLY | O_CLOEXEC));
    return opened && ::write(opened.value(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

// A world of mounts of its own.
bool leave_mounts() {
    if (::geteuid() == 0)
        return ::unshare(CLONE_NEWNS) == 0 &&
               ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    const std::string user = "0 " + std::to_string(::geteuid()) + " 1";
    const std::string group = "0 " + std::to_string(::getegid()) + " 1";
    return ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0 && write_once("/proc/self/setgroups", "deny") &&
           write_once("/proc/self/uid_map", user) && write_once("/proc/self/gid_map", group);
}

} // namespace

pid_t begin_child(const std::function<void()>& work) {
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    require(child >= 0, "a test could not begin a process");
    if (child > 0) return child;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
    work();
    ::_exit(0);
}

bool kill_child(pid_t child) {
    ::kill(child, SIGKILL);
    int status = 0;
    require(::waitpid(child, &status, 0) == child, "a test's process was lost");
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

std::string in_child(const std::function<std::string()>& work) {
    const ScratchFolder folder;
    const std::filesystem::path answer = folder / "answer";
    // Opened before: the child may go where it has no way to this file.
    const Descriptor file(::open(answer.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    const pid_t child = begin_child([&] {
        std::string words;
        try {
            words = work();
        } catch (const std::exception& error) {
            words = error.what();
        }
        if (::write(file.value(), words.data(), words.size()) < 0) ::_exit(1);
    });
    int status = 0;
    require(::waitpid(child, &status, 0) == child, "a test's process was lost");
    require(WIFEXITED(status) && WEXITSTATUS(status) == 0, "a test's process died");
    return read_text(answer);
}

bool mount_small_disk(const std::filesystem::path& folder, std::size_t bytes) {
    const std::string size = "size=" + std::to_string(bytes);
    return leave_mounts() && ::mount("tmpfs", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
}

bool make_read_only(const std::filesystem::path& disk) {
    return ::mount(nullptr, disk.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0;
}

bool become_nobody() {
    constexpr uid_t nobody = 65534;
    if (::geteuid() != 0) return true;
    return ::setgroups(0, nullptr) == 0 && ::setgid(nobody) == 0 && ::setuid(nobody) == 0;
}

} // namespace knead::test
