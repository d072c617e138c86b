// Bounds of the server's storage. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks between two keyframes of a recording while something changes: 1 s at 60 Hz. Seeking applies at most
/// that many frames that change something.
inline constexpr uint64_t ticks_per_keyframe = 60;

/// The same while nothing changes, 10 s: so many empty frames are read at most.
inline constexpr uint64_t ticks_per_idle_keyframe = 600;

/// Ticks from the state with which a recording begins to its first tick: a day at 60 Hz. More would be
/// simulated for ever, and is refused.
inline constexpr uint64_t unseen_ticks_max = 5'184'000;

/// Edited bricks that a recording keeps in memory for its keyframes: 170 MB, of which a server has most
/// anyway. Above: chunks that did not change for longest are read from the recording when they change again.
inline constexpr size_t recorded_bricks_max = size_t{1} << 18;

/// The same of a world that is simulated from a recording. Above: chunks that the recording has as they are
/// go out, and are read when they are needed.
inline constexpr size_t simulated_bricks_max = size_t{1} << 18;

/// Ticks between two looks whether there are more: as many as between two keyframes, which have what changed.
inline constexpr uint64_t ticks_per_make_room = ticks_per_keyframe;

/// Seconds of frames in one transaction: a crash loses at most that much of a recording.
inline constexpr double seconds_per_commit = 0.5;

/// Ticks that wake the storage thread before its next commit: more than come in seconds_per_commit at 60 Hz.
inline constexpr size_t recorder_wake_ticks = 60;

/// Ticks that wait for the storage thread; above: the simulation waits for it, and the wait is counted.
inline constexpr size_t recorder_queue_max = 600;

/// How long the simulation waits for a disk that takes nothing of a full queue, seconds. Afterwards ticks are
/// given up, and counted, until the disk answers: the game goes on. It is shorter than the time after which a
/// simulation counts as stopped.
inline constexpr double recorder_patience_s = 4.0;

/// Lines of the log of events (--events) that wait for its thread, or are being written; above: they are
/// lost, and counted.
inline constexpr size_t event_lines_max = 4096;

/// Events of sessions, of one tick, that wait for the recorder and the log; above: they are lost.
inline constexpr size_t noted_events_max = 1024;

/// Bytes of one row of a recording; a longer one is refused as damaged.
inline constexpr size_t row_bytes_max = size_t{1} << 29;

/// Chunks that changed since the last save. Above: the next save is due at once, for all of them are in
/// memory three times while it is written: 20 MB.
inline constexpr size_t unsaved_chunks_max = 256;

/// Chunks that the storage thread keeps from one save to the next, so that chunks that change again and again
/// are not read again: at most 10 MiB. Above: they are forgotten after a save.
inline constexpr size_t chunks_between_saves_max = 256;

/// Chunks that wait for the thread that reads them, or to be taken, for the simulation and for clients each:
/// at most 4.5 MiB when all were read. Above: the asking side asks again later.
inline constexpr size_t chunks_asked_max = 128;

/// What SQLite keeps of a file's pages for one connection, KiB: rows are read once, only the upper pages of
/// the tables again and again. A world that is kept has four connections.
inline constexpr int page_cache_kib = 1024;

/// Ticks until a chunk that could not be read is tried again; until then nobody waits for it.
inline constexpr double unreadable_retry_s = 2.0;

/// Seconds from a failed write to the next try, at first and at most; each pause is twice the one before.
/// More would leave a disk that works again unused, less would burden one in trouble.
inline constexpr double retry_pause_min_s = 0.25, retry_pause_max_s = 30.0;
/// The most where another program holds the file: it mostly does for seconds, and a recording waits for
/// recorder_queue_max ticks.
inline constexpr double retry_held_max_s = 1.0;

/// Seconds that the end of a server waits for a disk that fails: less than the 10 s after which `docker stop`
/// kills. Above: what was not written is lost, and the program says so.
inline constexpr double last_tries_s = 6.0;

/// Pauses between the tries of a tick that needs a chunk which cannot be read, seconds. After the last one
/// the server ends.
inline constexpr double needed_chunk_pauses_s[] = {0.05, 0.2, 1.0};

/// Parts of one recording, each a file. Above: it is refused, or does not go on.
inline constexpr uint32_t recording_parts_max = 9999;

/// Pages in SQLite's write-ahead log, a file beside a world's. Above: SQLite merges them into the file.
inline constexpr int wal_pages_max = 4096;

/// Bytes that a copy of a world's file moves before others have a turn: a few milliseconds of a disk. More
/// would make saves wait.
inline constexpr size_t copy_part_bytes = size_t{1} << 20U;

/// Copies of a world's file before the same new format, under names with a number. Above: the world is not
/// saved, and the server says so.
inline constexpr int older_worlds_max = 99;

/// Bytes of a page of a recording: frames of ticks in which little happens share one.
inline constexpr uint64_t recording_page_bytes = 16384;

/// Bytes of a recording's log, likewise; that of a ring of bytes has an eighth of them. Above: SQLite merges
/// it and cuts it to this size, unless somebody reads the recording as of one moment.
inline constexpr uint64_t log_bytes_max = 4096 * recording_page_bytes;

}  // namespace scree::limits
