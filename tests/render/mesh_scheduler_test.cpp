// Which meshes are shown together, and when: without OpenGL.
#include "client/render/meshing/mesh_scheduler.h"

#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <latch>
#include <map>
#include <set>

#include "client/render/levels/block_windows.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

constexpr float view_radius_m = 14.0F;
constexpr unsigned pool_threads = 2;

/// A world of one field, and what a scheduler shows of it.
class Watched : public testing::Test {
 protected:
  /// One update; keeps what is shown.
  MeshUpdate update() {
    MeshUpdate update = scheduler_.update(Scene{field_, pieces_}, eye_m_);
    for (const SurfaceNode& node : update.gone) nodes_.erase(node);
    for (const NodeMesh& node : update.nodes) {
      nodes_.erase(node.node);
      if (!node.mesh.empty()) nodes_[node.node] = node.mesh;
    }
    for (const PieceId id : update.removed_pieces) shown_pieces_.erase(id);
    for (const PieceMesh& piece : update.pieces) shown_pieces_.insert(piece.id);
    return update;
  }

  void finish() {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    for (update(); !scheduler_.complete(); update()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << scheduler_.waiting() << " are still waiting";
      wait_a_moment();
    }
  }

  MirrorChanges apply_now(const Operation& operation) {
    MirrorChanges changes;
    const Applied applied = apply(operation, field_, table_);
    changes.bricks = applied.changed;
    for (const CreatedPiece& piece : applied.created) changes.pieces_added.push_back(piece.id);
    if (const auto* stamp = std::get_if<StampOperation>(&operation))
      changes.pieces_removed.push_back(stamp->piece);
    for (const PieceId id : changes.pieces_added) pieces_[id] = {table_.at(id), Pose{}};
    for (const PieceId id : changes.pieces_removed) pieces_.erase(id);
    return changes;
  }

  MirrorChanges carve(glm::vec3 at_m, PieceId first) {
    return apply_now(CarveOperation{sphere(at_m, 1.2F), SeedPattern::uniform, 8, first, at_m, first});
  }

  /// Every block within the view is shown as the field is now.
  void expect_current() {
    size_t surfaces = 0;
    for (int x = -2; x < 2; ++x)
      for (int y = -2; y < 2; ++y)
        for (int z = -2; z < 2; ++z) {
          const SurfaceNode node{0, {x, y, z}};
          const VoxelBox owned = samples_of(node);
          const std::optional<BlockWindows> windows = gather_windows(field_, owned);
          const SurfaceMesh now = windows ? windows->mesh(FaceEdges::sharp) : SurfaceMesh{};
          const auto shown = nodes_.find(node);
          ASSERT_EQ(now.empty(), shown == nodes_.end());
          if (now.empty()) continue;
          ++surfaces;
          ASSERT_EQ(now.indices, shown->second.indices);
          ASSERT_EQ(now.vertices.size(), shown->second.vertices.size());
          for (size_t i = 0; i < now.vertices.size(); ++i)
            ASSERT_EQ(now.vertices[i].position, shown->second.vertices[i].position);
        }
    EXPECT_GT(surfaces, 10U);
  }

  MapField field_{TerrainSource{TerrainKind::noise, 3, 0.25F}};
  PieceTable table_;
  ScenePieces pieces_;
  glm::vec3 eye_m_{0.0F, 2.0F, 0.0F};
  std::map<SurfaceNode, SurfaceMesh> nodes_;
  std::set<PieceId> shown_pieces_;
  WorkPool pool_{pool_threads};
  MeshScheduler scheduler_{pool_, view_radius_m, Polygoniser::nets};
};

TEST_F(Watched, everything_around_the_eye_is_loaded) {
  finish();
  expect_current();
}

TEST_F(Watched, changes_while_loading_are_not_lost) {
  Random random(11);
  PieceId first = 1;
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 at = (glm::vec3(random.unit(), random.unit(), random.unit()) - 0.5F) * 12.0F;
    const MirrorChanges changes = carve(at, first);
    first += static_cast<PieceId>(changes.pieces_added.size());
    scheduler_.changed(changes);
    update();
  }
  finish();
  expect_current();
  EXPECT_EQ(shown_pieces_.size(), pieces_.size());
}

TEST_F(Watched, a_piece_and_its_hole_appear_together) {
  finish();
  const glm::vec3 ground(0.0F, ground_height_m(field_.source(), 0.0F, 0.0F), 0.0F);
  const MirrorChanges changes = carve(ground, 1);
  ASSERT_FALSE(changes.bricks.empty());
  scheduler_.changed(changes);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!scheduler_.complete() && std::chrono::steady_clock::now() < deadline) {
    const MeshUpdate step = update();
    EXPECT_EQ(step.nodes.empty(), step.pieces.empty()) << "one without the other";
  }
  expect_current();
  EXPECT_EQ(shown_pieces_.size(), pieces_.size());
}

TEST_F(Watched, a_merge_and_the_pieces_vanishing_appear_together) {
  finish();
  const glm::vec3 ground(0.0F, ground_height_m(field_.source(), 0.0F, 0.0F), 0.0F);
  scheduler_.changed(carve(ground, 1));
  finish();
  ASSERT_FALSE(pieces_.empty());
  const PieceId id = pieces_.begin()->first;
  const Pose pose{ground + glm::vec3(1.8F, 0.4F, 0.0F), {1.0F, 0.0F, 0.0F, 0.0F}};
  const MirrorChanges merged = apply_now(StampOperation{id, quantise(pose), 0});
  ASSERT_FALSE(merged.bricks.empty());
  scheduler_.changed(merged);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!scheduler_.complete() && std::chrono::steady_clock::now() < deadline) {
    const MeshUpdate step = update();
    EXPECT_EQ(step.nodes.empty(), step.removed_pieces.empty()) << "one without the other";
  }
  EXPECT_FALSE(shown_pieces_.contains(id));
  expect_current();
}

TEST_F(Watched, what_is_left_behind_is_dropped_and_loaded_again) {
  finish();
  eye_m_.x = 200.0F;
  finish();
  for (const auto& [node, mesh] : nodes_) EXPECT_TRUE(node.level > 0 || node.at.x > 30);
  eye_m_.x = 0.0F;
  finish();
  expect_current();
}

/// Keeps all threads of a pool from whatever comes later, until it is gone.
class Jam {
 public:
  Jam(WorkPool& pool, unsigned threads) {
    const std::shared_future<void> open = open_.get_future().share();
    const auto jammed = std::make_shared<std::latch>(threads);
    for (unsigned i = 0; i < threads; ++i)
      pool.submit(WorkPool::Urgency::edit, [open, jammed] {
        jammed->count_down();
        open.wait();
      });
    jammed->wait();
  }
  ~Jam() { open_.set_value(); }
  Jam(const Jam&) = delete;
  Jam& operator=(const Jam&) = delete;

 private:
  std::promise<void> open_;
};

TEST_F(Watched, changes_overtake_growth_that_waits_for_its_terrain) {
  finish();
  MeshUpdate first;
  MirrorChanges changes;
  {
    const Jam jam(pool_, pool_threads);
    eye_m_.x = 200.0F;
    EXPECT_TRUE(update().nodes.empty());
    EXPECT_GT(scheduler_.waiting(), 0U);
    changes = carve({0.0F, ground_height_m(field_.source(), 0.0F, 0.0F), 0.0F}, 1);
    scheduler_.changed(changes);
    EXPECT_TRUE(update().nodes.empty());
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (first.nodes.empty() && std::chrono::steady_clock::now() < deadline) first = update();
  EXPECT_EQ(first.pieces.size(), changes.pieces_added.size());
  EXPECT_TRUE(first.gone.empty());
  finish();
  // The growth came after.
  for (const auto& [node, mesh] : nodes_) EXPECT_TRUE(node.level > 0 || node.at.x > 30);
  EXPECT_EQ(shown_pieces_.size(), pieces_.size());
}

}  // namespace
}  // namespace scree
