#pragma once
// Writing a file piece by piece, and writing a copy of one with other bytes at some places: for the writers
// of all formats.

#include "base/progress.h"
#include "base/whole_file.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace knead {

// Collects small pieces into blocks, and says how much of the whole is written.
class BlockWriter {
public:
    // `total` is about how many bytes are to come, for the progress alone.
    BlockWriter(FileInTheMaking& file, std::size_t total, Progress& progress);

    void append(std::span<const std::byte> bytes);
    void append(std::string_view text) { append(std::as_bytes(std::span(text))); }

    void finish(); // to be called once, last

private:
    void flush();
    void put(std::span<const std::byte> bytes);

    FileInTheMaking& file_;
    Progress& progress_;
    double total_;
    std::vector<std::byte> buffer_;
    std::size_t written_ = 0;
};

// Copies a file's bytes, with other bytes at some places, told in ascending order.
class PatchedCopy {
public:
    // Both must outlive it.
    PatchedCopy(std::span<const std::byte> source, BlockWriter& out) : source_(source), out_(out) {}

    // The `size` bytes at `at` of the source are left out, and `by` comes in their place.
    void replace(std::size_t at, std::size_t size, std::span<const std::byte> by) {
        out_.append(source_.subspan(copied_, at - copied_));
        out_.append(by);
        copied_ = at + size;
    }

    void finish() { out_.append(source_.subspan(copied_)); } // the rest; the writer is to be finished, too

private:
    std::span<const std::byte> source_;
    BlockWriter& out_;
    std::size_t copied_ = 0;
};

} // namespace knead
