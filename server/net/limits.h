// Bounds of sessions, and of the network thread's queues. Each says its unit, its reason, and its effect at
// the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Seconds of a full socket after which its pace is known.
inline constexpr double pace_sample_s = 0.05;

/// Bytes of any kind waiting for one client, as replies that it never reads. Above: it is cut off.
inline constexpr size_t outbox_hard_bytes = 16 * 1024 * 1024;

/// Seconds from the connection to the hello; beyond: refused and closed.
inline constexpr double hello_seconds_max = 5.0;

/// Seconds that a refused client has to read the refusal before its connection is closed.
inline constexpr double linger_seconds_max = 2.0;

/// All connections that are no sessions: they have not said hello, or were refused and may still read why.
/// Above: one of them is closed for the newest (server/net/outsider.h), so that a client that says hello at
/// once always comes in. So many that a handshake over a slow link ends in time beside a thousand newcomers a
/// second.
inline constexpr size_t outsiders_max = 1024;

/// Such connections of one address beyond which it makes room first: a browser opens six.
inline constexpr size_t outsiders_of_an_address = 8;

/// Sessions of one address that another address's newcomer never makes go, however full the server is: a
/// household.
inline constexpr size_t sessions_of_a_household = 2;

/// Sessions that take no place: administrators, and programs that administer alone. Above: of those that hold
/// no token, the one that came first goes for the next, and for an administrator one of another role, too;
/// else the next is refused. So that an administrator can always act, whatever is full of others.
inline constexpr size_t administrators_max = 32;

/// Descriptors that the process keeps for files, threads and the owner's connections, beside all others.
inline constexpr size_t descriptors_reserved = 64;

/// When the server is full, a session makes room for the next if it has done nothing for so many seconds;
/// sooner if it has never sent anything since its hello, not even that it applied a frame.
inline constexpr double idle_seconds_max = 60.0;
inline constexpr double inert_seconds_max = 2.0;

/// Requests that a client may make at once after a silence, in seconds of its rate
/// (ServiceLimits::requests_per_second). Above: each gets a reply that refuses it.
inline constexpr double requests_burst_s = 2.0;

/// Questions about space from one client, per second and at once; a message without any counts as one. Ten
/// bodies that look about 50 times a second need half of it. Above: the message is refused in its answer.
inline constexpr double queries_per_second_max = 1000.0;
inline constexpr double queries_burst_max = 2000.0;

/// Metres by which a client may tell its eye off its person's, which has moved meanwhile. Beyond: the
/// person's counts.
inline constexpr float eye_off_person_m = 8.0F;

/// Inputs of a person on foot, in ticks' worths of them a second, and at once in seconds: a link may hold
/// some back. Above: refused.
inline constexpr double walk_inputs_a_tick_max = 1.5;
inline constexpr double walk_inputs_burst_s = 2.0;

/// Messages of any kind from one client, per second and at once. No client needs as many: refused and closed.
inline constexpr double messages_per_second_max = 500.0;
inline constexpr double messages_burst_max = 1000.0;

/// Lines of chat that a session may say, a second and at once after a silence, and all sessions of a party. A
/// party has no more than its even share of what all together may say, so that none silences the others.
/// Above: not passed on, and the speaker is told.
inline constexpr double lines_per_second_max = 0.5;
inline constexpr double lines_burst_max = 5.0;
inline constexpr double lines_per_second_party = 2.0;
inline constexpr double lines_burst_party = 10.0;

/// Each line goes to everybody: so many a second reach persons, all together, at least so many lines a
/// second, and at once as many as in so many seconds. A hundred persons may all talk without a pause.
inline constexpr double lines_heard_per_second = 40000.0;
inline constexpr double lines_per_second_all = 10.0;
inline constexpr double lines_burst_s = 4.0;

/// Seconds after its last line for which it is known what a party has said: longer than any of its limits
/// remembers, so that nobody may say more by coming again.
inline constexpr double lines_memory_s = 10.0;

/// Seconds between two lists of persons, and where there are more than one message holds.
inline constexpr double persons_interval_s = 1.0;
inline constexpr double persons_many_interval_s = 10.0;

/// Commands that wait for the next tick; above: each gets a reply that refuses it.
inline constexpr size_t commands_waiting_max = 1024;

/// Requests whose stages are measured at once, and whose stages the status sums up: more than may wait.
/// Above: their replies say nothing of stages, and the oldest answers are forgotten.
inline constexpr size_t requests_timed_max = 4096;

/// Part of a tick's time that handing messages to the sockets may take, on average. Above: those of several
/// ticks go out together, by one write for each session, for a write costs more than all else, and the
/// sessions take turns; the other half is for what selects them.
inline constexpr double flush_share_max = 0.5;

/// Ticks whose messages go out together at most, for that reason or because the network thread lags. They
/// wait for two ticks' time at most if no more ticks come.
inline constexpr uint32_t ticks_per_flush_max = 4;
inline constexpr double flush_wait_ticks_max = 2.0;

/// Parts of a tick's time that the network thread may be busy while the ground that it generates in a tick
/// grows, and above which it shrinks (GroundPace).
inline constexpr double tick_share_idle = 0.3;
inline constexpr double tick_share_busy = 0.5;

/// Ticks published that the network thread has not taken yet; above: the simulation waits for it, and the
/// wait is counted.
inline constexpr size_t deltas_in_flight_max = 128;

}  // namespace scree::limits
