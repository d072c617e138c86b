// What clients ask for: the world answers a request by operations, or by a refusal. Plain values; a request
// is untrusted until World::step has validated it. Lengths in metres.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/overloaded.h"
#include "shared/base/setting_value.h"
#include "shared/base/walking.h"
#include "shared/field/brick_patch.h"
#include "shared/field/piece.h"
#include "shared/field/shape.h"
#include "shared/fracture/seed_pattern.h"
#include "shared/game/rules_act.h"
#include "shared/material/material.h"
#include "shared/operation/blast.h"
#include "shared/operation/store.h"
#include "shared/prop/joint.h"
#include "shared/prop/prop.h"
#include "shared/region/region.h"

namespace scree {

struct CarveRequest {
  Shape shape;
  SeedPattern pattern = usual_pattern;
  uint32_t seeds = 32;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};  ///< place of the blow; pieces fly out towards it
  float blast_speed_m_s = 6.0F;
  std::vector<glm::vec3> authored_m{};  ///< as many as seeds when the pattern needs points; else none
  PieceId piece = 0;  ///< the piece that is carved where it is, by a drawn pattern; 0: the terrain is

  bool operator==(const CarveRequest&) const = default;
};

struct FillRequest {
  Shape shape;
  std::optional<Material> material{};  ///< nothing: as FillOperation says

  bool operator==(const FillRequest&) const = default;
};

/// The rock in the shape becomes this material, voxel by voxel.
struct PaintRequest {
  Shape shape;
  Material material = material::rock;

  bool operator==(const PaintRequest&) const = default;
};

/// Adds a prop to the world; the reply has its id.
struct AddPropRequest {
  Prop prop;
  glm::vec3 place_m{0.0F};
  glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 velocity_m_s{0.0F};  ///< of its origin
  glm::vec3 spin_rad_s{0.0F};

  bool operator==(const AddPropRequest&) const = default;
};

struct RemovePropRequest {
  PieceId prop = 0;

  bool operator==(const RemovePropRequest&) const = default;
};

/// Puts a prop elsewhere, or changes how it moves; what is left out stays. A kinematic one goes on as it was
/// told; a fixed one can only be put elsewhere.
struct MovePropRequest {
  PieceId prop = 0;
  std::optional<glm::vec3> place_m{};
  std::optional<glm::quat> turn{};
  std::optional<glm::vec3> velocity_m_s{};
  std::optional<glm::vec3> spin_rad_s{};

  bool operator==(const MovePropRequest&) const = default;
};

/// Gives a prop or a piece an impulse at a place in the world.
struct PushRequest {
  PieceId body = 0;
  glm::vec3 impulse_n_s{0.0F};
  glm::vec3 at_m{0.0F};

  bool operator==(const PushRequest&) const = default;
};

/// Breaks a piece where it is, about a place in the world.
struct BreakRequest {
  PieceId piece = 0;
  glm::vec3 at_m{0.0F};
  uint32_t seeds = 8;
  uint32_t random_seed = 0;

  bool operator==(const BreakRequest&) const = default;
};

/// Sets energy free at a place: rock breaks and is thrown out as far as the energy reaches (blast.h), and
/// what moves about there is thrown.
struct BlastRequest {
  glm::vec3 centre_m{0.0F};
  float energy_j = 4.2e6F;
  uint32_t random_seed = 0;

  bool operator==(const BlastRequest&) const = default;
};

/// Joins two bodies, or one to the terrain; the reply has the joint's id.
struct AddJointRequest {
  Joint joint;

  bool operator==(const AddJointRequest&) const = default;
};

struct RemoveJointRequest {
  JointId joint = 0;

  bool operator==(const RemoveJointRequest&) const = default;
};

/// Changes the motor of a joint that has an axis.
struct SetMotorRequest {
  JointId joint = 0;
  JointMotor motor;

  bool operator==(const SetMotorRequest&) const = default;
};

/// The terrain in the shape becomes a body that is kept: it never becomes terrain until it is released.
struct CutOutRequest {
  Shape shape;

  bool operator==(const CutOutRequest&) const = default;
};

/// Adds a piece of voxels that the request brings; its mass is poured in. Parts that do not connect become a
/// piece each. The reply has the first one's id.
struct AddPieceRequest {
  /// Codes of its whole box, and materials; its mass, masses and centre do not count. Null: it came as bytes
  /// that cannot be read, and is refused.
  std::shared_ptr<const Volume> volume;
  glm::vec3 place_m{0.0F};  ///< of the volume's voxel (0, 0, 0)
  glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 velocity_m_s{0.0F};  ///< of its centre of mass
  glm::vec3 spin_rad_s{0.0F};
  bool kept = true;  ///< else it becomes terrain where it comes to rest, as any piece

  bool operator==(const AddPieceRequest& other) const {
    const auto is_same = [](const Volume& a, const Volume& b) {
      return a.window.box == b.window.box && a.window.codes == b.window.codes && a.materials == b.materials;
    };
    const bool has_same =
        volume == other.volume || (volume && other.volume && is_same(*volume, *other.volume));
    return has_same && place_m == other.place_m && turn == other.turn && velocity_m_s == other.velocity_m_s &&
           spin_rad_s == other.spin_rad_s && kept == other.kept;
  }
};

/// A kept piece may become terrain from now on.
struct ReleaseRequest {
  PieceId piece = 0;

  bool operator==(const ReleaseRequest&) const = default;
};

/// Adds a region, or puts it in the place of the one of its name; its id and `until` are the world's to say.
struct SetRegionRequest {
  Region region;
  float lasts_s = 0.0F;  ///< seconds from then on; 0: until it is removed

  bool operator==(const SetRegionRequest&) const = default;
};

struct RemoveRegionRequest {
  std::string name;

  bool operator==(const RemoveRegionRequest&) const = default;
};

/// Takes the terrain in the shape into a store, without pieces and without dust; or a piece, whole.
struct DigRequest {
  Shape shape;        ///< of a piece: where it was seen
  PieceId piece = 0;  ///< 0: the terrain
  StoreName store{};

  bool operator==(const DigRequest&) const = default;
};

/// Fills the shape out of a store.
struct PlaceRequest {
  Shape shape;
  Material material = material::rock;  ///< that the store has; of a row that is rubble: that of its stones
  bool solid = false;                  ///< else as rubble, where the material has any
  StoreName store{};

  bool operator==(const PlaceRequest&) const = default;
};

/// Moves mass from a store to another.
struct TransferRequest {
  StoreName from{}, to{};
  std::optional<Material> material{};  ///< nothing: all that the store has
  MassUnits mass = 0;                  ///< of the material; 0: as much as there is

  bool operator==(const TransferRequest&) const = default;
};

/// Changes how the simulation goes on (server/world/settings.h): all of them, or none.
struct SettingsRequest {
  SettingValues settings;

  bool operator==(const SettingsRequest&) const = default;
};

/// The session cannot go on: its requests that still wait are dropped. Asked for by the network side, never
/// by a client, and not answered.
struct LeaveRequest {
  bool operator==(const LeaveRequest&) const = default;
};

/// Enters the world on foot, or leaves it; the reply has the id of the person's body.
struct StandRequest {
  /// Where the feet are; nothing: where visitors begin. The network side passes it on for directors alone.
  std::optional<glm::vec3> place_m{};
  bool away = false;  ///< the person leaves; there is no place then

  bool operator==(const StandRequest&) const = default;
};

/// What a person on foot does for one tick. The number of the request is that of the input: they ascend.
/// Answered by a reply only where it is refused.
struct WalkRequest {
  WalkInput input;
  glm::vec3 look{0.0F, 0.0F, -1.0F};  ///< unit

  bool operator==(const WalkRequest&) const = default;
};

/// What a host's rules do besides; of the server itself (session 0) alone.
struct RulesRequest {
  RulesAct act;

  bool operator==(const RulesRequest&) const = default;
};

/// Takes back what somebody did, in one chunk; of the server itself (session 0) alone.
struct RestoreRequest {
  /// A brick as it is to be, and the hash that it must have until then (brick_hash): one that has another was
  /// changed since, and stays.
  struct Brick {
    BrickPatch then;
    uint64_t now = 0;

    bool operator==(const Brick& other) const {
      return then.coord == other.then.coord && then.brick == other.then.brick &&
             then.materials == other.then.materials && now == other.now;
    }
  };
  std::shared_ptr<const std::vector<Brick>> bricks{};  ///< of one chunk, in order; null: none
  std::vector<PieceId> pieces{};    ///< that go, in order; those that are gone do not count
  std::vector<ChunkCoord> loose{};  ///< terrain may hang loose in them, and beside them

  bool operator==(const RestoreRequest& other) const {
    const bool same = bricks == other.bricks || (bricks && other.bricks && *bricks == *other.bricks);
    return same && pieces == other.pieces && loose == other.loose;
  }
};

using Request =
    std::variant<CarveRequest, FillRequest, PaintRequest, SettingsRequest, LeaveRequest, AddPropRequest,
                 RemovePropRequest, MovePropRequest, PushRequest, BreakRequest, BlastRequest, AddJointRequest,
                 RemoveJointRequest, SetMotorRequest, CutOutRequest, ReleaseRequest, AddPieceRequest,
                 SetRegionRequest, RemoveRegionRequest, StandRequest, WalkRequest, DigRequest, PlaceRequest,
                 TransferRequest, RulesRequest, RestoreRequest>;

/// The shape of a request that edits terrain, or in which it does; nothing: it edits none.
inline std::optional<Shape> shape_of(const Request& request) {
  using Found = std::optional<Shape>;
  return std::visit(Overloaded{[](const CarveRequest& carve) -> Found { return carve.shape; },
                               [](const FillRequest& fill) -> Found { return fill.shape; },
                               [](const PaintRequest& paint) -> Found { return paint.shape; },
                               [](const CutOutRequest& cut_out) -> Found { return cut_out.shape; },
                               [](const DigRequest& dig) -> Found { return dig.shape; },
                               [](const PlaceRequest& place) -> Found { return place.shape; },
                               [](const BlastRequest& blast) -> Found {
                                 return sphere(blast.centre_m, blast_reach_m(blast.energy_j));
                               },
                               [](const auto&) -> Found { return std::nullopt; }},
                    request);
}

/// The request with the name of its asker's store, where it says `own`.
inline Request with_own_store(Request request, const StoreName& own) {
  const auto name = [&](StoreName& store) {
    if (store.kind == StoreKind::own) store = own;
  };
  std::visit(
      Overloaded{[&](DigRequest& dig) { name(dig.store); }, [&](PlaceRequest& place) { name(place.store); },
                 [&](TransferRequest& transfer) {
                   name(transfer.from);
                   name(transfer.to);
                 },
                 [](auto&) {}},
      request);
  return request;
}

/// The place in the terrain that a request joins a body to; null: it does not.
inline const glm::vec3* anchor_of(const Request& request) {
  const auto* const add = std::get_if<AddJointRequest>(&request);
  if (add == nullptr) return nullptr;
  for (const JointSide* side : {&add->joint.a, &add->joint.b})
    if (side->holds_terrain()) return &side->place_m;
  return nullptr;
}

/// The place in the world at which a request acts on a body by reach; null: it does not.
inline const glm::vec3* place_of(const Request& request) {
  return std::visit(Overloaded{[](const PushRequest& push) { return &push.at_m; },
                               [](const BreakRequest& broken) { return &broken.at_m; },
                               [](const auto&) { return static_cast<const glm::vec3*>(nullptr); }},
                    request);
}

}  // namespace scree
