// A client's copy meets a server that sends what no world makes, within the letter of the codec: every
// message goes through the bytes of the wire, and ends in an error or in a change, never in a crash.
#include <cstdlib>
#include <gtest/gtest.h>

#include "client/mirror/limits.h"
#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "tests/support/flat_welcome.h"

namespace scree {
namespace {

/// As it comes off the wire; the error is the decoder's.
Result<MirrorChanges> send(Mirror& mirror, const ServerMessage& message) {
  const std::vector<uint8_t> framed = encode(message);
  const Result<ServerMessage> decoded =
      decode_server(std::span<const uint8_t>(framed).subspan(length_prefix_bytes));
  TRY(decoded);
  return mirror.apply(*decoded);
}

Volume block(int side, Code code = code_air) {
  Volume volume;
  volume.window = Window(VoxelBox{{0, 0, 0}, {side, side, side}}, code);
  volume.mass = mass_of(volume.window);
  volume.centre_voxels = glm::vec3(0.5F * static_cast<float>(side));
  return volume;
}

FrameMessage frame_of(const Operation& operation, Tick tick) {
  FrameMessage frame;
  frame.tick = tick;
  frame.operations = {operation};
  return frame;
}

TEST(HostileMirror, a_stamp_of_a_window_beyond_all_bounds_is_an_error) {
  for (const StampMethod method : all_kinds<StampMethod>)
    for (const Code code : {code_air, code_solid}) {
      Mirror mirror(flat_welcome());
      Volume volume = block(limits::window_side_max, code);
      volume.mass = int64_t{units_per_voxel} << 21;  // whatever its codes say
      const QuantisedPose turned = quantise({{}, {0.0F, 0.57735027F, 0.57735027F, 0.57735027F}});
      ASSERT_TRUE(send(mirror, PieceMessage{1, volume, turned}));
      const auto stamped = send(mirror, frame_of(StampOperation{1, turned, 0, method}, 1));
      ASSERT_FALSE(stamped);
      EXPECT_NE(stamped.error().message.find("stamp_voxels_max"), std::string::npos)
          << stamped.error().message;
    }
}

TEST(HostileMirror, chunks_that_it_never_offered_are_asked_for_and_bounded) {
  Mirror mirror(flat_welcome(), [](ChunkCoord) { return std::vector<BrickPatch>(); });
  UnchangedChunksMessage unchanged;
  unchanged.hashes.assign(limits::kept_chunks_max, 7);
  for (int round = 0;; ++round) {
    unchanged.chunks.clear();
    for (int i = 0; i < static_cast<int>(limits::kept_chunks_max); ++i)
      unchanged.chunks.push_back({round, 0, i});
    const auto applied = send(mirror, unchanged);
    if (!applied) {
      EXPECT_NE(applied.error().message.find("limits.mirror_chunks_max"), std::string::npos);
      break;
    }
    ASSERT_LE(mirror.held_chunks().size(), limits::mirror_chunks_max);
    const auto repair = mirror.next_repair_request();
    ASSERT_TRUE(repair);
    EXPECT_EQ(repair->hashes, std::vector<uint64_t>(limits::repair_chunks_max)) << "it has nothing of them";
    EXPECT_FALSE(mirror.next_repair_request());
  }
}

TEST(HostileMirror, chunks_of_which_the_last_part_never_comes_are_bounded) {
  Mirror mirror(flat_welcome());
  ChunkMessage part;
  part.edited = 1;
  part.more = true;
  for (size_t i = 0; i < limits::mirror_chunks_max; ++i) {
    part.chunk = {static_cast<int>(i % 1024), 0, static_cast<int>(i / 1024)};
    part.bricks = {{first_brick(part.chunk), solid_brick()}};
    ASSERT_TRUE(mirror.apply(part));
  }
  part.chunk.y = 1;
  part.bricks.clear();
  const auto applied = send(mirror, part);
  ASSERT_FALSE(applied);
  EXPECT_NE(applied.error().message.find("limits.mirror_chunks_max"), std::string::npos);
}

TEST(HostileMirror, a_frame_of_more_work_than_a_tick_ends_the_connection_before_it_is_done) {
  Mirror mirror(flat_welcome());
  FrameMessage frame;
  frame.tick = 1;
  CarveOperation carve;
  carve.shape = sphere({0.0F, 100.0F, 0.0F}, 8.0F);  // in the air, so it leaves nothing behind
  carve.cutter = Cutter::conform;
  carve.seeds = limits::seeds_max;
  for (int i = 0; i < 100; ++i) frame.operations.push_back(carve);
  const auto applied = send(mirror, frame);
  ASSERT_FALSE(applied);
  EXPECT_NE(applied.error().message.find("mirror_frame_work_max_us"), std::string::npos)
      << applied.error().message;
}

TEST(HostileMirror, a_centre_of_mass_far_from_its_volume_is_refused) {
  for (const glm::vec3 centre :
       {glm::vec3(9.5F, 1.0F, 1.0F), glm::vec3(1.0F, -0.5F, 1.0F), glm::vec3(1.0F, 1.0F, 16777216.0F)}) {
    Mirror mirror(flat_welcome());
    Volume volume = block(8, code_solid);
    volume.centre_voxels = centre;
    const auto sent = send(mirror, PieceMessage{1, volume, {}});
    ASSERT_FALSE(sent);
    EXPECT_NE(sent.error().message.find("centre of mass"), std::string::npos) << sent.error().message;
  }
}

/// Each is a hundred bytes on the wire and 2 MiB here.
TEST(HostileMirror, pieces_of_air_cannot_fill_the_memory) {
  Mirror mirror(flat_welcome());
  const Volume volume = block(limits::window_side_max);
  const size_t most = limits::piece_voxels_max / volume.window.codes.size();
  for (PieceId id = 1; id <= most; ++id) ASSERT_TRUE(send(mirror, PieceMessage{id, volume, {}})) << id;
  FrameMessage frame;
  frame.tick = 1;
  frame.removed_pieces = {7};
  ASSERT_TRUE(send(mirror, frame)) << "room is made";
  ASSERT_TRUE(send(mirror, PieceMessage{7, volume, {}}));
  const auto sent = send(mirror, PieceMessage{static_cast<PieceId>(most + 1), volume, {}});
  ASSERT_FALSE(sent);
  EXPECT_NE(sent.error().message.find("piece_voxels_max"), std::string::npos) << sent.error().message;
}

/// Volumes and operations of every kind, their numbers near and beyond what a world would give.
class Hostility {
 public:
  explicit Hostility(uint64_t seed) : random_(seed) {}

  Volume volume() {
    const VoxelCoord size{side(), side(), side()};
    const int far = chance(8) ? 1 << 20 : 40;
    const VoxelCoord lo{around(far), around(far), around(far)};
    Volume volume;
    volume.window = Window(VoxelBox{lo, lo + size});
    const uint32_t kind = random_.below(5);
    size_t i = 0;
    for (Code& code : volume.window.codes) code = code_of(kind, i++);
    volume.mass = chance(3) ? static_cast<MassUnits>(random_.below(500'000'000)) : mass_of(volume.window);
    volume.centre_voxels = {static_cast<float>(lo.x) + random_.unit() * static_cast<float>(size.x),
                            static_cast<float>(lo.y) + random_.unit() * static_cast<float>(size.y),
                            static_cast<float>(lo.z) + random_.unit() * static_cast<float>(size.z)};
    return volume;
  }
  QuantisedPose pose() {
    const int far = chance(4) ? 4'300'000 : 20'000;
    return {around(far), around(far), around(far), random_.next()};
  }
  Operation operation(PieceId piece, PieceId next) {
    const auto seeds = chance(4) ? limits::seeds_max : 1 + random_.below(40);
    const auto cutter = static_cast<Cutter>(random_.below(kind_count<StampMethod>));
    switch (random_.below(6)) {
      case 0:
        return StampOperation{piece, pose(), around(8191),
                              static_cast<StampMethod>(random_.below(kind_count<StampMethod>))};
      case 1: {
        StampOperation together{
            piece, {around(3000), around(3000), around(3000), random_.next()}, around(8191)};
        for (PieceId other = 1; other < piece && other < 5; ++other)
          together.others.push_back({other, {around(3000), around(3000), around(3000), random_.next()}});
        return together;
      }
      case 2:
        return ShatterOperation{piece,
                                drawn_patterns[random_.below(drawn_patterns.size())],
                                seeds,
                                random_.next(),
                                place(chance(2) ? 1e30F : 30.0F),
                                next,
                                cutter};
      case 3: {
        const VoxelCoord lo{around(200), around(40), around(200)};
        const VoxelCoord size{side() * 2, side() * 2, side() * 2};
        return IslandOperation{{lo, lo + size}, lo + VoxelCoord{size.x / 2, size.y / 2, size.z / 2}, next};
      }
      case 4:
        return PaintOperation{shape(), static_cast<Material>(random_.below(materials_max))};
      default:
        return CarveOperation{shape(),        drawn_patterns[random_.below(drawn_patterns.size())],
                              seeds % 64 + 1, random_.next(),
                              place(4000.0F), next,
                              cutter};
    }
  }

 private:
  bool chance(uint32_t of) { return random_.below(of) == 0; }
  int around(int most) { return static_cast<int>(random_.below(2 * static_cast<uint32_t>(most) + 1)) - most; }
  int side() {
    return chance(12) ? 1 + static_cast<int>(random_.below(48)) : 1 + static_cast<int>(random_.below(10));
  }
  glm::vec3 place(float most) {
    const float x = random_.unit() - 0.5F, y = random_.unit() - 0.5F;
    return glm::vec3(x, y, random_.unit() - 0.5F) * (2.0F * most);
  }
  Code code_of(uint32_t kind, size_t i) {
    switch (kind) {
      case 0:
        return code_air;
      case 1:
        return code_solid;
      case 2:
        return i % 2 == 0 ? code_solid : code_air;
      case 3:
        return chance(200) ? code_solid : code_air;
      default:
        return static_cast<Code>(static_cast<int>(random_.below(255)) - 127);
    }
  }
  Shape shape() {
    const glm::vec3 at = place(chance(6) ? 5000.0F : 20.0F);
    switch (random_.below(kind_count<StampMethod>)) {
      case 0:
        return box(at, glm::abs(place(1.5F)));
      case 1:
        return capsule(at, at + place(2.0F), random_.unit());
      default:
        return sphere(at, random_.unit() * 2.0F);
    }
  }

  Random random_;
};

TEST(HostileMirror, seeded_pieces_and_operations_are_survived) {
  const char* given = std::getenv("SCREE_FUZZ_SEED");
  const char* rounds = std::getenv("SCREE_FUZZ_ROUNDS");
  const uint64_t seed = given != nullptr ? std::strtoull(given, nullptr, 10) : 135;
  const uint64_t count = rounds != nullptr ? std::strtoull(rounds, nullptr, 10) : 60;
  std::printf("fuzz seed %llu (SCREE_FUZZ_SEED)\n", static_cast<unsigned long long>(seed));
  uint64_t applied = 0, refused = 0;
  for (uint64_t round = 0; round < count; ++round) {
    Hostility hostility(seed + round);
    Mirror mirror(flat_welcome(round % 3 == 0 ? limits::voxel_size_min_m : voxel_m));
    bool alive = true;
    for (PieceId id = 1; alive && id <= 6; ++id)
      alive = send(mirror, PieceMessage{id, hostility.volume(), hostility.pose()}).has_value();
    ASSERT_TRUE(alive) << "every such piece is valid";
    for (Tick tick = 1; tick <= 6; ++tick) {
      const bool done = send(mirror, frame_of(hostility.operation(static_cast<PieceId>(7 - tick),
                                                                  static_cast<PieceId>(tick * 10000)),
                                              tick))
                            .has_value();
      ++(done ? applied : refused);
    }
  }
  EXPECT_GT(applied, count) << "the operations are too hostile to reach the kernels";
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace scree
