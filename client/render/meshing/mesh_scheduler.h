// Decides which meshes are built, when, and which are shown together. No GL, so that tests can run it alone.
//
// Terrain is meshed in nodes of all levels of detail (surface_forest.h), in batches, one at a time: the
// mirror's changes and pieces, or some splits and joins of the forest, nearest first. All meshes of a batch
// replace the old ones at once, when all are ready. So there is never a hole, a crack between levels, or a
// piece beside the rock that it has become. The next batch is chosen when one ends, so that nothing is built
// for an earlier place of the eye.
//
// Changes go first: a batch of growth that still waits for generated terrain is undone for them. Growth that
// has its terrain takes turns with changes, so that the forest grows under any number of changes.
//
// Called from one thread; windows are copied out of the field there, generating and meshing run on the pool.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <unordered_set>
#include <vector>

#include "client/render/meshing/node_mesh.h"
#include "client/render/meshing/piece_mesh.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// Meshes to show from now on, all at once.
struct MeshUpdate {
  std::vector<NodeMesh> nodes;  ///< replace the nodes' meshes; empty ones show nothing
  std::vector<SurfaceNode> gone;
  std::vector<PieceMesh> pieces;
  std::vector<PieceId> removed_pieces;
};

class MeshScheduler {
 public:
  MeshScheduler(WorkPool& pool, float view_radius_m, Polygoniser polygoniser,
                FaceEdges edges = FaceEdges::sharp);
  ~MeshScheduler();

  void changed(const MirrorChanges& changes);
  /// Returns finished work, and begins new work.
  MeshUpdate update(const Scene& scene, glm::vec3 eye_m);
  /// Whether everything around the eye is shown at its level of detail, with all changes before the first
  /// update().
  bool loaded() const { return caught_up_ && grown_; }
  bool complete() const { return loaded() && waiting() == 0; }
  /// Nodes and changes not yet shown.
  size_t waiting() const;
  /// Terrain is drawn that far, metres.
  float reach_m() const;

 private:
  struct Inbox;  ///< results, filled by the workers
  struct Batch;
  struct LevelChunk {
    int level;
    ChunkCoord chunk;
    auto operator<=>(const LevelChunk&) const = default;
  };

  void start(const TerrainSource& source);
  void collect_results(const Field& field);
  bool has_changes() const;
  void begin_batch(const Scene& scene, glm::vec3 eye_m);
  void begin_growth(const Field& field, glm::vec3 eye_m);
  void begin_changes(const Scene& scene);
  void give_way();
  void ask_for_terrain(const Field& field);
  void generate_needed();
  void begin_meshes(const Field& field);
  void submit_piece(const Field& field, PieceId id, const ScenePiece& piece);

  WorkPool& pool_;
  float view_radius_m_;
  Polygoniser polygoniser_;
  FaceEdges edges_;
  std::shared_ptr<Inbox> inbox_;
  std::optional<SurfaceLevels> levels_;
  std::optional<SurfaceForest> forest_;
  bool caught_up_ = false;      ///< the first changes are shown
  bool grown_ = false;          ///< the forest needs no more steps
  bool growth_is_due_ = false;  ///< changes had their turn
  std::set<LevelChunk> generating_;
  MirrorChanges collected_;       ///< since the current batch began
  std::unique_ptr<Batch> batch_;  ///< in the works, or null
};

}  // namespace scree
