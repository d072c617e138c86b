// Terrain painted with a material: on every field alike, in a running world, for clients and in recordings.
#include "shared/field/paint.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "server/field/vdb_field.h"
#include "server/publish/publisher.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/limits.h"
#include "server/store/recorder.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

const Shape patch = box({0.0F, 0.0F, 0.0F}, {5.0F, 3.0F, 5.0F});

Command paint_it(Material material, const Shape& shape = patch) {
  return {1, 1, PaintRequest{shape, material}};
}

Command carve_at(glm::vec3 centre_m, uint32_t seeds = 6) {
  CarveRequest carve;
  carve.shape = sphere(centre_m, 1.5F);
  carve.seeds = seeds;
  carve.impact_m = centre_m + glm::vec3(0.0F, 1.5F, 0.0F);
  return {1, 2, carve};
}

TEST(paint, a_shape_is_rounded_to_the_bricks_whose_centres_it_holds) {
  // Bricks are 2 m wide: from −4 to 4 m along x and z, from −2 to 2 m along y.
  const std::vector<BrickCoord> bricks =
      bricks_of(in_voxels(box({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 4.0F}), voxel_m));
  EXPECT_EQ(bricks.size(), 4U * 2U * 4U);
  EXPECT_TRUE(std::ranges::is_sorted(bricks));
  const VoxelBox box = paint_box(in_voxels(scree::box({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 4.0F}), voxel_m));
  EXPECT_EQ(box, (VoxelBox{{-16, -8, -16}, {16, 8, 16}}));
  EXPECT_EQ(bricks_of(in_voxels(sphere({0.3F, 0.3F, 0.3F}, 0.2F), voxel_m)),
            std::vector<BrickCoord>{BrickCoord{}})
      << "too small for any centre: the brick that holds it";
}

TEST(paint, hashes_know_it_only_where_it_is_and_forget_it_with_its_chunk) {
  MapField map(flat_terrain);
  VdbField vdb(flat_terrain);
  const auto fields = {static_cast<Field*>(&map), static_cast<Field*>(&vdb)};
  for (Field* field : fields) {
    const BrickCoord coord{0, -1, 0};
    const Brick codes = field->brick(coord);
    field->set_materials(coord, BrickMaterials());
    EXPECT_EQ(field->hash(), 0U) << "no paint off what has none";
    field->set_materials(coord, all_of(material::ice));
    EXPECT_EQ(field->brick(coord), codes);
    EXPECT_EQ(field->materials(coord), all_of(material::ice));
    EXPECT_EQ(field->hash(), brick_hash(coord, codes, all_of(material::ice)));
    EXPECT_NE(field->hash(), brick_hash(coord, codes, all_of(material::soil)));
    EXPECT_NE(field->hash(), brick_hash(coord, codes));
    EXPECT_EQ(field->chunk_hash(chunk_of(coord)), field->hash());
    field->set_brick(coord, air_brick());
    EXPECT_EQ(field->materials(coord), all_of(material::ice)) << "paint stays";
    EXPECT_EQ(field->hash(), brick_hash(coord, air_brick(), all_of(material::ice)));
    field->set_materials(coord, BrickMaterials());
    EXPECT_EQ(field->hash(), brick_hash(coord, air_brick()));
    field->set_materials(coord, all_of(material::rock));
    field->forget_chunk(chunk_of(coord));
    EXPECT_TRUE(field->materials(coord).is_ground());
    EXPECT_EQ(field->hash(), 0U);
    const std::vector<BrickCoord> painted = paint_bricks(*field, in_voxels(patch, voxel_m), material::ice);
    EXPECT_FALSE(painted.empty());
    EXPECT_TRUE(paint_bricks(*field, in_voxels(patch, voxel_m), material::ice).empty())
        << "it was ice before";
  }
  EXPECT_EQ(map.hash(), vdb.hash());
}

TEST(paint, a_piece_is_made_of_what_its_place_was_painted_and_keeps_it) {
  World world(flat_world());
  world.step({{paint_it(material::ice)}});
  auto delta = world.step({{carve_at({0.0F, -0.3F, 0.0F})}});
  ASSERT_EQ(delta->replies.front().refusal, "");
  std::vector<SpawnedPiece> spawned = delta->spawned;
  delta = world.step({{carve_at({20.0F, 0.0F, 0.0F})}});
  ASSERT_EQ(delta->replies.front().refusal, "");
  spawned.insert(spawned.end(), delta->spawned.begin(), delta->spawned.end());
  EXPECT_EQ(delta->ledger.error(), 0);
  size_t ice = 0, soil = 0;
  for (const SpawnedPiece& piece : spawned) {
    const bool painted = piece.volume->centre_voxels.x < 40.0F;
    EXPECT_EQ(main_material(*piece.volume) == material::ice, painted);
    ice += main_material(*piece.volume) == material::ice ? 1 : 0;
    soil += main_material(*piece.volume) == material::soil ? 1 : 0;
  }
  EXPECT_GT(ice, 2U);
  EXPECT_GT(soil, 0U);
  const std::vector<Command> other{paint_it(material::rock)};
  world.step(other);
  MapField field(flat_terrain);
  PieceTable pieces{{1, spawned.front().volume}};
  const Volume& parent = *spawned.front().volume;
  ASSERT_EQ(main_material(parent), material::ice);
  apply(ShatterOperation{1, SeedPattern::uniform, 3, 1, parent.centre_voxels, 10}, field, pieces);
  ASSERT_GE(pieces.size(), 2U);
  for (const auto& [id, child] : pieces) EXPECT_EQ(main_material(*child), material::ice);
}

TEST(paint, an_island_is_made_of_what_its_place_was_painted) {
  MapField field(flat_terrain);
  PieceTable pieces;
  apply(FillOperation{sphere({0.0F, 5.0F, 0.0F}, 1.0F)}, field, pieces);
  apply(PaintOperation{sphere({0.0F, 5.0F, 0.0F}, 3.0F), material::soil}, field, pieces);
  apply(IslandOperation{{{-4, 16, -4}, {5, 25, 5}}, {0, 20, 0}, 5}, field, pieces);
  ASSERT_TRUE(pieces.contains(5));
  EXPECT_EQ(main_material(*pieces.at(5)), material::soil);
}

TEST(paint, the_reply_says_how_many_bricks_were_painted) {
  World world(flat_world());
  const auto painted = [&](Material material, const Shape& shape) {
    const std::vector<Command> commands{paint_it(material, shape)};
    const Reply reply = world.step(commands)->replies.front();
    EXPECT_EQ(reply.refusal, "");
    EXPECT_EQ(reply.pieces, 0U);
    return reply.painted;
  };
  const auto first = painted(material::ice, patch);
  ASSERT_TRUE(first.has_value());
  EXPECT_GT(*first, 0U);
  EXPECT_EQ(painted(material::ice, patch), 0U) << "all of them are ice";
  EXPECT_EQ(painted(material::soil, sphere({2.0F, 9.0F, 2.0F}, 0.9F)), 0U) << "there is air alone";
  const std::vector<Command> carve{carve_at({0.0F, -0.3F, 0.0F})};
  EXPECT_FALSE(world.step(carve)->replies.front().painted.has_value());
  EXPECT_FALSE(
      world.step({{paint_it(material::ice, sphere({}, -1.0F))}})->replies.front().painted.has_value());
}

TEST(paint, what_cannot_be_painted_is_refused_by_name_and_changes_nothing) {
  World world(flat_world());
  const auto refusal = [&](Material material, const Shape& shape) {
    const std::vector<Command> commands{paint_it(material, shape)};
    const auto delta = world.step(commands);
    EXPECT_EQ(delta->field_hash, 0U);
    return delta->replies.front().refusal;
  };
  EXPECT_NE(refusal(static_cast<Material>(materials_max), patch).find("material"), std::string::npos);
  EXPECT_NE(refusal(material::ice, sphere({}, 9.0F)).find("may be at most 8 m"), std::string::npos);
  EXPECT_NE(refusal(material::ice, sphere({}, -1.0F)).find("negative"), std::string::npos);
  EXPECT_NE(refusal(material::ice, sphere({1e6F, 0, 0}, 1.0F)).find("outside the world"), std::string::npos);
}

TEST(paint, bytes_with_materials_of_what_is_not_there_are_refused) {
  const std::vector<BrickPatch> bricks{{{0, 0, 0}, air_brick(), all_of(material::ice)},
                                       {{0, 0, 1}, air_brick(), {}}};
  const std::vector<uint8_t> bytes = encode_bricks(bricks);
  const auto decoded = decode_bricks(bytes);
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ((*decoded)[0].materials, all_of(material::ice));
  EXPECT_TRUE((*decoded)[1].materials.is_ground());
  // varint 2, two coordinates of three bytes, varint 1, varint 0, u8 2
  const auto refused = [&](size_t at, uint8_t value, const char* word) {
    std::vector<uint8_t> damaged = bytes;
    damaged.at(at) = value;
    const auto got = decode_bricks(damaged);
    ASSERT_FALSE(got) << word;
    EXPECT_NE(got.error().message.find(word), std::string::npos) << got.error().message;
  };
  refused(7, 3, "bricks with materials");
  refused(8, 2, "beyond the last brick");
  // 255 says that each voxel has its own material: then their bytes are missing.
  refused(9, materials_max, "do not declare 1536 bytes");
}

/// What a client gets of a world, from the tick at which it joins.
class Client {
 public:
  Client(Publisher& publisher, uint64_t session, glm::vec3 eye_m, float radius_m) : session_(session) {
    WelcomeMessage welcome;
    welcome.terrain = terrain_of_worlds(flat_terrain);
    welcome.tick = publisher.state().tick();
    mirror = std::make_unique<Mirror>(welcome);
    publisher.join(session, eye_m, radius_m, operation_kinds);
  }
  void receive(const std::vector<Outgoing>& outgoing) {
    for (const Outgoing& message : outgoing) {
      if (message.session != session_) continue;
      const auto decoded = decode_server(std::span(*message.bytes).subspan(length_prefix_bytes));
      ASSERT_TRUE(decoded) << decoded.error().message;
      const auto applied = mirror->apply(*decoded);
      ASSERT_TRUE(applied) << applied.error().message;
      for (const BrickCoord coord : applied->bricks) changed.push_back(coord);
    }
  }
  std::unique_ptr<Mirror> mirror;
  std::vector<BrickCoord> changed;

 private:
  uint64_t session_;
};

void expect_same(const Client& client, World& world) {
  EXPECT_EQ(client.mirror->mismatches(), 0U);
  EXPECT_FALSE(client.mirror->held_chunks().empty());
  for (const ChunkCoord chunk : client.mirror->held_chunks()) {
    EXPECT_EQ(client.mirror->field().chunk_hash(chunk), world.field().chunk_hash(chunk));
    for (const BrickCoord coord : world.field().edited_bricks(chunk))
      EXPECT_EQ(client.mirror->field().materials(coord), world.field().materials(coord));
  }
}

TEST(paint, clients_see_it_live_late_and_from_the_edge_of_their_interest) {
  World world(flat_world());
  Workers workers(1);
  Publisher publisher({flat_terrain, 60, 3}, workers);
  const auto tick = [&](const std::vector<Command>& commands, std::initializer_list<Client*> clients) {
    const auto delta = world.step(commands);
    const auto outgoing = publisher.publish(*delta, [](uint64_t) { return Backlog{}; });
    for (Client* client : clients) client->receive(outgoing);
  };
  Client live(publisher, 1, {0.0F, 0.0F, 0.0F}, 64.0F);
  Client beside(publisher, 2, {14.0F, 0.0F, 0.0F}, 5.0F);
  tick({}, {&live, &beside});
  tick({carve_at({3.0F, -0.3F, 0.0F})}, {&live, &beside});
  tick({paint_it(material::ice, box({4.0F, 0.0F, 0.0F}, {8.0F, 3.0F, 5.0F}))}, {&live, &beside});
  EXPECT_EQ(live.mirror->counters().operations.of<PaintOperation>(), 1U);
  EXPECT_EQ(material_at(live.mirror->field(), {3.9F, -1.9F, 0.1F}), material::ice);
  EXPECT_TRUE(std::ranges::find(live.changed, BrickCoord{1, -1, 0}) != live.changed.end())
      << "meshes of painted bricks must be made anew";
  Client late(publisher, 3, {0.0F, 0.0F, 0.0F}, 64.0F);
  tick({paint_it(material::soil, sphere({-6.0F, 0.0F, 0.0F}, 3.0F)), carve_at({-6.0F, -0.3F, 0.0F})},
       {&live, &beside, &late});
  for (int i = 0; i < 30; ++i) tick({}, {&live, &beside, &late});
  for (const Client* client : {&live, &beside, &late}) expect_same(*client, world);
  EXPECT_EQ(late.mirror->field().hash(), world.field().hash());
  size_t mixed = 0;
  for (const auto& [id, motion] : late.mirror->pieces()) {
    const Volume& seen_made = *live.mirror->pieces().at(id).volume;
    EXPECT_EQ(motion.volume->materials.each, seen_made.materials.each);
    EXPECT_EQ(motion.volume->materials.all, seen_made.materials.all);
    EXPECT_EQ(motion.volume->masses, seen_made.masses);
    mixed += motion.volume->materials.is_uniform() ? 0 : 1;
  }
  EXPECT_GT(mixed, 0U) << "some were cut out of soil and rock at once";
}

TEST(paint, a_recorded_session_verifies_and_plays_from_its_middle) {
  const auto folder = std::filesystem::temp_directory_path() / ("scree_paint_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "session.scree").string();
  auto recorder = Recorder::create(path, {"test", flat_world()});
  ASSERT_TRUE(recorder) << recorder.error().message;
  World world(flat_world());
  const Tick last = limits::ticks_per_keyframe + 10;
  for (Tick tick = 1; tick <= last; ++tick) {
    std::vector<Command> commands;
    if (tick == 2) commands = {paint_it(material::ice), carve_at({0.0F, -0.3F, 0.0F})};
    if (tick == last - 12) commands = {carve_at({1.0F, -1.0F, 3.0F}), paint_it(material::soil)};
    (*recorder)->push(world.step(commands), commands);
  }
  ASSERT_TRUE((*recorder)->finish());
  {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    const auto report = verify(**reader);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->difference;
    EXPECT_EQ(report->commands, 4U);
    auto source = ReplaySource::open(path, last);
    ASSERT_TRUE(source) << source.error().message;
    const auto whole = (*source)->next();
    ASSERT_TRUE(whole && *whole);
    EXPECT_EQ((*whole)->field_hash, world.field().hash());
    size_t painted = 0;
    for (const BrickState& state : (*whole)->bricks) {
      EXPECT_EQ(state.materials, world.field().materials(state.coord));
      painted += std::ranges::count(state.materials.list(), said(material::soil)) > 0 ? 1 : 0;
    }
    EXPECT_GT(painted, 10U);
    for (const SpawnedPiece& piece : (*whole)->spawned)
      EXPECT_NE(main_material(*piece.volume), material::rock);  // dents since then are of soil
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace scree
