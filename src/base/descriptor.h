#pragma once
// A file descriptor that closes itself.

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

} // namespace knead
