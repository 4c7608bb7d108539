#pragma once
// SHA-256, by which a session knows its cloud again.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace knead {

// Lower-case hexadecimal, 64 characters.
std::string sha256_of(std::span<const std::byte> bytes);

// Of a file's content, read block by block. Throws Error (input) when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

} // namespace knead
