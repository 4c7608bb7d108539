#include "io/patched_copy.h"

#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <bit>

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

void BlockWriter::append_little(const std::byte* from, std::size_t count, std::size_t size) {
    if constexpr (std::endian::native == std::endian::little) {
        append({from, count * size});
    } else {
        std::array<std::byte, 8> turned{};
        for (; count > 0; --count, from += size) {
            copy_scalar(from, size, true, turned.data());
            append(std::span(turned).first(size));
        }
    }
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

void patch_word(PatchedCopy& copy, std::string_view word, const PosedColumn& column, std::size_t i,
                const std::string& shown) {
    const auto value = posed_value(column, i, shown);
    if (!value) return;
    std::array<char, 64> buffer{};
    const std::size_t length = print_scalar(*value, column.attribute->type, buffer);
    copy.replace(copy.place_of(word.data()), word.size(), std::string_view(buffer.data(), length));
}

void patch_scalar(PatchedCopy& copy, std::size_t at, bool swap, const PosedColumn& column, std::size_t i,
                  const std::string& shown) {
    const auto value = posed_value(column, i, shown);
    if (!value) return;
    const StoredScalar scalar = stored_scalar(*value, column.attribute->type, swap);
    copy.replace(at, scalar.size, scalar.span());
}

} // namespace knead
