// A server of Scree and one of Luanti under the same edits, each with as many viewers of its own as this
// machine has room for with Luanti's.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "bench/peers/luanti.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "bench/support/server_process.h"
#include "server/world/world_config.h"
#include "shared/base/quantile.h"
#include "shared/base/timing.h"
#include "studies/peers/beside.h"
#include "studies/peers/server_phases.h"
#include "studies/peers/viewers.h"

namespace scree {

namespace {

constexpr int radius_voxels = 8;
constexpr float voxel_m = 0.25F;
constexpr float radius_m = radius_voxels * voxel_m;
constexpr int view_voxels = 96;
constexpr float eye_voxels = 75.0F;  ///< above the ground, as luanti_game.cpp has it
constexpr uint32_t carves_a_side = 4;
constexpr int spacing_voxels = 18;
constexpr uint32_t seeds_a_carve = 64;
constexpr size_t viewers_max = 64, viewers_a_batch = 16;
constexpr double busy_max = 0.85;  ///< of all cores, at rest: more viewers do not fit
constexpr double settled_within_s = 40.0;
constexpr double calm_within_s = 90.0;
constexpr double ends_within_s = 30.0;
constexpr uint64_t calm_bytes = 100;  ///< fewer in a half second: nothing is on the way

/// Share of the time of all cores that is not idle, over so many seconds.
double busy_share(double seconds) {
  const auto read = [] {
    std::ifstream stat("/proc/stat");
    std::string cpu;
    std::array<double, 8> ticks{};
    stat >> cpu;
    for (double& each : ticks) stat >> each;
    return std::pair(std::accumulate(ticks.begin(), ticks.end(), 0.0), ticks[3] + ticks[4]);
  };
  const auto [all_before, idle_before] = read();
  wait_s(seconds);
  const auto [all_after, idle_after] = read();
  return 1.0 - (idle_after - idle_before) / std::max(all_after - all_before, 1.0);
}

uint64_t sum_of(const std::vector<uint64_t>& values) {
  return std::accumulate(values.begin(), values.end(), uint64_t{0});
}

std::vector<uint64_t> to_clients(const peers::Luanti& luanti) {
  std::vector<uint64_t> bytes;
  for (const peers::RelayedBytes& each : luanti.bytes()) bytes.push_back(each.to_client);
  return bytes;
}

/// Starts so many clients and waits until the server has let them in.
Result<void> join(peers::Luanti& luanti, size_t count) {
  for (size_t i = 0; i < count; ++i) TRY(luanti.add_client());
  if (!holds_within(joined_within_s, [&] { return luanti.told().joined >= luanti.clients(); }))
    return fail(fmt::format("{} of {} Luanti clients joined within {:.0f} s", luanti.told().joined,
                            luanti.clients(), joined_within_s));
  seconds_until_quiet([&] { return sum_of(to_clients(luanti)) / luanti.clients(); });
  return {};
}

/// As many as were asked for, or, when none were, until the machine is full.
Result<void> fill(peers::Luanti& luanti, size_t wanted) {
  const size_t most = wanted == 0 ? viewers_max : wanted;
  TRY(join(luanti, 1));
  while (luanti.clients() < most) {
    TRY(join(luanti, std::min(viewers_a_batch, most - luanti.clients())));
    if (wanted == 0 && busy_share(1.5) > busy_max) break;
  }
  return {};
}

/// The middles of the balls, in voxels from the origin, on level ground.
std::vector<glm::ivec3> places(int ground, size_t count) {
  std::vector<glm::ivec3> all;
  const auto along = [](size_t i) {
    return static_cast<int>(i) * spacing_voxels - static_cast<int>(carves_a_side - 1) * spacing_voxels / 2;
  };
  for (size_t i = 0; i < count; ++i)
    all.push_back({along(i % carves_a_side), ground - 3, along(i / carves_a_side)});
  return all;
}

Result<Session> luanti_session(size_t& viewers, size_t carves, double rest_s, size_t& nodes) {
  const ScratchFolder folder("luanti");
  auto started = peers::Luanti::start(folder / "", view_voxels);
  if (!started) return fail(started.error().message);
  peers::Luanti& luanti = **started;
  Session session;
  const auto bytes_of_one = [&] { return sum_of(to_clients(luanti)) / luanti.clients(); };
  // Clients make meshes of all that came for a while, and the server is held up by them.
  const auto calm = [&] { seconds_until_quiet(bytes_of_one, calm_bytes, calm_within_s); };
  if (auto joined = join(luanti, 1); !joined) return fail(joined.error().message);
  calm();
  const double one_mib = luanti.server_memory_mib();
  if (auto joined = fill(luanti, viewers); !joined) return fail(joined.error().message);
  viewers = luanti.clients();
  calm();
  session.viewer_mib =
      (luanti.server_memory_mib() - one_mib) / static_cast<double>(std::max<size_t>(viewers - 1, 1));
  luanti.start_steps();
  rest_and_carve(
      session, viewers, places(peers::Luanti::ground, carves), rest_s, [&] { return luanti.server_cpu_s(); },
      [&] { return sum_of(to_clients(luanti)); },
      [&](glm::ivec3 place) { luanti.carve(place, radius_voxels); },
      [&] { seconds_until_quiet(bytes_of_one); });
  const peers::LuantiTold told = luanti.told();
  if (told.carve_ms.size() < carves || told.steps_ms.empty())
    return fail(fmt::format("Luanti's server tells of {} of {} carves and of {} steps", told.carve_ms.size(),
                            carves, told.steps_ms.size()));
  session.carve_blocks_ms = quantile(told.carve_ms, 0.5);
  session.step_ms = std::accumulate(told.steps_ms.begin(), told.steps_ms.end(), 0.0) /
                    static_cast<double>(told.steps_ms.size());
  session.late_step_ms = quantile(told.steps_ms, 0.99);
  nodes = told.carved_nodes / told.carve_ms.size();
  const auto add = [&]() -> Result<double> {
    const size_t known = to_clients(luanti).size();
    if (auto added = luanti.add_client(); !added) return fail(added.error().message);
    if (!holds_within(joined_within_s, [&] { return to_clients(luanti).size() > known; }))
      return fail(fmt::format("one more Luanti client sends nothing within {:.0f} s", joined_within_s));
    const double heard_s = steady_now_s();
    // It is quiet for a while before that, and has none of the terrain.
    if (!holds_within(joined_within_s, [&] { return luanti.told().joined >= luanti.clients(); }))
      return fail(fmt::format("one more Luanti client is not let in within {:.0f} s", joined_within_s));
    return heard_s;
  };
  const auto joined = measure_joins(session, add, [&] { return to_clients(luanti).back(); });
  if (!joined) return fail(joined.error().message);
  return session;
}

/// By its place in the server's report.
Result<double> number_of(const nlohmann::json& told, const char* place) {
  const nlohmann::json::json_pointer pointer(place);
  if (!told.contains(pointer) || !told.at(pointer).is_number())
    return fail(std::string("the report of Scree's server has no number ") + place);
  return told.at(pointer).get<double>();
}

/// What the server writes of itself when it ends.
Result<void> read_report(const std::string& path, Session& session, PeerFindings& findings) {
  const auto told = nlohmann::json::parse(std::ifstream(path), nullptr, false);
  constexpr std::array places = {"/late_ticks",
                                 "/ticks",
                                 "/seconds",
                                 "/stages_ms/carve/median",
                                 "/stages_ms/spawn/median",
                                 "/stages_ms/whole_tick/worst",
                                 "/stages_ms/whole_tick_cpu/worst"};
  std::array<double, places.size()> numbers{};
  for (size_t i = 0; i < places.size(); ++i) {
    const Result<double> number = number_of(told, places[i]);
    if (!number) return fail(number.error().message);
    numbers[i] = *number;
  }
  const auto [late_ticks, ticks, seconds, carve_ms, spawn_ms, worst_ms, worst_cpu_ms] = numbers;
  if (ticks <= 0.0) return fail("Scree's server made no tick");
  // Its clients draw on the same cores: a tick that took no more processor time than it has is late by them.
  const double tick_ms = 1e3 / WorldConfig().tick_rate_hz;
  findings.check(
      "scree_ticks", late_ticks == 0.0 || worst_cpu_ms <= tick_ms,
      fmt::format("{:.0f} of {:.0f} ticks began late; the longest took {:.1f} ms by the clock, and "
                  "none more than {:.1f} ms of the processor's time, of {:.1f}",
                  late_ticks, ticks, worst_ms, worst_cpu_ms, tick_ms));
  session.carve_blocks_ms = carve_ms + spawn_ms;
  session.step_ms = 1e3 * seconds / ticks;
  return {};
}

Result<Session> scree_session(size_t viewers, size_t carves, double rest_s, PeerFindings& findings) {
  const ScratchFolder folder("viewers");
  ::setenv("XDG_CACHE_HOME", (folder / "").c_str(), 1);
  const std::string told_path = folder / "report.json";
  ServerProcess server(server_program().c_str(), {"--terrain", "flat", "--report", told_path});
  if (server.port() == 0) return fail(server_program().string() + " does not start: build it");
  const TerrainSource terrain{TerrainKind::flat, 1, voxel_m};
  const float ground_m = ground_height_m(terrain, 0.0F, 0.0F);
  Viewers eyes(server.port(), {0.0F, ground_m + eye_voxels * voxel_m, 0.0F}, view_voxels * voxel_m);
  Session session;
  double one_mib = 0.0;
  for (size_t i = 0; i < viewers; ++i) {
    if (auto added = eyes.add(); !added) return fail(added.error().message);
    if (i == 0) {
      wait_s(1.5);
      one_mib = server.memory_mib("VmRSS");
    }
  }
  wait_s(1.5);
  session.viewer_mib =
      (server.memory_mib("VmRSS") - one_mib) / static_cast<double>(std::max<size_t>(viewers - 1, 1));
  uint32_t number = 0;
  const auto settled = [&] {
    wait_s(2.0);  // a status comes once a second
    holds_within(settled_within_s, [&] { return eyes.pieces() == 0; });
  };
  rest_and_carve(
      session, viewers, places(0, carves), rest_s, [&] { return server.cpu_s(); },
      [&] { return sum_of(eyes.received_bytes()); },
      [&](glm::ivec3 place) {
        const float x_m = static_cast<float>(place.x) * voxel_m, z_m = static_cast<float>(place.z) * voxel_m;
        eyes.carve(blow_at(terrain, x_m, z_m, radius_m, seeds_a_carve, ++number));
      },
      settled);
  const auto add = [&]() -> Result<double> {
    const double begin_s = steady_now_s();
    if (auto added = eyes.add(); !added) return fail(added.error().message);
    return begin_s;
  };
  const auto joined = measure_joins(session, add, [&] { return eyes.received_bytes().back(); });
  if (!joined) return fail(joined.error().message);
  findings.check("scree_carves", eyes.refused() == 0 && eyes.pieces() == 0,
                 fmt::format("{} carves refused, {} pieces left", eyes.refused(), eyes.pieces()));
  findings.check(
      "scree_hashes", eyes.failure().empty() && eyes.checks() > 0 && eyes.mismatches() == 0,
      fmt::format("{} checks, {} mismatches {}", eyes.checks(), eyes.mismatches(), eyes.failure()));
  if (server.end(SIGTERM, ends_within_s) != 0) return fail("Scree's server does not end in order");
  if (auto read = read_report(told_path, session, findings); !read) return fail(read.error().message);
  return session;
}

struct SessionRow {
  const char* name;
  const char* label;
  const char* what;
  double Session::*value;
  double noise_percent;
};

constexpr SessionRow rows[] = {
    {"carve_blocks_ms", "carve in a server", "a carve holds the server's step up, ms",
     &Session::carve_blocks_ms, 60.0},
    {"carve_cpu_ms", "processor a carve", "the server's processor time for a carve and all that follows, ms",
     &Session::carve_cpu_ms, 60.0},
    {"carve_bytes", "bytes a carve", "to each viewer, of a carve and all that follows, bytes",
     &Session::carve_bytes, 25.0},
    {"step_ms", "", "from one step of the server to the next, ms", &Session::step_ms, 10.0},
    {"idle_cpu_cores", "", "the server at rest with all viewers, cores", &Session::idle_cpu, 40.0},
    {"join_bytes", "join, bytes", "to one who joins after the carves, bytes (median of three)",
     &Session::join_bytes, 15.0},
    {"join_s", "", "until that one has all, s (in steps of 0.5)", &Session::join_s, 60.0},
    {"viewer_mib", "MiB a viewer", "the server's memory for one viewer more, MiB", &Session::viewer_mib,
     80.0}};

void add_run(const Session& ours, const Session& theirs, PeerFindings& findings) {
  for (const SessionRow& row : rows) {
    Comparison& figure = findings.figure(row.name, row.what, row.noise_percent);
    figure.label = row.label;
    figure.ours.push_back(ours.*row.value);
    figure.theirs.push_back(theirs.*row.value);
  }
  findings.figure("late_step_ms", "the same, 99th percentile (Scree: no tick may be late), ms", 60.0)
      .theirs.push_back(theirs.late_step_ms);
}

void say_conditions(size_t viewers, size_t carves, size_t nodes, PeerFindings& findings) {
  findings.conditions = {
      fmt::format("Debian's `minetestserver` has {} of its own clients (`minetest` with `video_driver = "
                  "null`: no pictures, 10 frames a second, all else as usual). These are as many as this "
                  "machine has room for with less than {:.0f} % of its cores busy at rest, at most {}. "
                  "`scree-server` has as many viewers, whose mirrors apply everything and check every hash. "
                  "All run on loopback and these cores.",
                  viewers, 100.0 * busy_max, viewers_max),
      fmt::format(
          "Both worlds are flat. When all viewers have everything and nothing is on its way, {} balls with a "
          "radius of {} voxels are taken out, one each {:.0f} s. All viewers look down from {:.0f} voxels "
          "above, with every ball in sight, because Luanti's server sends no block that is out of sight. All "
          "see {} voxels far. A node of Luanti is a voxel here, whatever its size is called. Its carve is "
          "Lua's fast way, a voxel manipulator with light: {} nodes go, and nothing else happens. Scree's "
          "makes {} pieces that fly, fall and become terrain again; its figures have all of that.",
          carves, radius_voxels, carve_every_s, eye_voxels, view_voxels, nodes, seeds_a_carve),
      "Settings that cost time are Luanti's defaults: a step of 90 ms (Scree: 16.7 ms), its own limits of "
      "blocks on the way. Bytes are those of datagrams and of streams, without their headers; Luanti's "
      "were counted by a relay between server and clients. Processor time is that of the server's process. "
      "Who joins has all when less than 3 kB came in each of five half seconds; Luanti's client starts "
      "with its first datagram."};
}

}  // namespace

PeerFindings beside_luanti(const PeerOptions& options) {
  PeerFindings findings;
  findings.name = "luanti";
  findings.peer = "Luanti (Minetest)";
  if (const auto missing = peers::Luanti::missing()) {
    findings.missing = *missing;
    return findings;
  }
  findings.peer = "Luanti (" + peers::Luanti::version() + ")";
  const size_t carves = options.quick ? 4 : size_t{carves_a_side} * carves_a_side;
  const double rest_s = options.quick ? 1.0 : 6.0;
  size_t viewers = options.quick ? 2 : 0;  // 0: to be found
  size_t nodes = 0;
  for (int run = 0; run < options.runs; ++run) {
    const Result<Session> theirs = luanti_session(viewers, carves, rest_s, nodes);
    options.progress((run + 0.5) / options.runs);
    const Result<Session> ours = theirs ? scree_session(viewers, carves, rest_s, findings) : theirs;
    if (!ours) {
      findings.missing = ours.error().message;
      return findings;
    }
    add_run(*ours, *theirs, findings);
    options.progress(static_cast<double>(run + 1) / options.runs);
  }
  say_conditions(viewers, carves, nodes, findings);
  return findings;
}

}  // namespace scree
