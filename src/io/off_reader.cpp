#include "base/error.h"
#include "io/off.h"
#include "io/text_coordinates.h"
#include "io/text_numbers.h"
#include "io/text_statements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;

// What the keyword says.
struct Keyword {
    bool texture_coordinates = false, colours = false, normals = false, homogeneous = false,
         any_space = false;
    std::size_t length = 0; // in letters; some programs write the first count directly behind it
};

std::optional<Keyword> parse_keyword(std::string_view word) {
    Keyword keyword;
    const std::string_view all = word;
    const auto take = [&](std::string_view part) {
        if (!word.starts_with(part)) return false;
        word.remove_prefix(part.size());
        return true;
    };
    keyword.texture_coordinates = take("ST");
    keyword.colours = take("C");
    keyword.normals = take("N");
    keyword.homogeneous = take("4");
    keyword.any_space = take("n");
    if (!take("OFF")) return std::nullopt;
    if (!word.empty() && (word.front() < '0' || word.front() > '9')) return std::nullopt;
    keyword.length = all.size() - word.size();
    return keyword;
}

// What stands first where the keyword is left out.
bool is_count(std::string_view word) {
    return std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
}

class OffReader {
public:
    OffReader(OffImage& image, const std::string& shown, Progress& progress)
        : image_(image), shown_(shown), source_{image.bytes, shown}, progress_(progress), rows_(image.bytes) {
    }

    void read_header() {
        if (!rows_.next()) refuse("holds no counts of vertices and faces");
        std::string_view first = rows_.keyword();
        const auto keyword = is_count(first) ? Keyword{} : parse_keyword(first);
        if (!keyword) fail(first, "stands where OFF, COFF, NOFF or CNOFF should; correct the first line");
        keyword_ = *keyword;
        first.remove_prefix(keyword_.length);
        if (keyword_.homogeneous || keyword_.any_space)
            fail(rows_.keyword(), "has vertices of other than three coordinates; convert it to OFF");
        if (first.empty()) {
            const auto word = rows_.word();
            if (word == "BINARY")
                fail(*word, "OFF is not read by knead; save the file again as text, or as PLY");
            if (!word && !rows_.next()) refuse("ends before its counts of vertices and faces");
            first = word ? *word : rows_.keyword();
        }
        image_.points = count(first);
        const auto faces = rows_.word();
        if (!faces) fail(first, "is not followed by the number of faces");
        image_.faces = count(*faces);
        if (const auto edges = rows_.word()) (void)count(*edges);
        if (rows_.word())
            fail(first, "begins a line of more than the three counts of vertices, faces, edges");
        image_.rows_begin = rows_.at();
        refuse_lying_counts();
    }

    PointCloud read_vertices() {
        PointCloud cloud;
        if (image_.points == 0) find_layout(); // columns of nothing, as the keyword has them
        for (std::size_t point = 0; point < image_.points; ++point) {
            report(point, image_.points, "parsing");
            begin_row("vertex", point, image_.points);
            if (point == 0) find_layout();
            read_vertex(point);
        }
        for (Column& column : columns_) column.finish(cloud);
        if (keyword_.colours && image_.points > 0) narrow_colours(cloud);
        coordinates_.finish(cloud);
        if (odd_ > 0)
            cloud.remarks.push_back(std::to_string(odd_) +
                                    " vertices have more numbers than the keyword on the first line says; "
                                    "they are kept, and not understood");
        return cloud;
    }

    // Checks the faces; returns how many rows follow them.
    std::size_t read_faces() {
        for (std::size_t face = 0; face < image_.faces; ++face) {
            report(face, image_.faces, "checking");
            begin_row("face", face, image_.faces);
            const std::string_view first = rows_.keyword();
            std::size_t corners = count(first);
            for (; corners > 0; --corners) {
                const auto word = rows_.word();
                if (!word) fail(first, "corners are promised, and the line ends before; a face is one line");
                if (count(*word) >= image_.points)
                    fail(*word, "names a vertex that is not in the file, which has " +
                                    std::to_string(image_.points) + ", counted from 0");
            }
        }
        std::size_t more = 0;
        while (rows_.next()) ++more;
        return more;
    }

private:
    struct Column {
        const char* name;
        std::vector<float> values = {};

        void finish(PointCloud& cloud) { add_attribute(cloud, name, values); }
    };

    void report(std::size_t row, std::size_t rows, const char* stage) {
        if (row % rows_between_reports == 0)
            progress_.step(stage, static_cast<double>(row) / static_cast<double>(rows));
    }

    // A number takes a digit and what parts it from the next; the last line may lack its end.
    void refuse_lying_counts() const {
        const std::size_t left = image_.bytes.size() - image_.rows_begin + 1;
        constexpr std::size_t vertex_bytes = 6, face_bytes = 2;
        const bool fits = image_.points <= left / vertex_bytes &&
                          image_.faces <= (left - image_.points * vertex_bytes) / face_bytes;
        if (!fits)
            refuse("promises " + std::to_string(image_.points) + " vertices and " +
                   std::to_string(image_.faces) + " faces, but only " + std::to_string(left - 1) +
                   " bytes follow: the file is cut off or its header lies; get it again from its source");
        if (image_.points >= no_index) refuse("has more vertices than the 4294967294 that knead takes");
    }

    void begin_row(const char* what, std::size_t row, std::size_t rows) {
        if (!rows_.next())
            refuse(std::string("ends before its ") + what + " " + std::to_string(row) + " of " +
                   std::to_string(rows) +
                   " (from 0), each on a line of its own: it is cut off or its header lies; get it again "
                   "from its source");
    }

    // Which numbers a vertex has; whether a colour has three or four is told by the first line.
    void find_layout() {
        if (keyword_.normals)
            for (const char* name : {"nx", "ny", "nz"}) columns_.push_back({name});
        if (keyword_.colours) {
            for (const char* name : {"red", "green", "blue"}) columns_.push_back({name});
            TextStatements ahead = rows_;
            std::size_t numbers = 1;
            while (ahead.word()) ++numbers;
            const std::size_t others =
                3 + (keyword_.normals ? 3 : 0) + (keyword_.texture_coordinates ? 2 : 0);
            if (numbers > others + 3) columns_.push_back({"alpha"});
        }
        if (keyword_.texture_coordinates)
            for (const char* name : {"s", "t"}) columns_.push_back({name});
        for (Column& column : columns_) column.values.reserve(image_.points);
    }

    void read_vertex(std::size_t point) {
        std::optional<std::string_view> word = rows_.keyword();
        for (std::size_t number = 0; number < 3 + columns_.size(); ++number, word = rows_.word()) {
            if (!word)
                fail(rows_.keyword(), "begins vertex " + std::to_string(point) + " of " +
                                          std::to_string(number) + " numbers; it needs " +
                                          std::to_string(3 + columns_.size()) + " on one line");
            if (number < 3)
                coordinates_.add(number, source_.number(*word), *word);
            else
                columns_[number - 3].values.push_back(source_.float_number(*word));
        }
        if (word) ++odd_;
    }

    // Colours that are bytes in the file become bytes.
    void narrow_colours(PointCloud& cloud) const {
        float most = 0;
        const std::size_t first = keyword_.normals ? 3 : 0;
        const std::size_t end = columns_.size() - (keyword_.texture_coordinates ? 2 : 0);
        for (std::size_t c = first; c < end; ++c)
            for (const float value : columns_[c].values) {
                if (!(value >= 0 && value <= 255 && value == std::floor(value))) return;
                most = std::max(most, value);
            }
        if (most <= 1) return;
        for (std::size_t c = first; c < end; ++c) {
            Attribute& attribute = cloud.attributes[c];
            attribute.type = ScalarType::uint8;
            attribute.values.resize(image_.points);
            for (std::size_t i = 0; i < image_.points; ++i)
                attribute.values[i] = static_cast<std::byte>(columns_[c].values[i]);
        }
    }

    std::size_t count(std::string_view word) const {
        std::size_t value = 0;
        const auto [end, trouble] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (trouble != std::errc{} || end != word.data() + word.size())
            fail(word, "is no count, a whole number of at least 0; correct it");
        return value;
    }

    [[noreturn]] void refuse(const std::string& words) const { throw Error(Trouble::input, shown_, words); }

    [[noreturn]] void fail(std::string_view word, const std::string& words) const {
        source_.fail(word, words);
    }

    OffImage& image_;
    const std::string& shown_;
    StatementSource source_;
    Progress& progress_;
    TextStatements rows_;
    Keyword keyword_;
    TextCoordinates coordinates_;
    std::vector<Column> columns_; // behind x y z, in the order of a line
    std::size_t odd_ = 0;
};

} // namespace

std::vector<std::string> OffImage::besides_points() const {
    if (faces == 0) return {};
    return {std::to_string(faces) + (faces == 1 ? " face" : " faces")};
}

bool looks_like_off(std::span<const std::byte> first_bytes) {
    TextStatements rows(first_bytes);
    return rows.next() && parse_keyword(rows.keyword()).has_value();
}

bool looks_like_bare_off(std::span<const std::byte> first_bytes) {
    TextStatements rows(first_bytes);
    return rows.next() && is_count(rows.keyword());
}

PointCloud read_off(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<OffImage>();
    image->bytes = std::move(bytes);
    OffReader reader(*image, shown, progress);
    reader.read_header();
    PointCloud cloud = reader.read_vertices();
    if (const std::size_t more = reader.read_faces(); more > 0)
        cloud.remarks.push_back((more == 1 ? "1 line follows" : std::to_string(more) + " lines follow") +
                                std::string(" what the counts promise, kept and not understood"));
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead
