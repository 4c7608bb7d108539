// Clouds far from the origin: an edit does to them what it does to their twins at zero, and they come back in
// their own frame.

#include "edit/editing.h"
#include "edit/replay.h"
#include "io/cloud_file.h"
#include "io/format.h"
#include "support/scratch_folder.h"

#include <iomanip>
#include <sstream>

namespace knead {
namespace {

using namespace test;

const Vec3d utm(431234.567, 5403123.321, 812.45);

// The bar with its middle at `middle`, in double; it came from no file.
PointCloud bar_at(const Vec3d& middle) {
    const PointCloud at_zero = bar(1500);
    PointCloud cloud;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Attribute column{std::string(1, "xyz"[axis]), ScalarType::float64, {}, {}, ScalarType::uint8};
        for (std::size_t i = 0; i < at_zero.size(); ++i) {
            const double value =
                at_zero.file_position(i)[static_cast<int>(axis)] + middle[static_cast<int>(axis)];
            const auto bytes = std::as_bytes(std::span(&value, 1));
            column.values.insert(column.values.end(), bytes.begin(), bytes.end());
        }
        cloud.coordinate_columns[axis] = axis;
        cloud.attributes.push_back(std::move(column));
    }
    set_positions_from_columns(cloud);
    return cloud;
}

void write_as_text(const std::filesystem::path& path, const PointCloud& cloud) {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << cloud.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
         << std::fixed << std::setprecision(6);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3d p = cloud.file_position(i);
        text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    write_text(path, text.str());
}

// Twists and bends it about a middle, with the foot held.
std::string session_about(const std::string& file, const Vec3d& middle) {
    const auto vector = [&](double x, double y, double z) {
        std::ostringstream text;
        text << std::setprecision(17) << '[' << middle.x() + x << ',' << middle.y() + y << ','
             << middle.z() + z << ']';
        return text.str();
    };
    const std::string handle = R"({"op":"handle","name":)";
    return R"({"knead":1,"cloud":{"path":")" + file + "\"}}\n" + handle +
           R"("foot","role":"fixed","region":{"halfspace":{"point":)" + vector(0, 0, -1.97) +
           R"(,"normal":[0,0,-1]}}})"
           "\n" +
           handle + R"("top","role":"moving","region":{"halfspace":{"point":)" + vector(0, 0, 1.97) +
           R"(,"normal":[0,0,1]}}})"
           "\n"
           R"({"op":"drag","handle":"top","pivot":)" +
           vector(0, 0, 2.5) + ",\"frames\":[" + turn('z', 40) + "," + turn('x', 35, "[0.2,0.3,-0.4]") +
           "]}\n" + settle(8);
}

struct Bent {
    PointCloud before, after;
    std::vector<std::string> warnings;
};
Bent bent(const std::string& extension, const Vec3d& middle) {
    const ScratchFolder folder;
    SilentProgress progress;
    const bool text = extension == "-text.ply";
    const std::string name = "cloud" + extension;
    if (text)
        write_as_text(folder / name, bar_at(middle));
    else
        (void)write_cloud(folder / name, bar_at(middle), {}, progress);
    write_text(folder / "s.knead", session_about(name, middle));
    ReplayOptions options;
    options.out = folder / ("bent" + extension);
    options.device = "reference";
    options.threads = 2;
    Bent result;
    result.warnings =
        replay(read_session(folder / "s.knead"), options, progress, [](const std::string&) {}).warnings;
    result.before = read_cloud(folder / name, progress);
    result.after = read_cloud(*options.out, progress);
    return result;
}

TEST(FarCoordinates, ACloudAtUtmDeformsLikeItsTwinAtZeroInEveryFormat) {
    std::vector<std::string> endings{"-text.ply"};
    for (const Format& format : known_formats()) endings.emplace_back(format.extensions.front());
    for (const std::string& extension : endings) {
        SCOPED_TRACE(extension);
        const Bent near = bent(extension, Vec3d::Zero());
        const Bent far = bent(extension, utm);
        EXPECT_TRUE(far.warnings.empty());
        ASSERT_EQ(far.after.size(), near.after.size());
        const double diagonal = bounds_of(near.before).diagonal();
        double apart = 0, largest_move = 0;
        std::size_t resting = 0;
        for (std::size_t i = 0; i < far.after.size(); ++i) {
            apart = std::max(apart, (far.after.file_position(i) - utm - near.after.file_position(i)).norm());
            const double move = (far.after.file_position(i) - far.before.file_position(i)).norm();
            largest_move = std::max(largest_move, move);
            resting += move == 0 ? 1 : 0; // bit for bit
        }
        EXPECT_LT(apart, 1e-5 * diagonal);
        EXPECT_GT(largest_move, 0.5);
        EXPECT_GT(resting, 100U); // the foot
        EXPECT_EQ(file_kind(far.after).encoding, file_kind(far.before).encoding);
        // Steps of 4-byte floats would be 0.5 there.
        std::size_t between = 0;
        for (std::size_t i = 0; i < far.after.size(); ++i)
            between += std::abs(std::remainder(far.after.file_position(i).y(), 0.5)) > 1e-3 ? 1 : 0;
        EXPECT_GT(between, far.after.size() / 2);
    }
}

} // namespace
} // namespace knead
