#include "edit/survey_shape.h"

#include "base/require.h"

#include <fstream>
#include <sstream>
#include <vector>

namespace knead::test {

namespace {

// The numbers of a file, its comments left out.
std::vector<double> numbers_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    require(file.good(), "a survey shape is complete");
    std::vector<double> numbers;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        for (std::string word; words >> word;)
            if (word != "OFF") numbers.push_back(std::stod(word));
    }
    return numbers;
}

std::string listed(const std::vector<double>& owners, double owner) {
    std::string points;
    for (std::size_t i = 0; i < owners.size(); ++i)
        if (owners[i] == owner) points += (points.empty() ? "" : ",") + std::to_string(i);
    return points;
}

std::string handle(const std::string& name, const std::string& role, const std::string& points) {
    return R"({"op":"handle","name":")" + name + R"(","role":")" + role + R"(","points":[)" + points + "]}\n";
}

} // namespace

SurveyShape read_survey_shape(const std::filesystem::path& off_file) {
    const auto beside = [&](const char* extension) {
        return std::filesystem::path(off_file).replace_extension(extension);
    };
    const std::vector<double> mesh = numbers_of(off_file);
    const auto vertices = static_cast<std::size_t>(mesh.at(0));
    require(mesh.size() >= 3 + 3 * vertices, "an OFF file has its vertices");
    std::vector<float> positions;
    for (std::size_t i = 0; i < 3 * vertices; ++i) positions.push_back(static_cast<float>(mesh[3 + i]));

    const std::vector<double> owners = numbers_of(beside(".sel"));
    require(owners.size() == vertices, "a selection has a number a vertex");
    const std::vector<double> matrix = numbers_of(beside(".def"));
    require(matrix.size() == 16, "a deformation is a 4 × 4 matrix");
    Eigen::Matrix4d motion;
    for (int i = 0; i < 16; ++i) motion(i / 4, i % 4) = matrix[static_cast<std::size_t>(i)];
    Quatd turn(Mat3d(motion.topLeftCorner<3, 3>()));
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();

    std::ostringstream drag;
    drag.precision(17);
    drag << R"({"op":"drag","handle":"moving","pivot":[0,0,0],"frames":[{"translate":[)" << motion(0, 3)
         << ',' << motion(1, 3) << ',' << motion(2, 3) << R"(],"rotate":[)" << turn.w() << ',' << turn.x()
         << ',' << turn.y() << ',' << turn.z() << "]}]}\n";
    return {make_cloud(positions),
            handle("fixed", "fixed", listed(owners, 0)) + handle("moving", "moving", listed(owners, 2)),
            drag.str()};
}

} // namespace knead::test
