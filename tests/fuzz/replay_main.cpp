// Runs one target over its seeds and over files: a test with no need of libFuzzer.
//
//   replay_TARGET [FILE | FOLDER]...     every input must pass; the exit code says so
//   replay_TARGET --write-seeds FOLDER   writes the seeds there, one file each

#include "fuzz/target.h"
#include "support/scratch_folder.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

using namespace knead;

void write_seeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const fuzz::Seed& seed : fuzz::seeds()) test::write_text(folder / seed.name, seed.bytes);
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(path)) return {path};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(path)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// What the target does with the input; of a find it says a word.
enum class Outcome { accepted, refused, find };
Outcome outcome_of(const std::string& name, std::string_view bytes) {
    try {
        const bool accepted = fuzz::run_target(std::as_bytes(std::span(bytes)));
        return accepted ? Outcome::accepted : Outcome::refused;
    } catch (const std::exception& trouble) {
        std::printf("%s: %s\n", name.c_str(), trouble.what());
        return Outcome::find;
    }
}

// How many of the seeds do not end as their names say.
int run_seeds(const std::vector<fuzz::Seed>& seeds) {
    int wrong = 0;
    for (const fuzz::Seed& seed : seeds) {
        const Outcome outcome = outcome_of("seed " + seed.name, seed.bytes);
        const Outcome expected = seed.name.starts_with("bad") ? Outcome::refused : Outcome::accepted;
        if (outcome != expected && outcome != Outcome::find)
            std::printf("seed %s: is %s\n", seed.name.c_str(),
                        outcome == Outcome::accepted ? "accepted, and should not be" : "refused");
        wrong += outcome != expected ? 1 : 0;
    }
    return wrong;
}

int run(const std::vector<std::string>& arguments) {
    if (arguments.size() == 2 && arguments[0] == "--write-seeds") {
        write_seeds(arguments[1]);
        return 0;
    }
    const std::vector<fuzz::Seed> seeds = fuzz::seeds();
    int wrong = run_seeds(seeds);
    std::size_t files = 0;
    for (const std::string& argument : arguments)
        for (const std::filesystem::path& file : files_of(argument)) {
            ++files;
            wrong += outcome_of(file.string(), test::read_text(file)) == Outcome::find ? 1 : 0;
        }
    std::printf("%zu seeds and %zu files, %d failed\n", seeds.size(), files, wrong);
    return wrong == 0 ? 0 : 1;
}

} // namespace

int main(int count, char** arguments) {
    try {
        return run({arguments + 1, arguments + count});
    } catch (const std::exception& trouble) {
        std::printf("%s\n", trouble.what());
        return 1;
    }
}
