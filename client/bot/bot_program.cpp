#include "client/bot/bot_program.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "client/bot/bot_options.h"
#include "shared/base/program_output.h"

namespace scree {

namespace {

constexpr int exit_failed = 1;
constexpr int exit_refused = 3;

bool write_report(const std::string& path, const std::string& json) {
  if (path.empty()) return true;
  if (path == "-") return std::fwrite(json.data(), 1, json.size(), stdout) == json.size();
  std::ofstream file(path);
  file << json << std::flush;
  return file.good();
}

std::string counted(const MoveReport& moves, const char* kind) {
  return fmt::format("{} {} asked, {} accepted, {} refused, {} lost", moves.asked, kind, moves.accepted,
                     moves.refused, moves.lost);
}

std::string carried_in_words(const BotReport& report) {
  std::string words;
  for (const auto& [material, mass] : report.carried)
    words += fmt::format("{}{:.2f} m³ {}", words.empty() ? "carries " : ", ", m3_of(mass, report), material);
  return words.empty() ? "carries nothing" : words;
}

int run(const BotOptions& options) {
  Bot bot(options.bot, [](const std::string& line) { spdlog::info(line); });
  const BotReport report = bot.run();
  const bool written = write_report(options.report, to_json(report));
  if (!written) spdlog::error("cannot write the report to {}", options.report);
  if (!report.failure.empty()) spdlog::error(report.failure);
  spdlog::info("{} carves asked, {} accepted, {} refused, {} lost; {} pieces made, {} merged, {} alive",
               report.carves_asked, report.carves_accepted, report.carves_refused, report.carves_lost,
               report.seen.pieces_made, report.seen.pieces_merged, report.pieces_alive);
  if (options.bot.digs > 0 || options.bot.places > 0)
    spdlog::info("{}, {:.2f} m³ dug; {}, {:.2f} m³ placed; {}", counted(report.digs, "digs"),
                 m3_of(report.digs.mass, report), counted(report.places, "places"),
                 m3_of(report.places.mass, report), carried_in_words(report));
  if (options.bot.walks > 0)
    spdlog::info(
        "{} walks, {} inputs, {} refused; {} corrections, of {:.3f} m at most; {:.3f} m deep in rock at "
        "most",
        report.walks.done, report.walks.inputs, report.walks.refused, report.walks.corrections,
        report.walks.correction_worst_m, report.walks.depth_worst_m);
  if (!report.failure.empty() || !written) return exit_failed;
  const std::string refused = all_refused(report);
  if (refused.empty()) return 0;
  spdlog::error(refused);
  return exit_refused;
}

}  // namespace

int bot_program(int argc, char** argv) {
  fail_at_file_limit();
  const auto parsed = parse_bot_options(argc, argv);
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  const auto& options = std::get<BotOptions>(parsed);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("bot"));
  spdlog::set_pattern("%H:%M:%S.%e %n %v");
  if (options.quiet) spdlog::set_level(spdlog::level::err);
  if (!options.warning.empty()) spdlog::warn(options.warning);
  return run(options);
}

}  // namespace scree
