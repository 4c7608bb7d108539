#include "io/scalar_bytes.h"

namespace knead {

namespace {

template<std::size_t size>
void gather(const std::byte* from, std::size_t stride, std::size_t rows, bool swap, std::byte* to) {
    if (swap)
        for (std::size_t row = 0; row < rows; ++row, from += stride, to += size)
            copy_scalar(from, size, true, to);
    else
        for (std::size_t row = 0; row < rows; ++row, from += stride, to += size) std::memcpy(to, from, size);
}

} // namespace

void gather_scalars(const std::byte* from, std::size_t stride, std::size_t rows, std::size_t size, bool swap,
                    std::byte* to) {
    if (size == 1) gather<1>(from, stride, rows, swap, to);
    if (size == 2) gather<2>(from, stride, rows, swap, to);
    if (size == 4) gather<4>(from, stride, rows, swap, to);
    if (size == 8) gather<8>(from, stride, rows, swap, to);
}

} // namespace knead
