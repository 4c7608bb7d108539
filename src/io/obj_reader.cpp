#include "base/counts.h"
#include "base/error.h"
#include "io/obj.h"
#include "io/obj_elements.h"
#include "io/text_coordinates.h"
#include "io/text_numbers.h"
#include "io/text_statements.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr std::size_t statements_between_reports = std::size_t{1} << 16;

// Statements that no other text begins with; knead understands only a few of them.
constexpr std::array<std::string_view, 14> keywords = {"v", "vt", "vn", "vp", "f",      "l",      "p",
                                                       "o", "g",  "s",  "mg", "mtllib", "usemtl", "usemap"};

// A column that only some points have numbers for; the others are 1.
class OptionalColumn {
public:
    explicit OptionalColumn(const char* name) : name_(name) {}

    void set(std::size_t point, float value) {
        values_.resize(point, 1.0F);
        values_.push_back(value);
        ++given_;
    }
    std::size_t given() const { return given_; }

    void finish(PointCloud& cloud, std::size_t points) {
        if (given_ == 0) return;
        values_.resize(points, 1.0F);
        add_attribute(cloud, name_, values_);
    }

private:
    const char* name_;
    std::vector<float> values_;
    std::size_t given_ = 0;
};

// Takes in the statements that hold numbers of points.
class VertexReader {
public:
    VertexReader(std::span<const std::byte> bytes, const std::string& shown) : source_{bytes, shown} {}

    void vertex(TextStatements& statements) {
        const std::size_t point = coordinates_.points();
        if (point >= no_index - 1) source_.fail(statements.keyword(), "is one vertex more than knead takes");
        std::array<float, 4> more{};
        std::size_t numbers = 0;
        while (const auto word = statements.word()) {
            if (numbers < 3)
                coordinates_.add(numbers, source_.number(*word), *word);
            else if (numbers < 7)
                more[numbers - 3] = source_.float_number(*word);
            ++numbers;
        }
        if (numbers < 3)
            source_.fail(statements.keyword(),
                         "is a vertex of " + std::to_string(numbers) + " numbers; a vertex has x, y and z");
        if (numbers == 4 || numbers == 7) weight_.set(point, more[0]);
        if (numbers == 6 || numbers == 7)
            for (std::size_t channel = 0; channel < 3; ++channel)
                colour_[channel].set(point, more[numbers - 6 + channel]);
        if (numbers == 5 || numbers > 7) ++odd_;
    }

    void normal(TextStatements& statements) {
        if (normals_.size() / 3 >= no_index - 1)
            source_.fail(statements.keyword(), "is one normal more than knead takes");
        std::size_t numbers = 0;
        while (const auto word = statements.word()) {
            if (numbers < 3) normals_.push_back(source_.float_number(*word));
            ++numbers;
        }
        if (numbers != 3)
            source_.fail(statements.keyword(),
                         "is a normal of " + std::to_string(numbers) + " numbers; a normal has x, y and z");
    }

    void finish(const ObjImage& image, PointCloud& cloud) {
        const std::size_t points = coordinates_.points();
        weight_.finish(cloud, points);
        for (OptionalColumn& channel : colour_) channel.finish(cloud, points);
        if (image.has_normals) add_normals(image, cloud);
        if (const std::size_t given = colour_[0].given(); given > 0 && given < points)
            cloud.remarks.push_back(std::to_string(points - given) + " of " + std::to_string(points) +
                                    " points have no colour in the file; they are taken as white");
        if (odd_ > 0)
            cloud.remarks.push_back(std::to_string(odd_) +
                                    " vertices have 5 or more than 7 numbers; those behind x, y and z are "
                                    "kept, and not understood");
        coordinates_.finish(cloud);
    }

private:
    void add_normals(const ObjImage& image, PointCloud& cloud) const {
        constexpr std::array<const char*, 3> names = {"nx", "ny", "nz"};
        std::vector<float> column(image.counts.points);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t n = 0; n < image.point_of_normal.size(); ++n)
                if (image.point_of_normal[n] != no_index)
                    column[image.point_of_normal[n]] = normals_[3 * n + axis];
            add_attribute(cloud, names[axis], column);
        }
    }

    StatementSource source_;
    TextCoordinates coordinates_;
    OptionalColumn weight_{"weight"};
    std::array<OptionalColumn, 3> colour_ = {OptionalColumn{"red"}, OptionalColumn{"green"},
                                             OptionalColumn{"blue"}};
    std::vector<float> normals_;
    std::size_t odd_ = 0;
};

void read_statements(ObjImage& image, VertexReader& vertices, Progress& progress) {
    TextStatements statements(image.bytes);
    ObjCounts& counts = image.counts;
    for (std::size_t statement = 0; statements.next(); ++statement) {
        if (statement % statements_between_reports == 0)
            progress.step("parsing",
                          static_cast<double>(statements.at()) / static_cast<double>(image.bytes.size()));
        const std::string_view keyword = statements.keyword();
        if (keyword == "v") {
            vertices.vertex(statements);
            ++counts.points;
        } else if (keyword == "vn") {
            vertices.normal(statements);
            ++counts.normals;
        }
        counts.texture_coordinates += keyword == "vt" ? 1 : 0;
        counts.faces += keyword == "f" || keyword == "fo" ? 1 : 0;
        counts.lines += keyword == "l" ? 1 : 0;
        counts.point_elements += keyword == "p" ? 1 : 0;
    }
}

} // namespace

std::vector<std::string> ObjImage::besides_points() const {
    std::vector<std::string> words;
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0) words.push_back(counted(count, what));
    };
    add(counts.faces, "face");
    add(counts.lines, "line");
    add(counts.point_elements, "point element");
    add(counts.texture_coordinates, "texture coordinate");
    if (!has_normals) add(counts.normals, "normal");
    return words;
}

bool looks_like_obj(std::span<const std::byte> first_bytes) {
    TextStatements statements(first_bytes);
    return statements.next() && std::ranges::find(keywords, statements.keyword()) != keywords.end();
}

PointCloud read_obj(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<ObjImage>();
    image->bytes = std::move(bytes);
    VertexReader vertices(image->bytes, shown);
    read_statements(*image, vertices, progress);
    if (image->counts.points == 0)
        throw Error(Trouble::input, shown,
                    "holds no vertices, lines 'v x y z', so there are no points in it");
    read_obj_elements(*image, shown, progress);
    PointCloud cloud;
    vertices.finish(*image, cloud);
    if (image->counts.normals > 0 && !image->has_normals)
        cloud.remarks.push_back("its " + counted(image->counts.normals, "normal") +
                                " cannot follow the points, since they are not one for each point; they are "
                                "kept as they are");
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead
