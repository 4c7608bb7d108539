#include "edit/open_files.h"

#include "edit/known_files.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

namespace knead {

namespace {

namespace fs = std::filesystem;

constexpr unsigned most_documents = 1000; // of one process

// An entry is called PROCESS-NUMBER, and holds the names, each with a zero byte behind it.
std::optional<pid_t> process_of(const fs::path& entry) {
    const std::string name = entry.filename().string();
    pid_t process = 0;
    const auto [end, trouble] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (trouble != std::errc{} || end == name.data() + name.size() || *end != '-') return std::nullopt;
    return process;
}

std::string text_of(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) text.append(real_name(file)).push_back('\0');
    return text;
}

bool lists(const fs::path& entry, const std::string& name) {
    std::ifstream in(entry, std::ios::binary);
    for (std::string one; std::getline(in, one, '\0');)
        if (one == name) return true;
    return false;
}

} // namespace

OpenFiles::OpenFiles(const fs::path& state_folder, const std::vector<fs::path>& files) {
    if (state_folder.empty()) return;
    folder_ = state_folder / "open";
    std::error_code ignored;
    fs::create_directories(folder_, ignored);
    try {
        for (unsigned number = 1; number <= most_documents && !entry_; ++number)
            if (auto claim = Claim::of(folder_ / (std::to_string(::getpid()) + '-' + std::to_string(number)),
                                       Claim::Kind::file))
                entry_.emplace(std::move(*claim));
    } catch (const std::system_error&) {
        return;
    }
    if (entry_ && write_all(entry_->descriptor(), text_of(files)) != 0) entry_.reset();
}

std::vector<pid_t> OpenFiles::others_with(const fs::path& file) const {
    std::vector<pid_t> others;
    const std::string name = real_name(file);
    std::error_code trouble;
    for (fs::directory_iterator entry(folder_, trouble), end; !trouble && entry != end;
         entry.increment(trouble)) {
        const std::optional<pid_t> process = process_of(entry->path());
        if (process && *process != ::getpid() && is_held(entry->path(), Claim::Kind::file) &&
            lists(entry->path(), name))
            others.push_back(*process);
    }
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    return others;
}

} // namespace knead
