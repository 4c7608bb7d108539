#include "app/recent_files.h"

#include "app/kept_text.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace knead {

namespace {

constexpr std::size_t most = 12;

constexpr const char* list_name = "recent";

void write_list(const std::vector<std::filesystem::path>& recent) {
    std::string text;
    for (const std::filesystem::path& file : recent) text += file.string() + '\n';
    keep_text(list_name, text);
}

} // namespace

std::vector<std::filesystem::path> read_recent_files() {
    std::vector<std::filesystem::path> recent;
    std::ifstream in(kept_file(list_name));
    std::error_code ignored;
    for (std::string line; recent.size() < most && std::getline(in, line);)
        if (!line.empty() && std::filesystem::is_regular_file(line, ignored)) recent.emplace_back(line);
    return recent;
}

void remember_file(std::vector<std::filesystem::path>& recent, const std::filesystem::path& file) {
    std::error_code trouble;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, trouble);
    const std::filesystem::path& kept = trouble ? file : whole;
    // A line of the list is a file; a name with a line's end in it cannot stand there.
    if (kept.string().find('\n') != std::string::npos) return;
    std::erase(recent, kept);
    recent.insert(recent.begin(), kept);
    if (recent.size() > most) recent.resize(most);
    write_list(recent);
}

void forget_files(std::vector<std::filesystem::path>& recent) {
    recent.clear();
    write_list(recent);
}

} // namespace knead
