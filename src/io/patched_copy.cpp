#include "io/patched_copy.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t block_size = std::size_t{4} << 20;

} // namespace

BlockWriter::BlockWriter(FileInTheMaking& file, std::size_t total, Progress& progress)
    : file_(file), progress_(progress), total_(static_cast<double>(std::max<std::size_t>(total, 1))) {
    buffer_.reserve(std::min(total, block_size) + 64);
    progress.step("writing", 0);
}

void BlockWriter::append(std::span<const std::byte> bytes) {
    if (buffer_.size() + bytes.size() > block_size) flush();
    for (; bytes.size() > block_size; bytes = bytes.subspan(block_size)) put(bytes.first(block_size));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void BlockWriter::finish() {
    flush();
    progress_.step("writing", 1);
}

void BlockWriter::flush() {
    put(buffer_);
    buffer_.clear();
}

void BlockWriter::put(std::span<const std::byte> bytes) {
    file_.write(bytes);
    written_ += bytes.size();
    progress_.step("writing", std::min(1.0, static_cast<double>(written_) / total_));
}

} // namespace knead
