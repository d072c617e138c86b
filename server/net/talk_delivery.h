// Brings sessions what Talk has for them. On the network thread.
#pragma once

#include <functional>

#include "proto/messages.h"
#include "server/net/session_table.h"
#include "server/net/talk.h"

namespace scree {

/// Sends the list of persons to the sessions that do not know it; later to a session that reads slowly.
void send_persons(Talk& talk, const SessionTable& sessions, double now_s);

/// Passes a line on. Sessions that read slowly miss it. Nobody hears a line for which `hook` returns false;
/// it may be empty.
void pass_on(const SayMessage& said, ClientSession& speaker, Talk& talk, const SessionTable& sessions,
             double now_s, const std::function<bool(const SaidMessage&)>& hook);

}  // namespace scree
