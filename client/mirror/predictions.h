// What this client has asked for and the server has not answered yet, laid over the mirror's field: for
// drawing and aiming alone, the mirror stays exact.
//
// A prediction is the operation that the server will probably make of a request, carried out by the same
// kernels on a layer over the mirror's field; its pieces lie where they are cut. It goes away when the
// server's operation or answer has come, and when neither comes in time. When the mirror changes where
// predictions read, all are carried out anew, in the order of asking. Bounded in number and in work. Time
// comes in as an argument, in seconds. Not thread-safe.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "client/mirror/mirror.h"

namespace scree {

class Predictions {
  /// Ids of predicted pieces, far above any that a server gives: it counts from one.
  static constexpr PieceId first_predicted_piece = 0xC0000000U;

 public:
  /// `mirror` must outlive it.
  explicit Predictions(Mirror& mirror) : mirror_(mirror) {}

  /// Shows at once what the server will do. False, and nothing is shown: the request edits nothing or is not
  /// valid, a chunk that the edit reads is not `known`, or limits::predictions_max or predictions_work_max_us
  /// would be exceeded.
  bool foresee(uint32_t request, const Request& asked, double now_s,
               const std::function<bool(ChunkCoord)>& known);
  /// Looks for answers in a message that the mirror has just applied.
  void notice(const ServerMessage& message);
  /// Takes all back.
  void revert();
  /// Call after the mirror's changes, once a frame. `changes`: the mirror's since the last call; adds what
  /// the predictions change.
  void settle(double now_s, MirrorChanges& changes);

  /// The mirror's field with the predictions over it. The reference stays valid until the next call of
  /// foresee() or settle().
  Field& field() { return layer_ ? *layer_ : mirror_.field(); }
  /// Pieces of the predictions: each lies where it was cut, in the voxel frame of the terrain.
  const PieceTable& pieces() const { return pieces_; }
  size_t outstanding() const { return predictions_.size(); }
  /// Whether a piece of that id is of a prediction; none of a server's is.
  static bool is_predicted(PieceId id) { return id >= first_predicted_piece; }

 private:
  struct Prediction {
    uint32_t request;
    Operation operation;
    double until_s;
    float work_us;
    VoxelBox reads;
    std::vector<BrickCoord> changed;
  };

  void carry_out(Prediction& prediction);
  void drop_layer();
  bool reads_any(const std::vector<BrickCoord>& bricks) const;
  template <typename Goes>
  void remove(Goes&& goes);

  Mirror& mirror_;
  std::vector<Prediction> predictions_;  ///< in the order of asking
  std::unique_ptr<MapField> layer_;      ///< null without predictions
  PieceTable pieces_;
  PieceId next_piece_ = first_predicted_piece;
  bool stale_ = false;     ///< the layer shows what is answered
  MirrorChanges changes_;  ///< not handed out yet
};

}  // namespace scree
