#include "edit/replay.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "edit/document_acts.h"
#include "edit/median.h"
#include "edit/recorded_checks.h"
#include "edit/session_cloud.h"
#include "io/cloud_file.h"
#include "io/compare.h"

#include <algorithm>
#include <cstdio>

namespace knead {

namespace {

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string exact_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

// "0.002 D from it, allowed are 0.001 D": with as many digits as it takes to see that it is more.
std::string words_beyond(double distance, double allowed, const std::string& from) {
    const bool differs = short_number(distance) != short_number(allowed);
    const auto number = [&](double value) { return differs ? short_number(value) : exact_number(value); };
    return number(distance) + from + ", allowed are " + number(allowed) + " D";
}

// What a `set` line changes where these overrides win. A key that the line does not have stays away: a line
// that is allowed while handles are posed must not become one that is not.
SettingsChange overridden(SettingsChange line, const SettingsChange& overrides) {
    for_each_setting([&](const auto& setting) {
        auto& own = line.*setting.change;
        const auto& over = overrides.*setting.change;
        if (own && over) own = over;
    });
    return line;
}

class Replay {
public:
    Replay(const Session& session, const ReplayOptions& options, Progress& progress,
           const std::function<void(const std::string&)>& warn)
        : session_(session), options_(options), progress_(progress), warn_(warn), workers_(options.threads) {}

    ReplayReport run() {
        refuse_bad_targets();
        find_check_files();
        Stopwatch clock;
        PointCloud cloud = read_session_cloud(session_, options_.cloud, progress_);
        report_.read = clock.lap();
        UpsamplerChoice choice = options_.make_upsampler(options_.device, workers_, options_.threads);
        const double device_seconds = clock.lap();
        upsampler_ = choice.upsampler.get();
        for (const std::string& remark : cloud.remarks) add_warning(remark);
        add_warning(choice.warning);

        Document document(std::move(cloud), changed(session_.settings, options_.overrides), workers_,
                          *upsampler_, options_.rehearse ? Document::Mode::rehearsal : Document::Mode::real);
        if (options_.after_frame && !options_.rehearse)
            document.on_frame = [&] { options_.after_frame(document, document.pipeline().posed()); };
        for (const SessionLine& line : session_.lines) carry_out(document, line);
        finish_edit(document, session_.lines.empty() ? 1 : session_.lines.back().number);
        if (options_.after_last && !options_.rehearse)
            options_.after_last(document, document.shape(progress_));

        clock.lap();
        measure_extent(document);
        if (!options_.rehearse) write_results(document);
        take_device_warning(); // of shapes that were made again at the end
        const bool writes = options_.out || options_.record_checks || options_.add_outputs;
        if (writes && !options_.rehearse) report_.write = clock.lap();
        if (is_undone_) document.prepare_ahead(progress_); // what is told is of the shape that is left
        fill_report(document, device_seconds);
        return std::move(report_);
    }

private:
    std::filesystem::path cloud_path() const {
        return options_.cloud ? *options_.cloud : session_.resolve(session_.cloud);
    }

    // What cannot be written, or should not be, is told before the work, not after it.
    void refuse_bad_targets() const {
        if (options_.out) refuse_bad_target(*options_.out);
        std::error_code ignored;
        if (options_.out && std::filesystem::equivalent(*options_.out, session_.file, ignored))
            throw Error(Trouble::output, options_.out->string(),
                        "is the session itself; give the shape another name");
        if (options_.record_checks && !options_.rehearse)
            refuse_to_record(session_, cloud_path(), options_.out);
    }

    // So is a missing file.
    void find_check_files() const {
        for (const SessionLine& line : session_.lines) {
            const auto* check = std::get_if<CheckLine>(&line.action);
            if (!check || is_recorded_anew(*check)) continue;
            const std::filesystem::path path = session_.resolve(check->positions);
            std::error_code ignored;
            if (!std::filesystem::exists(path, ignored))
                throw Error(Trouble::input, session_.place(line.number),
                            "\"positions\": there is no file " + path.string());
        }
    }

    void carry_out(Document& document, const SessionLine& line) {
        progress_.stop_if_cancelled();
        const std::string place = session_.place(line.number);
        if (std::holds_alternative<CommitLine>(line.action)) finish_edit(document, line.number - 1);
        if (const auto* set = std::get_if<SetLine>(&line.action))
            document.change_settings(overridden(set->change, options_.overrides), place);
        else
            carry_out_act(document, line.action, place, progress_);
        std::visit([&](const auto& done) { look_at(document, done, line.number); }, line.action);
        take_device_warning();
    }

    void take_device_warning() { add_warning(upsampler_->take_warning()); }

    // After a line is carried out; of most there is nothing to look at.
    template<typename Line>
    void look_at(Document& /*document*/, const Line& /*line*/, std::size_t /*number*/) {}

    void look_at(Document& document, const DragLine& line, std::size_t number) {
        checked_ = is_undone_ = false;
        if (options_.rehearse) return;
        add_warning(words_about(document.pipeline().strays()));
        std::vector<std::string> dragged{line.handle};
        for (const Companion& companion : line.with) dragged.push_back(companion.handle);
        for (const std::string& handle : dragged)
            for (const std::string& words :
                 {words_about_swallowed(document, handle), words_about_loose(document, handle)})
                if (!words.empty()) add_warning(session_.place(number) + ": " + words);
    }
    void look_at(Document& document, const SettleLine& /*line*/, std::size_t /*number*/) {
        if (document.is_posed()) checked_ = false;
        if (options_.after_frame && !options_.rehearse)
            options_.after_frame(document, document.shape(progress_)); // nothing need be posed
    }
    void look_at(Document& document, const CheckLine& line, std::size_t number) {
        if (!is_recorded_anew(line)) check(document, line, number);
    }
    void look_at(Document& document, const UndoLine& /*line*/, std::size_t /*number*/) {
        went_back(document);
    }
    void look_at(Document& document, const RedoLine& /*line*/, std::size_t /*number*/) {
        went_back(document);
    }

    // Or forth.
    void went_back(const Document& document) {
        is_undone_ = true;
        if (document.is_posed()) checked_ = false;
    }

    // Where all points lie in one place, D is 0, and only what lies just there holds.
    static void compare(const Distances& distances, double diagonal, double tolerance,
                        const std::string& other, CheckResult& result) {
        const std::string point = "point " + std::to_string(distances.largest_index) + " lies ";
        if (distances.incomparable > 0) {
            result.words = "point " + std::to_string(distances.first_incomparable) +
                           " is not finite, and not the same, in the cloud and " + other;
        } else if (diagonal > 0) {
            result.distance = distances.largest / diagonal;
            result.held = *result.distance <= tolerance;
            if (!result.held)
                result.words = point + words_beyond(*result.distance, tolerance, " D from " + other);
        } else {
            result.distance = distances.largest;
            result.held = distances.largest == 0;
            if (!result.held) result.words = point + "elsewhere than in " + other + ", and D is 0";
        }
    }

    void check(Document& document, const CheckLine& line, std::size_t number) {
        CheckResult result;
        result.line = number;
        const std::filesystem::path path = session_.resolve(line.positions);
        if (options_.rehearse) return;
        const PointCloud expected =
            read_named_cloud(path, session_.place(number), "\"positions\"", progress_);
        if (expected.size() != document.cloud().size()) {
            result.words = path.string() + " has " + std::to_string(expected.size()) + " points, the cloud " +
                           std::to_string(document.cloud().size());
        } else {
            const Distances distances =
                distances_between(document.cloud(), document.positions(progress_), expected);
            compare(distances, document.bounds().diagonal(), line.tolerance, path.string(), result);
        }
        report_.checks.push_back(std::move(result));
    }

    // At the end of an edit: how well the handles are met, and the check that records it.
    void finish_edit(Document& document, std::size_t after_line) {
        if (options_.rehearse) return;
        report_.handle_error = std::max(report_.handle_error, document.handle_error(progress_));
        add_warning(words_about_demand(document.demand(progress_)));
        if (!options_.record_checks || checked_) return;
        checked_ = true;
        recorded_.push_back({after_line, name_of_check(session_, recorded_.size() + 1),
                             document.positions(progress_), document.normals(progress_)});
    }

    bool is_recorded_anew(const CheckLine& check) const {
        return options_.record_checks && is_recorded(session_, check);
    }

    // Everything is put in its place when all of it is written.
    void write_results(Document& document) {
        std::error_code ignored;
        const bool replaces_cloud =
            options_.out && std::filesystem::equivalent(*options_.out, cloud_path(), ignored);
        refuse_to_replace_others(session_, recorded_);
        Outputs outputs;
        if (options_.add_outputs) options_.add_outputs(outputs);
        if (options_.out) {
            const std::vector<float> positions = document.positions(progress_);
            const std::vector<float> normals = document.normals(progress_);
            const std::vector<float> rotations = document.rotations(progress_);
            for (const std::string& words :
                 write_cloud(outputs.add(FileInTheMaking(*options_.out)), document.cloud(),
                             {positions, normals, {}, rotations}, progress_))
                add_warning(words);
            report_.written.push_back(*options_.out);
            if (replaces_cloud)
                add_warning(options_.out->string() + " was the cloud that the session begins with; from now "
                                                     "on it begins with the shape that is there now");
        }
        if (options_.record_checks) {
            write_checks(recorded_, document.cloud(),
                         outputs.add(TemporaryFolder(folder_of(session_))).path(), progress_);
            write_session(session_, recorded_, outputs.add(FileInTheMaking(session_.file)));
        }
        outputs.hand_over();
        if (!options_.record_checks) return;
        for (const RecordedCheck& recorded : recorded_)
            report_.written.push_back(session_.resolve(recorded.file));
        report_.written.push_back(session_.file);
    }

    void measure_extent(Document& document) {
        const Pipeline& pipeline = document.pipeline();
        if (!options_.measure_extent || options_.rehearse || !pipeline.shared_graph()) return;
        const RestShape& shape = document.shape(progress_);
        const RestShape& opened = pipeline.opened();
        report_.extent = extent_change(pipeline.standing_points(), pipeline.graph(), opened.positions,
                                       opened.normals, shape.positions, workers_);
    }

    // Once, and of nothing where there are no words.
    void add_warning(const std::string& words) {
        if (words.empty() || std::ranges::find(report_.warnings, words) != report_.warnings.end()) return;
        report_.warnings.push_back(words);
        warn_(words);
    }

    void fill_report(const Document& document, double device_seconds) {
        const Pipeline& pipeline = document.pipeline();
        const FrameLog& log = document.log();
        report_.points = document.cloud().size();
        report_.components = pipeline.shared_components() ? pipeline.components().size.size() : 0;
        report_.strays = pipeline.strays().parts;
        report_.samples = pipeline.samples().size();
        report_.frames = log.frames;
        report_.iterations = log.iteration.size();
        report_.threads = workers_.threads();
        report_.device = upsampler_->device();
        report_.diagonal = document.bounds().diagonal();
        report_.stages = pipeline.seconds();
        report_.stages.device += device_seconds;
        report_.solve = median(log.iteration);
        report_.upsample = median(log.upsample);
        report_.peak_memory = peak_memory();
        report_.total = since_start_.seconds();
    }

    const Session& session_;
    const ReplayOptions& options_;
    Progress& progress_;
    const std::function<void(const std::string&)>& warn_;
    Stopwatch since_start_;
    Workers workers_;
    Upsampler* upsampler_ = nullptr;
    ReplayReport report_;
    std::vector<RecordedCheck> recorded_;
    bool checked_ = true;    // whether the shape now was recorded already, or nothing changed it since
    bool is_undone_ = false; // whether the last shape was not made by the last drag
};

} // namespace

bool ReplayReport::all_checks_held() const {
    return std::ranges::all_of(checks, [](const CheckResult& check) { return check.held; });
}

ReplayReport replay(const Session& session, const ReplayOptions& options, Progress& progress,
                    const std::function<void(const std::string&)>& warn) {
    return Replay(session, options, progress, warn).run();
}

} // namespace knead
