// The messages between server and client as plain values. proto/scree.proto specifies their encoding and the
// order in which a client applies them; proto/codec.h converts and checks every byte.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "proto/admin_message.h"
#include "proto/contact_message.h"
#include "proto/content.h"
#include "proto/cursor.h"
#include "proto/game_message.h"
#include "proto/health.h"
#include "proto/joint_message.h"
#include "proto/kept_pieces.h"
#include "proto/marks.h"
#include "proto/paging_status.h"
#include "proto/person_message.h"
#include "proto/playback_state.h"
#include "proto/protocol_version.h"
#include "proto/query.h"
#include "proto/region_message.h"
#include "proto/status_values.h"
#include "proto/store_message.h"
#include "proto/talk.h"
#include "shared/base/digest.h"
#include "shared/base/ids.h"
#include "shared/base/latency.h"
#include "shared/base/role.h"
#include "shared/base/setting_value.h"
#include "shared/base/spawn.h"
#include "shared/field/brick_patch.h"
#include "shared/operation/operation.h"
#include "shared/operation/request.h"

namespace scree {

/// Default TCP port of a server.
inline constexpr uint16_t default_port = 4177;

// ---- client to server

struct HelloMessage {
  uint32_t protocol = protocol_version;
  std::string client;  ///< name of the program, for the server's log; at most 64 bytes
  glm::vec3 eye_m{0.0F};
  float interest_radius_m = 0.0F;
  std::string name{};  ///< the person's, shown to others; at most limits::person_name_bytes_max
  /// An access token, or the server's admin token; at most limits::access_token_bytes_max. Empty: none.
  std::string token{};
  bool lacks_kernels = false;    ///< it gets bricks and whole pieces instead of operations
  std::string ticket{};          ///< of the session that goes on, as its welcome gave it; empty: none
  uint64_t world = 0;            ///< of the OfferMessage that comes next; 0: none comes
  bool meets = false;            ///< it is a person's: PersonsMessage and SaidMessage are wanted
  bool administers = false;      ///< it does nothing else: it sees and changes no terrain, and takes no place
  uint32_t oldest_protocol = 0;  ///< the oldest that it speaks; 0: none but `protocol`
  uint32_t operations = operation_kinds;  ///< it carries out so many kinds, in the order of their numbers
  bool at_spawn = false;  ///< the server puts the eye at WelcomeMessage::spawn, where there is one
  bool stones = false;    ///< StoneMessages are wanted
};

/// A message of a kind that this version does not know, or a request with an unknown value. It is skipped
/// and counted, so that a later version may send what an older one has never heard of.
struct UnknownMessage {
  std::optional<uint32_t> request{};  ///< the number of a request, which is answered by a refusal
  std::string value{};                ///< of a request: the unknown value, in words
};

/// Chunks that the client has kept from earlier, in ascending order, none twice.
struct OfferMessage {
  uint64_t world = 0;
  std::vector<ChunkCoord> chunks;
  std::vector<uint16_t> hashes;  ///< one per chunk: short_hash()
};

/// The part of a chunk's hash that an offer has. That it agrees by chance is possible, and found out by the
/// whole hash in the UnchangedChunksMessage.
constexpr uint16_t short_hash(uint64_t hash) {
  return static_cast<uint16_t>(hash);
}

/// The client's eye; the client follows the chunks and pieces within the radius.
struct InterestMessage {
  glm::vec3 eye_m{0.0F};
  float interest_radius_m = 0.0F;
};

/// Depth of a carve's centre behind the struck point, in radii, as clients choose it. Most of the shape is
/// rock then, the carve opens the surface, and the pieces are thrown out.
inline constexpr float carve_depth_in_radii = 0.4F;

/// A request with the client's number of it, which the reply returns. Requests to change settings need a
/// token as well: AdminMessage.
template <typename Request>
struct RequestMessage : Request {
  uint32_t request = 0;
};
using CarveMessage = RequestMessage<CarveRequest>;
using FillMessage = RequestMessage<FillRequest>;
using PaintMessage = RequestMessage<PaintRequest>;
using AddPropMessage = RequestMessage<AddPropRequest>;
using RemovePropMessage = RequestMessage<RemovePropRequest>;
using MovePropMessage = RequestMessage<MovePropRequest>;
using PushMessage = RequestMessage<PushRequest>;
using BreakMessage = RequestMessage<BreakRequest>;
using BlastMessage = RequestMessage<BlastRequest>;
using AddJointMessage = RequestMessage<AddJointRequest>;
using RemoveJointMessage = RequestMessage<RemoveJointRequest>;
using SetMotorMessage = RequestMessage<SetMotorRequest>;
using CutOutMessage = RequestMessage<CutOutRequest>;
using ReleaseMessage = RequestMessage<ReleaseRequest>;
using AddPieceMessage = RequestMessage<AddPieceRequest>;
using SetRegionMessage = RequestMessage<SetRegionRequest>;
using RemoveRegionMessage = RequestMessage<RemoveRegionRequest>;
using StandMessage = RequestMessage<StandRequest>;
using WalkMessage = RequestMessage<WalkRequest>;
using DigMessage = RequestMessage<DigRequest>;
using PlaceMessage = RequestMessage<PlaceRequest>;
using TransferMessage = RequestMessage<TransferRequest>;
using RulesMessage = RequestMessage<RulesRequest>;  ///< in recordings and worlds alone, as the next one
using RestoreMessage = RequestMessage<RestoreRequest>;

/// Hashes of chunks whose frame at `tick` had another check than the client computed.
struct RepairMessage {
  Tick tick = 0;
  std::vector<ChunkCoord> chunks;
  std::vector<uint64_t> hashes;  ///< the client's, one per chunk
};

/// The last frame that the client has applied; sent a few times a second.
struct AckMessage {
  Tick tick = 0;
};

/// Switches PhysicsMessages on or off, and ContactsMessages of blows of at least so much energy; 0: none.
struct PhysicsSubscriptionMessage {
  bool physics = false;
  float contacts_j = 0.0F;
};

/// Asks for the generated ground of chunks; each is answered by a GroundMessage.
struct AskGroundMessage {
  std::vector<ChunkCoord> chunks;
};

/// The client leaves for good. Nothing follows.
struct GoodbyeMessage {};

/// Asks for tiles of the ground, each of which is answered by a TileMessage, and says which
/// the client has kept from earlier.
struct AskTilesMessage {
  std::vector<TileKey> wanted;
  std::vector<TileKey> held{};
};

using ClientMessage =
    std::variant<HelloMessage, InterestMessage, CarveMessage, FillMessage, PaintMessage, RepairMessage,
                 AckMessage, AdminMessage, CursorMessage, PhysicsSubscriptionMessage, AskGroundMessage,
                 OfferMessage, GoodbyeMessage, AskTilesMessage, SayMessage, AskHealthMessage,
                 AskContentMessage, AddPropMessage, RemovePropMessage, MovePropMessage, PushMessage,
                 BreakMessage, BlastMessage, AddJointMessage, RemoveJointMessage, SetMotorMessage,
                 CutOutMessage, ReleaseMessage, AddPieceMessage, QueryMessage, SetRegionMessage,
                 RemoveRegionMessage, StandMessage, WalkMessage, DigMessage, PlaceMessage, TransferMessage,
                 RulesMessage, RestoreMessage, ChannelMessage, UnknownMessage>;

// ---- server to client

/// A ground's stored chunks, as far as they are known without their tiles. `root`: SHA-256 of the root.
struct BrickGround {
  BrickLayout layout;
  Digest root{};

  bool operator==(const BrickGround&) const = default;
};

/// A ground by heights, as far as it is known without its tiles. `top`: SHA-256 of the coarsest one.
struct HeightGround {
  HeightLayout layout;
  Digest top{};
  std::optional<BrickGround> bricks{};

  bool operator==(const HeightGround&) const = default;
};

struct WelcomeMessage {
  uint32_t protocol = protocol_version;
  uint64_t session = 0;
  Tick tick = 0;
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;  ///< frames carry transforms every so many ticks
  TerrainSource terrain;
  float interest_radius_m = 0.0F;  ///< as granted
  bool replay = false;             ///< a recording: requests to carve are refused
  Role role = Role::viewer;        ///< what this session may do
  uint64_t world = 0;              ///< tells worlds apart; never 0 on the wire
  std::string ticket{};            ///< for HelloMessage::ticket, once
  bool resumed = false;            ///< the session of the hello's ticket goes on
  /// If the ground is by heights: then terrain.kind and random_seed mean nothing. Who receives it makes
  /// terrain.heights of it.
  std::optional<HeightGround> heights{};
  /// Where who has no place of its own begins. Servers of older releases say none.
  std::optional<Spawn> spawn{};
  std::optional<Digest> palette{};  ///< SHA-256 of its bytes (proto/palette_codec.h)
};

/// The reason for which the server closes the connection.
struct RefusalMessage {
  std::string reason;  ///< in words for people
  std::string name{};  ///< for programs: the same in every release (docs/protocol.md)
};

/// One tick, as selected for this client. Apply operations in order, then patches, then drops, then pieces.
struct FrameMessage {
  Tick tick = 0;
  std::vector<Operation> operations;
  std::vector<BrickPatch> patches;         ///< for changes whose operation the client could not apply
  std::vector<ChunkCoord> dropped_chunks;  ///< no longer followed: forget their edits
  std::vector<PieceId> removed_pieces;     ///< gone or out of interest, not named by an operation
  std::vector<uint8_t> transforms;         ///< packed poses (proto/transforms.h), for who does not predict
  std::vector<uint8_t> motions;            ///< proto/motion_codec.h; empty: nothing moved, or it is not told
  bool has_check = false;
  /// The high half xor the low half of the sum of the hashes of all chunks that this frame's operations and
  /// patches changed.
  uint32_t check = 0;
};

/// All edited bricks of a chunk: they replace the client's edits there; from now on the client follows it. Or
/// a part of them, by a slow link: they are put over the edits there, and with the last part the client
/// follows the chunk.
struct ChunkMessage {
  ChunkCoord chunk;
  Tick version = 0;
  std::vector<BrickPatch> bricks;
  uint64_t hash = 0;    ///< Σ brick_hash of all edited bricks; 0 when more parts come
  uint64_t edited = 0;  ///< of a part: bit i is set for every edited brick i (index_in_chunk); 0: no part
  bool more = false;    ///< a part, and not the last one

  bool is_part() const { return edited != 0; }
};

/// In place of as many ChunkMessages: chunks that the client offered, and has as they are.
struct UnchangedChunksMessage {
  std::vector<ChunkCoord> chunks;
  std::vector<uint64_t> hashes;  ///< one per chunk, whole
};

/// The ground of a chunk as generated: bricks that are neither wholly rock nor in the list are wholly air.
struct GroundMessage {
  ChunkCoord chunk;
  bool beyond = false;  ///< not within interest: nothing else is set
  uint64_t rock = 0;    ///< bit i: brick i of the chunk (index_in_chunk) is wholly rock
  std::vector<BrickPatch> bricks{};
  uint64_t hash = 0;  ///< Σ brick_hash of all bricks
};

/// A tile of the ground's elevation model (proto/height_codec.h).
struct TileMessage {
  TileKey key;
  std::vector<uint8_t> bytes;
};

/// A piece whose creating operation the client did not get.
struct PieceMessage {
  PieceId id = 0;
  Volume volume;
  QuantisedPose pose;
};

/// A piece that has become terrain, as it lay, for who did not see it merge (SettledStone).
struct StoneMessage : PieceMessage {
  uint32_t lies = 0;
};

/// A prop, whole: a new one, or one that came into the interest.
struct PropMessage {
  PieceId id = 0;
  Prop prop;
  QuantisedPose pose;
};

/// Tells the client to forget every edit, piece and prop, as if it had just joined.
struct ResetMessage {};

struct ReplyMessage {
  uint32_t request = 0;
  std::string refusal;  ///< empty: carried out
  uint32_t pieces = 0;
  std::string refusal_name{};  ///< for programs, as of RefusalMessage
  ServerLatency latency{};     ///< zeroes: no tick answered it
  Tick tick = 0;               ///< that answered it; 0: none. Saved once StatusMessage::saved_tick is as high
  std::optional<uint32_t> painted{};  ///< bricks of 8 voxels a side whose rock a paint changed
  std::optional<PieceId> prop{};      ///< that was added
  std::optional<JointId> joint{};     ///< likewise
  std::optional<MassUnits> mass{};    ///< that was dug, placed or transferred
};

/// Once a second, for people.
struct StatusMessage {
  Tick tick = 0;
  uint32_t clients = 0;
  uint32_t pieces = 0;
  uint32_t props = 0;
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
  uint64_t field_hash = 0;        ///< of the whole field after `tick`
  uint32_t repairs = 0;           ///< chunks resent to this client because a check failed
  SettingValues settings;         ///< every setting of the simulation
  std::vector<StageTime> stages;  ///< every one in order; mean over the last second
  WorkStatus work;
  std::vector<RefusalCount> refusals;  ///< since the start; reasons that were never given are left out
  LatencyStatus latency;
  std::string
      saving{};  ///< "tick", "second" or "off": how a world file is kept; "retrying"; empty: there is none
  Tick saved_tick = 0;  ///< what happened up to here outlives the server
  /// Edited chunks within this client's interest that it has not been sent as they are.
  uint32_t chunks_waiting = 0;
  PagingStatus paging;
  MaterialLedger materials{};  ///< the ledger by material
  int64_t ledger_stored = 0;
};

/// A rigid body without its pose.
struct BodyView {
  PieceId id = 0;
  bool awake = false;
  bool island = false;            ///< collides with terrain by points of its own surface
  std::vector<glm::vec3> hull_m;  ///< corners that collide, from the place of its pose, in its axes
};

struct ContactView {
  glm::vec3 point_m{0.0F};
  glm::vec3 normal{0.0F};
  float impulse_n_s = 0.0F;
};

/// The bodies, contacts and searches of a tick, for display. Lengths are rounded to 1/256 m on the wire.
struct PhysicsMessage {
  Tick tick = 0;
  std::vector<BodyView> bodies;  ///< ordered by id
  std::vector<ContactView> contacts;
  std::vector<BrickCoord> searched;  ///< bricks of unfinished searches for islands
};

using ServerMessage =
    std::variant<WelcomeMessage, RefusalMessage, FrameMessage, ChunkMessage, PieceMessage, ResetMessage,
                 ReplyMessage, StatusMessage, CursorsMessage, PhysicsMessage, GroundMessage, AdminListMessage,
                 UnchangedChunksMessage, TileMessage, PersonsMessage, SaidMessage, PlaybackMessage,
                 MarksMessage, RecordedCursorsMessage, HealthMessage, ContentMessage, PaletteChangedMessage,
                 PropMessage, ContactsMessage, JointsMessage, KeptPiecesMessage, AnswerMessage,
                 RegionsMessage, PersonPlacesMessage, StoresMessage, SignsMessage, CuesMessage,
                 ChannelMessage, StoneMessage, UnknownMessage>;

/// About what the decoded message takes in memory; a few compressed bytes can hold megabytes of codes.
size_t memory_bytes(const ServerMessage& message);

}  // namespace scree
