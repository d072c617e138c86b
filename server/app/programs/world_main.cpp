// scree-world: describes, checks, copies, repairs, compacts and rolls back the file of a world, and makes one
// of a recording. Exit status: 0 success, 1 failure or damage, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "server/app/chunk_text.h"
#include "server/app/ground_giver.h"
#include "server/app/recorded_past.h"
#include "server/app/world_facts.h"
#include "server/store/ground_mass.h"
#include "server/store/readable_rows.h"
#include "server/store/stored_field.h"
#include "server/store/world_file.h"
#include "server/store/world_lock.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/world.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"

namespace scree {
namespace {

constexpr int failed = 1;
constexpr int usage_error = 2;

using Json = nlohmann::ordered_json;

struct Options {
  std::string path;
  std::string to{};         ///< file
  std::string ground{};     ///< file; empty: it is looked for
  std::string recording{};  ///< file
  std::optional<Tick> tick{};
  std::vector<int32_t> chunk{};  ///< x, y, z
  bool json = false;
};

void print(const Json& json, bool as_json) {
  if (as_json) {
    std::printf("%s\n", json.dump(2).c_str());
    return;
  }
  for (const auto& [name, value] : json.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%-18s %s\n", name.c_str(), text.c_str());
  }
}

int complain(const Error& error) {
  std::fprintf(stderr, "scree-world: error: %s\n", error.message.c_str());
  return failed;
}

/// What is read from now on is of one moment.
Result<WorldRows> moment_of(WorldFile& file) {
  TRY(file.hold_moment());
  return file.read_moment();
}

Result<ChunkSums> sum_up(WorldFile& file) {
  ChunkSums sums;
  const auto bytes = file.each_chunk([&](const WorldChunk& chunk) -> Result<void> {
    ++sums.chunks;
    sums.bricks += chunk.bricks.size();
    return {};
  });
  TRY(bytes);
  sums.bytes = *bytes;
  sums.format = TRY(file.format());
  return sums;
}

int info(const Options& options) {
  const auto file = WorldFile::open(options.path);
  if (!file) return complain(file.error());
  const auto rows = moment_of(**file);
  if (!rows) return complain(rows.error());
  const auto sums = sum_up(**file);
  if (!sums) return complain(sums.error());
  print(Json::parse(world_facts(options.path, *rows, *sums)), options.json);
  return 0;
}

/// The rows with the ground that they name.
Result<void> find_ground_of(WorldRows& rows, const Options& options) {
  const auto ground = ground_giver(options.path, options.ground);
  TRY(ground);
  RecordedHeader& config = rows.world.moment.config;
  if (auto given = give_ground(config.ground, config.terrain, *ground); !given)
    return fail(options.path + ": " + given.error().message);
  return {};
}

/// What a start takes from the rows: the ground's mass in a chunk. Where the row has none, it is put there.
Result<void> weigh_ground(const TerrainSource& terrain, ChunkCoord chunk, std::span<const BrickPatch> bricks,
                          GroundMasses& ground) {
  const GroundMasses measured = measured_ground(terrain, bricks);
  const auto mass = measured.find(chunk);
  if (mass == measured.end() || ground.try_emplace(chunk, mass->second).first->second != mass->second)
    return fail(fmt::format("the ground of chunk ({}, {}, {}) does not have the mass that its row says",
                            chunk.x, chunk.y, chunk.z));
  return {};
}

/// Edited bricks that a check has in memory: 40 MB.
constexpr size_t checked_bricks_max = size_t{1} << 16;

/// Everything that a server's start checks, and what that takes from the rows, chunk by chunk.
Result<void> check_file(const Options& options) {
  const auto opened = TRY(WorldFile::open(options.path));
  WorldFile& file = *opened;
  auto rows = TRY(moment_of(file));
  TRY(find_ground_of(rows, options));
  GroundMasses ground;
  PagedTerrain terrain = terrain_of(
      file, [&](ChunkCoord chunk) { return file.read_bricks(chunk); }, ground, checked_bricks_max);
  Result<void> weighed;
  terrain.each = [&, each = terrain.each](const PagedTerrain::Visit& visit) {
    return each([&](ChunkCoord chunk, std::span<const BrickPatch> bricks) -> Result<void> {
      TRY(visit(chunk, bricks));  // it lies in the world
      if (weighed) weighed = weigh_ground(rows.world.moment.config.terrain, chunk, bricks, ground);
      return {};
    });
  };
  const auto world = World::restore(rows.world, terrain, 1, ground);
  if (!world) return fail(options.path + ": damaged: " + world.error().message);
  if (!weighed) return fail(options.path + ": damaged: " + weighed.error().message);
  return {};
}

int check(const Options& options) {
  const auto checked = check_file(options);
  if (!checked && refused_by_system(checked.error())) return complain(checked.error());
  Json json{{"file", options.path}, {"whole", checked.has_value()}};
  if (!checked) json["damage"] = checked.error().message;
  print(json, options.json);
  return checked ? 0 : failed;
}

int backup(const Options& options) {
  const auto file = WorldFile::open(options.path);
  if (!file) return complain(file.error());
  if (const auto copied = (*file)->copy_to(options.to); !copied) return complain(copied.error());
  return check({.path = options.to, .ground = options.ground, .json = options.json});
}

/// The text with the path of the user's file instead of the copy's.
std::string told_of(std::string text, const std::string& copy, const std::string& path) {
  for (size_t at = text.find(copy); at != std::string::npos; at = text.find(copy, at + path.size()))
    text.replace(at, copy.size(), path);
  return text;
}

/// What repairing a world has kept, and what not.
struct Repaired {
  LostRows lost;
  uint64_t chunks_kept = 0;
  WorldMoment before, after;
};

/// A new file of what is whole in a copy, chunk by chunk.
Result<void> repair_copy(const std::string& copy, const Options& options, Repaired& repaired) {
  const auto opened = TRY(WorldFile::open(copy));
  WorldFile& file = *opened;
  auto rows = TRY(file.read_moment(&repaired.lost));
  TRY(find_ground_of(rows, options));
  WorldMoment& moment = rows.world.moment;
  if (moment.tick == 0) {  // lost, perhaps: ticks that were given away are not given again
    LostRows told_later;
    const auto newest = [&](const WorldChunk& chunk) {
      moment.tick = std::max(moment.tick, chunk.version);
      return Result<void>();
    };
    TRY(file.each_chunk(newest, &told_later));
  }
  repaired.before = moment;
  GroundMasses ground;
  PagedTerrain terrain;
  terrain.bricks_max = checked_bricks_max;
  terrain.read = [&](ChunkCoord chunk) { return file.read_bricks(chunk); };
  terrain.each = [&](const PagedTerrain::Visit& visit) -> Result<void> {
    const auto bytes = file.each_chunk(
        [&](const WorldChunk& chunk) -> Result<void> {
          TRY(visit(chunk.chunk, chunk.bricks));  // it lies in the world
          ground[chunk.chunk] = measured_ground(moment.config.terrain, chunk.bricks).at(chunk.chunk);
          ++repaired.chunks_kept;
          return {};
        },
        &repaired.lost);
    return bytes ? Result<void>() : tl::unexpected(bytes.error());
  };
  const auto world = World::salvage(rows.world, terrain, ground);
  TRY(world);
  repaired.after = (*world)->moment();
  return create_world(options.to, rows.header, **world);
}

/// Keeps what is whole in a new file; the damaged one stays as it is, for it is read from a copy: reading a
/// file may change it.
int repair(const Options& options) {
  const auto lock = WorldLock::acquire(options.path);
  if (!lock) return complain(lock.error());
  const std::string copy = options.to + "-copy";
  Repaired repaired;
  const auto copied = copy_for_reading(options.path, copy);
  const auto done = copied ? repair_copy(copy, options, repaired) : copied;
  std::error_code ignored;
  for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(copy + end, ignored);
  std::vector<std::string>& lost = repaired.lost.reasons;
  for (std::string& reason : lost) reason = told_of(std::move(reason), copy, options.path);
  if (!done) return complain({told_of(done.error().message, copy, options.path)});
  const WorldMoment &before = repaired.before, &after = repaired.after;
  if (lost.empty() && after.field_hash != before.field_hash)
    lost.emplace_back("its chunks are undamaged, but some saved chunks are missing");
  print({{"file", options.path},
         {"repaired", options.to},
         {"lost", lost},
         {"chunks_kept", repaired.chunks_kept},
         {"pieces_kept", after.pieces.size()},
         {"pieces_lost", before.motion.bodies.size() - after.motion.bodies.size()},
         {"terrain_lost_units", before.ledger.terrain - after.ledger.terrain}},
        options.json);
  return 0;
}

int compact(const Options& options) {
  const auto lock = WorldLock::acquire(options.path);
  if (!lock) return complain(lock.error());
  std::error_code ignored;
  const auto before = std::filesystem::file_size(options.path, ignored);
  {
    const auto file = WorldFile::open(options.path);
    if (!file) return complain(file.error());
    if (const auto moment = (*file)->read_moment(); !moment) return complain(moment.error());
    if (const auto chunks = sum_up(**file); !chunks) return complain(chunks.error());
    if (const auto done = (*file)->compact(); !done) return complain(done.error());
  }
  print({{"file", options.path},
         {"bytes_before", before},
         {"bytes", std::filesystem::file_size(options.path, ignored)}},
        options.json);
  return 0;
}

int tell_made(const Options& options, const Result<PastWorld>& past) {
  if (!past) return complain(past.error());
  Json json{{"file", options.path}, {"recording", options.recording}, {"tick", past->tick}};
  if (!past->before.empty()) json["before"] = past->before;
  print(json, options.json);
  return 0;
}

int make_new(const Options& options) {
  const auto ground = ground_giver(options.recording, options.ground);
  if (!ground) return complain(ground.error());
  return tell_made(options, world_of_recording(options.path, options.recording, options.tick, *ground));
}

int rollback(const Options& options) {
  const auto ground = ground_giver(options.path, options.ground);
  if (!ground) return complain(ground.error());
  return tell_made(options, roll_back(options.path, options.recording, *options.tick, *ground));
}

int dump_chunk(const Options& options) {
  const auto text = saved_chunk_text(options.path, {options.chunk[0], options.chunk[1], options.chunk[2]});
  if (!text) return complain(text.error());
  std::fputs(text->c_str(), stdout);
  return 0;
}

struct CommandRow {
  const char* name;
  const char* what;
  int (*act)(const Options&);
  bool makes_file = false;     ///< NEW
  bool needs_ground = true;    ///< --ground
  bool has_recording = false;  ///< --from and --to
  bool has_chunk = false;      ///< CHUNK, and text
};

constexpr CommandRow commands[] = {
    {.name = "info",
     .what = "describes the world; works while a server runs",
     .act = info,
     .needs_ground = false},
    {.name = "check",
     .what = "checks the file as the start of a server does; works while a server runs",
     .act = check},
    {.name = "backup",
     .what = "copies the world as it is at one moment; works while a server runs",
     .act = backup,
     .makes_file = true},
    {.name = "repair",
     .what = "copies every undamaged part to a new file, and lists the lost ones",
     .act = repair,
     .makes_file = true},
    {.name = "compact", .what = "returns unused space to the disk", .act = compact, .needs_ground = false},
    {.name = "rollback",
     .what = "takes the world back to a tick of its recording; keeps the newer file beside it",
     .act = rollback,
     .has_recording = true},
    {.name = "new", .what = "makes a world from a recording's tick", .act = make_new, .has_recording = true},
    {.name = "dump-chunk",
     .what = "prints the edited bricks of a chunk as text; works while a server runs",
     .act = dump_chunk,
     .needs_ground = false,
     .has_chunk = true}};

CLI::App* add_command(CLI::App& app, Options& options, const CommandRow& row) {
  CLI::App* command = app.add_subcommand(row.name, row.what);
  command->add_option("FILE", options.path, "the file of a world")->required();
  if (!row.has_chunk) command->add_flag("--json", options.json, "prints JSON");
  if (row.makes_file) command->add_option("NEW", options.to, "the new file")->required();
  if (row.needs_ground)
    command->add_option("--ground", options.ground, "its ground file; default: found in the same folder");
  if (row.has_recording) {
    command->add_option("--from", options.recording, "a recording")->required();
    command->add_option("--to", options.tick, "tick of the recording; default: its last")
        ->required(row.act == rollback);
  }
  if (row.has_chunk)
    command->add_option("CHUNK", options.chunk, "X,Y,Z, as -1,0,2")->delimiter(',')->expected(3)->required();
  refuse_empty(*command);
  return command;
}

int run(int argc, char** argv) {
  CLI::App app("Checks, copies and repairs the file of a world (scree-server --world).", "scree-world");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  Options options;
  std::vector<const CLI::App*> parsed;
  for (const CommandRow& row : commands) parsed.push_back(add_command(app, options, row));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  for (size_t i = 0; i < parsed.size(); ++i) {
    if (!parsed[i]->parsed()) continue;
    const int code = commands[i].act(options);
    const auto printed = flush_output();
    return code == 0 && !printed ? complain(printed.error()) : code;
  }
  return usage_error;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  return scree::run(argc, argv);
}
