#pragma once
// A file descriptor that closes itself, and writing to one.

#include <cerrno>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace knead {

class Descriptor {
public:
    explicit Descriptor(int value = -1) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }

    int value() const { return value_; } // below 0: none
    explicit operator bool() const { return value_ >= 0; }

private:
    int value_;
};

// Writes all bytes, in as many calls as it takes. Returns 0, or errno's code of what stopped it half-way.
[[nodiscard]] inline int write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
        if (put < 0 && errno != EINTR) return errno;
        if (put > 0) bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
    return 0;
}

[[nodiscard]] inline int write_all(int descriptor, std::string_view text) {
    return write_all(descriptor, std::as_bytes(std::span(text.data(), text.size())));
}

} // namespace knead
