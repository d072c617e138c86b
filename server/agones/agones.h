// What a server tells Agones of itself, as one of a fleet: that it is ready and lives, how many people are
// in, and that it ends. Where people are in, it is allocated: Agones ends others to make the fleet smaller.
// When the last one has left, it is reserved for a while, for who has lost a connection comes back; then it
// is ready again.
//
// A thread of its own asks the side-car. A side-car that does not answer holds up nothing but shut_down(),
// which waits for the request that is under way and its own, limits::agones_request_ms each; it is asked
// again every second. Functions are for any thread.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace scree {

struct AgonesConfig {
  bool on = false;
  uint16_t port = 9358;  ///< of the side-car, as in AGONES_SDK_HTTP_PORT
  uint32_t kept_s = 60;  ///< reserved for, after the last one has left
  std::string world;     ///< the world's name, for a label; may be empty
  bool edge = false;     ///< likewise
};

class Agones {
 public:
  explicit Agones(AgonesConfig config);
  /// As shut_down().
  ~Agones();
  Agones(const Agones&) = delete;
  Agones& operator=(const Agones&) = delete;

  /// The port listens.
  void ready();
  /// The simulation goes on, with so many people of at most `seats`.
  void pulse(uint32_t people, uint32_t seats);
  /// The server ends. Nothing is told after this.
  void shut_down();

 private:
  /// What the server was last said to be.
  struct Known {
    bool ready = false;
    bool ends = false;
    uint64_t pulses = 0;
    uint32_t people = 0, seats = 0;
  };

  void run();
  Known await(double seconds, const Known& known);

  const AgonesConfig config_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Known known_;
  std::thread thread_;
};

}  // namespace scree
