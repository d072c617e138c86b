// The facts of a session and its view that the HUD shows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/viewer/viewing/visit.h"

namespace scree {

/// A drawing method that is not shown yet: its blocks of triangles, or bricks.
struct Preparing {
  std::string method;
  size_t done = 0;
  size_t waiting = 0;
  bool goes_on = false;  ///< there was a whole picture of this world before

  float share() const {
    return done + waiting == 0 ? 0.0F : static_cast<float>(done) / static_cast<float>(done + waiting);
  }
};

/// What became of the last strike.
enum class StrikeMark : uint8_t { none = 0, hit = 1, refused = 2 };

struct CarriedRow {
  std::string material;
  std::array<float, 3> colour{};  ///< linear, of its look
  double volume_m3 = 0.0;
};

struct HudFacts {
  std::string connection;  ///< one line
  bool lost = false;       ///< the connection is gone: shown above everything
  std::string camera;      ///< place and direction, one line
  Tick tick = 0;
  double tick_rate_hz = 60.0;
  double pace = 1.0;        ///< of the world's time, 1: as the clock's
  uint64_t lost_ticks = 0;  ///< by which the world is behind the clock
  bool is_replay = false;
  float voxel_size_m = 1.0F;
  size_t pieces_near = 0;              ///< that the server shows to this viewer
  size_t stones = 0;                   ///< drawn where pieces merged
  size_t props_near = 0;               ///< likewise
  size_t kept_near = 0;                ///< pieces of these that never become terrain
  std::vector<CarriedRow> carried;     ///< by the own store, in the palette's order
  std::optional<float> store_room_m3;  ///< what it holds at most; nothing: not known
  std::optional<Preparing> preparing;
  std::optional<StatusMessage> status;  ///< the server's last
  double bytes_per_s = 0.0;
  uint64_t mismatches = 0;
  std::string notice;                     ///< why the last request did nothing, or news, for a while
  StrikeMark mark = StrikeMark::none;     ///< of the last strike, for a moment
  std::string refused;                    ///< why it was, in three words
  std::optional<double> retry_s;          ///< until the next attempt to connect
  std::optional<RequestLatency> latency;  ///< of one's own last request
  size_t predictions = 0;                 ///< own carves that the server has not answered
  std::string method;
  std::string driver;
  DrawStats draw;
  std::vector<GpuTime> gpu_times;
  size_t held_chunks = 0;    ///< that follow the server
  size_t edited_chunks = 0;  ///< of them with edits
  size_t edited_bricks = 0;
  MemoryCounts memory;  ///< of the drawing method, of the mirror, and of waiting messages
};

/// Caches costly counts for limits::count_interval_s.
class FactFinder {
 public:
  HudFacts find(Visit& visit, double now_s);

 private:
  void count(const Mirror& mirror, const ViewerSession& session);

  MemoryCounts mirror_memory_;
  double next_count_s_ = 0.0;
  HudFacts counted_;
};

}  // namespace scree
