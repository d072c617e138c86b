// Operations: the only changes of a field, as they are simulated, sent, recorded and replayed.
//
// apply() is the only way to change a field, on the server, in a client's mirror and in a replay: same field,
// pieces and operation in, same bits out. Lengths in metres.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/field/brick_patch.h"
#include "shared/field/field.h"
#include "shared/field/piece.h"
#include "shared/field/shape.h"
#include "shared/fracture/cutter.h"
#include "shared/fracture/seed_pattern.h"
#include "shared/operation/ledger.h"
#include "shared/recombine/stamp_method.h"

namespace scree {

/// Carves the shape out and breaks it along Voronoi cells into pieces first_piece, first_piece + 1, …
struct CarveOperation {
  static constexpr std::string_view plural = "carves";
  Shape shape;
  SeedPattern pattern = SeedPattern::uniform;
  uint32_t seeds = 1;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};
  PieceId first_piece = 0;
  Cutter cutter = Cutter::field;
  std::vector<glm::vec3> authored_m{};  ///< as many as seeds when the pattern needs points; else none

  bool operator==(const CarveOperation&) const = default;
};

/// Adds a solid shape; its mass is entered in the ledger as poured.
struct FillOperation {
  static constexpr std::string_view plural = "fills";
  Shape shape;
  /// Nothing: of what each voxel is already, by paint or by the ground.
  std::optional<Material> material{};

  bool operator==(const FillOperation&) const = default;
};

/// A piece that becomes terrain together with another, and its pose.
struct StampedPiece {
  PieceId piece = 0;
  QuantisedPose pose;

  bool operator==(const StampedPiece&) const = default;
};

/// A piece becomes terrain at this pose; and others with it, in one pass over all of them: united first, then
/// the gaps closed, the mass met as a whole and the surroundings redistanced (paper, section 4.3: "groups of
/// objects"). Others only by a method that lays, at most limits::stamp_group_max pieces in all.
struct StampOperation {
  static constexpr std::string_view plural = "stamps";
  PieceId piece = 0;
  QuantisedPose pose;
  int32_t shift = 0;  ///< decides how the mass is met, as the method defines it
  StampMethod method = StampMethod::stamp;
  std::vector<StampedPiece> others{};
  /// What the voxels become (stamp_materials.h).
  Brings brings = Brings::rubble;

  bool operator==(const StampOperation&) const = default;
};

/// A piece that left the world becomes dust.
struct DiscardOperation {
  static constexpr std::string_view plural = "discards";
  PieceId piece = 0;

  bool operator==(const DiscardOperation&) const = default;
};

/// What a shatter cuts out of a piece: a shape in the world, and where the piece lies. A crater cuts as its
/// ball does.
struct PieceCut {
  Shape shape;
  QuantisedPose pose;

  bool operator==(const PieceCut&) const = default;
};

/// A piece breaks along Voronoi cells into pieces first_piece, first_piece + 1, … that lie where it lay. The
/// impact is in the voxel frame of its volume. The pattern is one of drawn_patterns (seed_pattern.h).
struct ShatterOperation {
  static constexpr std::string_view plural = "shatters";
  PieceId piece = 0;
  SeedPattern pattern = SeedPattern::radial;
  uint32_t seeds = 1;
  uint32_t random_seed = 0;
  glm::vec3 impact_voxels{0.0F};
  PieceId first_piece = 0;
  Cutter cutter = Cutter::field;
  /// Only what lies in this shape breaks. The rest of the piece stays whole, or falls apart into what is
  /// connected, limits::cut_rests_max at most: these are pieces, too, after those that broke.
  std::optional<PieceCut> cut{};

  bool operator==(const ShatterOperation&) const = default;
};

/// Loose terrain leaves the field: the solid voxels that connect to `start` within `box` become a
/// piece that lies where they lay, or dust when they weigh less than limits::piece_mass_min. Box and start in
/// voxels, which are exact.
struct IslandOperation {
  static constexpr std::string_view plural = "islands";
  VoxelBox box;
  VoxelCoord start;
  PieceId piece = 0;

  bool operator==(const IslandOperation&) const = default;
};

/// The voxels with rock whose centres lie in a shape become this material; no code changes.
struct PaintOperation {
  static constexpr std::string_view plural = "paints";
  Shape shape;
  Material material = material::rock;
  bool whole_bricks = false;  ///< as recordings have it from before voxels had materials (paint.h)

  bool operator==(const PaintOperation&) const = default;
};

/// Rubble, or loose ground, of one material that lies steeper than its angle of repose runs down within a box
/// of voxels, which are exact (shared/recombine/slide.h). It changes nothing where all is at rest, or where
/// the mass of each material cannot be kept to the unit.
struct SlideOperation {
  static constexpr std::string_view plural = "slides";
  VoxelBox box;  ///< its sides along x and z are whole cells
  Material material{};
  uint8_t tangent = 48;  ///< of the angle, in 64ths
  uint8_t cell = 1;      ///< slopes are those of squares of so many voxels a side

  bool operator==(const SlideOperation&) const = default;
};

/// Takes the terrain in the shape out of the world, into a store; or a piece, whole, that was at the shape.
struct DigOperation {
  static constexpr std::string_view plural = "digs";
  Shape shape;
  PieceId piece = 0;  ///< 0: the terrain

  bool operator==(const DigOperation&) const = default;
};

/// Adds a solid shape as a fill of that material does, but its mass comes out of a store.
struct PlaceOperation {
  static constexpr std::string_view plural = "places";
  Shape shape;
  Material material{};

  bool operator==(const PlaceOperation&) const = default;
};

/// Bricks of one chunk become what they were once, and pieces go: what that changes is entered as poured, or
/// as less of it.
struct RestoreOperation {
  static constexpr std::string_view plural = "restores";
  /// In order, each once, limits::restored_bricks_max at most; null: none.
  std::shared_ptr<const std::vector<BrickPatch>> bricks{};
  std::vector<PieceId> pieces{};  ///< in order, each once, limits::restored_pieces_max at most

  bool operator==(const RestoreOperation& other) const;
};

/// The place in this list is an operation's number on the wire and in recordings: new ones come last. Each
/// says by `plural` how reports call it.
using Operation = std::variant<CarveOperation, FillOperation, StampOperation, DiscardOperation,
                               ShatterOperation, IslandOperation, PaintOperation, SlideOperation,
                               DigOperation, PlaceOperation, RestoreOperation>;

/// The pieces that the operation takes out of the table.
std::vector<PieceId> pieces_ended_by(const Operation& operation);

/// How many pieces the operation makes terrain.
size_t pieces_merged_by(const Operation& operation);

/// Whether these pieces may merge in one pass: few, small, and near the first, so that the pass's window
/// stays small, too (limits::stamp_group_*). The group must not be empty, its pieces must be in the table.
bool can_merge_together(std::span<const StampedPiece> group, const PieceTable& pieces);

/// The ids that the operation may give to pieces: first, first + 1, … up to `count` of them.
struct PieceIds {
  PieceId first = 0;
  uint32_t count = 0;
};
PieceIds ids_made_by(const Operation& operation);

/// The piece whose place the made ones take; none: they lie where they were cut out of the terrain.
std::optional<PieceId> parent_of(const Operation& operation);

/// A piece that an operation made: its id, and its seeds, from which its cells can be computed again.
struct CreatedPiece {
  PieceId id = 0;
  /// Indices into Applied::seeds_voxels. Where the pattern's seeds are cut on: those of its block.
  std::vector<uint32_t> seeds;
};

struct Applied {
  std::vector<BrickCoord> changed;    ///< bricks whose codes or materials changed, in order
  std::vector<CreatedPiece> created;  ///< in order of id; their volumes are in the table
  std::vector<glm::vec3> seeds_voxels;
  size_t rests = 0;            ///< so many of `created`, the last ones, are what a cut left of a piece
  MassUnits terrain_gain = 0;  ///< negative for a carve
  MassUnits dust = 0;  ///< mass that went into no piece (carve, shatter, island), or a discarded piece's
  std::vector<MaterialFlow> flows;  ///< the same by material; what they leave is dust
  MassUnits stored = 0;             ///< what a dig took into a store; negative: what a place took out of one
};

/// The voxels that apply() reads: a field that holds their bricks can apply the operation.
/// Empty for a discard, a shatter and the dig of a piece. `pieces` must hold the piece of a stamp.
VoxelBox read_box(const Operation& operation, const PieceTable& pieces, float voxel_size_m);

struct PreparedStamp;

/// Applies a valid operation. A stamp, discard, shatter or dig takes its piece out of the table; it must be
/// there.
/// `prepared` may hold the result of a stamp (prepared_stamp.h); it is used if it is this stamp's.
Applied apply(const Operation& operation, Field& field, PieceTable& pieces,
              const PreparedStamp* prepared = nullptr);

/// Whether an operation may have this shape in a field of such voxels: it is valid, neither too small nor too
/// large, and its centre lies in the world. Only then is its box a bounded one near the world.
Result<void> validate_edit(const Shape& shape, float voxel_size_m);

/// Whether `apply` can be called at all, in a field of such voxels: shape valid, counts within limits, pieces
/// known, windows bounded. For what comes off a wire. The pieces' volumes must be valid themselves: made by
/// operations, or decoded.
Result<void> validate(const Operation& operation, const PieceTable& pieces, float voxel_size_m);

/// What a cut would do to a piece: whether it takes anything, and into how many parts that connect the rest
/// would fall.
struct PieceCutLook {
  bool takes = false;
  size_t rests = 0;
};
PieceCutLook look_at_cut(const PieceCut& cut, const Volume& piece, float voxel_size_m);

/// What a dig of terrain would take, and the gain of a place: both valid. The field stays as it is.
MassUnits mass_dug(const DigOperation& operation, const Field& field);
MassUnits mass_placed(const PlaceOperation& operation, const Field& field);

/// The volume that a carve of that shape would cut into pieces.
Window carved_volume(Field& field, const Shape& shape);

}  // namespace scree
