// Bounds of who comes in, and how often. Each says its unit, its reason, and its effect at the
// limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes of the kernel's send buffer for one client, most of them on their way; newer state cannot replace
/// those in it.
inline constexpr int socket_send_buffer_bytes = 256 * 1024;

/// Bytes in that buffer that are not on their way yet. Above: the socket takes no more, and what waits is
/// held back where newer state can replace it.
inline constexpr int socket_unsent_bytes = 2 * 1024;

/// Seconds within which a client must read some of the bytes that wait for it, and its machine acknowledge
/// those that were sent. Above: it is cut off.
inline constexpr double stall_seconds_max = 20.0;

/// Connections that one address (Door) may hold, unless the operator says otherwise
/// (--connections-per-address); above: turned away.
inline constexpr size_t connections_per_address_max = 64;

/// Connections that one address may open a second, unless the operator says otherwise
/// (--connects-per-second). After a silence it may open so many at once, or as many as it may hold. Above:
/// turned away.
inline constexpr double connects_per_second_max = 10.0;
inline constexpr double connects_burst_max = 64.0;

/// What an operator may say of them. Beyond: refused by name.
inline constexpr double door_connections_most = 65535.0;
inline constexpr double door_connects_least = 0.1;
inline constexpr double door_connects_most = 100000.0;

/// The greatest impulse of a push by a carver, newton seconds: of a car at 50 m/s. Above: for directors.
inline constexpr float carver_push_max_n_s = 1e5F;

/// Addresses (Door) for which the /56 and the /48 around one of IPv6 may stand: a site is given a /56, and a
/// provider's customers may share a /48. All addresses of such a network together may hold and open as many
/// connections as so many addresses. Above: turned away, and first to make room.
inline constexpr size_t addresses_of_a_site = 4;
inline constexpr size_t addresses_of_a_provider = 16;

/// Connections that are held, at once and a second, until their first bytes say in which language they are
/// turned away, and the seconds for which such bytes are waited for. TLS has its handshake first, which costs
/// the network thread as much as many messages do. Above: told in the protocol's, and closed at once.
inline constexpr size_t turned_away_max = 64;
inline constexpr double turned_away_per_second_max = 32.0;
inline constexpr double turned_away_seconds_max = 1.0;

/// HTTP requests from one address, a second and at once: a page is about ten, and a status page asks once a
/// second. Above: 429, and closed.
inline constexpr double http_requests_per_second_max = 50.0;
inline constexpr double http_requests_burst_max = 200.0;

/// Seconds for which a party without sessions keeps its number; longer than any request waits.
inline constexpr double party_memory_s = 10.0;

/// Addresses that are remembered; above, those without a connection are forgotten: that have been quiet for
/// door_memory_s; if that is too little, that need not wait after a wrong token; and then all.
inline constexpr size_t door_addresses_max = 65536;

/// Seconds for which an address without connections is remembered, when others need its place, and after
/// which its wrong guesses at tokens are forgiven.
inline constexpr double door_memory_s = 600.0;

/// Seconds that an address waits after its first wrong token, and at most.
inline constexpr double guess_wait_min_s = 1.0;
inline constexpr double guess_wait_max_s = 60.0;

/// Wrong tokens of one address that are known again; above: the oldest is forgotten, and counts as a guess.
inline constexpr size_t wrong_tokens_known = 4;

/// Connections by the admin socket that are no refused ones: a console and a few scripts. Above: the one that
/// has been idle for longest goes for the next. So many again may be refused and not closed yet; above, the
/// next is closed at once.
inline constexpr size_t owner_connections_max = 8;

/// Milliseconds that a start waits for another server that makes a socket in the same folder. Above: an
/// error.
inline constexpr int socket_folder_wait_ms = 2000;

/// Milliseconds for which no connection is accepted after accepting has failed.
inline constexpr int accept_pause_ms = 100;

/// Seconds after the end of its connection for which a session can go on by its ticket.
inline constexpr double ticket_seconds_max = 60.0;

/// Sessions without a connection that can go on; above: of the address or network that has the most of them,
/// those that were there for the shortest time are forgotten, a sixteenth of all.
inline constexpr size_t departed_max = 4096;

/// Seconds for which a full server keeps the place of a lost connection, and the part of all places that it
/// keeps so; above: somebody else may have it. Holders of tokens may at once.
inline constexpr double place_kept_seconds_max = 15.0;
inline constexpr double places_kept_part = 0.25;

/// Bytes a second to one address, and to all together, unless the operator says otherwise
/// (--bytes-out-per-address, --bytes-out): a household in which eight people join at once, each as fast as it
/// can; and most of a link of 1 Gbit/s. Above: what can wait does (BytesOut).
inline constexpr double bytes_out_per_address = 8.0e6;
inline constexpr double bytes_out_all = 100.0e6;

/// Seconds of its budget that an address saves up, and all together do: four people join an edited world of
/// 8 MB at once without waiting.
inline constexpr double bytes_out_saved_s = 4.0;
inline constexpr double bytes_out_saved_s_all = 1.0;

/// Bytes that one session or connection has room for between two ticks: more than a fast link takes.
inline constexpr int64_t bytes_out_at_once = 512 * 1024;

/// Bytes that one session or connection owes at most, for messages that do not wait. Above: they are for
/// nothing, so that it is not kept waiting for chunks for long.
inline constexpr int64_t bytes_owed_max = 2 * 1024 * 1024;

/// Bytes that stand for no limit.
inline constexpr int64_t bytes_without_limit = int64_t{1} << 48;

/// What an operator may say of them, megabytes a second; beside 0, no limit. Beyond: refused by name.
inline constexpr double bytes_out_most_mb = 100000.0;

/// Bytes from one client, per second and at once; refused and closed.
inline constexpr double client_bytes_per_second_max = 128.0 * 1024.0;
inline constexpr double client_bytes_burst_max = 512.0 * 1024.0;
/// Addresses, names and tokens that are banned; above: an administrator is told so.
inline constexpr size_t bans_max = 2048;
/// The file of bans, with comments, bytes.
inline constexpr size_t bans_bytes_max = size_t{4} << 20;

/// Bits of a network that is banned, at least: a slip of the hand is not to ban half the world. Fewer are
/// refused.
inline constexpr unsigned ban_bits_min_v4 = 8, ban_bits_min_v6 = 16;

}  // namespace scree::limits
