#include "bench/survey.h"

#include "base/error.h"
#include "base/quoted.h"

#include <charconv>
#include <fstream>
#include <span>
#include <string>
#include <type_traits>

namespace knead {

namespace {

namespace fs = std::filesystem;

// A text file, line by line, without remarks and blank lines.
class Lines {
public:
    explicit Lines(const fs::path& path) : path_(path.string()), file_(path) {
        if (!file_) throw Error(Trouble::input, path_, "cannot be opened");
    }

    // The next line as words; `expected` says what should have stood there.
    std::vector<std::string> next(const std::string& expected) {
        for (std::string line; std::getline(file_, line);) {
            ++number_;
            std::vector<std::string> words = words_of(line.substr(0, line.find('#')));
            if (!words.empty()) return words;
        }
        throw Error(Trouble::input, path_, "ends where " + expected + " should stand");
    }

    [[noreturn]] void refuse(const std::string& words) const {
        throw Error(Trouble::input, path_ + ":" + std::to_string(number_), words);
    }

    template<typename Number>
    Number number(const std::string& word) const {
        Number value{};
        const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failed != std::errc() || end != word.data() + word.size())
            refuse(quoted(word) + " is no " + (std::is_integral_v<Number> ? "whole number" : "number"));
        return value;
    }

    // As many numbers as there are places; more words on the line are not looked at.
    template<typename Number>
    void numbers(const std::string& expected, std::span<Number> values) {
        const std::vector<std::string> words = next(expected);
        if (words.size() < values.size()) refuse("here should stand " + expected);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = number<Number>(words[i]);
    }

private:
    static std::vector<std::string> words_of(const std::string& line) {
        constexpr const char* blanks = " \t\r";
        std::vector<std::string> words;
        for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string::npos;) {
            const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
            words.push_back(line.substr(begin, end - begin));
            begin = line.find_first_not_of(blanks, end);
        }
        return words;
    }

    std::string path_;
    std::ifstream file_;
    std::size_t number_ = 0;
};

PointCloud read_vertices(const fs::path& path) {
    Lines lines(path);
    if (lines.next("\"OFF\"") != std::vector<std::string>{"OFF"})
        lines.refuse("is no OFF file: its first line is not \"OFF\"");
    Index count = 0;
    lines.numbers("the numbers of vertices, faces and edges", std::span(&count, 1));
    if (count == 0) lines.refuse("holds no vertices");
    std::vector<float> positions;
    for (Index v = 0; v < count; ++v) {
        float place[3];
        lines.numbers("vertex " + std::to_string(v) + " of " + std::to_string(count),
                      std::span<float>(place));
        positions.insert(positions.end(), place, place + 3);
    }
    return make_cloud(positions);
}

void read_selection(const fs::path& path, DeformationTask& task) {
    Lines lines(path);
    for (Index v = 0; v < task.cloud.size(); ++v) {
        int status = 0;
        lines.numbers("the status of vertex " + std::to_string(v), std::span(&status, 1));
        if (status < 0 || status > 2)
            lines.refuse("a status is 0 (fixed), 1 (free) or 2 (handle), not " + std::to_string(status));
        if (status == 0) task.fixed.push_back(v);
        if (status == 2) task.handle.push_back(v);
    }
    if (task.fixed.empty()) lines.refuse("no vertex is fixed (status 0)");
    if (task.handle.empty()) lines.refuse("no vertex is in the handle (status 2)");
}

// The quaternion of a turn has two signs; here the one with w ≥ 0, the shorter way round.
HandlePose read_motion(const fs::path& path) {
    constexpr double rounding = 1e-3; // of matrices with six digits
    Lines lines(path);
    double matrix[4][4];
    for (auto& row : matrix) lines.numbers("four numbers of a 4×4 matrix", std::span<double>(row));
    Mat3d turn;
    HandlePose pose;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) turn(r, c) = matrix[r][c];
        pose.translate[r] = matrix[r][3];
    }
    const bool rigid = (turn.transpose() * turn - Mat3d::Identity()).norm() < rounding &&
                       turn.determinant() > 0 && pose.translate.allFinite();
    if (!rigid) lines.refuse("the matrix is no rigid motion");
    pose.rotate = Quatd(turn).normalized();
    if (pose.rotate.w() < 0) pose.rotate.coeffs() = -pose.rotate.coeffs();
    return pose;
}

} // namespace

DeformationTask read_survey_task(const fs::path& folder, std::string_view name) {
    const std::string stem = (folder / name).string();
    DeformationTask task;
    task.name = name;
    task.cloud = read_vertices(stem + ".off");
    read_selection(stem + ".sel", task);
    task.pose = read_motion(stem + ".def");
    return task;
}

std::vector<std::string> survey_names() {
    return {"bar", "cactus", "cylinder", "plane"};
}

std::optional<fs::path> survey_folder(const DataFolders& folders) {
    for (const std::string& name : survey_names())
        if (const auto found = find_data_file(folders, name + ".off")) return found->parent_path();
    return std::nullopt;
}

} // namespace knead
