#include "io/lzf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t longest_literal = 32;
constexpr std::size_t shortest_copy = 3;
constexpr std::size_t longest_copy = 264;
constexpr std::size_t farthest_copy = 8192;

// The last place where three bytes of this hash stood.
class Places {
public:
    // Where three bytes like those at `at` were seen last (0 at first, which the caller checks as any
    // other), and notes that they are here now.
    std::size_t exchange(std::span<const std::byte> bytes, std::size_t at) {
        std::uint32_t three = 0;
        for (std::size_t i = 0; i < shortest_copy; ++i)
            three = three << 8U | std::to_integer<std::uint32_t>(bytes[at + i]);
        return std::exchange(last_[(three * 0x9E3779B1U) >> (32U - hash_bits)], at);
    }

private:
    static constexpr unsigned hash_bits = 15;
    std::vector<std::size_t> last_ = std::vector<std::size_t>(std::size_t{1} << hash_bits);
};

void put_literals(std::span<const std::byte> bytes, std::vector<std::byte>& to) {
    while (!bytes.empty()) {
        const auto run = bytes.first(std::min(bytes.size(), longest_literal));
        to.push_back(static_cast<std::byte>(run.size() - 1));
        to.insert(to.end(), run.begin(), run.end());
        bytes = bytes.subspan(run.size());
    }
}

void put_copy(std::size_t back, std::size_t length, std::vector<std::byte>& to) {
    const std::size_t offset = back - 1;
    const std::size_t code = length - 2;
    to.push_back(static_cast<std::byte>(std::min<std::size_t>(code, 7) << 5U | offset >> 8U));
    if (code >= 7) to.push_back(static_cast<std::byte>(code - 7));
    to.push_back(static_cast<std::byte>(offset & 0xFFU));
}

// How many bytes at `at` are the same as those at `earlier`, longest_copy at most.
std::size_t common_length(std::span<const std::byte> bytes, std::size_t earlier, std::size_t at) {
    const std::size_t most = std::min(bytes.size() - at, longest_copy);
    std::size_t length = 0;
    while (length < most && bytes[earlier + length] == bytes[at + length]) ++length;
    return length;
}

} // namespace

bool unpack_lzf(std::span<const std::byte> packed, std::span<std::byte> to) {
    std::size_t in = 0;
    std::size_t out = 0;
    while (in < packed.size()) {
        const auto control = std::to_integer<std::size_t>(packed[in++]);
        std::size_t length = control >> 5U;
        if (length == 0) {
            length = control + 1;
            if (length > packed.size() - in || length > to.size() - out) return false;
            std::memcpy(to.data() + out, packed.data() + in, length);
            in += length;
            out += length;
            continue;
        }
        if (packed.size() - in < (length == 7 ? 2U : 1U)) return false;
        if (length == 7) length += std::to_integer<std::size_t>(packed[in++]);
        length += 2;
        const std::size_t back = ((control & 0x1FU) << 8U | std::to_integer<std::size_t>(packed[in++])) + 1;
        if (back > out || length > to.size() - out) return false;
        // Byte by byte where the copy reaches into itself.
        if (back >= length)
            std::memcpy(to.data() + out, to.data() + out - back, length);
        else
            for (std::size_t i = 0; i < length; ++i) to[out + i] = to[out + i - back];
        out += length;
    }
    return out == to.size();
}

std::vector<std::byte> pack_lzf(std::span<const std::byte> bytes) {
    std::vector<std::byte> packed;
    packed.reserve(bytes.size() / 2 + 64);
    Places places;
    std::size_t literals = 0; // bytes[literals … at) are not yet written
    std::size_t at = 0;
    while (at + shortest_copy <= bytes.size()) {
        const std::size_t earlier = places.exchange(bytes, at);
        const bool reachable = earlier < at && at - earlier <= farthest_copy;
        const std::size_t length = reachable ? common_length(bytes, earlier, at) : 0;
        if (length < shortest_copy) {
            ++at;
            continue;
        }
        put_literals(bytes.subspan(literals, at - literals), packed);
        put_copy(at - earlier, length, packed);
        // The last places of what was copied find the next copies; all of them would cost more than they
        // save.
        const std::size_t end = at + length;
        for (at = end - 2; at < end; ++at)
            if (at + shortest_copy <= bytes.size()) places.exchange(bytes, at);
        literals = at;
    }
    put_literals(bytes.subspan(literals), packed);
    return packed;
}

} // namespace knead
