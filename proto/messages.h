// The messages between server and client as plain values: what is sent, and in which order it is applied.
// Their encoding is proto/scree.proto; proto/codec.h turns one into the other and checks every byte.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/setting_value.h"
#include "shared/operation/operation.h"

namespace scree {

inline constexpr uint32_t protocol_version = 1;

/// TCP port of a server when nobody says otherwise.
inline constexpr uint16_t default_port = 4177;

// ---- client to server

struct HelloMessage {
  uint32_t protocol = protocol_version;
  std::string client;  ///< name of the program, for the server's log; at most 64 bytes
  glm::vec3 eye_m{0.0F};
  float interest_radius_m = 0.0F;
  std::string name{};  ///< the person's, shown to others; at most limits::person_name_bytes_max
};

/// Where the client looks from; it follows the chunks and pieces within the radius.
struct InterestMessage {
  glm::vec3 eye_m{0.0F};
  float interest_radius_m = 0.0F;
};

/// Where clients put a carve's centre: so far behind the point that they strike, in radii. Most of it is rock
/// then, it opens the surface, and the pieces are thrown out of it.
inline constexpr float carve_depth_in_radii = 0.4F;

struct CarveMessage {
  uint32_t request = 0;  ///< returned in the reply
  Shape shape;
  SeedPattern pattern = SeedPattern::radial;
  uint32_t seeds = 32;
  uint32_t random_seed = 0;
  glm::vec3 impact_m{0.0F};
  float blast_speed_m_s = 6.0F;
  std::vector<glm::vec3> authored_m{};  ///< for the pattern `authored`, as many as seeds; else none
};

struct FillMessage {
  uint32_t request = 0;
  Shape shape;
};

/// The bricks of the shape (shared/field/paint.h) become this material.
struct PaintMessage {
  uint32_t request = 0;
  Shape shape;
  Material material = Material::rock;
};

/// Chunks whose hash at `tick` was not what the frame's check said.
struct RepairRequest {
  Tick tick = 0;
  std::vector<ChunkCoord> chunks;
  std::vector<uint64_t> hashes;  ///< the client's, one per chunk
};

/// The last frame that the client has applied; sent a few times a second.
struct AckMessage {
  Tick tick = 0;
};

/// Changes the server's settings, all of them or none; answered with a reply.
struct AdminMessage {
  uint32_t request = 0;
  std::string token;  ///< what the server was started with
  SettingValues settings;
};

/// Where a person looks from and what they aim at, for others to see.
struct CursorMessage {
  glm::vec3 eye_m{0.0F};
  glm::vec3 aim_m{0.0F};
};

/// Asks for PhysicsMessages, or for no more of them.
struct WatchMessage {
  bool physics = false;
};

using ClientMessage = std::variant<HelloMessage, InterestMessage, CarveMessage, FillMessage, PaintMessage,
                                   RepairRequest, AckMessage, AdminMessage, CursorMessage, WatchMessage>;

// ---- server to client

struct WelcomeMessage {
  uint32_t protocol = protocol_version;
  uint64_t session = 0;
  Tick tick = 0;
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;  ///< frames carry transforms every so many ticks
  TerrainSource terrain;
  float interest_radius_m = 0.0F;  ///< as granted
  bool replay = false;             ///< a recording: requests to carve are refused
};

/// Says why, then the server closes the connection.
struct RefusalMessage {
  std::string reason;
};

/// A brick's new codes, and what it is painted.
struct BrickPatch {
  BrickCoord coord;
  Brick brick;
  std::optional<Material> paint = std::nullopt;
};

/// One tick, as this client needs it. Apply: operations in order, then patches, then drops, then the pieces.
struct FrameMessage {
  Tick tick = 0;
  std::vector<Operation> operations;
  std::vector<BrickPatch> patches;         ///< for changes whose operation the client could not apply
  std::vector<ChunkCoord> dropped_chunks;  ///< no longer followed: forget their edits
  std::vector<PieceId> removed_pieces;     ///< gone or out of interest, not named by an operation
  std::vector<uint8_t> transforms;         ///< packed poses (proto/transforms.h); empty: none in this frame
  bool has_check = false;
  uint32_t check =
      0;  ///< fold of Σ chunk hash over the chunks that operations and patches of this frame changed
};

/// A chunk's edited bricks, whole: replaces whatever edits the client had there; from now on it is followed.
struct ChunkMessage {
  ChunkCoord chunk;
  Tick version = 0;
  std::vector<BrickPatch> bricks;
  uint64_t hash = 0;  ///< Σ brick_hash
};

/// A piece whose making the client did not see.
struct PieceMessage {
  PieceId id = 0;
  Volume volume;
  QuantisedPose pose;
};

/// Forget every edit and piece; what follows is a join anew.
struct ResetMessage {};

struct ReplyMessage {
  uint32_t request = 0;
  std::string refusal;  ///< empty: carried out
  uint32_t pieces = 0;
};

/// The stages of a tick, as a status names them.
inline constexpr std::array<const char*, 8> stage_names{"carve", "spawn",     "bodies",  "impacts",
                                                        "rest",  "recombine", "islands", "publish"};

/// What the ticks of the last second had to do by the server's model, and what did not fit into them.
struct WorkStatus {
  uint32_t budget_us = 0;         ///< of a tick; 0: not known, as in a replay
  uint32_t worst_us = 0;          ///< most that a tick had to do
  uint32_t requests_waiting = 0;  ///< most at a tick's end
  uint32_t merges_put_off = 0;    ///< most at a tick's end
  uint32_t breaks_left_out = 0;   ///< in all
  uint32_t dents_left_out = 0;    ///< in all
  uint32_t ticks_cut_short = 0;   ///< in which any of these happened
  uint32_t ticks_merging_sooner = 0;
  uint32_t supports_put_off = 0;   ///< most bricks at a tick's end, around which what holds is not searched
  uint32_t islands_put_off = 0;    ///< most at a tick's end that hang loose and wait to fall
  uint32_t islands_too_large = 0;  ///< in all, taken for ground

  bool operator==(const WorkStatus&) const = default;
};

/// Once a second, for people.
struct StatusMessage {
  Tick tick = 0;
  uint32_t clients = 0;
  uint32_t pieces = 0;
  int64_t ledger_terrain = 0;
  int64_t ledger_pieces = 0;
  int64_t ledger_dust = 0;
  int64_t ledger_poured = 0;
  int64_t ledger_moved = 0;
  float tick_median_ms = 0.0F;  ///< over the last second
  float tick_worst_ms = 0.0F;
  uint64_t sent_bytes = 0;   ///< to this client since it joined
  uint64_t pieces_made = 0;  ///< since the start
  uint64_t pieces_merged = 0;
  uint64_t field_hash = 0;                           ///< of the whole field after `tick`
  uint32_t repairs = 0;                              ///< chunks resent to this client because a check failed
  SettingValues settings;                            ///< every setting of the simulation
  std::array<float, stage_names.size()> stage_ms{};  ///< mean over the last second
  WorkStatus work;
};

struct PlayerCursor {
  uint64_t session = 0;
  std::string name;
  glm::vec3 eye_m{0.0F};
  glm::vec3 aim_m{0.0F};

  bool operator==(const PlayerCursor&) const = default;
};

/// The other persons within interest, all of them.
struct CursorsMessage {
  std::vector<PlayerCursor> cursors;
};

/// A rigid body, beyond its pose.
struct WatchedBody {
  PieceId id = 0;
  bool awake = false;
  bool island = false;            ///< touches terrain by points of its own surface
  std::vector<glm::vec3> hull_m;  ///< corners that collide, from the centre of mass, in the volume's axes
};

struct WatchedContact {
  glm::vec3 point_m{0.0F};
  glm::vec3 normal{0.0F};
  float impulse_n_s = 0.0F;
};

/// What the bodies do, for people who want to see it. Lengths are rounded to 1/256 m on the wire.
struct PhysicsMessage {
  Tick tick = 0;
  std::vector<WatchedBody> bodies;  ///< ordered by id
  std::vector<WatchedContact> contacts;
  std::vector<BrickCoord> searched;  ///< bricks around which islands are looked for
};

using ServerMessage = std::variant<WelcomeMessage, RefusalMessage, FrameMessage, ChunkMessage, PieceMessage,
                                   ResetMessage, ReplyMessage, StatusMessage, CursorsMessage, PhysicsMessage>;

}  // namespace scree
