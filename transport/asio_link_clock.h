// A simulated link in real time, on the thread that runs the sockets. Used by .cpp files alone (Asio).
#pragma once

#include <asio/steady_timer.hpp>
#include <utility>

#include "shared/base/timing.h"
#include "transport/link_clock.h"

namespace scree {

class AsioLinkClock final : public LinkClock {
 public:
  explicit AsioLinkClock(asio::io_context& context) : timer_(context) {}

  double now_s() const override { return steady_now_s(); }
  void wake_at(double time_s, std::function<void()> wake) override {
    const std::chrono::duration<double> since_start(time_s);
    timer_.expires_at(std::chrono::steady_clock::time_point(
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(since_start)));
    timer_.async_wait([wake = std::move(wake)](asio::error_code error) {
      if (!error) wake();
    });
  }
  void cancel() override { timer_.cancel(); }

 private:
  asio::steady_timer timer_;
};

}  // namespace scree
