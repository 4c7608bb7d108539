#pragma once
// What the tests of documents share: a desk where session lines go in and shapes come out.

#include "edit/document.h"
#include "shapes/shapes.h"
#include "support/comparing.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

namespace knead::test {

class Desk {
public:
    explicit Desk(PointCloud cloud, const Settings& settings = {}, unsigned threads = 2,
                  const std::string& device = "reference", Document::Mode mode = Document::Mode::real,
                  const UpsamplerMaker& maker = make_upsampler)
        : workers_(threads), upsampler_(maker(device, workers_, threads).upsampler),
          document_(std::move(cloud), settings, workers_, *upsampler_, mode) {}

    // Carries out session lines, without their header; line 1 is the first of them.
    Desk& play(const std::string& lines) {
        const Session session = parse_session(R"({"knead":1,"cloud":{"path":"a.ply"}})"
                                              "\n" +
                                                  lines + "\n",
                                              "s");
        for (const SessionLine& line : session.lines)
            std::visit([&](const auto& action) { act(action, "s:" + std::to_string(line.number - 1)); },
                       line.action);
        return *this;
    }

    std::vector<float> shape() { return document_.positions(progress_); }
    std::vector<float> normals() { return document_.normals(progress_); }
    double handle_error() { return document_.handle_error(progress_); }
    Document& document() { return document_; }
    const Pipeline& pipeline() const { return document_.pipeline(); }
    double diagonal() const { return document_.bounds().diagonal(); }

private:
    void act(const HandleLine& line, const std::string& place) { document_.declare(line, place); }
    void act(const DragLine& line, const std::string& place) { document_.drag(line, place, progress_); }
    void act(const SettleLine& line, const std::string& /*place*/) { document_.settle(line, progress_); }
    void act(const CheckLine& /*line*/, const std::string& /*place*/) {}
    void act(const CommitLine& /*line*/, const std::string& /*place*/) { document_.commit(progress_); }
    void act(const SetLine& line, const std::string& place) { document_.change_settings(line.change, place); }
    void act(const DeleteLine& line, const std::string& place) { document_.remove(line, place); }
    void act(const RenameLine& line, const std::string& place) { document_.rename(line, place); }
    void act(const UndoLine& /*line*/, const std::string& place) { document_.undo(place); }
    void act(const RedoLine& /*line*/, const std::string& place) { document_.redo(place); }

    Workers workers_;
    std::unique_ptr<Upsampler> upsampler_;
    SilentProgress progress_;
    Document document_;
};

// What the last of these lines is refused with.
inline std::string refusal(Desk& desk, const std::string& lines) {
    try {
        desk.play(lines);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input);
        return error.what();
    }
    return "accepted";
}

inline PointCloud made(Shape shape, std::size_t points) {
    Workers workers(1);
    SilentProgress progress;
    ShapeOptions options;
    options.points = points;
    return make_shape(shape, options, workers, progress);
}

// The bar of shapes/shapes.h: 1 × 1 × 5 along z, around the origin.
inline PointCloud bar(std::size_t points = 1500) {
    return made(Shape::bar, points);
}

// The ends of the bar.
inline const std::string foot =
    R"({"op":"handle","name":"foot","role":"fixed","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
    "\n";
inline const std::string top =
    R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})"
    "\n";
inline const std::string ends = foot + top;

// A handle of all that lies higher.
inline std::string above(const std::string& name, double z, const std::string& role = "roi") {
    return R"({"op":"handle","name":")" + name + R"(","role":")" + role +
           R"(","region":{"halfspace":{"point":[0,0,)" + std::to_string(z) + R"(],"normal":[0,0,1]}}})" +
           "\n";
}

// A drag in one frame, which is given in JSON, about the middle of the top.
inline std::string drag(const std::string& frame, const std::string& handle = "top") {
    return R"({"op":"drag","handle":")" + handle + R"(","pivot":[0,0,2.5],"frames":[)" + frame + "]}\n";
}

// A frame that turns by so many degrees about x, y or z.
inline std::string turn(char axis, double degrees, const std::string& translate = "[0,0,0]") {
    const double half = degrees * std::numbers::pi / 360;
    std::string text = R"({"translate":)" + translate + R"(,"rotate":[)" + std::to_string(std::cos(half));
    for (const char each : {'x', 'y', 'z'}) text += "," + std::to_string(each == axis ? std::sin(half) : 0.0);
    return text + "]}";
}

inline const std::string lift = R"({"translate":[0.5,0,0.25]})"; // exact in floats
inline const std::string undo = "{\"op\":\"undo\"}\n";
inline const std::string redo = "{\"op\":\"redo\"}\n";
inline const std::string commit = "{\"op\":\"commit\"}\n";
inline std::string settle(unsigned iterations) {
    return R"({"op":"settle","iterations":)" + std::to_string(iterations) + "}\n";
}
inline std::string set(const std::string& settings) {
    return R"({"op":"set",)" + settings + "}\n";
}

inline Vec3d at(std::span<const float> positions, std::size_t i) {
    return Eigen::Map<const Vec3f>(positions.data() + 3 * i).cast<double>();
}

inline bool all_finite(const std::vector<float>& values) {
    return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

// The same frame, for which few samples answer.
inline std::string coarse(std::string frame) {
    return frame.insert(frame.size() - 1, R"(,"coarse":true)");
}

// The largest distance of a point that `chosen` names (by its rest position) from where `target` sends it.
inline double farthest(Desk& desk, const std::function<bool(const Vec3d&)>& chosen,
                       const std::function<Vec3d(const Vec3d&)>& target) {
    const std::vector<float> shape = desk.shape();
    double largest = 0;
    for (std::size_t i = 0; i < desk.document().cloud().size(); ++i) {
        const Vec3d rest = at(desk.document().cloud().positions, i);
        if (chosen(rest)) largest = std::max(largest, (at(shape, i) - target(rest)).norm());
    }
    return largest;
}
inline Vec3d stays(const Vec3d& p) {
    return p;
}
inline bool every(const Vec3d& /*p*/) {
    return true;
}

} // namespace knead::test
