// Bounds of what a server remembers of its world's edits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Megabytes of the file of a history, unless the operator says another number. Above: the oldest is
/// forgotten.
inline constexpr uint32_t history_mb = 512;
inline constexpr uint32_t history_mb_max = 65536;

/// Edits of one brick by one person within so many seconds are remembered as one: an undo takes back all of
/// them, or none.
inline constexpr double history_run_s = 60.0;

/// Ticks with edits that wait for the file. Above: they are not remembered, and what they changed is not
/// taken back.
inline constexpr size_t history_ticks_waiting_max = 4096;

/// Time between two commits, and the longest that a save of the world waits for one, seconds.
inline constexpr double history_commit_s = 1.0;
inline constexpr double history_patience_s = 2.0;

/// Bricks whose last edit is kept in memory.
inline constexpr size_t history_bricks_known_max = 65536;

/// Pieces whose maker is remembered. Above: the oldest are nobody's.
inline constexpr size_t history_pieces_max = 65536;

/// Edits of each party by which the maker of what follows from them is found.
inline constexpr size_t history_recent_edits = 64;

/// Bricks that one undo takes back. Above: refused; a box or a shorter time takes back a part.
inline constexpr size_t undo_bricks_max = 1'000'000;

/// Requests of an undo that are made ahead, and that wait in the simulation at once.
inline constexpr size_t undo_requests_ready = 64;
inline constexpr size_t undo_requests_waiting = 8;

/// How often an undo is planned, since bricks change while it goes on.
inline constexpr unsigned undo_plans_max = 4;

/// Marks of a preview on a person's screen, and how long they stay, seconds.
inline constexpr size_t undo_marks_max = 12;
inline constexpr double undo_marks_s = 30.0;

/// Edits that one answer lists, the newest first.
inline constexpr size_t history_lines_max = 200;

}  // namespace scree::limits
