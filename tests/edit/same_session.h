#pragma once
// Whether two things of a session are the same, numbers to the last bit.

#include "edit/session.h"

#include <algorithm>
#include <bit>
#include <type_traits>
#include <variant>
#include <vector>

namespace knead::test {

inline bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same(const Vec3d& a, const Vec3d& b) {
    return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}
inline bool same(const Quatd& a, const Quatd& b) {
    return same(a.w(), b.w()) && same(Vec3d(a.vec()), Vec3d(b.vec()));
}
inline bool same(const HandlePose& a, const HandlePose& b) {
    return same(a.translate, b.translate) && same(a.rotate, b.rotate) && same(a.scale, b.scale) &&
           same(a.axes, b.axes) && a.coarse == b.coarse;
}
inline bool same(const IndexRange& a, const IndexRange& b) {
    return a.first == b.first && a.last == b.last;
}
inline bool same(const BoxRegion& a, const BoxRegion& b) {
    return same(a.lowest, b.lowest) && same(a.highest, b.highest);
}
inline bool same(const SphereRegion& a, const SphereRegion& b) {
    return same(a.center, b.center) && same(a.radius, b.radius);
}
inline bool same(const HalfspaceRegion& a, const HalfspaceRegion& b) {
    return same(a.point, b.point) && same(a.normal, b.normal);
}
inline bool same(const WholeRegion& /*a*/, const WholeRegion& /*b*/) {
    return true;
}

template<typename Element>
bool same(const std::vector<Element>& a, const std::vector<Element>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Element& left, const Element& right) { return same(left, right); });
}
inline bool same(const Region& a, const Region& b) {
    return a.index() == b.index() &&
           std::visit(
               [&b](const auto& left) { return same(left, std::get<std::decay_t<decltype(left)>>(b)); }, a);
}

inline bool same(const HandleLine& a, const HandleLine& b) {
    if (a.name != b.name || a.role != b.role || a.points.index() != b.points.index()) return false;
    if (a.color != b.color || a.free_rotation != b.free_rotation || !same(a.falloff, b.falloff)) return false;
    if (const auto* points = std::get_if<std::vector<IndexRange>>(&a.points))
        return same(*points, std::get<std::vector<IndexRange>>(b.points));
    return same(std::get<Region>(a.points), std::get<Region>(b.points));
}
inline bool same(const DragLine& a, const DragLine& b) {
    return a.handle == b.handle && same(a.pivot, b.pivot) && same(a.frames, b.frames);
}
inline bool same(const SettleLine& a, const SettleLine& b) {
    return a.iterations == b.iterations;
}
inline bool same(const CheckLine& a, const CheckLine& b) {
    return a.positions == b.positions && same(a.tolerance, b.tolerance);
}
inline bool same(const SetLine& a, const SetLine& b) {
    return a.change.neighbors == b.change.neighbors && a.change.samples == b.change.samples &&
           a.change.samples.has_value() == b.change.samples.has_value() &&
           a.change.iterations == b.change.iterations && a.change.stiffness == b.change.stiffness &&
           a.change.poisson == b.change.poisson && a.change.weights == b.change.weights &&
           a.change.strays == b.change.strays;
}
inline bool same(const DeleteLine& a, const DeleteLine& b) {
    return a.handle == b.handle;
}
inline bool same(const RenameLine& a, const RenameLine& b) {
    return a.handle == b.handle && a.to == b.to;
}
inline bool same(const CommitLine& /*a*/, const CommitLine& /*b*/) {
    return true;
}
inline bool same(const UndoLine& /*a*/, const UndoLine& /*b*/) {
    return true;
}
inline bool same(const RedoLine& /*a*/, const RedoLine& /*b*/) {
    return true;
}
inline bool same(const SessionAction& a, const SessionAction& b) {
    return a.index() == b.index() &&
           std::visit(
               [&b](const auto& left) { return same(left, std::get<std::decay_t<decltype(left)>>(b)); }, a);
}

} // namespace knead::test
