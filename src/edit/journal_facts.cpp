#include "edit/journal_facts.h"

#include "edit/json_text.h"
#include "edit/standing_acts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

namespace knead {

namespace {

std::uint64_t last_of(const StandingActs& acts) {
    return acts.done.empty() ? 0 : acts.done.back().number;
}

nlohmann::ordered_json json_of(const FileStamp& stamp) {
    return {stamp.device, stamp.inode, stamp.size, stamp.seconds, stamp.nanoseconds};
}

std::optional<FileStamp> stamp_in(const nlohmann::json& facts, const char* key) {
    const auto stamp = facts.find(key);
    if (stamp == facts.end()) return std::nullopt;
    return FileStamp{stamp->at(0).get<dev_t>(), stamp->at(1).get<ino_t>(), stamp->at(2).get<off_t>(),
                     stamp->at(3).get<time_t>(), stamp->at(4).get<long>()};
}

} // namespace

std::filesystem::path journal_facts_file(const std::filesystem::path& journal) {
    std::filesystem::path file = journal;
    return file.replace_extension(".json");
}

void write_journal_facts(const std::filesystem::path& journal, const JournalFacts& facts) {
    nlohmann::ordered_json json;
    // A name that is no UTF-8 cannot be kept in JSON: then the file is asked for again.
    const bool named = utf8_of(facts.session.string()) == facts.session.string();
    json["session"] = named ? facts.session.string() : "";
    json["saved_lines"] = facts.saved_lines;
    json["chooses_samples"] = facts.chooses_samples;
    if (facts.stamp) json["stamp"] = json_of(*facts.stamp);
    if (facts.cloud) json["cloud"] = json_of(*facts.cloud);
    FileInTheMaking file(journal_facts_file(journal));
    file.write(json_text(json) + "\n");
    file.commit();
}

JournalFacts read_journal_facts(const std::filesystem::path& journal) {
    try {
        SilentProgress silent;
        const std::vector<std::byte> bytes = read_whole_file(journal_facts_file(journal), silent);
        const auto* text = reinterpret_cast<const char*>(bytes.data());
        const auto json = nlohmann::json::parse(text, text + bytes.size());
        JournalFacts facts;
        facts.session = json.at("session").get<std::string>();
        facts.saved_lines = json.at("saved_lines").get<std::size_t>();
        facts.chooses_samples = json.at("chooses_samples").get<bool>();
        facts.stamp = stamp_in(json, "stamp");
        facts.cloud = stamp_in(json, "cloud");
        return facts;
    } catch (const std::exception&) {
        return {};
    }
}

std::uint64_t state_after(std::span<const SessionLine> lines, std::size_t count) {
    return last_of(acts_after(lines.first(std::min(count, lines.size()))));
}

std::size_t lost_steps(std::span<const SessionLine> lines, std::size_t saved_lines) {
    saved_lines = std::min(saved_lines, lines.size());
    const StandingActs saved = acts_after(lines.first(saved_lines)), all = acts_after(lines);
    if (saved.count == all.count && last_of(saved) == last_of(all)) return 0;
    const auto is_new_step = [&](const StandingAct& act) {
        return act.number > saved.count && !std::holds_alternative<SettleLine>(act.line->action);
    };
    const auto steps =
        std::ranges::count_if(all.done, is_new_step) + std::ranges::count_if(all.undone, is_new_step);
    return std::max<std::size_t>(1, static_cast<std::size_t>(steps));
}

} // namespace knead
