#include "io/ply_header.h"

#include "base/error.h"
#include "io/header_lines.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_set>

namespace knead {

namespace {

struct TypeNames {
    ScalarType type;
    std::string_view classic;
    std::string_view sized;
};

constexpr std::array<TypeNames, 8> type_names = {{
    {ScalarType::int8, "char", "int8"},
    {ScalarType::uint8, "uchar", "uint8"},
    {ScalarType::int16, "short", "int16"},
    {ScalarType::uint16, "ushort", "uint16"},
    {ScalarType::int32, "int", "int32"},
    {ScalarType::uint32, "uint", "uint32"},
    {ScalarType::float32, "float", "float32"},
    {ScalarType::float64, "double", "float64"},
}};

void parse_format(const Words& words, const HeaderLines& lines, bool& seen, PlyHeader& header) {
    if (seen) lines.fail("a second format line; keep only one");
    if (!header.elements.empty()) lines.fail("the format line must come before the first element");
    if (words.size() != 3)
        lines.fail("a format line is 'format ENCODING 1.0', three words; this one has " +
                   std::to_string(words.size()));
    for (const auto encoding :
         {PlyEncoding::ascii, PlyEncoding::binary_little_endian, PlyEncoding::binary_big_endian}) {
        if (words[1] != name_of(encoding)) continue;
        if (words[2] != "1.0") lines.fail("PLY version " + in_quotes(words[2]) + "; knead reads version 1.0");
        header.encoding = encoding;
        seen = true;
        return;
    }
    lines.fail("unknown encoding " + in_quotes(words[1]) +
               "; PLY has ascii, binary_little_endian and binary_big_endian");
}

// Names go into messages and into other files; in a header whose lines end in lone \r they could even hold a
// \n.
std::string parse_name(std::string_view word, const HeaderLines& lines) {
    const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7F; };
    if (std::any_of(word.begin(), word.end(), is_control))
        lines.fail("the name " + in_quotes(word) + " has a control character, shown as '?'; rename it");
    return std::string(word);
}

void parse_element(const Words& words, const HeaderLines& lines, PlyHeader& header) {
    if (words.size() != 3)
        lines.fail("an element line is 'element NAME COUNT', three words; this one has " +
                   std::to_string(words.size()));
    PlyElement element{parse_name(words[1], lines), 0, {}, lines.line()};
    const char* const end = words[2].data() + words[2].size();
    const auto [stopped, trouble] = std::from_chars(words[2].data(), end, element.count);
    if (trouble == std::errc::result_out_of_range)
        lines.fail("the count " + in_quotes(words[2]) + " is larger than any file; correct the header");
    if (trouble != std::errc{} || stopped != end)
        lines.fail("the count " + in_quotes(words[2]) +
                   " is not a whole number of at least 0; correct the header");
    const auto is_vertex = [](const PlyElement& one) { return one.name == "vertex"; };
    if (is_vertex(element) && std::any_of(header.elements.begin(), header.elements.end(), is_vertex))
        lines.fail("a second element vertex; knead reads one cloud a file");
    header.elements.push_back(std::move(element));
}

ScalarType parse_type(std::string_view word, const HeaderLines& lines) {
    const auto type = ply_type(word);
    if (!type)
        lines.fail("unknown type " + in_quotes(word) +
                   "; PLY has char, uchar, short, ushort, int, uint, float and double (int8 … float64)");
    return *type;
}

// The names of the element under way, looked up in time that does not grow with them.
using Names = std::unordered_set<std::string_view>;

void parse_property(const Words& words, const HeaderLines& lines, Names& names, PlyHeader& header) {
    if (header.elements.empty()) lines.fail("a property before any element; an element line must come first");
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() != (is_list ? 5U : 3U))
        lines.fail(
            "a property line is 'property TYPE NAME' or 'property list TYPE TYPE NAME'; this one has " +
            std::to_string(words.size()) + " words");
    PlyProperty property;
    property.name = parse_name(words.back(), lines);
    property.is_list = is_list;
    property.type = parse_type(words[words.size() - 2], lines);
    if (is_list) {
        property.count_type = parse_type(words[2], lines);
        if (!is_whole(property.count_type))
            lines.fail("a list's length cannot be of type " + in_quotes(words[2]) +
                       "; it must be a whole number");
    }
    PlyElement& element = header.elements.back();
    if (!names.insert(words.back()).second)
        lines.fail("element " + in_quotes(element.name) + " has two properties " + in_quotes(property.name) +
                   "; rename one of them");
    element.properties.push_back(std::move(property));
}

} // namespace

std::string_view name_of(PlyEncoding encoding) {
    switch (encoding) {
    case PlyEncoding::ascii:
        return "ascii";
    case PlyEncoding::binary_little_endian:
        return "binary_little_endian";
    case PlyEncoding::binary_big_endian:
        return "binary_big_endian";
    }
    return "";
}

bool PlyElement::has_lists() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::optional<ScalarType> ply_type(std::string_view name) {
    for (const TypeNames& names : type_names)
        if (name == names.classic || name == names.sized) return names.type;
    return std::nullopt;
}

std::string_view ply_name_of(ScalarType type) {
    for (const TypeNames& names : type_names)
        if (names.type == type) return names.classic;
    return ply_name_of(ScalarType::float64);
}

PlyHeader parse_ply_header(std::span<const std::byte> bytes, const std::string& shown) {
    HeaderLines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, shown);
    PlyHeader header;
    bool format_seen = false;
    Names names;
    if (lines.next() != Words{"ply"}) lines.fail("the first line of a PLY file is 'ply' alone");
    while (const auto words = lines.next()) {
        if (words->empty()) continue;
        const std::string_view keyword = words->front();
        if (keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "format") {
            parse_format(*words, lines, format_seen, header);
        } else if (keyword == "element") {
            parse_element(*words, lines, header);
            names.clear();
        } else if (keyword == "property") {
            parse_property(*words, lines, names, header);
        } else if (keyword == "end_header" && words->size() == 1) {
            if (!format_seen) lines.fail("the header has no format line, so its encoding is unknown");
            header.body = lines.at();
            return header;
        } else {
            lines.fail("unknown header line " + in_quotes(keyword) +
                       "; a PLY header has format, comment, obj_info, element, property and end_header");
        }
    }
    lines.fail("the header has no end_header line: the file is cut off; get it again from its source");
}

} // namespace knead
