#include "deform/bodies.h"

#include "base/new_processors.h"

namespace knead {

BodiesAround bodies_around(const PointEnergy& energy, std::span<const Body> all, Index sample) {
    const std::size_t first = energy.first[sample], count = energy.first[sample + 1] - first;
    return {
        std::span(energy.pair).subspan(first, count), std::span(energy.slopes).subspan(first, count),
        std::span(energy.fits).subspan(first, count), std::span(energy.map_products).subspan(first, count),
        std::span(energy.body).subspan(first, count), all};
}

KNEAD_FOR_NEW_PROCESSORS_TOO
Mat3d local_sum_of(const BodiesAround& around, double midway) {
    Columns moved, wanted;
    for (std::size_t at = 0; at < around.slopes.size(); ++at) {
        const PairSlopes& slopes = around.slopes[at];
        const Body& body = around.all[around.body[at]];
        for (int column = 0; column < 3; ++column) moved.of[column] += body.way * slopes.way_slope[column];
        add_product(body.map, slopes.map_slope, moved);
        add_product(body.turn, slopes.target_spread, wanted);
    }
    Mat3d sum;
    for (int column = 0; column < 3; ++column)
        sum.col(column) = vector_of(moved.of[column] - midway * wanted.of[column]);
    return sum;
}

KNEAD_FOR_NEW_PROCESSORS_TOO
Vec3d force_of(const BodiesAround& around) {
    Four moved = {}, wanted = {};
    for (std::size_t at = 0; at < around.pair.size(); ++at) {
        const BodyPair& pair = around.pair[at];
        const Body& body = around.all[around.body[at]];
        add_product(body.map, pair.map_force, moved);
        add_product(body.turn, pair.target_force, wanted);
        if (body.placed) moved += body.way * pair.way;
    }
    return vector_of(wanted - moved);
}

KNEAD_FOR_NEW_PROCESSORS_TOO
Columns misfit_of(const BodiesAround& around) {
    Columns moved, wanted;
    for (std::size_t at = 0; at < around.fits.size(); ++at) {
        const PairFits& fits = around.fits[at];
        const Body& body = around.all[around.body[at]];
        for (int column = 0; column < 3; ++column) moved.of[column] += body.way * fits.way[column];
        add_product(body.map, around.map_products[at], moved);
        add_product(body.turn, fits.target, wanted);
    }
    for (int column = 0; column < 3; ++column) wanted.of[column] -= moved.of[column];
    return wanted;
}

} // namespace knead
