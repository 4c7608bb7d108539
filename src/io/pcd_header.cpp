#include "io/pcd_header.h"

#include "base/types.h"
#include "io/header_lines.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <charconv>
#include <unordered_set>

namespace knead {

namespace {

struct TypeCode {
    ScalarType type;
    std::string_view letter;
};

constexpr std::array<TypeCode, 10> type_codes = {{
    {ScalarType::int8, "I"},
    {ScalarType::int16, "I"},
    {ScalarType::int32, "I"},
    {ScalarType::int64, "I"},
    {ScalarType::uint8, "U"},
    {ScalarType::uint16, "U"},
    {ScalarType::uint32, "U"},
    {ScalarType::uint64, "U"},
    {ScalarType::float32, "F"},
    {ScalarType::float64, "F"},
}};

// What the lines said, as they came.
struct Lines {
    std::optional<Words> fields, sizes, types, counts;
    std::optional<std::uint32_t> width, height;
    std::optional<std::uint64_t> points;
};

template<typename Whole>
Whole parse_whole(std::string_view word, std::string_view what, const HeaderLines& lines) {
    Whole value = 0;
    const char* const end = word.data() + word.size();
    const auto [stopped, trouble] = std::from_chars(word.data(), end, value);
    if (trouble == std::errc::result_out_of_range)
        lines.fail(std::string(what) + " " + in_quotes(word) +
                   " is larger than any file; correct the header");
    if (trouble != std::errc{} || stopped != end)
        lines.fail(std::string(what) + " " + in_quotes(word) + " is not a whole number; correct the header");
    return value;
}

// The one number of a line such as WIDTH.
template<typename Whole>
void parse_number_line(const Words& words, const HeaderLines& lines, std::optional<Whole>& to) {
    const std::string keyword(words.front());
    if (to) lines.fail("a second " + keyword + " line; keep only one");
    if (words.size() != 2) lines.fail("a " + keyword + " line has one number");
    to = parse_whole<Whole>(words[1], keyword, lines);
}

void keep_field_line(Words words, const HeaderLines& lines, std::optional<Words>& to) {
    const std::string keyword(words.front());
    if (to) lines.fail("a second " + keyword + " line; keep only one");
    words.erase(words.begin());
    if (words.empty()) lines.fail("a " + keyword + " line has a word for each field; this one has none");
    if (words.size() > most_pcd_fields)
        lines.fail("the " + keyword + " line has " + std::to_string(words.size()) +
                   " words; knead takes up to " + std::to_string(most_pcd_fields) + " fields");
    to = std::move(words);
}

void check_version(const Words& words, const HeaderLines& lines) {
    constexpr std::array<std::string_view, 6> known = {".5", ".6", ".7", "0.5", "0.6", "0.7"};
    if (words.size() != 2 || std::find(known.begin(), known.end(), words[1]) == known.end())
        lines.fail("PCD version " + (words.size() > 1 ? in_quotes(words[1]) : "''") +
                   "; knead reads 0.5, 0.6 and 0.7");
}

PcdEncoding parse_encoding(const Words& words, const HeaderLines& lines) {
    if (words.size() == 2)
        for (const auto encoding : {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed})
            if (words[1] == name_of(encoding)) return encoding;
    lines.fail("a DATA line says ascii, binary or binary_compressed" +
               (words.size() > 1 ? "; this one says " + in_quotes(words[1]) : std::string()));
}

ScalarType parse_type(std::string_view size, std::string_view letter, const PcdField& field,
                      const HeaderLines& lines) {
    const auto bytes = parse_whole<std::uint32_t>(size, "SIZE", lines);
    for (const TypeCode& code : type_codes)
        if (code.letter == letter && size_of(code.type) == bytes) return code.type;
    lines.fail("the field " + in_quotes(field.name) + " is of TYPE " + in_quotes(letter) + " and SIZE " +
               in_quotes(size) + "; PCD has I and U of 1, 2, 4 and 8 bytes, and F of 4 and 8");
}

void check_length(const std::optional<Words>& words, std::string_view keyword, std::size_t fields,
                  const HeaderLines& lines) {
    if (words && words->size() != fields)
        lines.fail("the header has " + std::to_string(fields) + " FIELDS, but " +
                   std::to_string(words->size()) + " words in its " + std::string(keyword) +
                   " line; correct it so that each field has one");
}

void make_fields(const Lines& said, const HeaderLines& lines, PcdHeader& header) {
    if (!said.fields) lines.fail("the header has no FIELDS line, so nobody knows what a point is");
    const std::size_t fields = said.fields->size();
    check_length(said.sizes, "SIZE", fields, lines);
    check_length(said.types, "TYPE", fields, lines);
    check_length(said.counts, "COUNT", fields, lines);
    std::unordered_set<std::string_view> names;
    for (std::size_t f = 0; f < fields; ++f) {
        PcdField field;
        field.name = (*said.fields)[f];
        if (!field.is_padding() && !names.insert((*said.fields)[f]).second)
            lines.fail("two fields are called " + in_quotes(field.name) + "; rename one of them");
        field.type = parse_type(said.sizes ? (*said.sizes)[f] : "4", said.types ? (*said.types)[f] : "F",
                                field, lines);
        if (said.counts) field.count = parse_whole<std::uint32_t>((*said.counts)[f], "COUNT", lines);
        if (field.count == 0)
            lines.fail("the field " + in_quotes(field.name) + " has COUNT 0; leave it out of the header");
        header.bytes_a_point += field.bytes();
        header.words_a_point += field.count;
        header.fields.push_back(std::move(field));
    }
}

void make_points(const Lines& said, const HeaderLines& lines, PcdHeader& header) {
    if (!said.points && !said.width)
        lines.fail("the header has neither POINTS nor WIDTH, so nobody knows how many points there are");
    if (said.height && !said.width && *said.height > 1)
        lines.fail("the header has a HEIGHT but no WIDTH; add it");
    const std::uint64_t points = said.points.value_or(0);
    // As old files have it: no arrangement at all.
    const bool arranged = said.width && (*said.width > 0 || said.height.value_or(0) > 0);
    if (points >= no_index || (arranged && std::uint64_t{*said.width} * said.height.value_or(1) >= no_index))
        lines.fail("the header promises more points than the 4294967294 that knead takes; correct the "
                   "header, or cut the cloud into pieces");
    header.width = arranged ? *said.width : static_cast<std::uint32_t>(points);
    header.height = arranged ? said.height.value_or(1) : 1;
    header.points = std::uint64_t{header.width} * header.height;
    if (said.points && points != header.points)
        lines.fail("the header has WIDTH " + std::to_string(header.width) + " × HEIGHT " +
                   std::to_string(header.height) + ", but " + std::to_string(points) +
                   " POINTS; correct the one that is wrong");
}

void note_line_end(std::string_view text, const Words& words, PcdFieldLine line, PcdHeader& header) {
    const std::string_view last = words.back();
    header.line_ends[static_cast<std::size_t>(line)] =
        static_cast<std::size_t>(last.data() + last.size() - text.data());
}

std::string viewpoint_of(const Words& words) {
    std::string viewpoint;
    for (const std::string_view word : std::span(words).subspan(1))
        viewpoint.append(viewpoint.empty() ? "" : " ").append(word);
    return viewpoint;
}

// A line before DATA.
void take_line(const Words& words, std::string_view text, const HeaderLines& lines, Lines& said,
               PcdHeader& header) {
    const std::string_view keyword = words.front();
    const auto field_line = [&](PcdFieldLine line, std::optional<Words>& to) {
        keep_field_line(words, lines, to);
        note_line_end(text, words, line, header);
    };
    if (keyword == "VERSION")
        check_version(words, lines);
    else if (keyword == "FIELDS" || keyword == "COLUMNS")
        field_line(PcdFieldLine::fields, said.fields);
    else if (keyword == "SIZE")
        field_line(PcdFieldLine::size, said.sizes);
    else if (keyword == "TYPE")
        field_line(PcdFieldLine::type, said.types);
    else if (keyword == "COUNT")
        field_line(PcdFieldLine::count, said.counts);
    else if (keyword == "WIDTH")
        parse_number_line(words, lines, said.width);
    else if (keyword == "HEIGHT")
        parse_number_line(words, lines, said.height);
    else if (keyword == "POINTS")
        parse_number_line(words, lines, said.points);
    else if (keyword == "VIEWPOINT")
        header.viewpoint = viewpoint_of(words);
    else
        lines.fail("unknown header line " + in_quotes(keyword) +
                   "; a PCD header has VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, "
                   "POINTS and DATA");
}

} // namespace

std::string_view name_of(PcdEncoding encoding) {
    switch (encoding) {
    case PcdEncoding::ascii:
        return "ascii";
    case PcdEncoding::binary:
        return "binary";
    case PcdEncoding::binary_compressed:
        return "binary_compressed";
    }
    return "";
}

std::string_view pcd_letter_of(ScalarType type) {
    const auto code = std::find_if(type_codes.begin(), type_codes.end(),
                                   [&](const TypeCode& known) { return known.type == type; });
    return code->letter;
}

PcdHeader parse_pcd_header(std::span<const std::byte> bytes, const std::string& shown) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    HeaderLines lines(text, shown);
    PcdHeader header;
    Lines said;
    while (const auto words = lines.next()) {
        if (words->empty() || words->front().starts_with('#')) continue;
        if (words->front() != "DATA") {
            take_line(*words, text, lines, said, header);
            continue;
        }
        header.encoding = parse_encoding(*words, lines);
        make_fields(said, lines, header);
        make_points(said, lines, header);
        header.body = lines.at();
        return header;
    }
    lines.fail("the header has no DATA line: the file is cut off; get it again from its source");
}

} // namespace knead
