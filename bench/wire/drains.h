// Many viewers on loopback that read all they get and look at one thing: how old each frame is when it
// arrives.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "proto/messages.h"
#include "shared/base/result.h"

namespace scree {

/// Lets other threads go before this one, which stands for a client's machine, not for the server's.
void stand_aside();

/// When each tick was handed to the network side; written by the simulation, read by those who measure.
class TickTimes {
 public:
  static constexpr size_t ticks_max = 1U << 16U;
  void published(Tick tick, double now_s) {
    times_s_[tick % ticks_max].store(now_s, std::memory_order_release);
  }
  double of(Tick tick) const { return times_s_[tick % ticks_max].load(std::memory_order_acquire); }

 private:
  std::array<std::atomic<double>, ticks_max> times_s_{};
};

/// Counts of ages in steps of 0.1 ms.
class AgeCount {
 public:
  void add(double age_s);
  void clear() { *this = AgeCount(); }
  uint64_t count() const { return count_; }
  double quantile_ms(double part) const;

 private:
  std::vector<uint64_t> steps_ = std::vector<uint64_t>(100001);  ///< the last: 10 s and above
  uint64_t count_ = 0;
};

class Drains {
 public:
  /// Connects with a hello each; all are read by one thread, which begins with start().
  static Result<std::unique_ptr<Drains>> connect(uint16_t port, const std::vector<HelloMessage>& hellos,
                                                 const TickTimes& times);
  ~Drains();
  Drains(const Drains&) = delete;
  Drains& operator=(const Drains&) = delete;

  void start();
  /// Ages of frames that arrive from now on are counted.
  void count(bool on) { counting_ = on; }
  /// Ends the thread; after this the counts can be read.
  void stop();

  const AgeCount& ages() const { return ages_; }
  uint64_t bytes() const { return bytes_; }  ///< while counting
  size_t lost() const { return lost_; }      ///< connections that ended
  /// Processor time of its thread so far. From any thread.
  double cpu_s() const { return cpu_s_; }

 private:
  struct Reader;
  explicit Drains(const TickTimes& times);
  void run();
  void receive(Reader& reader, const uint8_t* bytes, size_t size, double now_s);

  const TickTimes& times_;
  int epoll_ = -1;
  std::vector<Reader> readers_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> counting_{false};
  std::atomic<double> cpu_s_{0.0};
  AgeCount ages_;
  uint64_t bytes_ = 0;
  size_t lost_ = 0;
};

}  // namespace scree
