// Many viewers on loopback that carve at their times, and look at one thing: how long it takes until their
// own carve is there, and what its reply says of the way.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "proto/messages.h"
#include "shared/base/random.h"
#include "shared/base/result.h"

namespace scree {

struct AskersConfig {
  uint16_t port = 0;
  TerrainSource terrain;
  size_t viewers = 100;
  float spread_m = 24.0F;  ///< they look, and carve, within this of the origin
  float apart_m = 0.0F;    ///< they stand on a square grid about the origin instead, so far apart; 0: not
  float interest_m = 48.0F;
  double seconds_per_carve = 4.0;  ///< of each viewer, on average, from turn to turn
  float radius_m = 1.0F;
  uint32_t seeds = 8;
  float speed_m_s = 0.0F;  ///< at which they walk, to and fro
  bool anywhere = false;   ///< they carve all over the spread, instead of near where they stand
  size_t carves_max = 0;   ///< of all together; 0: no end
};

/// By request, milliseconds. A viewer that waits for its answer misses its turn: with a server that is too
/// slow there are fewer requests than turns, and answers can be lacking at the end.
struct AskedTimes {
  std::vector<double> applied;        ///< until the frame with its operation had come
  std::vector<RequestLatency> reply;  ///< until the reply had come
  size_t turns = 0;                   ///< of viewers, missed ones as well
  size_t asked = 0;
  size_t refused = 0;
};

class Askers {
 public:
  /// Connects all; they are served by one thread, which begins with start().
  static Result<std::unique_ptr<Askers>> connect(const AskersConfig& config);
  ~Askers();
  Askers(const Askers&) = delete;
  Askers& operator=(const Askers&) = delete;

  void start();
  /// Turns and requests from now on are counted.
  void count(bool on) { counting_ = on; }
  /// Ends the thread; after this the times can be read.
  void stop();
  /// All of carves_max have been asked for and answered, or nobody is left.
  bool finished() const { return finished_; }
  size_t answered() const { return answered_; }
  /// Counted requests that have no answer so far.
  size_t counted_open() const { return counted_open_; }

  const AskedTimes& times() const { return times_; }
  size_t lost() const { return lost_; }  ///< connections that ended, or brought what cannot be decoded

 private:
  struct Viewer;
  explicit Askers(const AskersConfig& config);
  glm::vec3 place_m(size_t viewer);
  void run();
  void begin_turn(Viewer& viewer);
  void walk(Viewer& viewer, double now_s);
  bool receive(Viewer& viewer, std::span<const uint8_t> body, double now_s);
  void lose(Viewer& viewer);

  AskersConfig config_;
  int epoll_ = -1;
  std::vector<std::unique_ptr<Viewer>> viewers_;
  Random random_{77};
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> counting_{false};
  std::atomic<bool> finished_{false};
  std::atomic<size_t> answered_{0};
  std::atomic<size_t> counted_open_{0};
  size_t asked_ = 0;
  AskedTimes times_;
  size_t lost_ = 0;
};

}  // namespace scree
