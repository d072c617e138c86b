// The measurements of a bot, and their JSON form for programs.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "client/mirror/mirror.h"
#include "proto/messages.h"
#include "shared/field/mass.h"
#include "shared/operation/per_operation.h"

namespace scree {

/// Bytes received, length prefixes included, by kind of message. Transforms are part of the frames on the
/// wire, and counted apart here.
struct BytesByKind {
  uint64_t frames = 0;  ///< without transforms
  uint64_t transforms = 0;
  uint64_t chunks = 0;
  uint64_t pieces = 0;
  uint64_t tiles = 0;  ///< of the ground
  uint64_t other = 0;

  uint64_t total() const { return frames + transforms + chunks + pieces + tiles + other; }
};

/// Bytes of operations on the wire: their own, and an equal share of their frame's other bytes without
/// transforms. Frames with patches are left out: the patches replace operations that were not sent.
struct OperationCost {
  uint64_t count = 0;
  double bytes = 0.0;
  double bytes_worst = 0.0;

  double mean() const { return count == 0 ? 0.0 : bytes / static_cast<double>(count); }
  void add(double cost) {
    ++count;
    bytes += cost;
    if (cost > bytes_worst) bytes_worst = cost;
  }
};

/// Comparisons of the copy's hash with the server's, at each status that allows one.
struct HashComparison {
  uint64_t compared = 0;
  bool equal = false;  ///< at the last comparison
  Tick tick = 0;
  uint64_t client = 0;
  uint64_t server = 0;
};

/// A bot's walks on foot.
struct WalkReport {
  uint32_t done = 0;
  uint64_t inputs = 0;
  double seconds = 0.0;  ///< of the inputs
  uint64_t refused = 0;  ///< inputs, and requests to stand
  uint64_t corrections = 0;
  float correction_worst_m = 0.0F;
  float depth_worst_m = -1.0F;  ///< in rock, of the person as the server tells it
};

/// What a game's rules showed and told a bot.
struct RulesReport {
  uint64_t signs = 0;              ///< lists of signs
  uint64_t cues = 0;               ///< sounds and puffs
  uint64_t messages = 0;           ///< of channels
  std::vector<ChannelData> heard;  ///< the first of them, at most limits::bot_heard_max
  uint64_t lines = 0;              ///< that persons, the server or its rules said
  std::vector<SaidMessage> said;   ///< the first of them, likewise
};

/// A bot's digs, or its places.
struct MoveReport {
  uint32_t asked = 0;
  uint32_t accepted = 0;
  uint32_t refused = 0;
  uint32_t lost = 0;                         ///< the connection was lost before the reply
  MassUnits mass = 0;                        ///< that the accepted ones moved
  std::map<std::string, uint32_t> refusals;  ///< by the name of the reason

  uint32_t waiting() const { return asked - accepted - refused - lost; }
};

struct BotReport {
  std::string server;
  WelcomeMessage welcome;
  std::string failure;  ///< empty: no failure
  std::string refusal;  ///< the name of the server's reason, if it refused the session in the end
  bool settled =
      false;  ///< everything asked for was answered, the walks are over, and the terrain is at rest
  double duration_s = 0.0;
  uint32_t connections = 0;

  uint32_t carves_asked = 0;
  uint32_t carves_accepted = 0;
  uint32_t carves_saved = 0;  ///< of the accepted: the server said that their tick outlives it
  uint32_t carves_refused = 0;
  uint32_t carves_lost = 0;                  ///< the connection was lost before the reply
  std::map<std::string, uint32_t> refusals;  ///< by the name of the reason

  MoveReport digs, places;
  std::map<std::string, MassUnits> carried;  ///< in the own store, by material
  WalkReport walks;
  RulesReport rules;
  std::vector<Sign> signs;  ///< as they are at the end
  MirrorCounters seen;      ///< over all connections
  uint64_t pieces_alive = 0;
  uint64_t chunks_held = 0;
  BytesByKind bytes;
  uint64_t bytes_sent = 0;
  PerOperation<OperationCost> costs;
  HashComparison hash;
  StatusMessage status;  ///< the last one
  std::vector<double> tick_medians_ms;
  double tick_worst_ms = 0.0;
  double ticks_per_s = 0.0;
  std::vector<double> edit_latencies_ms;     ///< request sent to frame with its operation received
  std::vector<double> reply_latencies_ms;    ///< request sent to reply received
  std::vector<double> network_latencies_ms;  ///< the same, without what the server says of itself
  /// What it says, by stage (latency_stages).
  std::array<std::vector<double>, latency_stages.size()> server_latencies_ms;
};

std::string to_json(const BotReport& report);
/// The volume of rock without pores.
double m3_of(MassUnits mass, const BotReport& report);
/// Where all carves, digs and places were refused: that, and why; else empty.
std::string all_refused(const BotReport& report);

}  // namespace scree
