// Time that stands still until a test moves it, and streams in memory, for tests of links without sockets.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "transport/link_clock.h"
#include "transport/transport.h"

namespace scree {

/// Runs what its clocks are to wake, in the order of time.
class SimulatedTime {
 public:
  class Clock final : public LinkClock {
   public:
    explicit Clock(SimulatedTime& time) : time_(time) { time_.clocks_.insert(this); }
    ~Clock() override { time_.clocks_.erase(this); }
    double now_s() const override { return time_.now_s; }
    void wake_at(double time_s, std::function<void()> wake) override {
      at_s_ = std::max(time_s, time_.now_s);
      wake_ = std::move(wake);
    }
    void cancel() override { wake_ = nullptr; }

   private:
    friend SimulatedTime;
    SimulatedTime& time_;
    double at_s_ = 0.0;
    std::function<void()> wake_;
  };

  std::unique_ptr<LinkClock> clock() { return std::make_unique<Clock>(*this); }

  void run_until(double time_s) {
    for (;;) {
      Clock* next = nullptr;
      for (Clock* clock : clocks_)
        if (clock->wake_ && clock->at_s_ <= time_s && (next == nullptr || clock->at_s_ < next->at_s_))
          next = clock;
      if (next == nullptr) break;
      now_s = next->at_s_;
      std::exchange(next->wake_, nullptr)();
    }
    now_s = time_s;
  }

  double now_s = 0.0;

 private:
  std::set<Clock*> clocks_;
};

/// One end of a stream in memory, which holds so many bytes each way.
class MemoryStream final : public Transport, public std::enable_shared_from_this<MemoryStream> {
 public:
  explicit MemoryStream(size_t buffer_bytes) : buffer_bytes_(buffer_bytes) {}
  static void join(const std::shared_ptr<MemoryStream>& one, const std::shared_ptr<MemoryStream>& other) {
    one->other_ = other;
    other->other_ = one;
  }

  void read_some(std::span<uint8_t> into, Done done) override {
    into_ = into;
    read_done_ = std::move(done);
    go_on();
  }
  void write_some(Buffers buffers, Done done) override {
    outgoing_.clear();
    for (const auto bytes : buffers) outgoing_.insert(outgoing_.end(), bytes.begin(), bytes.end());
    write_done_ = std::move(done);
    go_on();
  }
  void finish_sending() override { end(true); }
  void close() override {
    read_done_ = write_done_ = nullptr;
    end(true);
  }
  void abort() override {
    read_done_ = write_done_ = nullptr;
    end(false);
  }
  bool established() const override { return true; }
  bool encrypted() const override { return false; }
  const std::string& address() const override { return address_; }
  uint16_t port() const override { return 0; }

  /// Bytes that wait for this end to read them.
  size_t waiting_bytes() const { return arrived_.size(); }

 private:
  void go_on() {
    const auto self = shared_from_this();
    const auto other = other_.lock();
    if (write_done_ && other && other->arrived_.size() < buffer_bytes_) {
      const size_t count = std::min(outgoing_.size(), buffer_bytes_ - other->arrived_.size());
      other->arrived_.insert(other->arrived_.end(), outgoing_.begin(),
                             outgoing_.begin() + static_cast<ptrdiff_t>(count));
      std::exchange(write_done_, nullptr)(count);
      other->go_on();
    }
    if (read_done_ && !arrived_.empty()) {
      const size_t count = std::min(into_.size(), arrived_.size());
      std::copy_n(arrived_.begin(), count, into_.begin());
      arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<ptrdiff_t>(count));
      std::exchange(read_done_, nullptr)(count);
      if (other) other->go_on();
    } else if (read_done_ && end_) {
      std::exchange(read_done_, nullptr)(tl::unexpected(*end_));
    }
  }
  void end(bool orderly) {
    const auto other = other_.lock();
    if (!other || other->end_) return;
    other->end_ = StreamEnd{orderly, orderly ? "the other side ended it" : "reset"};
    other->go_on();
  }

  size_t buffer_bytes_;
  std::weak_ptr<MemoryStream> other_;
  std::vector<uint8_t> arrived_, outgoing_;
  std::span<uint8_t> into_;
  Done read_done_, write_done_;
  std::optional<StreamEnd> end_;
  std::string address_ = "memory";
};

}  // namespace scree
