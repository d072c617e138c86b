// scree-bot: carves by script and reports as JSON. Exit status: 0 fine, 1 failed, 2 wrong usage, 3 every
// carve was refused.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <limits>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "client/bot/bot.h"
#include "client/cache/cache_options.h"
#include "client/connection/endpoint_options.h"
#include "shared/base/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"

namespace {

constexpr int exit_failed = 1;
constexpr int exit_usage = 2;
constexpr int exit_refused = 3;

/// In place of a pattern's name: those that a bot takes in turn when it is told none.
constexpr const char* both_patterns = "both";

template <scree::HasRows Kind>
std::vector<std::string> names_of() {
  return {scree::kind_names<Kind>.begin(), scree::kind_names<Kind>.end()};
}

struct Options {
  scree::BotConfig bot;
  std::string shape{scree::name_of(scree::CarverConfig{}.shape)};
  std::string pattern = "radial";
  std::vector<float> centre_m = {0.0F, 0.0F};
  std::string paint;
  std::string report;
  bool quiet = false;
};

void add_interest(CLI::App& app, Options& options) {
  scree::BotConfig& bot = options.bot;
  scree::bounded(app.add_option("--interest", bot.interest_radius_m,
                                "radius of the terrain that the bot follows, metres"),
                 {0.0, scree::limits::interest_radius_max_m})
      ->envname("SCREE_INTEREST")
      ->capture_default_str();
  scree::bounded(
      app.add_option("--reconnects", bot.reconnects_max, "how often to reconnect before the bot gives up"),
      scree::whole_within(0, 1e6))
      ->envname("SCREE_RECONNECTS")
      ->capture_default_str();
}

void add_carving(CLI::App& app, Options& options) {
  scree::BotConfig& bot = options.bot;
  scree::bounded(
      app.add_option("--carves", bot.carves, "number of carves; 0 only checks that the server answers"),
      scree::whole_within(0, 1e6))
      ->envname("SCREE_CARVES")
      ->capture_default_str();
  scree::bounded(app.add_option("--seed", bot.random_seed, "seed of the random choices"),
                 scree::whole_within(0, scree::whole_most))
      ->envname("SCREE_SEED")
      ->capture_default_str();
  scree::bounded(app.add_option("--rate", bot.rate_hz, "carves a second; 0: one after each reply"),
                 {0.0, 1000.0})
      ->envname("SCREE_RATE")
      ->capture_default_str();
  // A radius over the server's limit is allowed, to show the server's refusal; so are too many seeds.
  scree::bounded(app.add_option("--radius", bot.carver.radius_m, "radius of a carve, metres"), {0.0, 1e6})
      ->envname("SCREE_RADIUS")
      ->capture_default_str();
  scree::bounded(app.add_option("--seeds", bot.carver.seeds, "largest number of pieces of a carve"),
                 scree::whole_within(0, std::numeric_limits<uint32_t>::max()))
      ->envname("SCREE_SEEDS")
      ->capture_default_str();
  std::vector<std::string> shapes;
  for (const scree::ShapeKind kind : scree::bot_shapes) shapes.emplace_back(scree::name_of(kind));
  app.add_option("--shape", options.shape,
                 "shape of a carve: sphere, or crater, a ball with a wall of rough rock")
      ->envname("SCREE_SHAPE")
      ->check(CLI::IsMember(shapes))
      ->capture_default_str();
  std::vector<std::string> patterns = names_of<scree::SeedPattern>();
  patterns.emplace_back(both_patterns);
  app.add_option(
         "--pattern", options.pattern,
         "pattern of the seeds: " + scree::listed(scree::kind_names<scree::SeedPattern>) +
             "; both: uniform and radial in turn. A pattern that needs points gets those of a stone wall")
      ->envname("SCREE_PATTERN")
      ->check(CLI::IsMember(patterns))
      ->capture_default_str();
  constexpr double world_m = scree::limits::world_half_width_m;
  scree::bounded(app.add_option("--centre", options.centre_m, "x and z around which to carve, metres"),
                 {-world_m, world_m})
      ->expected(2);
  scree::bounded(
      app.add_option("--area", bot.carver.area_m, "half the side of the square to carve in, metres"),
      {0.0, world_m})
      ->envname("SCREE_AREA")
      ->capture_default_str();
  app.add_option("--paint", options.paint,
                 "before each carve, paint the rock with this material: " +
                     scree::listed(scree::kind_names<scree::Material>))
      ->envname("SCREE_PAINT")
      ->check(CLI::IsMember(names_of<scree::Material>()));
}

void add_ending(CLI::App& app, Options& options) {
  scree::BotConfig& bot = options.bot;
  app.add_flag("--linger", bot.linger, "wait until every piece has merged and the terrain is at rest")
      ->envname("SCREE_LINGER");
  app.add_flag("--check-hash", bot.check_hash,
               "fail if the hash of the edits differs from the server's at the end")
      ->envname("SCREE_CHECK_HASH");
  scree::bounded(app.add_option("--timeout", bot.timeout_s, "seconds until the bot gives up and fails"),
                 {0.1, 86400.0})
      ->envname("SCREE_TIMEOUT")
      ->capture_default_str();
  app.add_option("--report", options.report, "file for the report, JSON; - is the standard output")
      ->envname("SCREE_REPORT")
      ->check([](const std::string& path) { return path == "-" ? "" : scree::check_writable(path); }, "FILE");
  app.add_flag("--quiet", options.quiet, "print errors only");
}

/// Derives the rest of the configuration from the parsed options.
void complete(Options& options) {
  scree::CarverConfig& carver = options.bot.carver;
  carver.shape = *scree::kind_named<scree::ShapeKind>(options.shape);       // one of bot_shapes
  carver.pattern = scree::kind_named<scree::SeedPattern>(options.pattern);  // none: both
  options.bot.paint = scree::kind_named<scree::Material>(options.paint);
  carver.centre_m = {options.centre_m[0], 0.0F, options.centre_m[1]};
}

bool write_report(const std::string& path, const std::string& json) {
  if (path.empty()) return true;
  if (path == "-") return std::fwrite(json.data(), 1, json.size(), stdout) == json.size();
  std::ofstream file(path);
  file << json << std::flush;
  return file.good();
}

int run(const Options& options) {
  scree::Bot bot(options.bot, [](const std::string& line) { spdlog::info(line); });
  const scree::BotReport report = bot.run();
  const bool written = write_report(options.report, scree::to_json(report));
  if (!written) spdlog::error("cannot write the report to {}", options.report);
  if (!report.failure.empty()) spdlog::error(report.failure);
  spdlog::info("{} carves asked, {} accepted, {} refused, {} lost; {} pieces made, {} merged, {} alive",
               report.carves_asked, report.carves_accepted, report.carves_refused, report.carves_lost,
               report.seen.pieces_made, report.seen.pieces_merged, report.pieces_alive);
  if (!report.failure.empty() || !written) return exit_failed;
  const std::string refused = scree::all_refused(report);
  if (refused.empty()) return 0;
  spdlog::error(refused);
  return exit_refused;
}

}  // namespace

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  Options options;
  CLI::App app("A Scree client without a window: carves by script and reports as JSON.", "scree-bot");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::EndpointOptions endpoint(app, options.bot);
  scree::CacheOptions cache(app, options.bot.cache, 0);
  add_interest(app, options);
  add_carving(app, options);
  add_ending(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  if (const auto completed = endpoint.complete(); !completed) {
    std::fprintf(stderr, "scree-bot: error: %s\n", completed.error().message.c_str());
    return exit_usage;
  }
  cache.complete();
  const auto kept = cache.try_folder();
  complete(options);
  spdlog::set_default_logger(spdlog::stderr_logger_mt("bot"));
  spdlog::set_pattern("%H:%M:%S.%e %n %v");
  if (options.quiet) spdlog::set_level(spdlog::level::err);
  if (!kept) spdlog::warn(kept.error().message);
  return run(options);
}
