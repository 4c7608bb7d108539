#pragma once
// Work in a process of its own: to be killed, or to live in a world with a small disk. The test must have no
// other threads when it begins one.

#include <filesystem>
#include <functional>
#include <string>

#include <sys/types.h>

namespace knead::test {

// Begins a process that does `work` and ends (as soon as this one dies, too).
pid_t begin_child(const std::function<void()>& work);
// Kills it at once (SIGKILL) and waits until it is gone. Returns whether it was alive until then.
bool kill_child(pid_t child);

// Does `work` in a process of its own and returns what it returned; what it throws comes back as words.
// Breaks off if the process dies.
std::string in_child(const std::function<std::string()>& work);

// Of a process that may go on to another world: mounts an empty file system of so many bytes over the folder,
// seen by this process and its children only. Returns whether that is possible here (it takes root, or user
// namespaces).
bool mount_small_disk(const std::filesystem::path& folder, std::size_t bytes);
bool make_read_only(const std::filesystem::path& disk); // that was mounted so

// Gives up root's rights to write everywhere, for good; nothing to give up is fine, too. False if it cannot.
bool become_nobody();

} // namespace knead::test
