// Brings sessions what Talk has for them. On the network thread.
#pragma once

#include <functional>

#include "proto/messages.h"
#include "server/net/session_table.h"
#include "server/net/talk.h"

namespace scree {

/// Sends the list of persons to the sessions that do not know it; later to a session that reads slowly.
void send_persons(Talk& talk, const SessionTable& sessions, double now_s);

/// Who else hears lines.
struct LineListeners {
  const std::function<bool(const SaidMessage&)>& hook;  ///< false: nobody hears the line; may be empty
  bool log = false;                                     ///< lines that all hear are logged
};

/// Passes a line on. Sessions that read slowly miss it.
void pass_on(const SayMessage& said, ClientSession& speaker, Talk& talk, const SessionTable& sessions,
             double now_s, const LineListeners& listeners);

}  // namespace scree
