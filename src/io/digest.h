#pragma once
// SHA-256, by which a session knows its cloud again.

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

namespace knead {

// Of a file's content, read block by block: lower-case hexadecimal, 64 characters. Throws Error (input) when
// it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);
// The same, until another thread sets `stop`: then nothing.
std::optional<std::string> sha256_of_file(const std::filesystem::path& path, const std::atomic<bool>* stop);

} // namespace knead
