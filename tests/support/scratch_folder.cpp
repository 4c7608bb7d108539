#include "support/scratch_folder.h"

#include "base/require.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace knead::test {

ScratchFolder::ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "knead-test-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "a test needs a scratch folder");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string read_text(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

void write_text(const std::filesystem::path& file, std::string_view text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    require(out.good(), "a test's file could not be written");
}

} // namespace knead::test
