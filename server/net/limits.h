// Bounds of the server's network side. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Chunks and pieces that a client follows are dropped at this multiple of its radius of interest, so that a
/// viewer that moves to and fro across the edge does not get them again and again.
inline constexpr float interest_keep_factor = 1.25F;

/// Bytes of chunks sent to one client in a tick: about 1 MB/s at 60 Hz. Above: the rest waits for the next
/// ticks, nearest first.
inline constexpr int64_t chunk_bytes_per_tick = 16 * 1024;

/// Bytes of pieces' volumes sent to one client in a tick. Above: the rest waits, nearest first.
inline constexpr int64_t piece_bytes_per_tick = 8 * 1024;

/// Bricks sent as patches to one client in one frame: 512 KiB of codes, so that a frame stays within
/// message_bytes_max even when nothing compresses. Above: whole chunks are streamed instead.
inline constexpr size_t patch_bricks_max = 1024;

/// Bytes that a patched brick takes, about; by these a slow link's room for them is reckoned.
inline constexpr size_t patch_brick_bytes = 128;

/// Bricks sent as patches to a client without kernels, in a tick on average; what is saved up, up to
/// patch_bricks_max, may go at once. 32 KiB of codes compress to less than chunk_bytes_per_tick. Above: whole
/// chunks are streamed instead, within their budget, so that a chunk that changes in every tick is sent as
/// often as there is room.
inline constexpr size_t patch_bricks_per_tick = 64;

/// Bytes of ground sent to one client in a tick. Above: the rest waits.
inline constexpr int64_t ground_bytes_per_tick = 16 * 1024;

/// Bytes of the bodies' state (PhysicsMessage) sent to one client in a tick on average: 240 KB/s at 60 Hz.
/// Above: it gets the next message later, with the state as it is then.
inline constexpr int64_t physics_bytes_per_tick = 4 * 1024;

/// Ground that the network thread generates in a tick for all clients together: a chunk with a surface counts
/// 8 and takes 1 to 2 ms with its encoding, another one counts 1 and takes 0.2 ms. The last one may go
/// beyond. Above: the rest waits, each client in turn.
inline constexpr int ground_work_per_tick = 8;

/// Bytes of encoded ground kept to be sent to several clients. Above: all of it is forgotten, and generated
/// again on demand.
inline constexpr size_t ground_kept_bytes_max = 32 * 1024 * 1024;

/// Ticks between two scans of the edited chunks for one client that moves: bounds the cost of fast movement.
inline constexpr uint32_t rescan_ticks_min = 6;

/// Seconds after which a client gets a frame though nothing happened: it sees that the server lives, and what
/// time it is there.
inline constexpr double heartbeat_s = 0.5;

/// Bytes waiting for one client above which it gets no transforms and no streaming: what it reads must not be
/// old. By a slow link they are fewer: what it takes in outbox_wait_s, but enough for a few frames.
inline constexpr size_t outbox_soft_bytes = 16 * 1024;
inline constexpr size_t outbox_soft_min_bytes = 1024;
inline constexpr double outbox_wait_s = 0.1;

/// Seconds of a full socket after which its pace is known.
inline constexpr double pace_sample_s = 0.05;

/// Bytes waiting for one client above which it gets no frames: when it has read all, it is reset.
inline constexpr size_t outbox_resync_bytes = 2 * 1024 * 1024;

/// Bytes of any kind waiting for one client, as replies that it never reads. Above: it is cut off.
inline constexpr size_t outbox_hard_bytes = 16 * 1024 * 1024;

/// Bytes of the kernel's send buffer for one client, most of them on their way; newer state cannot replace
/// those in it.
inline constexpr int socket_send_buffer_bytes = 256 * 1024;

/// Bytes in that buffer that are not on their way yet. Above: the socket takes no more, and what waits is
/// held back where newer state can replace it.
inline constexpr int socket_unsent_bytes = 2 * 1024;

/// Encoded chunks kept to be sent to several clients. Above: all are forgotten, and encoded again on demand.
inline constexpr size_t encoded_chunks_max = 1024;

/// Seconds within which a client must read some of the bytes that wait for it, and its machine acknowledge
/// those that were sent. Above: it is cut off.
inline constexpr double stall_seconds_max = 20.0;

/// Seconds from the connection to the hello; beyond: refused and closed.
inline constexpr double hello_seconds_max = 5.0;

/// Seconds that a refused client has to read the refusal before its connection is closed.
inline constexpr double linger_seconds_max = 2.0;

/// Connections that are no sessions (they have not said hello, or were refused and may still read why), all
/// together; above: the oldest of them is closed for the newest, so that whoever says hello at once always
/// comes in.
inline constexpr size_t outsiders_max = 512;

/// Descriptors that the process keeps for files and threads, beside connections.
inline constexpr size_t descriptors_reserved = 64;

/// Connections that one address (Door) may hold; above: closed at once.
inline constexpr size_t connections_per_address_max = 64;

/// Connections that one address may open, a second and at once; above: closed at once.
inline constexpr double connects_per_second_max = 10.0;
inline constexpr double connects_burst_max = 64.0;

/// Addresses that are remembered; above: those without a connection are forgotten, the longest quiet first.
inline constexpr size_t door_addresses_max = 65536;

/// Seconds for which an address without connections is remembered, when others need its place, and after
/// which its wrong guesses at tokens are forgiven.
inline constexpr double door_memory_s = 600.0;

/// Seconds that an address waits after its first wrong token, and at most.
inline constexpr double guess_wait_min_s = 1.0;
inline constexpr double guess_wait_max_s = 60.0;

/// Wrong tokens of one address that are known again; above: the oldest is forgotten, and counts as a guess.
inline constexpr size_t wrong_tokens_known = 4;

/// Milliseconds for which no connection is accepted after accepting has failed.
inline constexpr int accept_pause_ms = 100;

/// When the server is full, a session makes room for the next if it has done nothing for so many seconds;
/// sooner if it has never sent anything since its hello, not even that it applied a frame.
inline constexpr double idle_seconds_max = 60.0;
inline constexpr double inert_seconds_max = 2.0;

/// Seconds for which no chunks are sent to a client that has announced an offer; then it is as one without.
inline constexpr double offer_wait_s = 1.0;

/// Seconds after which an offer is forgotten, if not all that was wanted has come before.
inline constexpr double offer_seconds_max = 60.0;

/// Seconds after the end of its connection for which a session can go on by its ticket.
inline constexpr double ticket_seconds_max = 60.0;

/// Sessions without a connection that can go on; above: those that ended first are forgotten.
inline constexpr size_t departed_max = 4096;

/// Seconds for which a full server keeps the place of a lost connection, and the part of all places that it
/// keeps so; above: somebody else may have it. Holders of tokens may at once.
inline constexpr double place_kept_seconds_max = 15.0;
inline constexpr double places_kept_part = 0.25;

/// Lines of one kind in the log, a second and at once; the rest is counted.
inline constexpr double log_lines_per_second = 2.0;
inline constexpr double log_lines_burst = 8.0;

/// Requests that a client may make at once after a silence, in seconds of its rate
/// (ServiceLimits::requests_per_second). Above: each gets a reply that refuses it.
inline constexpr double requests_burst_s = 2.0;

/// Messages of any kind from one client, per second and at once. No client needs as many: refused and closed.
inline constexpr double messages_per_second_max = 500.0;
inline constexpr double messages_burst_max = 1000.0;

/// Bytes from one client, per second and at once; refused and closed.
inline constexpr double client_bytes_per_second_max = 128.0 * 1024.0;
inline constexpr double client_bytes_burst_max = 512.0 * 1024.0;
/// Addresses that are banned; above: an administrator is told so.
inline constexpr size_t bans_max = 2048;

/// Commands that wait for the next tick; above: each gets a reply that refuses it.
inline constexpr size_t commands_waiting_max = 1024;

/// Requests whose stages are measured at once, and whose stages the status sums up: more than may wait.
/// Above: their replies say nothing of stages, and the oldest answers are forgotten.
inline constexpr size_t requests_timed_max = 4096;

/// Part of a tick's time that handing its messages to the sockets may take, on average. Above: those of
/// several ticks go out together, by one write for each session, for a write costs more than all else; the
/// other half is for what selects them.
inline constexpr double flush_share_max = 0.5;

/// Ticks whose messages go out together at most, for that reason or because the network thread lags. They
/// wait for two ticks' time at most if no more ticks come.
inline constexpr uint32_t ticks_per_flush_max = 4;
inline constexpr double flush_wait_ticks_max = 2.0;

/// Threads that encode and send, the network thread included; more would wait for each other.
inline constexpr size_t workers_max = 64;

/// Sessions that a thread serves before it takes the next: about 0.2 ms of work, several times what it costs
/// to wake a thread.
inline constexpr size_t sessions_per_part = 32;

/// Ticks published that the network thread has not taken yet; above: the simulation waits for it, and the
/// wait is counted.
inline constexpr size_t deltas_in_flight_max = 128;

}  // namespace scree::limits
