#pragma once
// Writing a file piece by piece, and writing a copy of one with other bytes at some places: for the writers
// of all formats.

#include "base/progress.h"
#include "base/whole_file.h"
#include "io/posed_values.h"

#include <cstddef>
#include <span>
#include <string>
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

    // So many scalars of `size` bytes, in native byte order there and little endian in the file.
    void append_little(const std::byte* from, std::size_t count, std::size_t size);

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

    void replace(std::size_t at, std::size_t size, std::string_view by) {
        replace(at, size, std::as_bytes(std::span(by)));
    }

    // A place in the text of the source, or at its end, as a place among its bytes.
    std::size_t place_of(const char* at) const {
        return static_cast<std::size_t>(at - reinterpret_cast<const char*>(source_.data()));
    }

    void finish() { out_.append(source_.subspan(copied_)); } // the rest; the writer is to be finished, too

private:
    std::span<const std::byte> source_;
    BlockWriter& out_;
    std::size_t copied_ = 0;
};

// Puts the value of point i in a pose, where that is another, in the place of a word of the source, or of a
// scalar at the byte `at`, which is there in the order of bytes that `swap` tells. `shown` names the target
// in errors.
void patch_word(PatchedCopy& copy, std::string_view word, const PosedColumn& column, std::size_t i,
                const std::string& shown);
void patch_scalar(PatchedCopy& copy, std::size_t at, bool swap, const PosedColumn& column, std::size_t i,
                  const std::string& shown);

} // namespace knead
