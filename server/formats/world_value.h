// A world between two ticks as one value: a save, the start of a recording, and where a recording goes on
// after a restart. World::snapshot() (server/world/world.h) makes it, World::restore() makes a world of it.
//
// What Bullet cannot take up again is left out: caches of contacts with their impulses, who sleeps, and the
// order of its tree. A restored body is awake and without contacts. Nor is a search for islands kept: islands
// that wait to fall are searched anew. Parties keep the work that waits for them, but begin level: turns are
// kept of requests alone. So a restored world is no continuation of the running one bit for bit,
// but a pure function of the value: the same value and the same commands give the same hashes, and
// snapshot(restore(value)) is the value.
//
// Metres, voxels and ticks, as said. Plain values, whose pieces share immutable buffers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "proto/messages.h"
#include "server/formats/recording_codec.h"
#include "server/provenance/provenance.h"
#include "shared/base/walking.h"
#include "shared/field/piece.h"
#include "shared/game/kept.h"
#include "shared/game/sign.h"
#include "shared/prop/joint.h"
#include "shared/prop/prop.h"
#include "shared/recombine/settled_stone.h"

namespace scree {

/// How a body moves, and what it meets. A piece has what stands here; a prop says its own
/// (shared/prop/prop.h).
struct BodyNature {
  PropMotion motion = PropMotion::dynamic;
  float drag = 0.0F, spin_drag = 0.0F, gravity = 1.0F;
  uint32_t groups = group::pieces, meets = group::all;

  bool is_piece() const { return groups == group::pieces; }
  bool operator==(const BodyNature&) const = default;
};

/// The data of a piece that the body library needs. `hull_m`: corners of the piece's convex hull, at least 4
/// and not all in one plane, relative to the centre of mass, in the volume's axes (the world's axes at
/// birth). See server/fracture/hull.h.
struct BodyShape {
  std::vector<glm::vec3> hull_m;
  float mass_kg = 0.0F;
  glm::mat3 inertia_kg_m2{0.0F};  ///< tensor in the volume's axes; symmetric, positive definite
  /// Coefficient of friction. A contact has the geometric mean of both sides; the terrain has that of its
  /// material.
  float friction = 0.7F;
  /// Points that collide with the terrain, for a concave piece: of its own surface, in the same frame as
  /// `hull_m`. Empty: points of the hull collide.
  std::vector<glm::vec3> surface_m{};
  /// Convex parts that collide with other bodies, for a large concave piece: each has corners as `hull_m`
  /// has. Empty: the hull collides.
  std::vector<std::vector<glm::vec3>> parts_m{};
  /// For each of parts_m, where any is rounded: the radius of a ball that goes around its points, which may
  /// be fewer than four then; 0: it is as it is.
  std::vector<float> part_radii_m{};
  BodyNature nature{};
  glm::vec3 centre_m{0.0F};   ///< the centre of mass, from the volume's centre, in the volume's axes
  float restitution = 0.05F;  ///< share of the speed that a blow gives back; combined as friction is

  bool operator==(const BodyShape&) const = default;
};

/// Properties that a piece keeps for life.
struct PieceTraits {
  uint8_t generation = 0;  ///< number of breaks among its ancestors
  bool fell = false;       ///< it was an island: where it merges, nothing that hangs loose falls once more
  uint64_t owner = 0;      ///< party that caused it, by a carve or a fall (command.h); 0: the world itself
  bool kept = false;       ///< it never becomes terrain, until it is released

  bool operator==(const PieceTraits&) const = default;
};

/// What never changes of a piece. Neither buffer is null.
struct PieceRecord {
  PieceId id = 0;
  PieceTraits traits;
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const BodyShape> shape;
};

/// What never changes of a prop, which is not null.
struct PropRecord {
  PieceId id = 0;
  uint64_t owner = 0;  ///< party that added it (command.h)
  std::shared_ptr<const Prop> prop;
};

/// A joint, which is not null, as it stands.
struct JointRecord {
  JointId id = 0;
  uint64_t owner = 0;  ///< party that added it (command.h)
  std::shared_ptr<const Joint> joint;
};

/// Chunks of terrain that hangs on a region, ordered.
struct HungTerrain {
  RegionId region = 0;
  std::vector<ChunkCoord> chunks;

  bool operator==(const HungTerrain&) const = default;
};

/// An input of a person that is not carried out yet.
struct WaitingInput {
  uint32_t number = 0;
  WalkInput input;
  glm::vec3 look{0.0F, 0.0F, -1.0F};

  bool operator==(const WaitingInput&) const = default;
};

/// A person on foot. The body is a prop, which moves as told and belongs to the world: no request moves it.
struct PersonRecord {
  uint64_t session = 0;
  PieceId body = 0;
  WalkerState walker;
  glm::vec3 look{0.0F, 0.0F, -1.0F};   ///< unit
  uint32_t taken = 0;                  ///< number of the last input that was carried out; 0: none
  uint32_t credit = 0;                 ///< inputs that may be carried out now, in parts of one (limits.h)
  uint32_t idle_ticks = 0;             ///< since an input was carried out
  bool is_held = false;                ///< by rock, since the last tick or longer
  std::vector<WaitingInput> inputs{};  ///< in order

  bool operator==(const PersonRecord&) const = default;
};

struct BoundsM {
  glm::vec3 lo_m{0.0F};
  glm::vec3 hi_m{0.0F};

  bool operator==(const BoundsM&) const = default;
};

/// A body's exact motion, in its principal axes, as its library keeps it.
struct BodyMotion {
  PieceId id = 0;
  glm::vec3 origin_m{0.0F};
  std::array<glm::vec3, 3> basis{};  ///< rows of the rotation
  glm::vec3 velocity_m_s{0.0F};
  glm::vec3 spin_rad_s{0.0F};
  bool frozen = false;            ///< Bodies::freeze
  std::optional<BoundsM> thawed;  ///< where it thawed, until it has moved away

  bool operator==(const BodyMotion&) const = default;
};

/// `bodies` in order of id; the rest are changes that the bodies have not been told yet.
struct MotionValue {
  std::vector<BodyMotion> bodies;
  std::vector<BoundsM> freed;     ///< where bodies were removed
  std::vector<VoxelBox> changes;  ///< where terrain changed

  bool operator==(const MotionValue&) const = default;
};

/// How long a piece has been still (RestDetector).
struct StillnessTimer {
  PieceId id = 0;
  glm::vec3 anchor_m{0.0F};
  std::array<float, 4> anchor_rotation{};  ///< w, x, y, z
  uint32_t age_ticks = 0;
  uint32_t still_ticks = 0;
  uint32_t terrain_ticks = 0;

  bool operator==(const StillnessTimer&) const = default;
};

struct RestValue {
  std::vector<StillnessTimer> timers;  ///< ordered by id
  uint64_t put_off = 0;

  bool operator==(const RestValue&) const = default;
};

/// Whose turn it is (FairTurns).
struct TurnsValue {
  struct Turn {
    uint64_t who = 0;
    uint64_t start_ns = 0;
    bool waits = false;

    bool operator==(const Turn&) const = default;
  };
  std::vector<Turn> turns;  ///< ordered by `who`
  uint64_t served_ns = 0;

  bool operator==(const TurnsValue&) const = default;
};

/// Requests that wait, of a session and of a party (RequestQueue). The commands' sessions and parties are
/// those that they wait under.
struct WaitingValue {
  Command command;
  float cost_us = 0.0F;
  Tick since = 0;
};
struct SessionValue {
  uint64_t session = 0;
  float waiting_us = 0.0F;
  std::vector<WaitingValue> requests;
};
struct PartyValue {
  uint64_t party = 0;
  TurnsValue turns;  ///< of its sessions
  std::vector<SessionValue> sessions;
};
struct RequestsValue {
  TurnsValue turns;  ///< of the parties
  std::vector<PartyValue> parties;
};

/// A piece that is still to be cut into so many (server/world/refracture_stage.h).
struct PendingRefracture {
  PieceId piece = 0;
  uint32_t pieces = 0;
  SeedPattern pattern = SeedPattern::uniform;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};
  /// The carve whose volume this is, whole: its blow throws the pieces. Null: they move on as parts of the
  /// piece.
  std::shared_ptr<const CarveRequest> thrown_by{};
  uint64_t party = 0;    ///< whose carve it was (command.h); 0: the world itself
  bool blasted = false;  ///< the carve was a blast: it throws out what it breaks (ejecta.h)
};

/// Changed bricks around which islands are searched for.
struct LooseningEdit {
  std::vector<BrickCoord> bricks;
  uint32_t restarts = 0;
  uint64_t party = 0;  ///< who caused the change, as in PendingRefracture

  bool operator==(const LooseningEdit&) const = default;
};

/// Bricks that a party changed; never empty.
struct PartyBricks {
  uint64_t party = 0;
  std::vector<BrickCoord> bricks;  ///< ordered

  bool operator==(const PartyBricks&) const = default;
};

/// A cell of 4³ voxels that blows struck, and what of their energy made no dent yet.
struct StruckPlace {
  VoxelCoord cell;
  float energy_j = 0.0F;
  Tick at = 0;  ///< tick of the last of them

  bool operator==(const StruckPlace&) const = default;
};
inline constexpr int struck_cell_bits = 2;
inline VoxelCoord cell_of_place(VoxelCoord v) {
  return {v.x >> struck_cell_bits, v.y >> struck_cell_bits, v.z >> struck_cell_bits};
}
inline BrickCoord brick_of_place(VoxelCoord cell) {
  constexpr int side = 1 << struck_cell_bits;
  return brick_of(VoxelCoord{cell.x * side, cell.y * side, cell.z * side});
}

/// A store, and what was dug into it that the rate of digging still counted at that tick.
struct StoreRecord {
  StoreContent content;
  MassUnits dug = 0;
  Tick dug_at = 0;

  bool operator==(const StoreRecord&) const = default;
};

/// What a host's rules keep, show and made of persons. The lists never change, and are never null.
struct GameValue {
  std::shared_ptr<const std::vector<KeptValue>> kept =
      std::make_shared<const std::vector<KeptValue>>();  ///< ordered by key
  std::shared_ptr<const std::vector<Sign>> signs =
      std::make_shared<const std::vector<Sign>>();  ///< in order (sign_before)
  std::shared_ptr<const std::vector<Player>> players =
      std::make_shared<const std::vector<Player>>();  ///< ordered by session
};

/// All but the terrain: cheap to make, so that every tick can be saved.
struct WorldMoment {
  RecordedHeader config;  ///< `program` is empty
  Tick tick = 0;
  PieceId next_piece = 1;
  Ledger ledger;
  uint64_t field_hash = 0;
  uint64_t state_hash = 0;          ///< of field, bodies and ledger, as a tick publishes it
  std::vector<PieceRecord> pieces;  ///< ordered by id, as motion.bodies, which has those of props, too
  std::vector<PropRecord> props;    ///< ordered by id
  std::vector<JointRecord> joints;  ///< ordered by id
  MotionValue motion;
  RestValue rest;
  RequestsValue requests;
  Tick requested = 0;  ///< tick in which a request that costs time was carried out last
  float debt_us = 0.0F;
  std::vector<PendingRefracture> refractures;  ///< by party, each one's in order
  Tick refractured_at = 0;                     ///< tick of the last cut, as island_at of the last fall
  Tick island_at = 0;
  std::vector<LooseningEdit> islands;        ///< searches, in order
  std::vector<PartyBricks> loosened_bricks;  ///< await a search for islands; by party, as `strained`
  std::vector<PartyBricks> strained;         ///< await a search for support
  std::vector<PartyBricks> slopes;           ///< places whose rubble may lie too steep
  std::vector<VoxelBox> gained;              ///< around terrain that gained rock
  std::vector<PieceId> buried;               ///< ordered, as `sunk`; may be gone
  std::vector<PieceId> sunk;
  MaterialLedger materials;            ///< empty in worlds that keep none
  std::vector<StruckPlace> struck;     ///< ordered by cell
  std::vector<Region> regions;         ///< ordered by id
  std::vector<HungTerrain> hung;       ///< ordered by region; none is empty
  std::vector<ChunkCoord> released;    ///< ordered: await the search for what hung in them
  std::vector<PersonRecord> persons;   ///< ordered by session
  std::vector<StoreRecord> stores;     ///< ordered by owner
  std::vector<PlacedMass> provenance;  ///< ordered by place and origin
  GameValue game;
  /// Stones where pieces merged, ordered by id. They are for the eye alone: rows of a world's file, and no
  /// part of the value's bytes, by which worlds are compared.
  std::vector<SettledStone> stones;
};

struct WorldSnapshot {
  WorldMoment moment;
  std::vector<BrickPatch> bricks;  ///< every edited brick, ordered
};

}  // namespace scree
