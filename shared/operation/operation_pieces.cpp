// Which pieces an operation takes and makes.
#include "shared/base/overloaded.h"
#include "shared/operation/limits.h"
#include "shared/operation/operation.h"

namespace scree {

std::vector<PieceId> pieces_ended_by(const Operation& operation) {
  using Ids = std::vector<PieceId>;
  return std::visit(Overloaded{
                        [](const CarveOperation&) { return Ids{}; },
                        [](const FillOperation&) { return Ids{}; },
                        [](const StampOperation& op) {
                          Ids ended{op.piece};
                          for (const StampedPiece& other : op.others) ended.push_back(other.piece);
                          return ended;
                        },
                        [](const DiscardOperation& op) { return Ids{op.piece}; },
                        [](const ShatterOperation& op) { return Ids{op.piece}; },
                        [](const IslandOperation&) { return Ids{}; },
                        [](const PaintOperation&) { return Ids{}; },
                        [](const SlideOperation&) { return Ids{}; },
                        [](const DigOperation& op) { return op.piece != 0 ? Ids{op.piece} : Ids{}; },
                        [](const PlaceOperation&) { return Ids{}; },
                        [](const RestoreOperation& op) { return op.pieces; },
                    },
                    operation);
}

size_t pieces_merged_by(const Operation& operation) {
  return std::visit(Overloaded{
                        [](const CarveOperation&) { return size_t{0}; },
                        [](const FillOperation&) { return size_t{0}; },
                        [](const StampOperation& op) { return 1 + op.others.size(); },
                        [](const DiscardOperation&) { return size_t{0}; },
                        [](const ShatterOperation&) { return size_t{0}; },
                        [](const IslandOperation&) { return size_t{0}; },
                        [](const PaintOperation&) { return size_t{0}; },
                        [](const SlideOperation&) { return size_t{0}; },
                        [](const DigOperation&) { return size_t{0}; },
                        [](const PlaceOperation&) { return size_t{0}; },
                        [](const RestoreOperation&) { return size_t{0}; },
                    },
                    operation);
}

PieceIds ids_made_by(const Operation& operation) {
  return std::visit(Overloaded{
                        [](const CarveOperation& op) {
                          return PieceIds{op.first_piece, op.seeds};
                        },
                        [](const FillOperation&) { return PieceIds{}; },
                        [](const StampOperation&) { return PieceIds{}; },
                        [](const DiscardOperation&) { return PieceIds{}; },
                        [](const ShatterOperation& op) {
                          return PieceIds{op.first_piece, op.seeds + (op.cut ? limits::cut_rests_max : 0)};
                        },
                        [](const IslandOperation& op) {
                          return PieceIds{op.piece, 1};
                        },
                        [](const PaintOperation&) { return PieceIds{}; },
                        [](const SlideOperation&) { return PieceIds{}; },
                        [](const DigOperation&) { return PieceIds{}; },
                        [](const PlaceOperation&) { return PieceIds{}; },
                        [](const RestoreOperation&) { return PieceIds{}; },
                    },
                    operation);
}

std::optional<PieceId> parent_of(const Operation& operation) {
  using Parent = std::optional<PieceId>;
  return std::visit(Overloaded{
                        [](const CarveOperation&) { return Parent(); },
                        [](const FillOperation&) { return Parent(); },
                        [](const StampOperation&) { return Parent(); },
                        [](const DiscardOperation&) { return Parent(); },
                        [](const ShatterOperation& op) { return Parent(op.piece); },
                        [](const IslandOperation&) { return Parent(); },
                        [](const PaintOperation&) { return Parent(); },
                        [](const SlideOperation&) { return Parent(); },
                        [](const DigOperation&) { return Parent(); },
                        [](const PlaceOperation&) { return Parent(); },
                        [](const RestoreOperation&) { return Parent(); },
                    },
                    operation);
}

}  // namespace scree
