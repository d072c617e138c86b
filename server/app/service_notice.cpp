#include "server/app/service_notice.h"

#include <ctime>
#include <fmt/format.h>
#include <string>
#include <systemd/sd-daemon.h>

namespace scree {
namespace {

/// sd_notify() reads NOTIFY_SOCKET, and does nothing where there is none.
void send_notice(const std::string& lines) {
  static_cast<void>(::sd_notify(0, lines.c_str()));
}

}  // namespace

void notify_ready() {
  send_notice("READY=1");
}

void notify_reloading() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  send_notice(fmt::format("RELOADING=1\nMONOTONIC_USEC={}", now.tv_sec * 1'000'000 + now.tv_nsec / 1000));
}

void notify_stopping() {
  send_notice("STOPPING=1\nSTATUS=saving, and stopping");
}

void notify_pulse(const LivePulse& pulse) {
  send_notice(fmt::format("WATCHDOG=1\nSTATUS=tick {}, {} sessions, {} ticks late", pulse.tick,
                          pulse.sessions, pulse.late_ticks));
}

}  // namespace scree
