// The formats that knead only knows by sight.

#include "base/error.h"
#include "io/format.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

struct Signature {
    std::string_view begins;
    std::string_view words; // "is ..."
    Cure cure = Cure::told;
};

constexpr std::array<Signature, 11> signatures = {{
    {"\xEF\xBB\xBFply", "is a PLY file behind a byte-order mark; save it again without the mark"},
    {"\xEF\xBB\xBF# .PCD", "is a PCD file behind a byte-order mark; save it again without the mark"},
    {"\xFF\xFE", "is text in UTF-16; save it again as plain ASCII"},
    {"\xFE\xFF", "is text in UTF-16; save it again as plain ASCII"},
    {"ASTM-E57", "is an E57 file"},
    {"solid", "is an STL file"},
    {"glTF", "is a glTF file"},
    {"\x1F\x8B", "is compressed with gzip; unpack it first"},
    {"PK\x03\x04", "is a ZIP archive; unpack it first"},
    {"{\"knead\"", "is a knead session, not a cloud", Cure::open_session},
    {"ply", "begins like a PLY file, but 'ply' must stand alone on its first line; correct that line"},
}};

// The first line that says something: neither empty nor a comment, as OBJ has them.
std::string_view first_line(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        const std::string_view line = text.substr(0, end);
        if (!line.empty() && !line.starts_with('#')) return line;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
}

} // namespace

void refuse_foreign_file(std::span<const std::byte> first_bytes, const std::string& shown) {
    const std::string_view text(reinterpret_cast<const char*>(first_bytes.data()), first_bytes.size());
    const std::string cure = "; knead reads " + known_extensions() + ", convert it to one of them";
    const auto is = [&](std::string_view begin, const Signature& signature) {
        return begin.starts_with(signature.begins);
    };
    for (const std::string_view begin : {text, first_line(text)})
        for (const Signature& signature : signatures) {
            if (!is(begin, signature)) continue;
            const bool has_cure =
                signature.cure != Cure::told || signature.words.find(';') != std::string_view::npos;
            throw Error(Trouble::input, shown, std::string(signature.words) + (has_cure ? "" : cure),
                        signature.cure);
        }
}

} // namespace knead
