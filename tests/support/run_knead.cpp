#include "support/run_knead.h"

#include "base/require.h"
#include "support/scratch_folder.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace knead::test {

namespace {

void redirect(const std::filesystem::path& file, int descriptor) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(127);
}

} // namespace

std::filesystem::path knead_binary() {
    return KNEAD_BINARY;
}

Outcome run_knead(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const ScratchFolder scratch;
    const auto out = scratch / "out";
    const auto err = scratch / "err";
    std::vector<std::string> words{KNEAD_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    require(child >= 0, "a test could not start the program");
    if (child == 0) {
        redirect(out, STDOUT_FILENO);
        redirect(err, STDERR_FILENO);
        if (!folder.empty() && ::chdir(folder.c_str()) != 0) ::_exit(127);
        ::execv(KNEAD_BINARY, argv.data());
        ::_exit(127);
    }
    int status = 0;
    require(::waitpid(child, &status, 0) == child, "the program was lost");
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = read_text(out);
    outcome.err = read_text(err);
    return outcome;
}

} // namespace knead::test
