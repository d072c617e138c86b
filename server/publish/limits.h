// Bounds of what clients are sent. Each says its unit, its reason, and its effect at the
// limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Seconds between two messages of all regions to one client, some 64 KiB at most: a game may change them in
/// every tick. Sooner: the client gets the latest when they have passed.
inline constexpr double regions_wait_s = 0.25;

/// Seconds between two lists of signs for a client: a countdown's seconds are counted by the client.
inline constexpr double signs_wait_s = 0.1;

/// Chunks and pieces that a client follows are dropped at this multiple of its radius of interest, so that a
/// viewer that moves to and fro across the edge does not get them again and again.
inline constexpr float interest_keep_factor = 1.25F;

/// Bytes of chunks sent to one client in a tick: about 1 MB/s at 60 Hz. Above: the rest waits for the next
/// ticks, nearest first.
inline constexpr int64_t chunk_bytes_per_tick = 16 * 1024;

/// Bytes of pieces' volumes sent to one client in a tick. Above: the rest waits, nearest first.
inline constexpr int64_t piece_bytes_per_tick = 8 * 1024;

/// Bytes of stones, where pieces merged, sent to one client in a tick: for the eye alone, so less than of
/// pieces. Above: the rest waits, nearest first.
inline constexpr int64_t stone_bytes_per_tick = 4 * 1024;

/// Bricks sent as patches to one client in one frame: 512 KiB of codes, so that a frame stays within
/// message_bytes_max even when nothing compresses. Above: whole chunks are streamed instead.
inline constexpr size_t patch_bricks_max = 1024;

/// Bytes that a brick takes in a frame or in a part of a chunk, about: rubble compresses to half of its
/// codes. By these a slow link's room for bricks is reckoned.
inline constexpr size_t patch_brick_bytes = 256;

/// Bricks sent as patches to a client without kernels, in a tick on average; what is saved up, up to
/// patch_bricks_max, may go at once. 32 KiB of codes compress to less than chunk_bytes_per_tick. Above: whole
/// chunks are streamed instead, within their budget, so that a chunk that changes in every tick is sent as
/// often as there is room.
inline constexpr size_t patch_bricks_per_tick = 64;

/// Bytes of ground sent to one client in a tick. Above: the rest waits.
inline constexpr int64_t ground_bytes_per_tick = 16 * 1024;

/// Bytes of an elevation model's tiles sent to one client in a tick, 2 MB/s at 60 Hz: the horizon stands
/// within a second. One tile may go beyond, and is made up for. Above: the rest waits.
inline constexpr int64_t tile_bytes_per_tick = 32 * 1024;

/// Bytes of the bodies' state (PhysicsMessage) sent to one client in a tick on average: 240 KB/s at 60 Hz.
/// Above: it gets the next message later, with the state as it is then.
inline constexpr int64_t physics_bytes_per_tick = 4 * 1024;

/// Bytes of tiles sent to all clients together in a tick, 30 MB/s at 60 Hz: each is read from the ground's
/// file. One tile may go beyond. Above: the rest waits, each party in turn.
inline constexpr int64_t tile_bytes_per_tick_all = 512 * 1024;

/// Bytes of palettes and images sent to one client in a tick, 2 MB/s at 60 Hz, and to all clients together,
/// 15 MB/s: 64 MiB of images take half a minute. One part may go beyond, and is made up for. Above: the rest
/// waits, each party in turn.
inline constexpr int64_t content_bytes_per_tick = 32 * 1024;
inline constexpr int64_t content_bytes_per_tick_all = 256 * 1024;

/// Palettes of before that are known as such, so that they need not wait. Above: all are forgotten, and who
/// asks for one later is answered that it is not there.
inline constexpr size_t former_palettes_max = 1024;

/// Bytes of a part by the slowest link. Less would be mostly its digest.
inline constexpr size_t content_part_bytes_min = 512;

/// Ground that the network thread generates in a tick for all clients together, at least: a chunk with a
/// surface counts 8 and takes 1 to 2 ms with its encoding, another one counts 1 and takes 0.2 ms. The last
/// one may go beyond. Above: the rest waits, each party in turn. An idle network thread generates more
/// (server/net/ground_pace.h), up to ground_work_max.
inline constexpr int ground_work_min = 8;
inline constexpr int ground_work_max = 64;

/// Work for questions about space that the network thread does in a tick for all clients together, in steps
/// of 0.2 µs (QueryCost): 2 ms. A chunk that is generated counts as so many, about 0.8 ms. The last step of a
/// question may go beyond, by 10 ms at most. Above: the rest waits, each party in turn.
inline constexpr uint64_t query_steps_per_tick = 10'000;
inline constexpr uint64_t query_chunk_steps = 4'000;

/// Where ground is not generated yet, casts are tried so much farther at a time, metres, and other questions
/// generate so many chunks at a time: so ground comes bit by bit, and none behind what is hit.
inline constexpr float query_probe_m = 32.0F;
inline constexpr size_t query_chunks_at_once = 4;

/// Seconds back that questions may ask for, and for which poses and changed bricks are kept, as questions may
/// wait. Older: refused.
inline constexpr double query_past_s = 0.75;
inline constexpr double query_past_kept_s = 1.0;

/// Seconds that a question waits for chunks that are out of memory. Then: refused, to be asked again.
inline constexpr double query_wait_s = 1.0;

/// Times that a message's questions are answered anew, because so much ground was generated for the first
/// ones that their tick is not kept any more. Then: those that are left are refused, to be asked again.
inline constexpr int query_anew_max = 3;

/// Questions of a session that wait. Above: the message is refused.
inline constexpr size_t queries_waiting_max = 512;

/// Bytes of answers sent to one client in a tick on average. Above: the rest waits.
inline constexpr int64_t query_bytes_per_tick = 16 * 1024;

/// Chunks in a tick that the field of questions takes up from the state: 4 ms at most, when the first
/// question comes. Above: questions wait.
inline constexpr size_t query_chunks_followed = 2048;

/// Seconds after the last question for which that field is kept.
inline constexpr double query_idle_s = 30.0;

/// Bytes for which ground's work counts in the parties' turns, beside those that are sent.
inline constexpr uint64_t ground_work_bytes = 16 * 1024;

/// Edited chunks that are looked at in a tick for interests that moved, for all clients together: about 2 ms.
/// The last interest may go beyond. Above: the rest waits, each party in turn.
inline constexpr uint64_t scanned_chunks_per_tick = 64 * 1024;

/// Bytes of encoded ground kept to be sent to several clients. Above: all of it is forgotten, and generated
/// again on demand.
inline constexpr size_t ground_cache_bytes_max = 8 * 1024 * 1024;

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

/// Bytes of room where no budget holds: more than anybody is sent in a tick, and far from an overflow.
inline constexpr int64_t bytes_free = int64_t{1} << 48;

/// Bytes waiting for one client above which it gets no frames: when it has read all, it is reset.
inline constexpr size_t outbox_resync_bytes = 2 * 1024 * 1024;

/// Chunks out of memory that are read for one client before those are sent: what its budget sends in a few
/// ticks. Above: they are asked for when these are sent.
inline constexpr size_t chunks_read_ahead = 16;

/// Chunks that were read and are taken in a tick, for all clients together: about 1 ms. Above: they wait.
inline constexpr size_t chunks_taken_per_tick = 32;

/// When more bricks are in memory than there should be, one of so many goes out, so that looking for chunks
/// that nobody needs is rare.
inline constexpr size_t page_out_parts = 8;

/// Bytes of encoded chunks kept from one tick to the next, to be sent to several clients: some 800 chunks.
/// Above: all are forgotten, and encoded again on demand.
inline constexpr size_t encoded_chunk_bytes_max = 8 * 1024 * 1024;

/// Seconds for which no chunks are sent to a client that has announced an offer; then it is as one without.
inline constexpr double offer_wait_s = 1.0;

/// Seconds after which an offer is forgotten, if not all that was wanted has come before.
inline constexpr double offer_seconds_max = 60.0;

/// Sessions that a thread serves before it takes the next: about 0.2 ms of work, several times what it costs
/// to wake a thread.
inline constexpr size_t sessions_per_part = 32;

}  // namespace scree::limits
