#pragma once
// The whole way from a cloud and its handles to posed points: every stage once, kept until one of its inputs
// changes.
//
//     neighbors                 → order, graph, components
//     strays: bridge or not     → outliers, bridges between components, components again (graph/bridges.h)
//     handle set                → labels; whether they leave little of the cloud free, and where
//     samples, that little      → base samples and their flood
//     labels                    → handle samples, sample graph, coarse samples; the flood from the borders of
//                                 the handles (it floods only what it reaches)
//     weights, strays           → what moves each point; what carries the parts without a handle
//                                 (edit/carried_parts.h)
//     rest shape                → the weights of the sample graph's links
//     rest shape, stiffness     → both systems, ordered and factorised; that of the coarse samples
//     poses                     → iterations, then upsampling
//
// Which points are samples and what they influence is decided on the shape as it was opened, so a commit
// changes none of it. Editor, replay, benchmarks and tests all come through here.
//
// What becomes of components that hold no handle is the setting `strays`:
//     freeze    they stay where they are
//     carry     each follows the nearest that holds one, rigidly
//     bridge    components with a gap comparable to their spacing are one to begin with, and what is too far
//               away to be joined is carried
// Outliers hang on the surface and do not pull, whatever it says.

#include "base/progress.h"
#include "deform/acceleration.h"
#include "deform/coarse_level.h"
#include "deform/sample_system.h"
#include "edit/carried_parts.h"
#include "edit/falloffs.h"
#include "edit/handle_demand.h"
#include "edit/handle_labels.h"
#include "edit/handle_slots.h"
#include "edit/posed_shapes.h"
#include "edit/rest_shape.h"
#include "edit/small_patches.h"
#include "graph/changing_territories.h"
#include "graph/neighbors.h"
#include "graph/point_order.h"
#include "graph/sampling.h"
#include "graph/starts_flood.h"
#include "graph/territory_areas.h"
#include "upsample/point_blocks.h"
#include "upsample/upsample.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace knead {

// All that the stages depend on beside the cloud.
struct PipelineInput {
    Settings settings;
    std::vector<Handle> handles;           // in the order of declaration
    std::shared_ptr<const RestShape> rest; // null: as opened
};

// Wall-clock seconds spent in each stage so far.
struct StageSeconds {
    double order = 0;     // Morton order, duplicates
    double neighbors = 0; // graph, outliers, components, bridges if `strays` asks for them
    double sampling = 0;  // base samples, areas, labels, handle samples
    double geodesic = 0;  // floods, falloffs, sample graph, influences, coarse samples
    double factorize = 0; // weights of the links, energy of the points between few samples, and the
                          // ordering and factorisation of both systems
    double device = 0;    // the kernel's build, what it reads, and the first touch
};

class Pipeline {
public:
    // All of these must outlive the pipeline. The cloud must not change, and has at least one finite point.
    Pipeline(const PointCloud& cloud, Workers& workers, Upsampler& upsampler);

    // Runs the stages whose inputs changed since the last call. Throws Error (numeric) if a system cannot be
    // factorised, and Cancelled; then the next call starts the unfinished stages again.
    void prepare(PipelineInput input, Progress& progress);

    // Only the stages that need no handles: graph, samples, flood.
    void prepare_ahead(const Settings& settings, Progress& progress);

    // Only the first stage: order() and opened() stand from here on, for good.
    void prepare_order(Progress& progress);

    // --- After prepare() ---

    // All samples at rest.
    SampleState rest_state() const { return knead::rest_state(system_); }

    // The start of every frame: hands the handles' turns since the last one on to the samples.
    // `motions`: one a handle.
    void follow_handles(const std::vector<HandleMotion>& motions, SampleState& state);

    // One iteration; returns the longest way that a sample would have gone in a plain one. `acceleration`
    // goes with iterations at unchanging motions.
    double iterate(const std::vector<HandleMotion>& motions, SampleState& state, Acceleration& acceleration);

    // Whether there are so many samples that some of them can answer for all, with deform/coarse_level.h's
    // anchor() and follow_coarsely(). A CoarseFollowing is good as long as no prepare() comes in between.
    bool has_coarse_samples() const { return has_coarse_; }
    void anchor(const std::vector<HandleMotion>& motions, SampleState& state, CoarseFollowing& following);
    double follow_coarsely(const std::vector<HandleMotion>& motions, unsigned iterations,
                           CoarseFollowing& following, SampleState& state);

    // Every point's position and normal for a state of the samples. The shape before is written over unless
    // somebody keeps it.
    void upsample(const std::vector<HandleMotion>& motions, const SampleState& state);
    const RestShape& posed() const { return posed_.now(); }
    std::shared_ptr<const RestShape> keep_posed() { return posed_.keep_now(); }
    // Takes the memory for shapes while others are kept; upsample() does so itself, else.
    void make_spare_shapes() { posed_.make_spares(workers_); }
    // The same for whoever draws where the device shares its memory (upsample/drawing.h), but for the last
    // bits of single points that leave rotation free: posed() stays as it was. Null where that is not to be
    // had.
    std::shared_ptr<const DeviceFrame> frame(const std::vector<HandleMotion>& motions,
                                             const SampleState& state);
    // How often upsample() was called, and in which call, from 1, it wrote each block of points
    // (upsample/point_blocks.h) last: since then the block has not changed by a bit. What rests -
    // handles that are held still, what lies outside a region of interest, frozen parts - is written once.
    std::uint64_t upsampled() const { return upsampled_; }
    std::span<const std::uint64_t> written() const { return written_; }

    // Whether the handles ask for too much. Of the shape that was upsampled last, from this state.
    HandleDemand demand(const std::vector<HandleMotion>& motions, const SampleState& state) const;

    // How each point turned from the shape as opened to posed(), 4n, w x y z, for the state that upsample()
    // was called with last: for points with a direction of their own, when the shape is committed or saved.
    std::vector<float> rotations(const std::vector<HandleMotion>& motions, const SampleState& state) const;

    const PointOrder& order() const { return order_; }
    // The point that stands for each vertex, its first one; but of twins that different handles hold, the
    // first that belongs to the handle that the vertex does. Where those were taken apart by a pose, a vertex
    // of a committed shape is where its handle has it.
    const Numbering& standing_points() const { return standing_ ? *standing_ : order_.first_point; }
    const Graph& graph() const { return *graph_; }
    const Components& components() const { return *components_; }
    // The same for whoever looks on from another thread, where they outlive a change of settings; null
    // before.
    std::shared_ptr<const Graph> shared_graph() const { return graph_; }
    std::shared_ptr<const Components> shared_components() const { return components_; }
    const std::vector<Index>& samples() const { return samples_; } // the vertex of each
    const SampleGraph& sample_graph() const { return sample_graph_; }
    // Of each vertex 1 for an outlier that hangs on the surface (graph/bridges.h); empty without any.
    std::span<const std::uint8_t> hanging() const { return hanging_; }
    // Counts how often samples() and sample_graph() changed together; 0: never yet.
    std::uint64_t samples_version() const { return samples_version_; }
    // Who holds each point, by numbers that handle_of() knows.
    const HandleLabels& labels() const { return labels_; }
    // Which of the handles a label means; their number for what is outside; no_index for what is free.
    Index handle_of(Index label) const { return label == no_index ? no_index : slots_.handle[label]; }
    // Which motions move a vertex that no handle holds: those of samples, and from first_handle_motion() on,
    // which is not below samples().size(), those of handles, by their labels.
    Influence influence(Index vertex) const;
    Index first_handle_motion() const { return static_cast<Index>(first_handle_motion_); }
    // What is small of the handles that were prepared last.
    std::shared_ptr<const PatchesOfHandles> small_patches() const { return small_patches_; }
    const SampleSystem& system() const { return system_; }
    const RestShape& opened() const { return *opened_; } // the shape in the file
    std::shared_ptr<const RestShape> keep_opened() const { return opened_; }
    // How large it is (cloud/extent.h), as its graph tells; 0 before there is one.
    double cloud_size() const { return cloud_size_; }

    // Parts of the cloud that hold no handle, and what becomes of them.
    struct LooseParts {
        std::size_t parts = 0;
        std::size_t points = 0;
        Strays fate = Strays::freeze;
    };
    LooseParts strays() const { return strays_; }

    // Whether a handle of the list moves any point: not where others that were declared later hold all that
    // it holds. Of what is prepared.
    bool moves_points(Index handle) const;
    // Whether nothing of the part of the cloud stays that it moves (of several the largest), and something
    // does elsewhere: points of a fixed handle, or what lies outside a region of interest. Of what is
    // prepared.
    bool is_on_loose_part(Index handle) const;

    const StageSeconds& seconds() const { return seconds_; }

private:
    void note_changes(const Settings& settings);
    void prepare_graph(Progress& progress);
    void prepare_labels();
    void prepare_stages_without_handles(Progress& progress);
    void prepare_points(Progress& progress);
    void prepare_bridges(Progress& progress);
    void find_size();
    std::vector<bool> labels_that_leave_little() const;
    void find_held_inside();
    std::vector<Index> sample_candidates() const;
    std::vector<std::uint8_t> not_asked() const;
    void prepare_samples(Progress& progress);
    void prepare_areas();
    void prepare_handles(Progress& progress);
    bool turns_freely(Index label) const;
    std::vector<bool> turns_by_samples() const;
    Index first_handle_number() const;
    std::vector<std::pair<Index, Index>> find_hinges(std::span<const BorderVertex> borders) const;
    std::vector<FloodStart> handle_starts(std::span<const BorderVertex> borders) const;
    Index followed_by(std::size_t point) const;
    Vicinities find_vicinities(Progress& progress);
    void find_pulled(const Vicinities& near, Progress& progress);
    void choose_coarse_samples();
    void label_vertices();
    void label_hanging();
    void find_standing_points();
    void note_single_places();
    void count_strays();
    std::vector<LostTurn> lost_turns(const std::vector<HandleMotion>& motions,
                                     const SampleState& state) const;
    struct MoverNumbers {
        std::size_t first_handle = 0; // where every part holds one; 0: else, or there are no movers
        std::vector<bool> turning;    // at each place, whether its handle leaves rotation free
    };
    MoverNumbers find_mover_numbers(std::size_t first_handle) const;
    bool are_known(const MoverNumbers& numbers) const;
    void note_changed_points(std::size_t block);
    void prepare_influences();
    void prepare_carried(std::span<const Index> mover_of_label);
    void find_link_weights(const SampleRest& rest);
    void find_energy(const SampleRest& rest);
    void prepare_systems();
    void prepare_upsampler();
    const RestShape& rest_shape() const; // that this edit starts from
    UpsampleInput upsample_input() const;
    std::span<const float> vertex_positions() const; // as opened
    std::span<const HandleMotion> all_motions(const std::vector<HandleMotion>& motions);
    // Calls visit(sample, handle) for every handle of a single point that leaves rotation free.
    template<typename Visit>
    void for_lone_pegs(Visit&& visit) const;
    void make_motions(const std::vector<HandleMotion>& motions, const SampleState& state);
    void put_exactly(Index sample, const Vec3d& displacement, RestShape& posed);

    const PointCloud& cloud_;
    Workers& workers_;
    Upsampler& upsampler_;
    PipelineInput input_;
    StageSeconds seconds_;

    // Which stages have to run again before the next frame.
    struct Stale {
        bool points = true, bridges = true, labels = true, samples = true, areas = true, handles = true,
             contacts = true, influences = true, weights = true, energy = true, systems = true,
             upsampler = true;
        bool memory = false; // what a set-up freed is not given back yet
    };
    Stale stale_;

    PointOrder order_;
    std::shared_ptr<const RestShape> opened_ = std::make_shared<RestShape>();
    std::vector<float> merged_positions_;    // of the vertices, if they are fewer than the points; else empty
    std::shared_ptr<const Graph> neighbors_; // of the vertices
    std::shared_ptr<const Graph> graph_;     // the same with outliers hung, perhaps bridged
    std::shared_ptr<const Components> components_;
    std::vector<std::uint8_t> hanging_; // of each vertex: 1 for an outlier that hangs; empty without any
    std::vector<std::uint8_t> link_lengths_;
    double cloud_size_ = 0;

    bool every_point_ = false;
    std::vector<Index> samples_;
    std::size_t base_samples_ = 0;
    // Handles that hold much, by label, and of each vertex 1 where one of them holds it and all its
    // neighbours: no base sample is worth having there. Empty where they leave a fourth of the cloud or more.
    std::vector<std::uint8_t> held_inside_;
    std::vector<bool> hold_much_;
    std::size_t candidates_ = 0;                   // vertices among which base samples are chosen
    InfluenceRows nearest_;                        // of each vertex; empty if every point is a sample
    AddedStarts<influences_per_row> from_handles_; // that are in these
    std::vector<Index> row_ends_;                  // of blocks of rows: find_row_ends()
    std::vector<std::uint8_t> changed_rows_;       // since those were found
    std::vector<WideRow> rows_of_base_;            // of the base samples, in the flood from them alone
    ChangingTerritories territories_;
    AskedVertices asked_;              // of what territories are made
    std::vector<float> area_of_links_; // level_areas()

    HandleSlots slots_; // by which the stages tell handles
    HandleLabels labels_;
    std::vector<HeldBlock> held_blocks_; // of those
    std::shared_ptr<const PatchesOfHandles> small_patches_ = std::make_shared<const PatchesOfHandles>();
    std::vector<Pulled> pulled_;
    std::optional<Numbering> standing_; // standing_points(), where they are not all the first ones
    LooseParts strays_;
    std::vector<bool> held_component_;
    std::vector<bool> holds_one_place_; // of the handles, by label: one vertex, and no more
    SampleGraph sample_graph_;
    std::vector<double> link_weights_; // of the links of that
    PointEnergy energy_;               // of the points between these samples, where they are few
    std::uint64_t samples_version_ = 0;

    std::vector<Index> mover_of_point_;        // as influence_of() reads it
    std::vector<std::size_t> mover_ends_;      // one past the largest of the points of each block of vertices
    MoverNumbers mover_numbers_;               // that they were made with
    std::vector<Vec3d> sample_places_;         // at rest, while the upsampler sees them
    std::vector<std::uint8_t> changed_points_; // blocks of them, as UpsampleInput has it
    Contacts contacts_;
    CarriedParts carried_;

    SampleSystem system_;
    CoarseLevel coarse_;
    bool has_coarse_ = false;                  // its system stands
    std::vector<HandleMotion> handle_motions_; // at the handles' places; the identity for what is outside
    // Of the samples; from first_handle_motion_ on those of the handles, what is outside, and the carried
    // parts. Those in between move nothing.
    std::vector<Motion> motions_;
    std::size_t first_handle_motion_ = 0;
    PosedShapes posed_;
    std::uint64_t upsampled_ = 0;
    std::vector<std::uint64_t> written_;
};

// What the user should hear about parts that hold no handle; empty when there are none.
std::string words_about(const Pipeline::LooseParts& strays);

} // namespace knead
