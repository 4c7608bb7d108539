#include "edit/journal.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "edit/journal_facts.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace knead {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, Trouble trouble, const std::string& doing,
                       int code = errno) {
    throw Error(trouble, file.string(),
                "cannot " + doing + " the recording: " + std::generic_category().message(code));
}

bool lock(const Descriptor& journal) {
    return ::flock(journal.value(), LOCK_EX | LOCK_NB) == 0;
}

void write_text(const Descriptor& journal, std::string_view text, const std::filesystem::path& file) {
    if (const int code = write_all(journal.value(), text); code != 0)
        fail(file, Trouble::output, "write", code);
}

// All of it, or Error (input): half of a journal must not pass for the whole.
std::string read_all(const Descriptor& journal, const std::filesystem::path& file) {
    std::string text;
    char buffer[65536];
    for (;;) {
        const ssize_t got = ::read(journal.value(), buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(file, Trouble::input, "read");
        if (got == 0) return text;
        text.append(buffer, static_cast<std::size_t>(got));
    }
}

// A name that no other journal has: the time, then the process, then a count.
std::filesystem::path fresh_name(const std::filesystem::path& folder, unsigned attempt) {
    char stamp[32];
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    ::localtime_r(&now, &local);
    std::strftime(stamp, sizeof stamp, "%Y-%m-%d-%H%M%S", &local);
    return folder /
           (std::string(stamp) + "-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".knead");
}

void remove_journal(const std::filesystem::path& journal) {
    ::unlink(journal.c_str());
    ::unlink(journal_facts_file(journal).c_str());
}

// What a journal holds, if it is one, nobody has it open, and it can be read.
std::optional<LostWork> look_at(const std::filesystem::path& file) {
    const Descriptor journal(::open(file.c_str(), O_RDWR | O_CLOEXEC));
    if (!journal || !lock(journal)) return std::nullopt;
    try {
        const std::string text = read_all(journal, file);
        const std::string whole = mended(text, file).text;
        if (whole.empty()) { // knead was ended, or the disk full, before its first line was there
            remove_journal(file);
            return std::nullopt;
        }
        const Session session = parse_session(whole, file);
        const JournalFacts facts = read_journal_facts(file);
        if (const std::size_t lost = lost_steps(session.lines, facts.saved_lines); lost > 0)
            return LostWork{file, session.resolve(session.cloud), facts.session, lost,
                            std::filesystem::last_write_time(file)};
        remove_journal(file);
    } catch (const std::filesystem::filesystem_error&) { // it is gone meanwhile
        return std::nullopt;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // a damaged one, or of another version
        LostWork damaged;
        damaged.journal = file;
        damaged.trouble = error.what();
        return damaged;
    }
    return std::nullopt;
}

} // namespace

std::filesystem::path default_journal_folder() {
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state && state[0] == '/') return std::filesystem::path(state) / "knead";
    const char* home = std::getenv("HOME");
    if (home && home[0] == '/') return std::filesystem::path(home) / ".local/state/knead";
    return {};
}

Journal Journal::create(const std::filesystem::path& folder, const std::string& header) {
    std::error_code trouble;
    std::filesystem::create_directories(folder, trouble);
    for (unsigned attempt = 0;; ++attempt) {
        const std::filesystem::path file = fresh_name(folder, attempt);
        Descriptor made(::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0600));
        if (!made && errno == EEXIST && attempt < 1000) continue;
        if (!made) fail(file, Trouble::output, "begin");
        // Somebody who looks for lost work may have it for a moment, and may have removed it.
        ::flock(made.value(), LOCK_EX);
        struct stat status {};
        if (::fstat(made.value(), &status) == 0 && status.st_nlink == 0) continue;
        Journal journal(file, std::move(made));
        try {
            journal.append(header);
        } catch (...) {
            journal.discard(); // or a full disk would be left one more empty file by every act
            throw;
        }
        sync_folder(folder); // or the file could be nameless after a power cut
        return journal;
    }
}

Journal Journal::take_over(const std::filesystem::path& file) {
    Descriptor descriptor(::open(file.c_str(), O_RDWR | O_APPEND | O_CLOEXEC));
    if (!descriptor) fail(file, Trouble::input, "open");
    if (!lock(descriptor))
        throw Error(Trouble::input, file.string(), "another knead is working on this recording");
    const std::string text = read_all(descriptor, file);
    const std::string whole = mended(text, file).text;
    if (whole.size() > text.size()) write_text(descriptor, std::string_view(whole).substr(text.size()), file);
    if (::ftruncate(descriptor.value(), static_cast<off_t>(whole.size())) != 0)
        fail(file, Trouble::output, "mend");
    return {file, std::move(descriptor)};
}

void Journal::append(std::string_view lines) {
    const off_t before = ::lseek(descriptor_.value(), 0, SEEK_END);
    try {
        write_text(descriptor_, std::string(lines) + "\n", file_);
        if (::fdatasync(descriptor_.value()) != 0) fail(file_, Trouble::output, "sync");
    } catch (...) {
        // Whole lines only; if even that fails, take_over() drops the piece.
        [[maybe_unused]] const int cut = ::ftruncate(descriptor_.value(), before);
        throw;
    }
}

void Journal::discard() {
    remove_journal(file_);
}

MendedText mended(std::string text, const std::filesystem::path& file) {
    const std::size_t whole = text.rfind('\n') + 1; // 0 where there is none
    if (whole == text.size()) return {std::move(text), false};
    try {
        (void)parse_session(text, file);
        return {std::move(text) + '\n', false};
    } catch (const Error&) {
        text.resize(whole);
        return {std::move(text), true};
    }
}

std::vector<LostWork> find_lost_work(const std::filesystem::path& folder) {
    std::vector<LostWork> found;
    std::error_code trouble;
    // Not by a loop over the range, which throws where the folder goes away meanwhile.
    std::filesystem::directory_iterator entry(folder, trouble);
    for (; !trouble && entry != std::filesystem::directory_iterator(); entry.increment(trouble)) {
        if (!has_session_extension(entry->path())) continue;
        if (auto lost = look_at(entry->path())) found.push_back(std::move(*lost));
    }
    std::ranges::sort(found, std::greater{}, &LostWork::when);
    return found;
}

} // namespace knead
