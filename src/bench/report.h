#pragma once
// What the sections of the evaluation's report have in common, and the sections that have a file of their
// own: each a table for people, at most 130 columns wide, and an array with every number.

#include "bench/deviation.h"
#include "bench/statistics.h"
#include "bench/text_table.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace knead {

using ReportJson = nlohmann::ordered_json;

std::string asked_text(const std::optional<std::uint64_t>& samples); // "1,000", "every point"
std::string percent_text(double fraction);                           // two digits, without the sign
std::string verdict_text(bool holds);                                // "pass", "FAIL"
std::string share_text(double fraction);                             // "46 %"

// link_noise() over that of the full solution, 1 where that has none; and what a table says of both.
double noise_times(double noise, double full);
std::string noise_words();

struct Machine;
std::string machine_text(const Machine& machine); // in one line
ReportJson machine_json(const Machine& machine);  // an object, to which more may be added

ReportJson json_of(const Summary& measured);                        // {"median", "min", "max", "count"}
ReportJson json_of(const Deviation& deviation);                     // {"rms", "largest"}
ReportJson asked_json(const std::optional<std::uint64_t>& samples); // a number, or "all"

struct ScanSamples;
std::string scan_samples_text(std::span<const ScanSamples> scans);
ReportJson scan_samples_json(std::span<const ScanSamples> scans);

struct SamplingResult;
std::string sampling_text(std::span<const SamplingResult> results);
ReportJson sampling_json(std::span<const SamplingResult> results);

struct TurnResult;
std::string turns_text(std::span<const TurnResult> results);
ReportJson turns_json(std::span<const TurnResult> results);

struct DemandResult;
std::string demands_text(std::span<const DemandResult> results);
ReportJson demands_json(std::span<const DemandResult> results);

struct SmallResult;
std::string small_handles_text(std::span<const SmallResult> results);
ReportJson small_handles_json(std::span<const SmallResult> results);

struct StiffnessResult;
std::string stiffness_text(std::span<const StiffnessResult> results);
ReportJson stiffness_json(std::span<const StiffnessResult> results);

} // namespace knead
