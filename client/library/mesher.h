// Meshes for programs: what the viewer's scheduler makes, as flat arrays.
#pragma once

#include <deque>
#include <optional>

#include "client/library/array_block.h"
#include "client/library/include/scree/client.h"
#include "client/render/meshing/mesh_scheduler.h"
#include "client/render/scene/work_pool.h"

namespace scree {

/// A mesh with its arrays, which lie in one block: 3 floats a position and a normal, 4 bytes an index, a byte
/// a material and a shade.
struct FlatMesh {
  scree_mesh mesh{};
  ArrayBlock block{};

  float* positions() const { return static_cast<float*>(block.memory()); }
  float* normals() const { return positions() + 3 * mesh.vertex_count; }
  uint32_t* indices() const { return reinterpret_cast<uint32_t*>(normals() + 3 * mesh.vertex_count); }
  uint8_t* materials() const { return reinterpret_cast<uint8_t*>(indices() + mesh.index_count); }
  uint8_t* shades() const { return materials() + mesh.vertex_count; }
};

}  // namespace scree

/// One thread uses it, together with its client, which outlives it.
struct scree_mesher {
  scree_mesher(scree_client& owner, const scree_mesher_options& options);
  ~scree_mesher();
  scree_mesher(const scree_mesher&) = delete;
  scree_mesher& operator=(const scree_mesher&) = delete;

  void changed(const scree::MirrorChanges& changes) { scheduler_->changed(changes); }
  /// For another mirror.
  void restart();
  /// False: there is no update.
  bool update(glm::vec3 eye_m);
  /// Null: that was the last.
  const scree_mesh* next();
  bool complete() const { return scheduler_->complete(); }

 private:
  void make_next();
  size_t left() const {
    return update_.nodes.size() + update_.gone.size() + update_.pieces.size() + update_.removed_pieces.size();
  }

  scree_client& owner_;
  scree_mesher_options options_;
  scree::WorkPool pool_;
  std::optional<scree::MeshScheduler> scheduler_;
  scree::MeshUpdate update_;  ///< what is not told of it yet, from the back
  std::optional<scree::FlatMesh> told_;
};
