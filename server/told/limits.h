// Limits of what is told over a bus, each with its unit, its reason and its effect.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks that wait for the teller's thread: 10 s at 60 Hz, which is longer than a call of the bus may take.
/// Above: all that wait are given up, and the world is told anew by a keyframe.
inline constexpr size_t told_waiting_max = 600;

/// Between two keyframes of a world that changes, s: who begins reads at most the ticks of that time.
inline constexpr double told_keyframe_s = 10.0;
/// The same of a world in which nothing changes.
inline constexpr double told_still_keyframe_s = 60.0;
/// A keyframe may take this share of the teller's thread; where it takes more, there are fewer of them.
inline constexpr double told_keyframe_share = 0.1;
/// The share of the stream's bytes that ticks may take between two keyframes: then the last keyframe and all
/// behind it are never dropped.
inline constexpr double told_tail_share = 0.25;
/// The share of the stream's bytes that a keyframe may take; above: it is not told, which is a fault.
inline constexpr double told_keyframe_bytes_share = 0.4;

/// Parts of a keyframe that are sent before waiting ticks are looked for again.
inline constexpr int told_parts_at_once = 4;

/// Between attempts to make the stream, or to begin anew, s.
inline constexpr double told_retry_s = 0.5;

/// How long a reader waits for a message before it looks at the connection, s.
inline constexpr double told_wait_s = 0.1;
/// Without a message, s: the stream is looked at.
inline constexpr double told_silent_s = 1.0;
/// Messages that wait in an edge for its reading thread. Above: later ones are lost, and read from the
/// stream.
inline constexpr size_t told_messages_max = 4096;
/// Ticks that wait in an edge for its clients. Above: the reading thread waits.
inline constexpr size_t told_ready_max = 600;
/// Bytes of ticks that come between the parts of a keyframe, in an edge that reads it; above: it waits for
/// another keyframe.
inline constexpr size_t told_between_bytes_max = size_t{128} << 20U;

/// Without a tick, s: an edge goes on with the last state, in ticks of its own, and after the second figure
/// it says that the world is away.
inline constexpr double edge_still_s = 0.25;
inline constexpr double edge_away_s = 2.0;
/// How long an edge waits for its world when it begins, s, before its program says so and tries again.
inline constexpr double edge_begins_s = 5.0;

/// Pipes of persons of one edge at once, and of all edges; above: the newest are refused.
inline constexpr size_t pipes_of_an_edge_max = 2048;
inline constexpr size_t pipes_max = 8192;
/// Edges of which the simulating server knows at once; above: a new one is not heard.
inline constexpr size_t edges_max = 256;
/// Pipes that an edge may open a second, and at once.
inline constexpr double pipes_per_second_max = 50.0;
inline constexpr double pipes_burst_max = 500.0;
/// Messages of one edge a second, and at once; above: they are lost, and their pipes end.
inline constexpr double edge_messages_per_second_max = 20000.0;
inline constexpr double edge_messages_burst_max = 40000.0;
/// Messages of edges that wait for the network thread; above: likewise.
inline constexpr int edge_messages_waiting_max = 8192;
/// Bytes of a pipe that wait to be read; above: it ends.
inline constexpr size_t pipe_unread_bytes_max = size_t{1} << 20U;
/// Between two signs of life of an edge, and the silence after which its pipes end, s.
inline constexpr double edge_alive_s = 1.0;
inline constexpr double edge_silent_s = 5.0;

/// Requests of one person that wait for answers, in an edge; above: refused.
inline constexpr size_t edge_requests_waiting_max = 256;
/// Seconds without an answer after which a request counts as lost.
inline constexpr double edge_answer_s = 15.0;

/// How long an edge hands on nothing for a person whom the simulating server has just refused, s: he cannot
/// take the others' share of what the edge may open.
inline constexpr double edge_shut_s = 3.0;

}  // namespace scree::limits
