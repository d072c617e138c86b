// A flight over ground that is carved and grows together again all the while, by every method: no frame shows
// a hole, and nothing is left behind.
#include <cmath>
#include <deque>
#include <malloc.h>
#include <string>
#include <vector>

#include "client/render/methods.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/offscreen_fixture.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const MethodEntry& entry : all_methods()) names.push_back(entry.name);
  return names;
}

/// What was there at some moment.
struct Moment {
  std::unique_ptr<MapField> field;
  ScenePieces pieces;
};

class Flight : public OffscreenTest, public testing::WithParamInterface<std::string_view> {
 protected:
  Flight() : OffscreenTest(GetParam(), {TerrainKind::noise, 3, voxel_m}, 8.0F) {}

  void SetUp() override {
    OffscreenTest::SetUp();
    if (const auto missing = method_named(GetParam())->missing()) GTEST_SKIP() << *missing;
  }

  float ground_m(float x, float z) { return ground_height_m(field_.source(), x, z); }

  /// A blow. Its pieces lie a little off their places from then on, and those of the blow before the last
  /// become ground where they lie.
  void blow(glm::vec3 at_m, float radius_m, uint32_t seeds) {
    MirrorChanges changes;
    const CarveOperation carve{sphere(at_m, radius_m), SeedPattern::uniform, seeds, 5, at_m, next_piece_};
    const Applied applied = apply(carve, field_, table_);
    next_piece_ += static_cast<PieceId>(applied.created.size());
    changes.bricks = applied.changed;
    for (const CreatedPiece& piece : applied.created) {
      const glm::vec3 home_m = table_.at(piece.id)->centre_voxels * voxel_m;
      pieces_[piece.id] = {table_.at(piece.id), Pose{home_m + glm::vec3(0.1F, 0.3F, 0.0F), {}}};
      changes.pieces_added.push_back(piece.id);
    }
    lying_.push_back(changes.pieces_added);
    if (lying_.size() > 2) {
      merge(lying_.front(), changes);
      lying_.pop_front();
    }
    bricks_.insert(bricks_.end(), changes.bricks.begin(), changes.bricks.end());
    method_->changed(changes);
  }
  void merge(const std::vector<PieceId>& pieces, MirrorChanges& changes) {
    for (const PieceId piece : pieces) {
      const StampOperation stamp{piece, quantise(pieces_.at(piece).pose), 0};
      const Applied applied = apply(stamp, field_, table_);
      changes.bricks.insert(changes.bricks.end(), applied.changed.begin(), applied.changed.end());
      pieces_.erase(piece);
      changes.pieces_removed.push_back(piece);
    }
  }

  Moment moment() {
    Moment now{std::make_unique<MapField>(field_.source()), pieces_};
    for (const ChunkCoord chunk : field_.edited_chunks())
      for (const BrickCoord brick : field_.edited_bricks(chunk))
        now.field->set_brick(brick, field_.brick(brick));
    return now;
  }
  void travel_to(const Moment& moment) {
    for (const BrickCoord brick : bricks_) field_.set_brick(brick, moment.field->brick(brick));
  }
  std::vector<float> depths(DrawMethod& method) {
    const Result<DepthImage> image = renderer_->draw_depths(method, camera_, width, height);
    EXPECT_TRUE(image) << image.error().message;
    return image ? image->metres : std::vector<float>(width * height);
  }
  /// By a method that saw none of the flight, each moment when it is all there: the deepest of all, pixel by
  /// pixel.
  std::vector<float> settled(DrawMethod& method, const std::deque<Moment>& moments) {
    std::vector<float> deepest(width * height, 0.0F);
    for (const Moment& moment : moments) {
      travel_to(moment);
      MirrorChanges changes{bricks_, {}, {}};
      for (const auto& [id, piece] : pieces_) changes.pieces_removed.push_back(id);
      for (const auto& [id, piece] : moment.pieces) changes.pieces_added.push_back(id);
      pieces_ = moment.pieces;
      method.changed(changes);
      finish(method);
      const std::vector<float> then = depths(method);
      for (size_t i = 0; i < then.size(); ++i) deepest[i] = std::max(deepest[i], then[i]);
    }
    return deepest;
  }
  /// A ball becomes a piece; the next frame it is gone, and the ball is filled again.
  void carve_and_fill(const Shape& ball) {
    const PieceId piece = next_piece_++;
    const CarveOperation carve{ball, SeedPattern::uniform, 1, 5, {}, piece};
    const std::vector<BrickCoord> carved = apply(carve, field_, table_).changed;
    pieces_[piece] = {table_.at(piece), Pose{table_.at(piece)->centre_voxels * voxel_m, {}}};
    method_->changed({carved, {piece}, {}});
    method_->update(Scene{field_, pieces_}, camera_);
    pieces_.clear();
    apply(DiscardOperation{piece}, field_, table_);
    method_->changed({apply(FillOperation{ball}, field_, table_).changed, {}, {piece}});
    method_->update(Scene{field_, pieces_}, camera_);
  }
  /// What this process has allocated when all is shown; with a software driver, its textures and buffers,
  /// too.
  size_t settled_heap_bytes() {
    finish();
    draw();
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
  }
  static bool amidst_rock(const std::vector<float>& depths, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
        if (std::isinf(depths[static_cast<size_t>(v * width + u)])) return false;
    return true;
  }
  /// Near by, where one level of detail shows all, any depth behind the settled one; farther off, where hills
  /// may still be coarser than they will be, sky below what is drawn.
  static size_t holes(const std::vector<float>& drawn, const std::vector<float>& settled) {
    constexpr float near_m = 12.0F, slack_m = voxel_m * 0.5F;
    size_t count = 0;
    for (int x = 0; x < width; ++x) {
      bool below_rock = false;
      for (int y = 0; y < height; ++y) {
        const auto i = static_cast<size_t>(y * width + x);
        const bool deep = settled[i] < near_m && drawn[i] > settled[i] + slack_m;
        const bool sky = below_rock && std::isinf(drawn[i]) && amidst_rock(settled, x, y);
        if (deep || sky) ++count;
        below_rock = below_rock || std::isfinite(drawn[i]);
      }
    }
    return count;
  }

  PieceTable table_;
  std::deque<std::vector<PieceId>> lying_;  ///< by blow
  std::vector<BrickCoord> bricks_;          ///< changed since the leg began
};

TEST_P(Flight, no_frame_shows_a_hole) {
  constexpr int legs = 2, frames = 5;
  for (int leg = 0; leg < legs; ++leg) {
    // What a frame shows is one of these: all is shown when a leg begins, and not awaited from then on.
    std::deque<Moment> moments;
    bricks_.clear();
    const std::unique_ptr<DrawMethod> fresh = make_method();
    for (int frame = 0; frame < frames; ++frame) {
      const float x = -12.0F + 0.3F * static_cast<float>(leg * frames + frame);
      camera_ = {{x, ground_m(x, 0.0F) + 5.0F, 0.0F}, -1.5708F, -0.5F};
      if (frame == 0) {
        finish();
        moments.push_back(moment());
      }
      if (frame % 3 == 1) {
        const float z = static_cast<float>((leg + frame) % 5) - 2.0F;
        blow({x + 5.0F, ground_m(x + 5.0F, z), z}, 1.2F, 6);
        moments.push_back(moment());
      }
      method_->update(Scene{field_, pieces_}, camera_);
      const std::vector<float> drawn = depths(*method_);
      if (frame != frames - 1) continue;
      EXPECT_EQ(holes(drawn, settled(*fresh, moments)), 0U) << "leg " << leg << ", frame " << frame;
    }
  }
}

TEST_P(Flight, nothing_is_left_of_many_edits) {
  constexpr int edits_a_round = 3;  // carve, discard, fill
  constexpr int times = rounds(4000, 1000) / edits_a_round + 1, warm_up = times / 4, places_a_side = 7;
  camera_ = {{0.0F, ground_m(0.0F, 0.0F) + 5.0F, 6.0F}, 0.0F, -0.5F};
  finish();
  size_t warm_heap_bytes = 0;
  for (int round = 0; round < times; ++round) {
    const auto along = [](int place) {
      return 1.5F * static_cast<float>(place % places_a_side - places_a_side / 2);
    };
    const float x = along(round), z = along(round / places_a_side);
    carve_and_fill(sphere({x, ground_m(x, z), z}, 0.9F));
    if (round == warm_up) warm_heap_bytes = settled_heap_bytes();
  }
  const size_t heap_bytes = settled_heap_bytes();
  // What the driver and the allocator take once, now and then, is up to 5 MiB.
  EXPECT_LT(heap_bytes, warm_heap_bytes + (size_t{8} << 20));
  draw();
  const DrawStats flown = method_->stats();

  method_ = make_method();
  finish();
  draw();
  const DrawStats fresh = method_->stats();
  EXPECT_EQ(flown.pieces, 0U);
  EXPECT_EQ(flown.resident, fresh.resident);
  EXPECT_EQ(flown.draws, fresh.draws);
  EXPECT_EQ(flown.triangles, fresh.triangles);
  ASSERT_EQ(flown.memory.size(), fresh.memory.size());
  for (size_t i = 0; i < fresh.memory.size(); ++i) {
    EXPECT_EQ(flown.memory[i].cpu_bytes, fresh.memory[i].cpu_bytes) << fresh.memory[i].category;
    EXPECT_EQ(flown.memory[i].gpu_bytes, fresh.memory[i].gpu_bytes) << fresh.memory[i].category;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Flight, testing::ValuesIn(method_names()),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace scree
