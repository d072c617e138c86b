// Scenes of a world that goes on: what does not change is shared from one to the next, namely what was read
// of the field, and the convex parts of props. Some 0.3 µs a body. For one thread at a time.
#pragma once

#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "shared/prop/prop.h"
#include "shared/query/scene.h"

namespace scree {

/// The parts of a prop as questions see them, rounded hulls in the prop's axes. Each passes validate().
std::vector<Convex> convex_parts_of(const Prop& prop);

/// A scene that holds its solids and the parts of its props. The field, the volumes and the maker outlive it.
class HeldScene {
 public:
  using Parts = std::shared_ptr<const std::vector<Convex>>;

  HeldScene(const Field& field, FieldCells& terrain, std::vector<QuerySolid> solids, std::vector<Parts> parts)
      : parts_(std::move(parts)), solids_(std::move(solids)), scene_(field, solids_, terrain) {}
  HeldScene(const Field& field, std::vector<QuerySolid> solids, std::vector<Parts> parts)
      : parts_(std::move(parts)), solids_(std::move(solids)), scene_(field, solids_) {}
  HeldScene(HeldScene&&) = default;
  HeldScene(const HeldScene&) = delete;
  HeldScene& operator=(const HeldScene&) = delete;
  HeldScene& operator=(HeldScene&&) = delete;
  ~HeldScene() = default;

  // NOLINTNEXTLINE(google-explicit-constructor): it is asked as any scene is.
  operator const QueryScene&() const { return scene_; }
  const QueryScene& scene() const { return scene_; }

 private:
  std::vector<Parts> parts_;
  std::vector<QuerySolid> solids_;
  QueryScene scene_;
};

class SceneMaker {
 public:
  /// Codes or materials of the chunk have changed, or its ground has arrived.
  void forget(ChunkCoord chunk) {
    if (cells_ != nullptr) changed_.insert(chunk);
  }
  /// Begins a scene of about so many bodies. Then come all pieces, in order, then all props, in order.
  void begin(size_t bodies);
  void add_piece(PieceId id, const Pose& pose, const Volume& volume);
  void add_prop(PieceId id, const Pose& pose, const std::shared_ptr<const Prop>& prop);
  /// What was read of the field is kept, and scenes share it: it is the same field each time.
  HeldScene make(const Field& field);
  /// What is read is the scene's own.
  HeldScene make_apart(const Field& field);

 private:
  struct Known {
    std::shared_ptr<const Prop> prop;
    HeldScene::Parts parts;
  };
  void put_in_order();

  std::unordered_map<PieceId, Known> known_;
  std::unique_ptr<FieldCells> cells_;
  std::unordered_set<ChunkCoord, CoordHash> changed_;
  std::vector<QuerySolid> solids_;
  std::vector<HeldScene::Parts> parts_;
  size_t pieces_ = 0;
};

}  // namespace scree
