// Bounds of rules.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Length of a mod's name: with "rules " before it, it fits the name of who asks in recordings. Above:
/// refused.
inline constexpr size_t mod_name_bytes_max = 24;

/// What the files of a mod may use while they load, in a thread of their own: a second of work.
inline constexpr int64_t load_work_max = 20'000'000;
inline constexpr double load_cpu_max_s = 1.0;

/// Share of a tick's length that all rules of a world may take, percent: by default, and at most.
inline constexpr uint32_t rules_percent_usual = 10;
inline constexpr uint32_t rules_percent_max = 50;
/// Processor time that a unit of a script's work stands for (ScriptBudget::work): its price.
inline constexpr double script_work_ns = 10.0;
/// Processor time that a call may take, as a multiple of what its work stands for: what generates ground
/// takes longer than it counts.
inline constexpr double backstop_usual = 3.0;
/// What on.start may use, once, and a line of the console, seconds of work: so much later a tick may be.
inline constexpr double start_work_s = 0.02;
inline constexpr double console_cpu_max_s = 0.004;

/// A handler that failed so often in a row rests, seconds at first, and twice as long each time that it fails
/// again, so often doubled at most: 10 s to 11 minutes.
inline constexpr uint32_t handler_faults_max = 3;
inline constexpr double handler_rest_s = 10.0;
inline constexpr uint32_t handler_rest_doublings = 6;

/// Handlers and timers of a mod, and replies that it waits for. Above: an error of the script; a reply is
/// not told.
inline constexpr size_t handlers_max = 256;
inline constexpr size_t timers_max = 1024;
inline constexpr size_t awaited_replies_max = 1024;

/// Commands of all rules in a tick. Above: an error of the script.
inline constexpr size_t rules_commands_max = 512;

/// Happenings that wait until rules have time for them, and messages and lines of persons. Above: the newest
/// are lost, and it is said.
inline constexpr size_t happenings_waiting_max = 4096;
inline constexpr size_t heard_waiting_max = 1024;

/// Blows of a tick that rules hear of, the hardest ones, and the least energy of one, joules.
inline constexpr size_t impacts_told_max = 16;
inline constexpr float impact_told_least_j = 100.0F;

/// Lines that a mod may log a second, and at once. Above: they are counted, and the number is said.
inline constexpr double mod_lines_per_second = 10.0;
inline constexpr double mod_lines_burst = 50.0;
/// The last lines of all rules, for administrators.
inline constexpr size_t lines_kept = 40;

/// Seconds between two looks at the files of rules that are watched, and between two calls of on.save.
inline constexpr double watch_period_s = 0.5;
inline constexpr double save_period_s = 10.0;

/// Parties of persons who have left that rules know, beside twice as many as persons are here. Above: they
/// are forgotten.
inline constexpr size_t parties_known_min = 64;

}  // namespace scree::limits
