// Bounds of the programs. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Bytes and lines of a file of options (--config): each entry is parsed by itself where the file is refused,
/// a third of a millisecond each. Above: refused.
inline constexpr size_t config_bytes_max = size_t{256} << 10U;
inline constexpr size_t config_lines_max = 4096;

/// Values that a file of options sets; there are some hundred options. Above: refused, for to find the
/// mistake among so many would take seconds.
inline constexpr size_t config_values_max = 512;

/// Ticks that a late simulation catches up with. Above: the ticks are lost, and counted as overruns.
inline constexpr int catch_up_ticks_max = 5;

/// Radius around each client's eye within which terrain is generated before anything touches it, chunks: 32 m
/// at voxels of 0.25 m, the reach of a viewer's tools. Beyond: edits wait for it.
inline constexpr int ahead_chunks = 4;

/// Chunks that a tick tests for being generated: a few microseconds.
inline constexpr size_t ahead_chunks_per_tick = 64;

/// Chunks that edits wait for at once, to be generated: some two seconds' work. Above: more are asked for
/// when these have come.
inline constexpr size_t ahead_asked_max = 1024;

/// Seconds that an edit waits for its terrain to be generated. Above: its tick generates what is lacking.
inline constexpr double generated_wait_s = 0.25;

/// Chunks that a tick tests for being out of memory, around eyes: some 10 us. The radius is ahead_chunks.
inline constexpr size_t pager_chunks_per_tick = 128;

/// A piece is looked at every so many ticks, where it is and where it will be so many ticks later: reading a
/// chunk takes less.
inline constexpr unsigned piece_forecast_ticks = 8;
inline constexpr unsigned piece_ahead_ticks = 30;

/// Places of pieces that are gone are forgotten when there are more than so many.
inline constexpr size_t pieces_forgotten_min = 1024;

/// Ticks for which nobody asked for a chunk that goes out of memory.
inline constexpr uint64_t pager_idle_ticks = 60;

/// When more bricks are in memory than there should be, at most so many chunks go out in a tick, and at most
/// so many that were read come in: a fraction of a millisecond each.
inline constexpr size_t page_out_per_tick = 16;
inline constexpr size_t page_in_per_tick = 16;

/// Ticks between two looks for chunks that nobody needs, at least, and between two counts of the regions of
/// OpenVDB's tree: each looks at all chunks in memory.
inline constexpr uint64_t idle_scan_ticks = 8;
inline constexpr unsigned pager_count_ticks = 64;

/// Share of memory-max that the process should leave free in RAM. Above: malloc gives back what it holds for
/// nothing, and where that does not do, terrain goes out until it does.
inline constexpr double resident_margin_share = 0.0625;

/// Share of memory-max by which terrain gives way at most to what the model does not know of. Above: the
/// limit does not hold, but some terrain stays in memory.
inline constexpr double beyond_share_max = 0.25;

/// Part of what is free by which terrain may grow again after it gave way, at each count.
inline constexpr double beyond_relief = 1.0 / 16.0;

/// Arenas of malloc; and bytes of a block that it takes from the system and gives back by itself, more than a
/// carve's windows take.
inline constexpr int heap_arenas = 4;
inline constexpr int heap_block_bytes = 4 * 1024 * 1024;

/// Seconds of ticks between two looks of the governor; in so many looks, ticks must be lost so many times
/// before the simulation may take only so many percent of what it took. Once may be anything.
inline constexpr double governor_interval_s = 0.5;
inline constexpr size_t governor_intervals = 8;
inline constexpr uint32_t governor_losses_min = 2;
inline constexpr uint32_t governor_lower_percent = 80;

/// Looks in a row without a lost tick, and with no greater share of late ones, after which it may take so
/// much more of a tick's length, percent.
inline constexpr uint32_t governor_calm_intervals = 4;
inline constexpr double governor_late_share = 0.2;
inline constexpr uint32_t governor_raise_percent = 5;

/// Seconds without the end of a tick after which the simulation counts as standing still: the server is not
/// healthy then, and the log says so, again and again after so many more. The longest ticks that were
/// measured take a second.
inline constexpr double still_seconds_max = 5.0;
inline constexpr double still_line_seconds = 60.0;

/// Seconds between two pulses of a server that lives (LiveConfig::pulse). A service manager's watchdog waits
/// for many of them.
inline constexpr double pulse_seconds = 1.0;

/// Seconds for which saves that are due may wait for the one that is being written. Above: the server is not
/// healthy; a disk that hangs gives no error.
inline constexpr double save_delay_seconds_max = 10.0;

/// Bounds of --backup-every, seconds, and of --backup-keep. More often than that a backup would follow the
/// other without a pause.
inline constexpr double backup_every_min_s = 1.0, backup_every_max_s = 366.0 * 86400.0;
inline constexpr uint32_t backup_keep_max = 10'000;

/// After each part of a backup the others have the disk for so many times as long as the part took, within
/// these seconds: a large world takes 5 MB/s at least.
inline constexpr double backup_pause_parts = 4.0;
inline constexpr double backup_pause_min_s = 0.002, backup_pause_max_s = 0.2;

/// Seconds until a backup that failed is tried again, or less where they come more often.
inline constexpr double backup_retry_s = 60.0;

/// Niceness of the thread that makes backups: ticks come first.
inline constexpr int backup_niceness = 10;

/// Bytes of the file of what administrators did. Above: it is renamed, and another one begins.
inline constexpr size_t audit_bytes_max = 4 * 1024 * 1024;

/// Bytes of its newest lines that administrators may read. Above: the oldest go, from memory alone.
inline constexpr size_t audit_kept_bytes = 65'536;

/// Seconds between two samples of a server's figures, and how many are kept: an hour.
inline constexpr double figure_sample_s = 10.0;
inline constexpr size_t figure_samples_max = 360;

/// Milliseconds between two looks at what the process has in RAM.
inline constexpr int resident_sample_ms = 500;

/// Seconds that an edit waits for its terrain to be read, or for room in memory. Above: it is refused.
inline constexpr double held_seconds_max = 5.0;

/// Terrain around an edit's box that must be in memory, too, voxels: what hangs loose is searched there.
inline constexpr int admitted_margin_voxels = 16;

}  // namespace scree::limits
