#include "edit/replay.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "edit/median.h"
#include "edit/session_cloud.h"
#include "io/cloud_file.h"
#include "io/compare.h"

#include <algorithm>
#include <cstdio>
#include <limits>

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

// A check that --record-checks puts in.
struct RecordedCheck {
    std::size_t after_line = 0; // of the session; 0: behind the header
    std::filesystem::path file; // beside the session
    std::vector<float> positions;
    std::vector<float> normals;
};

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
    bool is_cloud(const std::filesystem::path& path) const {
        std::error_code ignored;
        return std::filesystem::equivalent(
            path, options_.cloud ? *options_.cloud : session_.resolve(session_.cloud), ignored);
    }

    // What cannot be written, or should not be, is told before the work, not after it.
    void refuse_bad_targets() const {
        if (options_.out) refuse_bad_target(*options_.out);
        std::error_code ignored;
        if (options_.out && std::filesystem::equivalent(*options_.out, session_.file, ignored))
            throw Error(Trouble::output, options_.out->string(),
                        "is the session itself; give the shape another name");
        if (!options_.record_checks || options_.rehearse) return;
        refuse_link_from_elsewhere();
        const TemporaryFolder checks(folder_of_session());
        const FileInTheMaking session(session_.file);
        refuse_other_uses_of_checks();
    }

    // The session would be written where the link leads, and its checks could be found from one of them only.
    void refuse_link_from_elsewhere() const {
        std::error_code trouble, ignored;
        const std::filesystem::path file = std::filesystem::canonical(session_.file, trouble);
        if (!trouble && !std::filesystem::equivalent(file.parent_path(), folder_of_session(), ignored))
            throw Error(Trouble::output, session_.file.string(),
                        "is a link into another folder; record the checks of " + file.string() + " itself");
    }

    // A check is written beside the session, over what has its name.
    void refuse_other_uses_of_checks() const {
        std::error_code trouble, ignored;
        std::filesystem::directory_iterator entry(folder_of_session(), trouble), end;
        for (; !trouble && entry != end; entry.increment(trouble))
            if (is_name_of_check(entry->path().filename()) && is_cloud(entry->path()))
                throw Error(Trouble::output, entry->path().string(),
                            "is the cloud that the session begins with, and has a name that recorded checks "
                            "take; give the cloud another one");
        if (!options_.out || !is_name_of_check(options_.out->filename())) return;
        const std::filesystem::path folder = options_.out->parent_path();
        if (std::filesystem::equivalent(folder.empty() ? "." : folder, folder_of_session(), ignored))
            throw Error(Trouble::output, options_.out->string(),
                        "has a name that recorded checks take; give the shape another one");
    }

    // Nor may it be written over a file that is none of this session's: another session of the same name may
    // have recorded it. Only at the end is it known how many there are.
    void refuse_to_replace_others() const {
        for (const RecordedCheck& recorded : recorded_) {
            const bool is_own = std::ranges::any_of(session_.lines, [&](const SessionLine& line) {
                const auto* check = std::get_if<CheckLine>(&line.action);
                return check && check->positions == recorded.file;
            });
            const std::filesystem::path target = session_.resolve(recorded.file);
            std::error_code ignored;
            if (!is_own && std::filesystem::exists(target, ignored))
                throw Error(Trouble::output, target.string(),
                            "is there already and no check of this session has it; to record one there, "
                            "move the file away first");
        }
    }

    // So is a missing file.
    void find_check_files() const {
        for (const SessionLine& line : session_.lines) {
            const auto* check = std::get_if<CheckLine>(&line.action);
            if (!check || is_recorded_name(check->positions)) continue;
            const std::filesystem::path path = session_.resolve(check->positions);
            std::error_code ignored;
            if (!std::filesystem::exists(path, ignored))
                throw Error(Trouble::input, session_.place(line.number),
                            "\"positions\": there is no file " + path.string());
        }
    }

    void carry_out(Document& document, const SessionLine& line) {
        const std::string place = session_.place(line.number);
        progress_.stop_if_cancelled();
        std::visit([&](const auto& action) { act(document, action, line.number, place); }, line.action);
        take_device_warning();
    }

    void take_device_warning() { add_warning(upsampler_->take_warning()); }

    void act(Document& document, const HandleLine& line, std::size_t /*number*/, const std::string& place) {
        document.declare(line, place);
    }
    void act(Document& document, const DragLine& line, std::size_t number, const std::string& place) {
        document.drag(line, place, progress_);
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
    void act(Document& document, const SettleLine& line, std::size_t /*number*/,
             const std::string& /*place*/) {
        document.settle(line, progress_);
        if (document.is_posed()) checked_ = false;
        if (options_.after_frame && !options_.rehearse)
            options_.after_frame(document, document.shape(progress_)); // nothing need be posed
    }
    void act(Document& document, const CheckLine& line, std::size_t number, const std::string& /*place*/) {
        if (!is_recorded_name(line.positions)) check(document, line, number);
    }
    void act(Document& document, const CommitLine& /*line*/, std::size_t number,
             const std::string& /*place*/) {
        finish_edit(document, number - 1);
        document.commit(progress_);
    }
    void act(Document& document, const SetLine& line, std::size_t /*number*/, const std::string& place) {
        document.change_settings(overridden(line.change, options_.overrides), place);
    }
    void act(Document& document, const DeleteLine& line, std::size_t /*number*/, const std::string& place) {
        document.remove(line, place);
    }
    void act(Document& document, const RenameLine& line, std::size_t /*number*/, const std::string& place) {
        document.rename(line, place);
    }
    void act(Document& document, const UndoLine& /*line*/, std::size_t /*number*/, const std::string& place) {
        document.undo(place);
        is_undone_ = true;
        if (document.is_posed()) checked_ = false;
    }
    void act(Document& document, const RedoLine& /*line*/, std::size_t /*number*/, const std::string& place) {
        document.redo(place);
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
        recorded_.push_back({after_line, recorded_name(recorded_.size() + 1), document.positions(progress_),
                             document.normals(progress_)});
    }

    std::filesystem::path recorded_name(std::size_t number) const {
        return session_.file.stem().string() + "-check-" + std::to_string(number) + ".ply";
    }

    // Whether a check's cloud is one that this run records anew.
    bool is_recorded_name(const std::filesystem::path& name) const {
        return options_.record_checks && name.parent_path().empty() && is_name_of_check(name);
    }

    // Whether recorded_name() makes such names.
    bool is_name_of_check(const std::filesystem::path& name) const {
        const std::string stem = name.stem().string(), begin = session_.file.stem().string() + "-check-";
        return name.extension() == ".ply" && stem.starts_with(begin) && stem.size() > begin.size() &&
               std::ranges::all_of(stem.substr(begin.size()), [](char c) { return c >= '0' && c <= '9'; });
    }

    // That of the check which is recorded anew, or a usual one.
    double recorded_tolerance(const std::filesystem::path& file) const {
        for (const SessionLine& line : session_.lines)
            if (const auto* check = std::get_if<CheckLine>(&line.action); check && check->positions == file)
                return check->tolerance;
        return 1e-4;
    }

    // Everything is put in its place when all of it is written.
    void write_results(Document& document) {
        const bool replaces_cloud = options_.out && is_cloud(*options_.out);
        refuse_to_replace_others();
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
            write_checks(document.cloud(), outputs.add(TemporaryFolder(folder_of_session())));
            write_session(outputs.add(FileInTheMaking(session_.file)));
        }
        outputs.hand_over();
        if (!options_.record_checks) return;
        for (const RecordedCheck& recorded : recorded_)
            report_.written.push_back(session_.resolve(recorded.file));
        report_.written.push_back(session_.file);
    }

    std::filesystem::path folder_of_session() const {
        const std::filesystem::path folder = session_.file.parent_path();
        return folder.empty() ? "." : folder;
    }

    void write_checks(const PointCloud& cloud, const TemporaryFolder& folder) {
        // Only positions are ever read from them, which every format holds.
        for (const RecordedCheck& recorded : recorded_)
            (void)write_cloud(folder.path() / recorded.file, cloud, {recorded.positions, recorded.normals},
                              progress_);
    }

    // The session as it was, line for line, with the recorded checks in place of earlier recorded ones.
    void write_session(FileInTheMaking& file) const {
        file.write(session_.header_text + "\n");
        auto next = recorded_.begin();
        const auto put_checks_up_to = [&](std::size_t line) {
            for (; next != recorded_.end() && next->after_line <= line; ++next)
                file.write(to_text(CheckLine{next->file, recorded_tolerance(next->file)}) + "\n");
        };
        put_checks_up_to(1);
        for (const SessionLine& line : session_.lines) {
            put_checks_up_to(line.number - 1);
            const auto* check = std::get_if<CheckLine>(&line.action);
            if (!check || !is_recorded_name(check->positions)) file.write(line.text + "\n");
        }
        put_checks_up_to(std::numeric_limits<std::size_t>::max());
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
