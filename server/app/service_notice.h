// What the server tells the service manager that started it, by the protocol of sd_notify(3): that it is
// ready, reads its files again, stops, and lives. Nothing is sent where the environment has no NOTIFY_SOCKET.
// A notice that cannot be sent is lost: the manager misses it soon enough. Any thread.
#pragma once

#include "server/app/live_server.h"

namespace scree {

/// The port listens, and the world is loaded; or the files were read again.
void notify_ready();

/// The files are read again from now on; notify_ready() ends that.
void notify_reloading();

/// The server ends. It is asked for no more pulses.
void notify_stopping();

/// The server's words for `systemctl status`, and a ping for the manager's watchdog, which restarts a server
/// that sends none.
void notify_pulse(const LivePulse& pulse);

}  // namespace scree
