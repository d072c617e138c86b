// The simulation: field, pieces, bodies and ledger, advanced tick by tick.
//
// A pure function of its configuration and of the commands by tick: the same input gives the same hashes, in
// any build and on any number of threads. It reads a clock for StageTimes only. One thread at a time calls
// its functions; step() shares the bodies' work with others of its own; all results are in the TickDelta.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>

#include "server/command/command.h"
#include "server/world/body_facts.h"
#include "server/world/tick_delta.h"
#include "server/world/world_config.h"
#include "shared/field/field_paging.h"
#include "shared/query/scene_maker.h"

namespace scree {

/// Ten times a second at 60 Hz: enough to look at, a small part of the tick.
inline constexpr Tick ticks_per_physics = 6;

struct GameValue;
struct WorldMoment;
struct WorldSnapshot;

/// Mass of the unedited ground where a chunk's edited bricks lie, by chunk, as far as it is known: measuring
/// it generates the chunk.
using GroundMasses = std::map<ChunkCoord, MassUnits>;

/// Terrain that comes chunk by chunk, and whose chunks may be out of memory (Field::page_by).
struct PagedTerrain {
  /// The edited bricks of a chunk, in order.
  using Visit = std::function<Result<void>(ChunkCoord, std::span<const BrickPatch>)>;
  /// Calls `visit` once for each edited chunk, and ends at the first error. `ground` of restore(), which may
  /// grow meanwhile, is read afterwards.
  std::function<Result<void>(const Visit& visit)> each;
  ReadChunk read;
  size_t bricks_max = 0;  ///< chunks that come when so many are in memory are out
};

class World {
 public:
  /// Refuses a configuration beyond its limits. `threads`: that step() takes, its caller's included; 0: as
  /// many as the machine has cores.
  static Result<std::unique_ptr<World>> create(const WorldConfig& config, size_t threads = 1);
  /// The world of a value (server/formats/world_value.h), which may come from a file: refuses one whose parts
  /// do not agree with each other, or that no world has, and one whose ground is not there. Masses and hashes
  /// are measured anew, but for the ground's where `ground` knows it.
  static Result<std::unique_ptr<World>> restore(const WorldSnapshot& value, size_t threads = 1,
                                                const GroundMasses& ground = {});
  /// The same of a value without bricks, whose terrain is `terrain`.
  static Result<std::unique_ptr<World>> restore(const WorldSnapshot& value, const PagedTerrain& terrain,
                                                size_t threads, const GroundMasses& ground);
  /// The same of what is left of a damaged value: masses and hashes are taken as measured, what is missing is
  /// booked as poured or as dust, and bodies without a piece, or pieces without a body, are left out.
  static Result<std::unique_ptr<World>> salvage(WorldSnapshot value);
  /// The same of a value without bricks, whose terrain is `terrain`.
  static Result<std::unique_ptr<World>> salvage(WorldSnapshot value, const PagedTerrain& terrain,
                                                const GroundMasses& ground);
  /// The configuration must pass validate(), which is CHECKed.
  explicit World(const WorldConfig& config, size_t threads = 1);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Advances one tick: commands in order, bodies, rest, recombination. The first delta says how every
  /// setting stands, later ones only when one changes.
  std::shared_ptr<const TickDelta> step(std::span<const Command> commands);

  /// As it stands: what settings changed is changed here.
  const WorldConfig& config() const;
  Tick tick() const;
  /// What a host's rules ask for, between steps: the regions, by id; what became of the rock of those that
  /// count, by origin and material; the stores, by owner.
  const std::vector<Region>& regions() const;
  std::vector<RegionMass> region_masses() const;
  std::vector<StoreContent> stores() const;
  const Ledger& ledger() const;
  const MaterialLedger& materials() const;
  /// By id.
  std::vector<KnownJoint> joints() const;
  /// Whether there is a joint of that id.
  bool has_joint(JointId id) const;
  /// What the host's rules keep with the world, show, and made of persons.
  const GameValue& game() const;
  /// The body as it is now; nothing: there is none of that id.
  std::optional<BodyFacts> body(PieceId id) const;
  /// The bodies whose bounds meet the box, by id: pieces, props and persons' bodies.
  std::vector<PieceId> bodies_near(glm::vec3 lo_m, glm::vec3 hi_m) const;
  /// Every person on foot, by session.
  std::vector<PersonPlace> persons() const;
  /// The terrain's gain since the start, measured from every edited brick. Must equal the ledger's.
  MassUnits measure_terrain();
  /// Switches TickDelta::physics, in every ticks_per_physics-th delta, on or off. Changes nothing else.
  void want_physics(bool wanted);
  /// Switches TickDelta::replaced on or off. Changes nothing else.
  void want_replaced(bool wanted);
  /// The state between two ticks, without the terrain: it shares what never changes, so that every tick may
  /// be asked for it.
  WorldMoment moment() const;
  /// The whole state.
  WorldSnapshot snapshot();
  /// Makes of this world what restore() makes of its snapshot, in place and without reading its terrain: so a
  /// recording may begin here. Bodies wake, and searches for islands begin again.
  void renew();
  /// The edited bricks of a chunk, in order. One that is out is read, and stays out.
  std::vector<BrickPatch> chunk(ChunkCoord chunk);
  /// One delta that takes an empty PublishedState to this world: every edited brick, every piece and every
  /// setting, without operations. For chunks that are out, it has what is known of them.
  TickDelta keyframe();
  /// The same without bricks: of every chunk, what is known of one that is out.
  TickDelta outline();
  /// The terrain, for reading by the thread of step(), between steps. Commands alone change it.
  const Field& field() const;
  /// What questions about space (shared/query/query.h) are asked of: terrain, pieces and props, where the
  /// last delta says that they are. By the thread of step(), between steps: it holds until the next step, and
  /// one scene at a time is asked. Chunks that are out come in.
  HeldScene scene() const;
  /// Moves the terrain's chunks in and out of memory, by the thread of step(), between steps.
  FieldPaging paging();

  /// The thread of the first step() owns the world; step() and renew() by another one are a breach, which is
  /// checked. The owner may let go of it: then the thread of the next step() owns it, and sees all that was
  /// done before.
  void release_thread();

  struct State;  ///< world_state.h, for the stages in this folder alone

 private:
  struct Made {};
  World(Made, std::unique_ptr<State> state);
  /// `terrain`: null where the value has it.
  static Result<std::unique_ptr<World>> salvaged(WorldSnapshot value, const PagedTerrain* terrain,
                                                 const GroundMasses& ground);

  std::unique_ptr<State> state_;
};

/// World::chunk() of that world, which must outlive the result.
ReadChunk reader_of(World& world);

}  // namespace scree
