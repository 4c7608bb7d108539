#include "render/scattered.h"
#include "render/software_pixels.h"
#include "render/splats.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

constexpr int rows_in_band = 32;

// A point on the screen. Pixels from the upper left corner.
struct Splat {
    float x, y, depth, radius;
    std::uint32_t color;
    float bulge;            // of a disc, as in splats.h
    float slope_x, slope_y; // to the right, and downwards
};

// No pixel of a splat is nearer than that.
float nearest_depth(const Splat& splat) {
    const float steep = splat.slope_x * splat.slope_x + splat.slope_y * splat.slope_y;
    return splat.depth - splat.bulge * 0.25f * tilt_over_bulge * tilt_over_bulge * steep / (1 + 0.5f * steep);
}

// Some splats that follow each other, and so lie close together: where they are, and the nearest depth. Most
// that lie behind others are left out by that alone.
constexpr std::size_t splats_in_group = 64;
struct Group {
    float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f;
    float depth = 2;

    void add(const Splat& splat) {
        left = std::min(left, splat.x - splat.radius);
        right = std::max(right, splat.x + splat.radius);
        top = std::min(top, splat.y - splat.radius);
        bottom = std::max(bottom, splat.y + splat.radius);
        depth = std::min(depth, nearest_depth(splat));
    }
};

// What is seen of a chunk.
struct Batch {
    std::span<const std::uint16_t> slots; // that belong to the subset
    std::span<const std::uint16_t> order; // of the chunk
    std::size_t end = 0;                  // one past the last of the slots
    std::size_t first = 0, count = 0;     // of the splats
    std::size_t first_group = 0;
    float top = 0, bottom = 0; // the rows that they reach
};

// Three floats a point, in every chunk in scattered order. They come in that of the cloud, every frame while
// something is dragged, and then few are drawn: so what is drawn is put in order when it is drawn.
class ScatteredVectors {
public:
    // All of them, of which these chunks are new; the caller's, good until the next call.
    void take(std::span<const float> vectors, std::span<const Index> chunks) {
        given_ = vectors;
        values_.resize(vectors.size());
        ready_.resize(chunks_of(vectors.size() / 3), 0);
        for (const Index chunk : chunks) ready_[chunk] = 0;
    }
    // Before slots of a chunk are asked for: it puts the first `count` in order, of which `order` tells the
    // places. Different chunks may have different threads.
    void make_ready(std::size_t chunk, std::span<const std::uint16_t> order, std::size_t count) {
        std::uint16_t& ready = ready_[chunk];
        const float* const own = given_.data() + 3 * chunk * points_in_chunk;
        float* const kept = values_.data() + 3 * chunk * points_in_chunk;
        for (std::size_t slot = ready; slot < count; ++slot)
            for (std::size_t i = 0; i < 3; ++i) kept[3 * slot + i] = own[3 * std::size_t{order[slot]} + i];
        ready = std::max(ready, static_cast<std::uint16_t>(count));
    }
    // Of the point in this slot, counted through all chunks.
    const float* operator[](std::size_t slot) const { return &values_[3 * slot]; }

private:
    std::span<const float> given_;
    std::vector<float> values_;
    std::vector<std::uint16_t> ready_; // slots of each chunk, from the first one on
};

// In every chunk in scattered order.
struct Points {
    ScatteredVectors positions, normals;
    std::vector<std::uint32_t> tinted;
    std::vector<std::uint8_t> widths; // or empty
};

std::size_t end_of(std::span<const std::uint16_t> slots) {
    return slots.empty() ? 0 : std::size_t{std::ranges::max(slots)} + 1;
}

// Times the usual width.
float width_of(std::uint8_t width) {
    static const auto table = [] {
        std::array<float, 256> widths{};
        for (std::size_t w = 0; w < widths.size(); ++w)
            widths[w] = static_cast<float>(std::exp2(static_cast<double>(w) / widths_in_double));
        return widths;
    }();
    return table[width];
}

std::uint32_t lit(std::uint32_t color, const float* normal, const SplatView& view) {
    const glm::vec3 n(normal[0], normal[1], normal[2]);
    const float side = glm::dot(n, view.forward) > 0 ? -0.5f : 0.5f; // both sides are lit
    const float light = 0.5f + side * glm::dot(n, view.key);
    const float brightness = 0.40f + 0.64f * light * light;
    const auto part = [&](unsigned shift) {
        const float value = static_cast<float>(color >> shift & 0xffU) * brightness + 0.5f;
        return static_cast<std::uint32_t>(std::min(value, 255.0f)) << shift;
    };
    return part(0) | part(8) | part(16) | (color & 0xff000000U);
}

// Where a point lies on the screen; false if it does not.
bool project(const Points& points, std::size_t i, const SplatView& view, const Pixels& layer, Splat& splat) {
    const std::uint32_t color = points.tinted[i];
    if (color == 0) return false; // hidden
    const float* p = points.positions[i];
    const glm::vec4 clip =
        view.to_clip[0] * p[0] + view.to_clip[1] * p[1] + view.to_clip[2] * p[2] + view.to_clip[3];
    if (!(clip.z >= -clip.w && clip.z < clip.w)) return false; // nor if not finite
    const float part = 1 / clip.w;
    const float width = static_cast<float>(layer.width), height = static_cast<float>(layer.height);
    splat.x = (0.5f + 0.5f * clip.x * part) * width;
    splat.y = (0.5f - 0.5f * clip.y * part) * height;
    const float wider = points.widths.empty() ? 1 : width_of(points.widths[i]);
    const float diameter = diameter_of(view, view.fixed + view.by_distance * wider * part);
    splat.radius = 0.5f * diameter;
    if (!(splat.x > -splat.radius && splat.x < width + splat.radius && splat.y > -splat.radius &&
          splat.y < height + splat.radius))
        return false;
    splat.depth = 0.5f + 0.5f * clip.z * part;
    splat.color = view.shaded ? lit(color, points.normals[i], view) : color;
    splat.bulge = splat.slope_x = splat.slope_y = 0;
    if (diameter > widest_square) {
        const float back = bulge_over_diameter * diameter * view.pixel_size * clip.w;
        const glm::vec3 f = view.forward * back;
        const glm::vec4 rim = clip + view.to_clip[0] * f.x + view.to_clip[1] * f.y + view.to_clip[2] * f.z;
        splat.bulge = 0.5f + 0.5f * rim.z / rim.w - splat.depth;
        if (view.shaded) {
            const float* const n = points.normals[i];
            const glm::vec2 slope = slope_of(view, {n[0], n[1], n[2]}, clip.x * part, clip.y * part);
            splat.slope_x = slope.x;
            splat.slope_y = -slope.y;
        }
    }
    return true;
}

// The rows or columns whose middles lie between two places, from `least` to below `most`.
struct Span {
    int first, end;
};
Span middles_between(float low, float high, int least, int most) {
    const int first = static_cast<int>(std::ceil(low - 0.5f)), end = static_cast<int>(std::ceil(high - 0.5f));
    return {std::max(first, least), std::min(end, most)};
}

void draw_square(const Splat& splat, int first, int end, Pixels& layer) {
    const Span rows = middles_between(splat.y - splat.radius, splat.y + splat.radius, first, end);
    const Span columns = middles_between(splat.x - splat.radius, splat.x + splat.radius, 0, layer.width);
    for (int y = rows.first; y < rows.end; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * layer.row();
        for (int x = columns.first; x < columns.end; ++x) {
            const std::size_t at = row + static_cast<std::size_t>(x);
            if (splat.depth >= layer.depths[at]) continue;
            layer.depths[at] = splat.depth;
            layer.colors[at] = splat.color;
        }
    }
}

// Of a row of a splat's pixels, lengths in pixels: `dx` from the middle to the first of them, `height` the
// square of how far above or below the middle they are, and s·t where dx is 0.
struct DiscRow {
    float dx, height, fall;
};
// Of the splat: the square of its radius, s to the right, and what depths are made of.
struct Disc {
    float reach, slope, depth, curve, tilt;
    std::uint32_t color;
};

[[gnu::always_inline]] inline void draw_lanes(const DiscRow& row, const Disc& disc, float* depths,
                                              std::uint32_t* colors) {
    constexpr Floats steps = {0, 1, 2, 3, 4, 5, 6, 7};
    const Floats away = row.dx + steps, fall = row.fall + disc.slope * away;
    const Floats squared = away * away + row.height + 0.5f * fall * fall;
    const Floats here = disc.depth + disc.curve * squared + disc.tilt * fall;
    Floats there;
    Words before;
    std::memcpy(&there, depths, sizeof there);
    std::memcpy(&before, colors, sizeof before);
    const Mask wins = (squared < disc.reach) & (here < there);
    there = wins ? here : there;
    before = wins ? disc.color - Words{} : before;
    std::memcpy(depths, &there, sizeof there);
    std::memcpy(colors, &before, sizeof before);
}

KNEAD_FOR_NEW_PROCESSORS_TOO
void draw_disc(const Splat& splat, int first, int end, Pixels& layer) {
    const float reach = splat.radius * splat.radius;
    const float curve = splat.bulge / reach, tilt = splat.bulge * tilt_over_bulge / splat.radius;
    const Disc disc{reach, splat.slope_x, splat.depth, curve, tilt, splat.color};
    const Span rows = middles_between(splat.y - splat.radius, splat.y + splat.radius, first, end);
    const Span columns = middles_between(splat.x - splat.radius, splat.x + splat.radius, 0, layer.width);
    DiscRow row{};
    for (int y = rows.first; y < rows.end; ++y) {
        const float dy = static_cast<float>(y) + 0.5f - splat.y;
        row.height = dy * dy;
        row.fall = splat.slope_y * dy;
        const std::size_t at =
            static_cast<std::size_t>(y) * layer.row() + static_cast<std::size_t>(columns.first);
        for (int x = 0; x < columns.end - columns.first; x += lanes) {
            row.dx = static_cast<float>(columns.first + x) + 0.5f - splat.x;
            draw_lanes(row, disc, layer.depths.data() + at + x, layer.colors.data() + at + x);
        }
    }
}

// Whether all of the group's pixels in these rows already show something nearer.
KNEAD_FOR_NEW_PROCESSORS_TOO
bool is_hidden(const Group& group, int first, int end, const Pixels& layer) {
    const Span rows = middles_between(group.top, group.bottom, first, end);
    const Span columns = middles_between(group.left, group.right, 0, layer.width);
    for (int y = rows.first; y < rows.end; ++y) {
        const float* const depths = layer.depths.data() + static_cast<std::size_t>(y) * layer.row();
        Mask farther{};
        for (int x = columns.first; x < columns.end; x += lanes) {
            Floats there;
            std::memcpy(&there, depths + x, sizeof there);
            constexpr Mask places = {0, 1, 2, 3, 4, 5, 6, 7};
            farther |= (there > group.depth) & (places < columns.end - x);
        }
        for (int i = 0; i < lanes; ++i)
            if (farther[i] != 0) return false;
    }
    return true;
}

void draw_group(const Group& group, std::span<const Splat> splats, int first, int end, Pixels& layer) {
    if (group.bottom < static_cast<float>(first) || group.top > static_cast<float>(end) ||
        is_hidden(group, first, end, layer))
        return;
    for (const Splat& splat : splats) {
        if (2 * splat.radius <= widest_square)
            draw_square(splat, first, end, layer);
        else
            draw_disc(splat, first, end, layer);
    }
}

class SoftwareSplats final : public Splats {
public:
    explicit SoftwareSplats(Workers& workers) : workers_(workers) {}

    void set_points(std::size_t n) override {
        last_order_ = scattered_order(n % points_in_chunk);
        points_.tinted.resize(n);
        points_.widths.clear();
    }
    void set_positions(std::span<const float> positions, std::span<const Index> chunks) override {
        points_.positions.take(positions, chunks);
    }
    void set_normals(std::span<const float> normals, std::span<const Index> chunks) override {
        points_.normals.take(normals, chunks);
    }
    void set_widths(std::span<const std::uint8_t> widths) override {
        points_.widths.clear();
        if (!widths.empty()) scatter(widths, points_.widths);
    }
    void set_tinted(std::span<const std::uint32_t> tinted) override { scatter(tinted, points_.tinted); }

    // The result does not depend on the number of threads: every band of rows belongs to one, who draws all
    // splats in their order.
    std::size_t draw(std::span<const PointRange> ranges, std::size_t subset, std::size_t stride,
                     const SplatView& view, Layer& /*layer*/, bool clear) override {
        if (clear) clear_pixels(view.viewport);
        const std::size_t drawn = make_room(ranges, subset, stride);
        workers_.for_each(ranges.size(), 4, [&](std::size_t r) {
            make_ready(ranges[r].first / points_in_chunk, view.shaded, batches_[r]);
            see(ranges[r].first, view, batches_[r]);
        });
        const auto bands = static_cast<std::size_t>((pixels_.height + rows_in_band - 1) / rows_in_band);
        workers_.for_each(bands, 1,
                          [&](std::size_t band) { draw_band(static_cast<int>(band) * rows_in_band); });
        return drawn;
    }

    void finish(const ScreenPass& pass, const Overlay& overlay, Layer& /*shown*/, bool is_new,
                Layer& finished) override {
        if (is_new)
            screen_.compose(pass, pixels_, flat_lines(overlay.lines, overlay.view, pass.viewport), workers_);
        bind_layer(finished, pass.viewport, false);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(pixels_.row()));
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, *finished.color);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pass.viewport.width, pass.viewport.height, GL_BGRA,
                        GL_UNSIGNED_BYTE, screen_.picture().data());
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    }

    bool by_processor() const override { return true; }

private:
    std::span<const std::uint16_t> order_of(std::size_t chunk, std::size_t points) const {
        return (chunk + 1) * points_in_chunk <= points ? order_ : last_order_;
    }

    // A number a point.
    template<typename Number>
    void scatter(std::span<const Number> from, std::vector<Number>& to) {
        to.resize(from.size());
        workers_.for_each(chunks_of(from.size()), 16, [&](std::size_t chunk) {
            const Number* const own = from.data() + chunk * points_in_chunk;
            Number* next = to.data() + chunk * points_in_chunk;
            for (const std::uint16_t place : order_of(chunk, from.size())) *next++ = own[place];
        });
    }

    void clear_pixels(Viewport size) {
        pixels_.width = size.width;
        pixels_.height = size.height;
        const std::size_t count = pixels_.row() * static_cast<std::size_t>(size.height);
        pixels_.colors.resize(count);
        pixels_.depths.resize(count);
        workers_.for_chunks(count, std::size_t{1} << 16U, [this](std::size_t begin, std::size_t end) {
            std::fill(pixels_.colors.data() + begin, pixels_.colors.data() + end, 0U);
            std::fill(pixels_.depths.data() + begin, pixels_.depths.data() + end, 1.0f);
        });
    }

    // Room for a splat of every point of the subset; returns how many.
    std::size_t make_room(std::span<const PointRange> ranges, std::size_t subset, std::size_t stride) {
        const PartOfChunk own = part_of_chunk(subset, stride);
        slots_ = slots_of_part(order_, own.part, own.parts);
        last_slots_ = slots_of_part(last_order_, own.part, own.parts);
        const std::size_t slots_end = end_of(slots_), last_slots_end = end_of(last_slots_);
        batches_.resize(ranges.size());
        std::size_t room = 0, groups = 0;
        for (std::size_t r = 0; r < ranges.size(); ++r) {
            Batch& batch = batches_[r];
            const bool whole = ranges[r].end - ranges[r].first == points_in_chunk;
            batch.slots = whole ? slots_ : last_slots_;
            batch.order = whole ? order_ : last_order_;
            batch.end = whole ? slots_end : last_slots_end;
            if (ranges[r].first / points_in_chunk % own.step != own.rest) batch.slots = {};
            batch.first = room;
            batch.first_group = groups;
            room += batch.slots.size();
            groups += (batch.slots.size() + splats_in_group - 1) / splats_in_group;
        }
        if (splats_.size() < room) splats_.resize(room);
        groups_.resize(groups);
        return room;
    }

    void make_ready(std::size_t chunk, bool shaded, const Batch& batch) {
        if (batch.slots.empty()) return;
        points_.positions.make_ready(chunk, batch.order, batch.end);
        if (shaded) points_.normals.make_ready(chunk, batch.order, batch.end);
    }

    void see(std::size_t first_point, const SplatView& view, Batch& batch) {
        Splat* const seen = splats_.data() + batch.first;
        batch.count = 0;
        batch.top = static_cast<float>(pixels_.height);
        batch.bottom = 0;
        Group group;
        const auto finish_group = [&] {
            groups_[batch.first_group + (batch.count - 1) / splats_in_group] = group;
            batch.top = std::min(batch.top, group.top);
            batch.bottom = std::max(batch.bottom, group.bottom);
            group = {};
        };
        for (const std::uint16_t slot : batch.slots) {
            Splat& next = seen[batch.count];
            if (!project(points_, first_point + slot, view, pixels_, next)) continue;
            group.add(next);
            if (++batch.count % splats_in_group == 0) finish_group();
        }
        if (batch.count % splats_in_group != 0) finish_group();
    }

    void draw_band(int first) {
        const int end = std::min(first + rows_in_band, pixels_.height);
        for (const Batch& batch : batches_) {
            if (batch.bottom < static_cast<float>(first) || batch.top > static_cast<float>(end)) continue;
            const std::span<const Splat> splats(splats_.data() + batch.first, batch.count);
            for (std::size_t s = 0; s < splats.size(); s += splats_in_group) {
                const std::size_t count = std::min(splats_in_group, splats.size() - s);
                draw_group(groups_[batch.first_group + s / splats_in_group], splats.subspan(s, count), first,
                           end, pixels_);
            }
        }
    }

    Workers& workers_;
    const std::vector<std::uint16_t> order_ = scattered_order(points_in_chunk);
    std::vector<std::uint16_t> last_order_; // of the last chunk, if that is smaller
    Points points_;
    Pixels pixels_;
    SoftwareScreen screen_;
    std::vector<std::uint16_t> slots_, last_slots_; // of a chunk that are drawn
    std::vector<Splat> splats_;
    std::vector<Batch> batches_;
    std::vector<Group> groups_;
};

} // namespace

std::unique_ptr<Splats> make_software_splats(Workers& workers) {
    return std::make_unique<SoftwareSplats>(workers);
}

} // namespace knead
