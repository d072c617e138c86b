#include "client/bot/bot_options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <limits>

#include "client/cache/cache_options.h"
#include "client/connection/endpoint_options.h"
#include "shared/base/limits.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

constexpr int exit_usage = 2;

/// In place of a pattern's name: those that a bot takes in turn when it is told none.
constexpr const char* both_patterns = "both";

template <HasRows Kind>
std::vector<std::string> names_of() {
  return {kind_names<Kind>.begin(), kind_names<Kind>.end()};
}

/// As the command line says it; complete() makes the rest of BotOptions of it.
struct Words {
  std::string shape{name_of(CarverConfig{}.shape)};
  std::string pattern{name_of(usual_pattern)};
  std::vector<std::string> messages{};  ///< channel and text of each
  std::vector<float> centre_m{};        ///< empty: in the view of the world's spawn
  std::vector<float> place_m{};         ///< empty: around the centre
  std::vector<float> walk_square_m{};   ///< its middle, and half its side; empty: none
};

void add_interest(CLI::App& app, BotConfig& bot) {
  app.add_option("--name", bot.name, "name of the bot's person, as others see it")->envname("SCREE_NAME");
  bounded(app.add_option("--interest", bot.interest_radius_m,
                         "radius of the terrain that the bot follows, metres"),
          {0.0, limits::interest_radius_max_m})
      ->envname("SCREE_INTEREST")
      ->capture_default_str();
  bounded(
      app.add_option("--reconnects", bot.reconnects_max, "how often to reconnect before the bot gives up"),
      whole_within(0, 1e6))
      ->envname("SCREE_RECONNECTS")
      ->capture_default_str();
}

/// A place of the ground by two words.
CLI::Option* add_place(CLI::App& app, const char* name, std::vector<float>& place_m, const char* help) {
  constexpr double world_m = limits::world_half_width_m;
  return bounded(app.add_option(name, place_m, help), {-world_m, world_m})->expected(2);
}

void add_moving(CLI::App& app, BotConfig& bot, Words& words) {
  bounded(app.add_option("--digs", bot.digs,
                         "number of digs, after the carves: what is dug goes into the bot's store"),
          whole_within(0, 1e6))
      ->envname("SCREE_DIGS")
      ->capture_default_str();
  bounded(
      app.add_option(
          "--places", bot.places,
          "number of places, after the digs: each puts down its share of what the bot carries, as rubble"),
      whole_within(0, 1e6))
      ->envname("SCREE_PLACES")
      ->capture_default_str();
  add_place(app, "--place-centre", words.place_m, "x and z around which to place, metres; default: --centre");
}

void add_carving(CLI::App& app, BotConfig& bot, Words& words) {
  bounded(app.add_option("--carves", bot.carves, "number of carves; 0 only checks that the server answers"),
          whole_within(0, 1e6))
      ->envname("SCREE_CARVES")
      ->capture_default_str();
  bounded(app.add_option("--walk", bot.walks,
                         "random walks on foot, a second to three each, in a world whose persons walk"),
          whole_within(0, 1e6))
      ->envname("SCREE_WALK")
      ->capture_default_str();
  constexpr double world_m = limits::world_half_width_m;
  bounded(app.add_option(
              "--walk-in", words.walk_square_m,
              "square to walk in, by x and z of its middle and half its side, metres; default: anywhere"),
          {-world_m, world_m})
      ->expected(3);
  bounded(app.add_option("--seed", bot.random_seed, "seed of the random choices"),
          whole_within(0, whole_most))
      ->envname("SCREE_SEED")
      ->capture_default_str();
  bounded(app.add_option("--rate", bot.rate_hz, "carves, digs and places a second; 0: one after each reply"),
          {0.0, 1000.0})
      ->envname("SCREE_RATE")
      ->capture_default_str();
  // A radius over the server's limit is allowed, to show the server's refusal; so are too many seeds.
  bounded(app.add_option(
              "--radius", bot.carver.radius_m,
              "radius of a carve or a dig, metres; servers allow 8 at most, and 5.4 in voxels of 0.1 m"),
          {0.0, 1e6})
      ->envname("SCREE_RADIUS")
      ->capture_default_str();
  bounded(app.add_option("--seeds", bot.carver.seeds, "largest number of pieces of a carve"),
          whole_within(0, std::numeric_limits<uint32_t>::max()))
      ->envname("SCREE_SEEDS")
      ->capture_default_str();
  std::vector<std::string> shapes;
  for (const ShapeKind kind : bot_shapes) shapes.emplace_back(name_of(kind));
  app.add_option("--shape", words.shape,
                 "shape of a carve or a dig: sphere, or crater, a ball with a wall of rough rock")
      ->envname("SCREE_SHAPE")
      ->check(CLI::IsMember(shapes))
      ->capture_default_str();
  std::vector<std::string> patterns = names_of<SeedPattern>();
  patterns.emplace_back(both_patterns);
  app.add_option(
         "--pattern", words.pattern,
         "pattern of the seeds: " + listed(kind_names<SeedPattern>) +
             "; both: uniform and radial in turn. A pattern that needs points gets those of a stone wall")
      ->envname("SCREE_PATTERN")
      ->check(CLI::IsMember(patterns))
      ->capture_default_str();
  add_place(app, "--centre", words.centre_m,
            "x and z around which to carve, metres; default: in the view of the world's spawn");
  bounded(app.add_option(
              "--area", bot.carver.area_m,
              "half the side of the square to carve in, metres; 0: each carve at the centre, from above"),
          {0.0, world_m})
      ->envname("SCREE_AREA")
      ->capture_default_str();
  app.add_option("--paint", bot.paint,
                 "before each carve, paint the rock with this material of the world's palette")
      ->envname("SCREE_PAINT")
      ->check([](const std::string& name) { return name.empty() ? "must not be empty" : ""; }, "");
}

void add_talking(CLI::App& app, BotConfig& bot, Words& words) {
  app.add_option("--say", bot.lines,
                 "a line for everybody, once the bot has joined; may be given more than once")
      ->take_all();
  app.add_option("--message", words.messages,
                 "CHANNEL TEXT: a message for the server's rules, once the bot has joined; may be given more "
                 "than once")
      ->expected(2)
      ->take_all();
  bounded(app.add_option("--hear", bot.hears_s,
                         "seconds for which the bot stays to get what the rules show and tell"),
          {0.0, 86400.0})
      ->envname("SCREE_HEAR")
      ->capture_default_str();
}

void add_ending(CLI::App& app, BotOptions& options) {
  BotConfig& bot = options.bot;
  app.add_flag("--linger", bot.linger, "wait until every piece has merged and the terrain is at rest")
      ->envname("SCREE_LINGER");
  app.add_flag("--check-hash", bot.check_hash,
               "fail if the hash of the edits differs from the server's at the end")
      ->envname("SCREE_CHECK_HASH");
  bounded(app.add_option("--timeout", bot.timeout_s, "seconds until the bot gives up and fails"),
          {0.1, 86400.0})
      ->envname("SCREE_TIMEOUT")
      ->capture_default_str();
  app.add_option("--report", options.report, "file for the report, JSON; - is the standard output")
      ->envname("SCREE_REPORT")
      ->check([](const std::string& path) { return path == "-" ? "" : check_writable(path); }, "FILE");
  app.add_flag("--quiet", options.quiet, "print errors only");
}

/// Derives the rest of the configuration from the words.
Result<void> complete(BotOptions& options, const Words& words) {
  if (words.messages.size() % 2 != 0) return fail("--message takes a channel and a text");
  for (size_t i = 0; i + 1 < words.messages.size(); i += 2) {
    const std::string& text = words.messages[i + 1];
    ChannelData data{words.messages[i], {text.begin(), text.end()}};
    if (const auto valid = validate(data); !valid) return fail("--message: " + valid.error().message);
    options.bot.messages.push_back(std::move(data));
  }
  for (const std::string& line : options.bot.lines) {
    if (line.empty() || line.size() > limits::line_bytes_max)
      return fail(fmt::format("--say: a line has 1 to {} bytes", limits::line_bytes_max));
  }
  CarverConfig& carver = options.bot.carver;
  carver.shape = *kind_named<ShapeKind>(words.shape);       // one of bot_shapes
  carver.pattern = kind_named<SeedPattern>(words.pattern);  // none: both
  options.bot.at_spawn = words.centre_m.empty();
  if (!options.bot.at_spawn) carver.centre_m = {words.centre_m[0], 0.0F, words.centre_m[1]};
  if (const std::vector<float>& square = words.walk_square_m; !square.empty()) {
    if (square[2] <= 0.0F) return fail("--walk-in: half of the square's side is more than 0 m");
    options.bot.walk_square = WalkSquare{{square[0], 0.0F, square[1]}, square[2]};
  }
  if (!words.place_m.empty()) options.bot.place_m = {words.place_m[0], 0.0F, words.place_m[1]};
  return {};
}

}  // namespace

std::variant<BotOptions, int> parse_bot_options(int argc, char** argv) {
  BotOptions options;
  Words words;
  CLI::App app("A Scree client without a window: carves by script and reports as JSON.", "scree-bot");
  app.set_version_flag("--version", SCREE_VERSION);
  EndpointOptions endpoint(app, options.bot);
  CacheOptions cache(app, options.bot.cache, 0);
  add_interest(app, options.bot);
  add_carving(app, options.bot, words);
  add_moving(app, options.bot, words);
  add_talking(app, options.bot, words);
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
  if (const auto folder = cache.try_folder(); !folder) options.warning = folder.error().message;
  if (const auto completed = complete(options, words); !completed) {
    std::fprintf(stderr, "scree-bot: error: %s\n", completed.error().message.c_str());
    return exit_usage;
  }
  return options;
}

}  // namespace scree
