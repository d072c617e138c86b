// Impacts: what falls hard breaks where it struck and dents soft ground; mass and momentum stay.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>
#include <utility>

#include "server/store/recorder.h"
#include "server/world/impact_stage.h"
#include "server/world/limits.h"
#include "server/world/published_state.h"
#include "server/world/spawn.h"
#include "tests/support/flat_world.h"
#include "tests/support/materials.h"
#include "tests/support/verify_recording.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

/// A block of rock in the air, cut loose at once: it falls from there.
std::vector<Command> hang_block(glm::vec3 centre_m, float half_m, uint32_t seeds) {
  CarveRequest carve;
  carve.shape = box(centre_m, glm::vec3(half_m + 0.6F));
  carve.pattern = SeedPattern::uniform;
  carve.seeds = seeds;
  carve.impact_m = centre_m - glm::vec3(0.0F, 20.0F, 0.0F);
  carve.blast_speed_m_s = 0.0F;
  return {{1, 1, FillRequest{box(centre_m, glm::vec3(half_m))}}, {1, 2, carve}};
}

template <typename T>
const T* find_operation(const TickDelta& delta) {
  for (const AppliedOperation& applied : delta.operations)
    if (const auto* found = std::get_if<T>(&applied.operation)) return found;
  return nullptr;
}

/// Steps until an operation of that kind happens; null when none does.
template <typename T>
std::shared_ptr<const TickDelta> step_until(World& world, int ticks = 240) {
  for (int i = 0; i < ticks; ++i) {
    auto delta = step(world);
    EXPECT_EQ(delta->ledger.error(), 0);
    if (find_operation<T>(*delta) != nullptr) return delta;
  }
  return nullptr;
}

TEST(impact, a_hard_fall_breaks_a_piece_where_it_struck) {
  WorldConfig config = flat_world();
  config.methods.dents = false;
  World world(config);
  const auto born = step(world, hang_block({0.0F, 20.0F, 0.0F}, 0.75F, 1));
  ASSERT_EQ(born->spawned.size(), 1U) << born->replies.back().refusal;
  const Volume& parent = *born->spawned.front().volume;
  const auto broken = step_until<ShatterOperation>(world);
  ASSERT_NE(broken, nullptr);
  const auto* shatter = find_operation<ShatterOperation>(*broken);
  EXPECT_EQ(shatter->piece, born->spawned.front().id);
  EXPECT_GE(broken->spawned.size(), 2U);
  EXPECT_LT(shatter->impact_voxels.y, parent.centre_voxels.y) << "the piece's lower side struck";
  EXPECT_EQ(mass_of(broken->spawned), parent.mass);
  EXPECT_EQ(broken->ledger.pieces, parent.mass);
}

TEST(material, soil_lies_on_rock_and_ice_on_the_heights) {
  MapField flat(flat_terrain);
  EXPECT_EQ(material_at(flat, {3.0F, -0.5F, 8.0F}), material::soil);
  EXPECT_EQ(material_at(flat, {3.0F, -1.5F, 8.0F}), material::rock);
  EXPECT_EQ(material_at(flat, {3.0F, 0.5F, 8.0F}), material::rock) << "what is poured above the ground";
  MapField canyon(TerrainSource{TerrainKind::canyon, 1, 0.25F});
  uint32_t seen[3] = {0, 0, 0};
  for (int x = -40; x < 40; x += 2)
    for (int z = -40; z < 40; z += 2) {
      const glm::vec3 p(static_cast<float>(x), 0.0F, static_cast<float>(z));
      const float ground_m = ground_height_m(canyon.source(), p.x, p.z);
      ++seen[static_cast<size_t>(material_at(canyon, {p.x, ground_m - 0.3F, p.z}))];
      EXPECT_EQ(material_at(canyon, {p.x, -30.0F, p.z}), material::rock);
    }
  for (const uint32_t count : seen) EXPECT_GT(count, 0U);
}

TEST(impact, a_piece_weighs_what_its_material_weighs_and_its_children_do_too) {
  World::State state(flat_world(), 1);
  TickDelta delta;
  const Applied cut = state.apply_and_record(
      CarveOperation{sphere({0.0F, 0.0F, 0.0F}, 0.8F), SeedPattern::uniform, 1, 1, {}, 1}, 0, delta);
  const auto born = [](PieceId, const Volume&) {
    Newborn piece;
    piece.body.pose.position_m = {8.0F, 20.0F, 0.0F};  // not back into its hole
    return piece;
  };
  spawn(state, cut, born, delta);
  // A metre of soil lies on rock; the ball reaches a little into the air.
  EXPECT_GT(mass_of(masses_of(*state.pieces.at(1)), material::soil), 0);
  const auto weighs_right = [&](PieceId id) {
    float kg = 0.0F;
    for (const MaterialMass& one : masses_of(*state.pieces.at(id)))
      kg += static_cast<float>(one.mass) / units_per_voxel / 64.0F * builtin_row(one.material).density_kg_m3;
    return std::abs(state.bodies.mass_kg(id) / kg - 1.0F) < 0.001F;
  };
  EXPECT_TRUE(weighs_right(1));
  for (int i = 0; i < 240 && state.pieces.contains(1); ++i) {
    state.bodies.step();
    apply_impacts(state, delta);
  }
  ASSERT_FALSE(state.pieces.contains(1)) << "it did not break";
  for (const auto& [id, volume] : state.pieces) EXPECT_TRUE(weighs_right(id)) << id;
}

TEST(impact, a_soft_fall_breaks_nothing) {
  World world(flat_world());
  ASSERT_EQ(step(world, hang_block({0.0F, 2.0F, 0.0F}, 0.75F, 1))->spawned.size(), 1U);
  EXPECT_EQ(step_until<ShatterOperation>(world), nullptr);
  EXPECT_EQ(world.measure_terrain(), step(world)->ledger.terrain);
}

TEST(impact, switched_off_nothing_breaks_and_nothing_dents) {
  WorldConfig config = flat_world();
  config.methods.impacts = config.methods.dents = false;
  World world(config);
  ASSERT_EQ(step(world, hang_block({0.0F, 20.0F, 0.0F}, 0.75F, 1))->spawned.size(), 1U);
  for (int i = 0; i < 300; ++i) {
    const auto delta = step(world);
    ASSERT_EQ(find_operation<ShatterOperation>(*delta), nullptr);
    ASSERT_EQ(find_operation<CarveOperation>(*delta), nullptr);
  }
}

/// Σ m v of some pieces, in units of mass · m/s.
glm::dvec3 momentum(const World::State& state, const PieceTable& pieces) {
  glm::dvec3 sum(0.0);
  for (const auto& [id, volume] : pieces)
    sum += glm::dvec3(state.bodies.state(id).velocity_m_s) * static_cast<double>(volume->mass);
  return sum;
}

/// A fast, spinning block of rock just above the ground, so that its next step is an impact.
void throw_block(World::State& state, TickDelta& delta) {
  apply(FillOperation{box({0.0F, 12.0F, 0.0F}, glm::vec3(0.75F))}, state.field, state.pieces);
  const Applied cut = state.apply_and_record(
      CarveOperation{box({0.0F, 12.0F, 0.0F}, glm::vec3(1.5F)), SeedPattern::uniform, 1, 1, {}, 1}, 0, delta);
  ASSERT_EQ(cut.created.size(), 1U);
  const auto born = [](PieceId, const Volume&) {
    Newborn piece;
    piece.body.pose.position_m = {0.0F, 0.76F, 0.0F};
    piece.body.velocity_m_s = {3.0F, -24.0F, 1.0F};
    piece.body.spin_rad_s = {0.5F, 1.0F, 2.0F};
    return piece;
  };
  spawn(state, cut, born, delta);
}

TEST(impact, children_carry_on_the_momentum_and_spin_of_the_piece) {
  World::State state(flat_world(), 1);
  TickDelta delta;
  throw_block(state, delta);
  state.config.methods.dents = false;
  bool broke = false;
  for (int i = 0; i < 30 && !broke; ++i) {
    state.bodies.step();
    const glm::dvec3 before = momentum(state, state.pieces);
    const glm::vec3 spin = state.bodies.states().front().spin_rad_s;
    apply_impacts(state, delta);
    broke = state.pieces.size() > 1;
    const glm::dvec3 change = momentum(state, state.pieces) - before;
    EXPECT_LT(glm::length(change), 1e-5 * glm::length(before) + 1e-3);
    if (!broke) continue;
    for (const BodyState& child : state.bodies.states()) EXPECT_EQ(child.spin_rad_s, spin);
  }
  EXPECT_TRUE(broke);
}

TEST(impact, pieces_of_a_dent_take_their_momentum_and_energy_from_the_blow) {
  World::State state(flat_world(), 1);
  state.config.methods.impacts = false;
  TickDelta delta;
  throw_block(state, delta);
  const PieceId block = state.pieces.begin()->first;
  for (int i = 0; i < 30 && state.pieces.size() == 1; ++i) {
    state.bodies.step();
    const std::vector<BodyImpact> blows = state.bodies.impacts(limits::impact_speed_min_m_s);
    apply_impacts(state, delta);
    if (state.pieces.size() == 1) continue;
    ASSERT_EQ(blows.size(), 1U);
    const BodyImpact& blow = blows.front();
    glm::vec3 momentum(0.0F);
    float energy_j = 0.0F;
    for (const BodyState& body : state.bodies.states()) {
      if (body.id == block) continue;
      const float mass_kg = state.bodies.mass_kg(body.id);
      momentum += body.velocity_m_s * mass_kg;
      energy_j += 0.5F * mass_kg * glm::dot(body.velocity_m_s, body.velocity_m_s);
    }
    const float along = glm::dot(momentum, blow.normal);
    EXPECT_GT(along, 0.0F);
    EXPECT_LE(along, 1.001F * blow.impulse_n_s);
    EXPECT_LT(glm::length(momentum - along * blow.normal), 1e-4F * blow.impulse_n_s);
    const float blow_j = 0.5F * blow.impulse_n_s * blow.give_m_s;
    EXPECT_LE(energy_j, 1.001F * limits::dent_energy_share * blow_j);
  }
  EXPECT_GT(state.pieces.size(), 1U) << "there was a dent";
}

TEST(impact, soft_ground_dents_and_rock_does_not) {
  World soft(flat_world());
  step(soft, hang_block({0.0F, 20.0F, 0.0F}, 1.0F, 1));
  const auto dented = step_until<CarveOperation>(soft);
  ASSERT_NE(dented, nullptr);
  EXPECT_FALSE(dented->bricks.empty());
  EXPECT_EQ(soft.measure_terrain(), dented->ledger.terrain);

  // The same fall onto a slab, which is rock as all that is poured.
  World hard(flat_world());
  step(hard, {{1, 1, FillRequest{box({0.0F, 1.0F, 0.0F}, {5.0F, 2.0F, 5.0F})}}});
  step(hard, hang_block({0.0F, 23.0F, 0.0F}, 1.0F, 1));
  EXPECT_EQ(step_until<CarveOperation>(hard), nullptr);
}

TEST(impact, a_dent_is_of_the_party_whose_piece_fell) {
  World world(flat_world());
  step(world, hang_block({0.0F, 20.0F, 0.0F}, 1.0F, 1));
  const auto dented = step_until<CarveOperation>(world);
  ASSERT_NE(dented, nullptr);
  for (const AppliedOperation& applied : dented->operations) EXPECT_EQ(applied.party, 1U);
}

TEST(impact, caps_on_generations_size_and_count_keep_the_mass) {
  WorldConfig config = flat_world();
  config.pieces_max = 40;
  World world(config);
  auto delta = step(world, hang_block({0.0F, 30.0F, 0.0F}, 2.0F, 24));
  ASSERT_GT(delta->spawned.size(), 12U);
  uint64_t shatters = 0;
  for (int i = 0; i < 600; ++i) {
    delta = step(world);
    ASSERT_LE(delta->pieces.size(), config.pieces_max);
    ASSERT_EQ(delta->ledger.error(), 0);
    uint32_t in_tick = 0;
    for (const AppliedOperation& applied : delta->operations)
      in_tick += std::holds_alternative<ShatterOperation>(applied.operation) ? 1U : 0U;
    EXPECT_LE(in_tick, limits::breaks_per_tick_max);
    shatters += in_tick;
  }
  EXPECT_GT(shatters, 0U);
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
}

/// Takes every piece but the heaviest out of the world and throws that one at the ground anew.
PieceId throw_heaviest(World::State& state, TickDelta& delta) {
  const auto lighter = [](const auto& a, const auto& b) { return a.second->mass < b.second->mass; };
  const PieceId heaviest = std::ranges::max_element(state.pieces, lighter)->first;
  const PieceTraits traits = state.traits_of(heaviest);
  std::vector<PieceId> all;
  for (const auto& [id, volume] : state.pieces) all.push_back(id);
  for (const PieceId id : all) {
    if (state.bodies.contains(id)) state.bodies.remove(id);
    if (id != heaviest) state.apply_and_record(DiscardOperation{id}, 0, delta);
  }
  Applied again;
  again.created = {{heaviest, {}}};
  const auto born = [&](PieceId, const Volume&) {
    Newborn piece;
    piece.body.pose.position_m = {0.0F, 6.0F, 0.0F};
    piece.body.velocity_m_s = {0.0F, -40.0F, 0.0F};
    piece.traits = traits;
    return piece;
  };
  const PieceId next = std::exchange(state.next_piece, heaviest);
  spawn(state, again, born, delta);
  state.next_piece = std::max(next, heaviest + 1);
  return heaviest;
}

TEST(impact, a_piece_whose_ancestors_broke_often_enough_holds) {
  World::State state(flat_world(), 1);
  state.config.methods.dents = false;
  TickDelta delta;
  const Shape block = box({0.0F, 12.0F, 0.0F}, glm::vec3(3.0F));
  apply(FillOperation{block}, state.field, state.pieces);
  state.apply_and_record(
      CarveOperation{box({0.0F, 12.0F, 0.0F}, glm::vec3(4.0F)), SeedPattern::uniform, 1, 1, {}, 1}, 0, delta);
  for (int generation = 0; generation <= limits::break_generations_max; ++generation) {
    const PieceId piece = throw_heaviest(state, delta);
    ASSERT_GT(state.pieces.at(piece)->mass, 2 * limits::break_mass_min)
        << "its size is not to be why it holds";
    for (int tick = 0; tick < 60 && state.pieces.contains(piece); ++tick) {
      state.bodies.step();
      apply_impacts(state, delta);
    }
    EXPECT_EQ(state.pieces.contains(piece), generation == limits::break_generations_max)
        << "a piece whose ancestors broke " << generation << " times";
  }
}

TEST(impact, two_worlds_with_impacts_agree_at_every_tick) {
  World one(flat_world()), other(flat_world());
  for (int tick = 0; tick < 300; ++tick) {
    std::vector<Command> commands;
    if (tick % 60 == 0) commands = hang_block({static_cast<float>(tick) * 0.05F, 18.0F, 0.0F}, 1.0F, 2);
    const auto a = step(one, commands), b = step(other, commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
  }
}

TEST(impact, a_recorded_session_with_impacts_verifies) {
  const auto path =
      std::filesystem::temp_directory_path() / ("scree_impact_" + std::to_string(::getpid()) + ".scree");
  World world(flat_world());
  uint64_t shatters = 0;
  {
    auto recorder = Recorder::create(path.string(), {"test", world.config()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (int tick = 0; tick < 240; ++tick) {
      std::vector<Command> commands;
      if (tick == 3) commands = hang_block({0.0F, 18.0F, 0.0F}, 1.0F, 2);
      const auto delta = step(world, commands);
      shatters += find_operation<ShatterOperation>(*delta) != nullptr ? 1 : 0;
      (*recorder)->push(delta, commands);
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
  }
  EXPECT_GT(shatters, 0U);
  expect_verifies(path);
}

TEST(impact, a_follower_of_the_deltas_ends_with_the_same_pieces) {
  World world(flat_world());
  PublishedState published;
  auto delta = step(world, hang_block({0.0F, 18.0F, 0.0F}, 1.0F, 2));
  for (int tick = 0; tick < 200; ++tick) {
    published.apply(*delta);
    ASSERT_EQ(published.pieces().size(), delta->pieces.size());
    delta = step(world);
  }
}

}  // namespace
}  // namespace scree
