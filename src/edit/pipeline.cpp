#include "edit/pipeline.h"

#include "base/counts.h"
#include "base/error.h"
#include "base/large_pages.h"
#include "base/memory.h"
#include "base/require.h"
#include "base/stopwatch.h"
#include "cloud/extent.h"
#include "edit/held_parts.h"
#include "graph/balanced_weights.h"
#include "graph/bridges.h"
#include "graph/edge_weights.h"
#include "graph/link_lengths.h"
#include "graph/octree.h"
#include "graph/relaxing.h"
#include "graph/row_ends.h"
#include "graph/scrambled.h"
#include "graph/solid_links.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace knead {

namespace {

constexpr int relaxing_rounds = 3;

// Where little of the cloud is free, one vertex in so many tells of what is held inside of handles.
constexpr std::size_t tells_inside = 1024;

// Vertices that tell how large the cloud is: of all it is the same within half a per cent.
constexpr std::size_t asked_for_size = 1 << 13;

// Links are numbered by an Index.
void refuse_too_many_links(double links, const std::string& what_for, const std::string& what_to_do) {
    if (links >= double{no_index})
        throw Error(Trouble::input, "",
                    "the cloud has too many points " + what_for + ": knead takes " +
                        std::to_string(no_index - 1) + " links in all; " + what_to_do);
}

} // namespace

Pipeline::Pipeline(const PointCloud& cloud, Workers& workers, Upsampler& upsampler)
    : cloud_(cloud), workers_(workers), upsampler_(upsampler) {}

void Pipeline::prepare(PipelineInput input, Progress& progress) {
    note_changes(input.settings);
    if (!hold_the_same(input.handles, input_.handles)) {
        arrange(input.handles, slots_);
        stale_.labels = true;
    }
    if (input.rest != input_.rest) {
        stale_.areas = stale_.weights = stale_.energy = stale_.systems = stale_.upsampler = true;
        stale_.memory = true; // of systems: states that are kept lie between what was freed
        std::ranges::fill(changed_points_, std::uint8_t{1}); // other places, other weights
    }
    input_ = std::move(input); // which cannot fail: half of it would pass for what the stages are made of

    // Each stage makes those that use it stale, and is done once it returned.
    prepare_graph(progress);
    if (stale_.labels) {
        prepare_labels();
        stale_.handles = true;
        stale_.labels = false;
    }
    prepare_stages_without_handles(progress);
    if (stale_.handles) {
        prepare_handles(progress);
        ++samples_version_;
        stale_.influences = stale_.weights = stale_.energy = stale_.systems = true;
        stale_.handles = false;
    }
    if (stale_.influences) {
        prepare_influences();
        stale_.upsampler = true;
        stale_.influences = false;
    }
    if (stale_.systems) {
        prepare_systems();
        stale_.systems = false;
    }
    // Before more is taken: what the stages above worked with is freed by now.
    if (std::exchange(stale_.memory, false)) give_back_freed_memory();
    if (stale_.upsampler) {
        prepare_upsampler();
        stale_.upsampler = false;
    }
}

void Pipeline::prepare_ahead(const Settings& settings, Progress& progress) {
    note_changes(settings);
    prepare_stages_without_handles(progress);
}

void Pipeline::note_changes(const Settings& settings) {
    const Settings& before = input_.settings;
    stale_.points |= settings.neighbors != before.neighbors;
    stale_.samples |= settings.samples != before.samples;
    stale_.bridges |= (settings.strays == Strays::bridge) != (before.strays == Strays::bridge);
    stale_.influences |= settings.weights != before.weights || settings.strays != before.strays;
    if (settings.weights != before.weights && !energy_.first.empty()) stale_.energy = stale_.systems = true;
    stale_.systems |= settings.stiffness != before.stiffness;
    if (settings.poisson != before.poisson && !stale_.systems) {
        stale_.systems = true; // if only one of them comes to have it
        set_poisson(system_, settings.poisson, workers_);
        set_poisson(coarse_.system, settings.poisson, workers_);
        stale_.systems = false;
    }
    input_.settings = settings;
}

void Pipeline::prepare_graph(Progress& progress) {
    if (stale_.points) {
        prepare_points(progress);
        stale_.bridges = true;
        stale_.points = false;
    }
    if (stale_.bridges) {
        prepare_bridges(progress);
        stale_.labels = stale_.samples = stale_.contacts = true;
        stale_.bridges = false;
    }
}

void Pipeline::prepare_stages_without_handles(Progress& progress) {
    prepare_graph(progress);
    if (stale_.samples) {
        prepare_samples(progress);
        stale_.areas = stale_.handles = stale_.memory = true;
        stale_.samples = false;
    }
    if (stale_.areas) {
        prepare_areas();
        stale_.areas = false;
    }
}

void Pipeline::prepare_order(Progress& progress) {
    if (!opened().positions.empty()) return;
    const Stopwatch clock;
    order_ = order_points(cloud_.positions, workers_, progress);
    require(order_.points() > 0, "a pipeline needs a finite point");
    RestShape opened;
    resize_in_large_pages(opened.positions, 3 * order_.points(), workers_);
    gather(order_, cloud_.positions, 3, opened.positions, workers_);
    const std::vector<float> normals = read_normals(cloud_);
    resize_in_large_pages(opened.normals, normals.empty() ? 0 : 3 * order_.points(), workers_);
    if (!normals.empty()) gather(order_, normals, 3, opened.normals, workers_);
    if (order_.vertices() < order_.points())
        merged_positions_ = knead::vertex_positions(order_, opened.positions, workers_);
    opened_ = std::make_shared<const RestShape>(std::move(opened));
    seconds_.order += clock.seconds();
}

const RestShape& Pipeline::rest_shape() const {
    return input_.rest ? *input_.rest : opened();
}

std::span<const float> Pipeline::vertex_positions() const {
    if (!merged_positions_.empty()) return merged_positions_;
    return opened().positions;
}

void Pipeline::prepare_points(Progress& progress) {
    prepare_order(progress);
    // About half of the links have no link back.
    refuse_too_many_links(1.5 * static_cast<double>(order_.vertices()) * input_.settings.neighbors,
                          "for " + std::to_string(input_.settings.neighbors) + " neighbours each",
                          "cut the cloud into pieces");
    const Stopwatch clock;
    neighbors_ = std::make_shared<const Graph>(
        neighbor_graph(vertex_positions(), input_.settings.neighbors, workers_, progress));
    seconds_.neighbors += clock.seconds();
}

void Pipeline::prepare_bridges(Progress& progress) {
    const Stopwatch clock;
    graph_ = neighbors_;
    hanging_.clear();
    labels_ = {}; // and who knew the former ones begins anew
    hold_much_.clear();
    held_blocks_.clear();
    mover_numbers_ = {};
    std::optional<JoinedGraph> joined =
        input_.settings.strays == Strays::bridge
            ? bridged(*neighbors_, vertex_positions(), workers_, progress)
            : with_hanging_outliers(*neighbors_, vertex_positions(), workers_, progress);
    if (joined) {
        graph_ = std::make_shared<const Graph>(std::move(joined->graph));
        if (joined->outliers > 0) hanging_ = std::move(joined->hanging);
    }
    components_ = std::make_shared<const Components>(find_components(*graph_, workers_));
    link_lengths_ = link_lengths(*graph_, vertex_positions(), workers_);
    find_size();
    seconds_.neighbors += clock.seconds();
}

// Of the surface, not of its outliers, nor of what joins its parts.
void Pipeline::find_size() {
    const AskedVertices asked =
        ask_vertices(*neighbors_, opened().positions, order_.first_point, hanging_,
                     choose_by_number(order_.vertices(), asked_for_size), 1, workers_);
    std::vector<float> positions;
    positions.reserve(3 * asked.vertex.size());
    for (const Index v : asked.vertex) {
        const std::span<const float> at = vertex_positions().subspan(std::size_t{3} * v, 3);
        positions.insert(positions.end(), at.begin(), at.end());
    }
    cloud_size_ = knead::cloud_size(positions, asked.area);
}

// What is on the surface, and of what is held inside of handles little, or as much as is needed to have more
// of them than samples.
std::vector<Index> Pipeline::sample_candidates() const {
    const auto is_inside = [&](Index v) { return !held_inside_.empty() && held_inside_[v] == 1; };
    const auto vertices = static_cast<Index>(order_.vertices());
    std::size_t inside = 0, elsewhere = 0;
    for (Index v = 0; v < vertices; ++v)
        if (!hangs(hanging_, v)) ++(is_inside(v) ? inside : elsewhere);
    const std::size_t wanted = *input_.settings.samples + *input_.settings.samples / 4;
    const std::size_t needed = wanted - std::min(wanted, elsewhere);
    const std::size_t step = std::max<std::size_t>(1, inside / std::max(needed, inside / tells_inside + 1));
    std::vector<Index> among;
    among.reserve(elsewhere + inside / step + 1);
    std::size_t met = 0; // inside
    for (Index v = 0; v < vertices; ++v)
        if (!hangs(hanging_, v) && (!is_inside(v) || met++ % step == 0)) among.push_back(v);
    return among;
}

// Of each vertex 1 where it is not asked what the surface is like: outliers, and most of what is held inside
// of handles. Empty without any.
std::vector<std::uint8_t> Pipeline::not_asked() const {
    std::vector<std::uint8_t> marks = held_inside_;
    for (std::size_t v = 0; v < marks.size(); v += tells_inside) marks[v] = 0;
    if (marks.empty()) return hanging_;
    for (std::size_t v = 0; v < hanging_.size(); ++v) marks[v] |= hanging_[v];
    return marks;
}

void Pipeline::prepare_samples(Progress& progress) {
    Stopwatch clock;
    progress.step("choosing samples", 0);
    const std::size_t vertices = order_.vertices();
    // Outliers are samples only where all are.
    const std::size_t on_surface = vertices - static_cast<std::size_t>(std::ranges::count(hanging_, 1));
    every_point_ = !input_.settings.samples || *input_.settings.samples >= on_surface;
    candidates_ = vertices;
    if (every_point_) {
        samples_.resize(vertices);
        std::iota(samples_.begin(), samples_.end(), Index{0});
    } else {
        const std::vector<Index> among = sample_candidates();
        if (!held_inside_.empty()) candidates_ = among.size();
        auto chosen =
            octree_samples(order_.cube, vertex_positions(), among, *input_.settings.samples, OfCell::aside);
        shuffle_in_runs(chosen);
        std::vector<std::uint8_t> barred = not_asked();
        for (const Index v : chosen)
            if (!barred.empty()) barred[v] = 0;
        samples_ = relaxed(std::move(chosen), *graph_, link_lengths_, vertex_positions(), barred,
                           relaxing_rounds, workers_, progress);
    }
    base_samples_ = samples_.size();
    seconds_.sampling += clock.lap();

    changed_rows_.clear();
    row_ends_.clear();
    from_handles_ = {}; // before the next are made
    nearest_ = {};
    territories_ = {};
    rows_of_base_.clear();
    if (!every_point_) {
        nearest_ = flood(*graph_, link_lengths_, samples_, workers_, progress);
        from_handles_ = no_starts(nearest_, static_cast<Index>(base_samples_));
        changed_rows_.assign(blocks_of_rows(nearest_.size()), 1);
        row_ends_.resize(changed_rows_.size());
        rows_of_base_ = rows_at(nearest_, samples_);
        territories_ = territories_of_base(nearest_, base_samples_, *graph_, workers_);
    } else {
        refuse_too_many_links(static_cast<double>(graph_->neighbor.size()) +
                                  2.0 * links_in_solid * static_cast<double>(vertices),
                              "for all of them to be samples", "set a number of samples");
        sample_graph_ = sample_graph_of_all(with_solid_links(*graph_, vertex_positions(), workers_));
    }
    seconds_.geodesic += clock.lap();
}

// Of what territories are made, on the shape as it is at rest.
void Pipeline::prepare_areas() {
    const Stopwatch clock;
    const RestShape& rest = rest_shape();
    const std::size_t all = order_.vertices();
    area_of_links_.clear();
    if (every_point_) {
        asked_ = ask_vertices(sample_graph_.graph, rest.positions, standing_points(), hanging_,
                              choose_by_number(all, all), 1, workers_);
    } else {
        const Asking asking = asking_for(base_samples_, all);
        asked_ = ask_vertices(*graph_, rest.positions, standing_points(), hanging_,
                              choose_by_area(*graph_, link_lengths_, not_asked(), asking.vertices, workers_),
                              asking.of_cells, workers_);
        area_of_links_ = level_areas(asked_, territories_, base_samples_);
    }
    seconds_.sampling += clock.seconds();
}

// Of each handle whether it leaves rotation free and holds enough base samples, which flood, to tell how it
// turns all over: its own do not.
std::vector<bool> Pipeline::turns_by_samples() const {
    constexpr std::size_t enough_samples = 4;
    std::vector<std::size_t> count(slots_.handles.size(), 0);
    for (const Index v : std::span(samples_).first(base_samples_))
        if (const Index label = labels_.vertex[v]; turns_freely(label)) ++count[label];
    std::vector<bool> result;
    result.reserve(count.size());
    for (const std::size_t samples : count) result.push_back(samples >= enough_samples);
    return result;
}

// Where samples are few enough that what lies between them has to be asked.
void Pipeline::find_energy(const SampleRest& rest) {
    energy_ = {};
    const double share = share_of_points(base_samples_, candidates_); // whatever handles add
    if (every_point_ || share == 0) return;
    const RestShape& shape = rest_shape();
    const PointsBetween between{*graph_,
                                shape.positions,
                                standing_points(),
                                asked_.vertex,
                                asked_.each,
                                nearest_,
                                input_.settings.weights,
                                area_of_links_,
                                hanging_,
                                labels_.vertex,
                                rest.turns_freely,
                                turns_by_samples(),
                                rest.position,
                                slots_.handles.size() + 1}; // and what is outside
    energy_ = point_energy(between, workers_);
    energy_.share = share;
}

void Pipeline::find_link_weights(const SampleRest& rest) {
    const std::vector<double> areas =
        every_point_ ? asked_.area : territory_areas(asked_, territories_, samples_.size(), workers_);
    link_weights_ = isotropic_weights(rest.graph, rest.position, sample_graph_.contact,
                                      every_point_ ? of_points : of_territories, areas, workers_);
}

void Pipeline::prepare_systems() {
    Stopwatch clock;
    const RestShape& shape = rest_shape();
    SampleRest rest;
    rest.graph = sample_graph_.graph;
    rest.position.reserve(samples_.size());
    for (const Index v : samples_) {
        rest.position.push_back(point_at(shape.positions, standing_points()[v]));
        rest.handle.push_back(labels_.vertex[v]);
    }
    if (stale_.weights) find_link_weights(rest);
    stale_.weights = false;
    rest.weight = link_weights_;
    rest.held_part = held_parts(
        {rest.graph, samples_, labels_.vertex, *graph_, link_lengths_, vertex_positions(), nearest_},
        workers_);
    rest.cloud_size = cloud_size_;
    rest.stiffness = input_.settings.stiffness;
    rest.poisson = input_.settings.poisson;
    for (const Handle& handle : slots_.handles) rest.turns_freely.push_back(handle.free_rotation);
    std::vector<Vec3d> held;
    for (const Pulled& each : pulled_)
        held.push_back(point_at(shape.positions, standing_points()[each.held]));
    rest.pulled = soft_holds(slots_.handles, pulled_, held, rest);
    if (stale_.energy) find_energy(rest);
    stale_.energy = false;
    rest.energy = energy_;
    has_coarse_ = false;
    FactorOutcome outcome = build_system(std::move(rest), system_, workers_);
    if (outcome.solved && !coarse_.samples.sample.empty()) {
        FactorOutcome of_coarse = build_coarse_level(system_, coarse_, workers_);
        has_coarse_ = of_coarse.solved;
        // Frames without it come out otherwise: what decides that must be the system, not the memory of
        // today.
        if (of_coarse.lacks_memory) outcome = std::move(of_coarse);
    }
    seconds_.factorize += clock.lap();
    if (!outcome.solved)
        throw Error(Trouble::numeric, "",
                    "the deformation cannot be computed: " + outcome.words +
                        "; another number of samples or another stiffness may help");
}

Influence Pipeline::influence(Index vertex) const {
    const UpsampleInput input = upsample_input();
    return influence_of(nearest_, input.weights, input.places, vertex,
                        point_at(input.positions, standing_points()[vertex]));
}

// What the upsampler is told, but for what is known of the numbers in it.
UpsampleInput Pipeline::upsample_input() const {
    const RestShape& rest = rest_shape();
    return {rest.positions,          rest.normals,  mover_of_point_, &nearest_,
            input_.settings.weights, sample_places_};
}

void Pipeline::prepare_upsampler() {
    Stopwatch clock;
    const RestShape& rest = rest_shape();
    for (std::size_t part = 0; part < carried_.size(); ++part) {
        const Index begin = contacts_.first[part], end = contacts_.first[part + 1];
        Vec3d sum = Vec3d::Zero();
        for (Index at_contact = begin; at_contact < end; ++at_contact)
            sum += point_at(rest.positions, standing_points()[contacts_.vertex[at_contact]]);
        carried_.anchor[part] = sum / static_cast<double>(end - begin);
    }
    posed_.make_room(rest.positions.size(), rest.normals.size(), workers_);
    written_.resize(blocks_of(order_.points()), 0);
    find_row_ends(nearest_, changed_rows_, row_ends_, workers_);
    for (std::size_t block = 0; block < changed_rows_.size(); ++block)
        if (changed_rows_[block]) note_changed_points(block);
    std::ranges::fill(changed_rows_, std::uint8_t{0});
    const auto largest = []<typename End>(const std::vector<End>& ends) {
        return ends.empty() ? End{0} : std::ranges::max(ends);
    };
    sample_places_ = system_.rest.position;
    UpsampleInput input = upsample_input();
    input.rows_end = largest(row_ends_);
    input.mover_end = largest(mover_ends_);
    input.changed = changed_points_;
    upsampler_.prepare(input, motions_.size());
    std::ranges::fill(changed_points_, std::uint8_t{0});
    seconds_.device += clock.lap();
}

std::string words_about(const Pipeline::LooseParts& strays) {
    if (strays.parts == 0) return {};
    const bool one = strays.parts == 1;
    std::string words =
        counted(strays.parts, "part") + " of the cloud (" + counted(strays.points, "point") + ") ";
    switch (strays.fate) {
    case Strays::freeze:
        words += one ? "holds no handle and stays where it is" : "hold no handle and stay where they are";
        break;
    case Strays::carry:
        words += one ? "holds no handle and follows the nearest part that does"
                     : "hold no handle and follow the nearest part that does";
        break;
    case Strays::bridge:
        words +=
            one ? "is too far from what holds a handle to be joined to it, and follows the nearest of that"
                : "are too far from what holds a handle to be joined to it, and follow the nearest of that";
        break;
    }
    return words;
}

} // namespace knead
