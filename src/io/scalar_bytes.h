#pragma once
// Scalars as they lie in binary files: copied, counted and stored with or without turning their bytes round.

#include "cloud/point_cloud.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>

namespace knead {

// Copies one scalar of `size` bytes, turned round if `swap`.
inline void copy_scalar(const std::byte* from, std::size_t size, bool swap, std::byte* to) {
    if (swap)
        std::reverse_copy(from, from + size, to);
    else
        std::memcpy(to, from, size);
}

// The little-endian scalar at a place in a file's bytes, which must hold it.
template<typename T>
T load_little(std::span<const std::byte> bytes, std::size_t at) {
    T value{};
    copy_scalar(bytes.data() + at, sizeof value, std::endian::native == std::endian::big,
                reinterpret_cast<std::byte*>(&value));
    return value;
}

template<typename T>
void store_little(T value, std::span<std::byte> bytes, std::size_t at) {
    copy_scalar(reinterpret_cast<const std::byte*>(&value), sizeof value,
                std::endian::native == std::endian::big, bytes.data() + at);
}

// Copies a text to a place in a file's bytes, which must have room for it.
inline void store_text(std::string_view text, std::span<std::byte> bytes, std::size_t at) {
    std::memcpy(bytes.data() + at, text.data(), text.size());
}

// Copies one scalar of `size` bytes out of each of `rows` records, `stride` bytes apart, into a column.
void gather_scalars(const std::byte* from, std::size_t stride, std::size_t rows, std::size_t size, bool swap,
                    std::byte* to);

// One scalar of an integer type; `swap` says that it lies in the other byte order. A uint64 beyond the
// largest int64 comes out negative.
inline std::int64_t load_integer(const std::byte* from, ScalarType type, bool swap) {
    std::array<std::byte, 8> native{};
    copy_scalar(from, size_of(type), swap, native.data());
    const auto as = [&]<typename T>(T value) {
        std::memcpy(&value, native.data(), sizeof value);
        return static_cast<std::int64_t>(value);
    };
    switch (type) {
    case ScalarType::int8:
        return as(std::int8_t{});
    case ScalarType::uint8:
        return as(std::uint8_t{});
    case ScalarType::int16:
        return as(std::int16_t{});
    case ScalarType::uint16:
        return as(std::uint16_t{});
    case ScalarType::int32:
        return as(std::int32_t{});
    case ScalarType::uint32:
        return as(std::uint32_t{});
    case ScalarType::int64:
        return as(std::int64_t{});
    case ScalarType::uint64:
        return as(std::uint64_t{});
    case ScalarType::float32:
    case ScalarType::float64:
        break;
    }
    return -1;
}

// Stores a value that the type holds exactly, in native byte order.
inline void store_scalar(double value, ScalarType type, std::byte* to) {
    const auto put = [to](auto typed) { std::memcpy(to, &typed, sizeof typed); };
    switch (type) {
    case ScalarType::int8:
        return put(static_cast<std::int8_t>(value));
    case ScalarType::uint8:
        return put(static_cast<std::uint8_t>(value));
    case ScalarType::int16:
        return put(static_cast<std::int16_t>(value));
    case ScalarType::uint16:
        return put(static_cast<std::uint16_t>(value));
    case ScalarType::int32:
        return put(static_cast<std::int32_t>(value));
    case ScalarType::uint32:
        return put(static_cast<std::uint32_t>(value));
    case ScalarType::int64:
        return put(static_cast<std::int64_t>(value));
    case ScalarType::uint64:
        return put(static_cast<std::uint64_t>(value));
    case ScalarType::float32:
        return put(static_cast<float>(value));
    case ScalarType::float64:
        return put(value);
    }
}

// A scalar as it lies in a file.
struct StoredScalar {
    std::array<std::byte, 8> bytes{};
    std::size_t size = 0;

    std::span<const std::byte> span() const { return std::span(bytes).first(size); }
};

// A value that the type holds exactly; `swap` says that files have the other byte order.
inline StoredScalar stored_scalar(double value, ScalarType type, bool swap) {
    std::array<std::byte, 8> native{};
    StoredScalar stored{{}, size_of(type)};
    store_scalar(value, type, native.data());
    copy_scalar(native.data(), stored.size, swap, stored.bytes.data());
    return stored;
}

} // namespace knead
