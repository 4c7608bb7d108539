#include "io/obj_elements.h"

#include "base/error.h"
#include "io/text_numbers.h"
#include "io/text_statements.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace knead {

namespace {

constexpr std::size_t statements_between_reports = std::size_t{1} << 16;

// In place of the number of a point or a normal: there are several.
constexpr Index several = no_index - 1;

// Whose normal is whose, as far as the corners have said it.
struct Owners {
    std::vector<Index> point_of_normal;
    std::vector<Index> normal_of_point;

    void meet(Index point, Index normal) {
        const auto note = [](Index& known, Index one) {
            known = known == no_index || known == one ? one : several;
        };
        note(point_of_normal[normal], point);
        note(normal_of_point[point], normal);
    }

    // A face names this point without a normal.
    void meet(Index point) { normal_of_point[point] = several; }

    bool are_pairs() const {
        return std::ranges::find(point_of_normal, several) == point_of_normal.end() &&
               std::ranges::find(normal_of_point, several) == normal_of_point.end();
    }
};

// What may be counted from the end of.
struct SoFar {
    std::size_t points = 0, texture_coordinates = 0, normals = 0;
};

class ElementReader {
public:
    ElementReader(const ObjImage& image, const std::string& shown)
        : image_(image), source_{image.bytes, shown} {
        if (image.counts.normals == 0) return;
        owners_.point_of_normal.assign(image.counts.normals, no_index);
        owners_.normal_of_point.assign(image.counts.points, no_index);
    }

    // A word of an element: a point's number, and behind slashes those of a texture coordinate and a normal,
    // which may be left out.
    void corner(std::string_view keyword, std::string_view word, const SoFar& so_far) {
        word_ = word;
        std::string_view rest = word;
        const std::size_t point = number(rest, image_.counts.points, so_far.points, "point");
        if (part(rest))
            number(rest, image_.counts.texture_coordinates, so_far.texture_coordinates, "texture coordinate");
        if (part(rest)) {
            const std::size_t normal = number(rest, image_.counts.normals, so_far.normals, "normal");
            owners_.meet(static_cast<Index>(point), static_cast<Index>(normal));
            ++corners_with_normals_;
        } else if (keyword.front() == 'f' && image_.counts.normals > 0) {
            owners_.meet(static_cast<Index>(point));
        }
        if (!rest.empty())
            fail("is no corner of " + in_quotes(keyword) + "; a corner is point/texture/normal");
    }

    void finish(ObjImage& image) && {
        const ObjCounts& counts = image.counts;
        if (counts.normals == 0) return;
        if (corners_with_normals_ == 0 && counts.normals == counts.points) {
            image.has_normals = true;
            for (Index i = 0; i < counts.points; ++i) owners_.point_of_normal[i] = i;
        } else {
            image.has_normals = corners_with_normals_ > 0 && owners_.are_pairs();
            if (counts.normals == counts.points) pair_the_rest();
        }
        if (image.has_normals) image.point_of_normal = std::move(owners_.point_of_normal);
    }

private:
    // Where as many normals as points go by their numbers at every corner, those at no corner do so, too.
    void pair_the_rest() {
        std::vector<Index>& point_of = owners_.point_of_normal;
        for (Index i = 0; i < point_of.size(); ++i)
            if (point_of[i] != no_index && point_of[i] != i) return;
        std::iota(point_of.begin(), point_of.end(), Index{0});
    }

    // Steps over a slash, if there is one; whether a number follows it.
    static bool part(std::string_view& rest) {
        if (!rest.starts_with('/')) return false;
        rest.remove_prefix(1);
        return !rest.empty() && rest.front() != '/';
    }

    // The number at the start of `rest`, from 0: in the file it counts from 1, or backwards from -1.
    std::size_t number(std::string_view& rest, std::size_t all, std::size_t so_far, const char* what) const {
        std::int64_t value = 0;
        const auto [end, trouble] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (trouble == std::errc::invalid_argument)
            fail("has no number of a " + std::string(what) + "; a corner is point/texture/normal");
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        const bool there =
            trouble == std::errc{} && (value > 0 ? static_cast<std::uint64_t>(value) <= all
                                                 : value < 0 && value >= -static_cast<std::int64_t>(so_far));
        if (!there)
            fail("names a " + std::string(what) + " that is not in the file, which has " +
                 std::to_string(all) + (value < 0 ? " (" + std::to_string(so_far) + " so far)" : "") +
                 "; correct the number, counted from 1");
        return value > 0 ? static_cast<std::size_t>(value) - 1 : so_far - static_cast<std::size_t>(-value);
    }

    [[noreturn]] void fail(const std::string& words) const { source_.fail(word_, words); }

    const ObjImage& image_;
    StatementSource source_;
    Owners owners_;
    std::size_t corners_with_normals_ = 0;
    std::string_view word_; // for messages
};

} // namespace

void read_obj_elements(ObjImage& image, const std::string& shown, Progress& progress) {
    ElementReader reader(image, shown);
    SoFar so_far;
    TextStatements statements(image.bytes);
    for (std::size_t statement = 0; statements.next(); ++statement) {
        if (statement % statements_between_reports == 0)
            progress.step("checking",
                          static_cast<double>(statements.at()) / static_cast<double>(image.bytes.size()));
        const std::string_view keyword = statements.keyword();
        if (keyword == "v") ++so_far.points;
        if (keyword == "vt") ++so_far.texture_coordinates;
        if (keyword == "vn") ++so_far.normals;
        if (keyword == "f" || keyword == "fo" || keyword == "l" || keyword == "p")
            while (const auto word = statements.word()) reader.corner(keyword, *word, so_far);
    }
    std::move(reader).finish(image);
}

} // namespace knead
