// Pieces as their own volumes on the GPU: bricks in an atlas, entries in a texture of their own, and one
// instance each, whose box is drawn and marched through (client/shaders/piece.glsl). Needs the GL context
// current.
//
// A piece's bricks begin one voxel before its first rock, so that all of its surface lies in them.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "client/render/bricks/brick_atlas.h"
#include "client/render/bricks/clip_window.h"
#include "client/render/scene/draw_method.h"

namespace scree {

class PieceVolumes {
 public:
  /// Entries in a row of the texture, as client/shaders/piece.glsl has it.
  static constexpr int entries_row = 256;

  explicit PieceVolumes(FaceEdges edges);

  /// Shows exactly these pieces, where they are now. New ones are uploaded: the cost grows with their number.
  void update(const Field& field, const ScenePieces& pieces, BrickAtlas& atlas);
  /// Draws the boxes' far sides with the program that is in use. Binds a vertex array of its own.
  void draw() const;

  unsigned entry_texture() const { return entries_texture_.name(); }
  size_t count() const { return instances_.size(); }
  size_t gpu_bytes() const;
  size_t cpu_bytes() const;

 private:
  /// As client/shaders/piece.vert takes it.
  struct Instance {
    std::array<float, 4> place;
    std::array<float, 4> rotation;
    std::array<float, 3> centre;
    std::array<float, 3> size;
    std::array<float, 3> origin;
    std::array<int32_t, 4> bricks;
  };
  struct Stored {
    std::shared_ptr<const Volume> volume;
    Instance instance;
    uint32_t first = 0;
    uint32_t count = 0;
  };

  Stored store(const Field& field, const ScenePiece& piece, BrickAtlas& atlas);
  void drop(const Stored& stored, BrickAtlas& atlas);
  uint32_t allocate_run(uint32_t count);
  void upload_entries(uint32_t first, uint32_t count);
  void upload_instances(const ScenePieces& pieces);

  FaceEdges edges_;
  gl::Texture entries_texture_;
  gl::Buffer instance_buffer_;
  gl::VertexArray array_;
  std::vector<ClipEntry> entries_;
  std::array<std::vector<uint32_t>, 32> free_runs_;  ///< by the logarithm of their length
  uint32_t used_ = 0;                                ///< entries beyond were never handed out
  std::unordered_map<PieceId, Stored> stored_;
  std::vector<Instance> instances_;
};

}  // namespace scree
