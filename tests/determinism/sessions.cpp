// Plays one session under every value of every setting, one varied at a time. Each runs twice side by side in
// this process, on one thread and on two, or once with the argument `once`. It prints the hashes: a line for
// every so many ticks, and one over all of them. The output must be the same from every compiler at every
// optimisation (tests/determinism/CMakeLists.txt).
//
// Fails when two worlds with the same commands part, when the session lacks something that methods are for,
// and when a value of a setting makes no difference: then it says nothing about that method.
#include <cinttypes>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/world/settings.h"
#include "server/world/world.h"
#include "shared/material/rubble.h"

namespace scree {
namespace {

constexpr Tick ticks = 180;
constexpr Tick ticks_per_line = 30;
const TerrainSource terrain{TerrainKind::noise, 3, 0.25F};

/// A world of three rows, as the ground's layers need, and their rubble.
WorldConfig usual_config() {
  auto palette = std::make_shared<Palette>();
  for (const char* name : {"rock", "soil", "ice"}) palette->rows.emplace_back().name = name;
  MaterialRow& soil = palette->rows[row_number(material::soil)];
  soil.density_kg_m3 = 1700.0F;
  soil.friction = 0.9F;
  soil.strength_m_s = 7.0F;
  soil.seed_density = 1.5F;
  soil.dent_resistance_j_m3 = 2.5e5F;
  soil.bearing = {4.0e5F, 1.0e5F, 5.0e4F, 1.0e5F};
  MaterialRow& ice = palette->rows[row_number(material::ice)];
  ice.density_kg_m3 = 920.0F;
  ice.friction = 0.3F;
  ice.breaks = BreakLook::shards;
  add_rubble(*palette);
  WorldConfig config;
  config.palette = std::move(palette);
  return config;
}

/// On the ground of the session at x.
glm::vec3 ground(float x_m) {
  return {x_m, ground_height_m(terrain, x_m, 0.0F), 0.0F};
}

Command fill(const Shape& shape) {
  return {1, 1, FillRequest{shape}};
}

Command carve(const Shape& shape, uint32_t seeds, glm::vec3 impact_m, float blast_speed_m_s) {
  CarveRequest request;
  request.shape = shape;
  request.seeds = seeds;
  request.random_seed = seeds;
  request.impact_m = impact_m;
  request.blast_speed_m_s = blast_speed_m_s;
  return {1, 2, request};
}

/// A person who stands up beside the blow and walks into it, where persons walk.
std::vector<Command> walks(uint32_t number) {
  constexpr uint64_t person = 5;
  if (number == 1) return {{person, 1, StandRequest{ground(-5.0F) + glm::vec3(0.0F, 0.5F, 0.0F)}}};
  return {{person, number, WalkRequest{{{-1.0F, 0.0F, 0.25F}, true, number % 9 == 0}}}};
}

/// A block that falls from a height, blows on the ground and again on what they left, a crater, a tower that
/// loses its foot, a table whose leg gets thin, and a person.
std::map<Tick, std::vector<Command>> script() {
  const glm::vec3 up(0.0F, 1.0F, 0.0F), half(0.6F);
  const glm::vec3 block = ground(0.0F) + 16.0F * up, tower = ground(10.0F), blow = ground(-8.0F);
  const glm::vec3 table = ground(24.0F);
  std::map<Tick, std::vector<Command>> commands{
      {1,
       {fill(box(block, half)), fill(box(tower + 2.5F * up, {0.8F, 3.5F, 0.8F})),
        fill(box(table + 3.0F * up, {0.75F, 5.0F, 0.75F})),
        fill(box(table + 8.5F * up, {5.0F, 0.75F, 5.0F}))}},
      {2, {carve(box(block, 2.0F * half), 1, block, 0.0F)}},
      {3, {carve(sphere(blow - 0.5F * up, 1.25F), 16, blow, 6.0F)}},
      {4, {carve(box(table + glm::vec3(1.2F, 7.0F, 0.0F), {1.6F, 0.3F, 1.2F}), 1, table, 0.0F)}},
      {12, {carve(crater(ground(-14.0F) - 0.5F * up, 1.75F), 20, ground(-14.0F), 6.0F)}},
      {20, {carve(box(tower + 1.0F * up, {1.2F, 0.4F, 1.2F}), 3, tower, 2.0F)}},
      {100, {carve(sphere(blow - 0.8F * up, 1.0F), 8, blow, 4.0F)}},
  };
  for (uint32_t number = 1; number <= 60; ++number) commands[30 + number] = walks(number);
  return commands;
}

struct Happened {
  int shatters = 0, dents = 0, islands = 0, merges = 0;
};

void count(const TickDelta& delta, size_t commands, Happened& happened) {
  int carves = 0;
  for (const AppliedOperation& applied : delta.operations) {
    happened.shatters += std::holds_alternative<ShatterOperation>(applied.operation) ? 1 : 0;
    happened.islands += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
    happened.merges += std::holds_alternative<StampOperation>(applied.operation) ? 1 : 0;
    carves += std::holds_alternative<CarveOperation>(applied.operation) ? 1 : 0;
  }
  if (commands == 0) happened.dents += carves;
}

struct Played {
  uint64_t digest = 0xcbf29ce484222325ULL;  ///< FNV-1a over the hashes of every tick
  Happened happened;
};

/// False when two worlds part, that is, with twins.
bool play(const std::string& name, WorldConfig config, bool twins, Played& played) {
  config.terrain = terrain;
  World one(config);
  std::optional<World> other;
  if (twins) other.emplace(config, 2);
  const auto commands_by_tick = script();
  for (Tick tick = 1; tick <= ticks; ++tick) {
    const auto found = commands_by_tick.find(tick);
    const std::vector<Command> commands =
        found == commands_by_tick.end() ? std::vector<Command>{} : found->second;
    const auto a = one.step(commands), b = other ? other->step(commands) : a;
    if (a->state_hash != b->state_hash || a->field_hash != b->field_hash) {
      std::fprintf(stderr, "%s: two worlds with the same commands part at tick %" PRIu64 "\n", name.c_str(),
                   tick);
      return false;
    }
    for (const uint64_t hash : {a->field_hash, a->state_hash})
      played.digest = (played.digest ^ hash) * 0x100000001b3ULL;
    count(*a, commands.size(), played.happened);
    if (tick % ticks_per_line == 0)
      std::printf("%-20s %4" PRIu64 " %016" PRIx64 " %016" PRIx64 "\n", name.c_str(), tick, a->field_hash,
                  a->state_hash);
  }
  const Happened& h = played.happened;
  std::printf("%-20s all  %016" PRIx64 " shatters %d dents %d islands %d merges %d\n", name.c_str(),
              played.digest, h.shatters, h.dents, h.islands, h.merges);
  return true;
}

int run(bool twins) {
  Played usual;
  if (!play("default", usual_config(), twins, usual)) return 1;
  const Happened& h = usual.happened;
  if (h.shatters == 0 || h.dents == 0 || h.islands == 0 || h.merges == 0) {
    std::fprintf(stderr, "the session lacks shatters, dents, islands or merges\n");
    return 1;
  }
  int failures = 0;
  for (const Setting& setting : settings())
    for (const std::string_view value : setting.tried) {
      WorldConfig config = usual_config();
      if (!setting.parse(value, config) || config == usual_config()) continue;
      const std::string name = std::string(setting.name) + "=" + std::string(value);
      Played played;
      if (!play(name, config, twins, played)) return 1;
      if (played.digest != usual.digest) continue;
      std::fprintf(stderr, "%s makes no difference in this session\n", name.c_str());
      ++failures;
    }
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  return scree::run(argc < 2 || std::string_view(argv[1]) != "once");
}
