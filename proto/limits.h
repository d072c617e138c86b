// Bounds of a message's content. A decoder enforces these and shared/base/limits.h.
// A sender keeps within them; a receiver refuses more, naming the limit, before it allocates memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/base/limits.h"

namespace scree::limits {

/// The longest message of a client, and the longest first one; bytes. Above: the connection ends. (A
/// server's: message_bytes_max.)
inline constexpr size_t client_message_bytes_max = size_t{64} << 10;
inline constexpr size_t hello_bytes_max = 1024;

/// Joints that one message tells of, and as many that are gone: some 130 bytes each. More come in several.
inline constexpr size_t joints_a_message = 256;

/// Bricks in one message: 2 MiB of codes, which compress to about message_bytes_max. When a tick changes more
/// for one client, whole chunks are streamed instead.
inline constexpr size_t bricks_per_message_max = 4096;

/// Operations in one frame. A tick has a few dozen; the rest is margin.
inline constexpr size_t operations_per_frame_max = 4096;

/// Chunks dropped, or pieces removed or moved, in one frame.
inline constexpr size_t entries_per_frame_max = 65536;

/// Chunks in one repair request; more mismatches wait for the next request.
inline constexpr size_t repair_chunks_max = 1024;

/// Chunks in one offer: with 16 bits of hash, and coordinates that are close to each other, these take 7
/// bytes at most, and all of them less than client_message_bytes_max. A client offers the nearest ones.
inline constexpr size_t offer_chunks_max = 8192;

/// Chunks in one Kept message.
inline constexpr size_t kept_chunks_max = 1024;

/// Length of a ticket, bytes: twice what servers give. Above: refused.
inline constexpr size_t ticket_bytes_max = 48;

/// Chunks of ground in one request, and asked for by one client and not answered yet. Above: refused, and the
/// connection ends.
inline constexpr size_t ground_chunks_max = 1024;

/// Bytes of a tile of the ground: 65,536 of an elevation model that nothing compresses, and what is around
/// them; a stored chunk has half of that. Above: refused.
inline constexpr size_t tile_bytes_max = size_t{72} << 10;

/// Bytes of one palette or image (limits::image_bytes_max), and of one part of it. Above: refused.
inline constexpr uint32_t content_bytes_max = uint32_t{4} << 20U;
inline constexpr size_t content_part_bytes_max = size_t{32} << 10;

/// Contents that a client may ask for in one message, and wait for. Above: refused, and the connection ends.
inline constexpr size_t contents_wanted_max = 64;

/// Questions in one message, 4 KiB or so, and ids in one answer: all answers together stay below
/// message_bytes_max. Above: a client's message is refused, and the connection ends; of ids the rest is left
/// out.
inline constexpr size_t questions_max = 64;
inline constexpr size_t query_ids_max = 1024;

/// How deep a layer of the ground may reach, metres. Above: refused.
inline constexpr float layer_depth_max_m = 50.0F;

/// A number of a tile's key on the wire: the highest chunk's y with the level beside it. Above: refused.
inline constexpr int32_t tile_coordinate_max = 1 << 20;

/// Tiles that a client may ask for in one message, and wait for. Above: refused, and the connection ends.
inline constexpr size_t tiles_wanted_max = 256;

/// Tiles that a client says in one message to have kept. Above: refused; others go into the next message.
inline constexpr size_t tiles_held_max = 2048;

/// Length of a client's name, bytes.
inline constexpr size_t client_name_bytes_max = 64;

/// Length of a person's name, bytes; an encoder cuts a longer one.
inline constexpr size_t person_name_bytes_max = 32;

/// Length of the token in a hello, bytes: an access token with the longest names has 262. Above: refused.
inline constexpr size_t access_token_bytes_max = 512;

/// Length of a world's name, bytes: of a server's own, and of the one that a token is for. Above: refused.
inline constexpr size_t world_name_bytes_max = 64;

/// Length of an address as text, and of an administrator's words to who is sent away, bytes. Above: refused.
inline constexpr size_t address_bytes_max = 64;
inline constexpr size_t admin_reason_bytes_max = 256;

/// Minutes of a ban: ten years. Above: refused; 0 minutes are for ever.
inline constexpr uint32_t ban_minutes_max = 5'256'000;

/// Length of the name of an author of edits, bytes. Above: refused.
inline constexpr size_t author_bytes_max = 64;

/// Rows of sessions, or of bans, in one answer to an administrator: under 500 KiB. The rest is left out.
inline constexpr size_t admin_rows_max = 2048;

/// Rows of slow ticks in one answer to an administrator, and bytes of their words such as a stage: some 100
/// KiB. Above: the oldest are left out; a longer word is a fault of the sender.
inline constexpr size_t slow_rows_max = 256;
inline constexpr size_t flight_word_bytes_max = 32;

/// A line for the console of rules, and the text that answers an administrator, bytes. A longer line is
/// refused, a longer text is cut.
inline constexpr size_t console_line_bytes_max = 4096;
inline constexpr size_t admin_text_bytes_max = 65536;

/// Ids of bodies that a list of them may be asked for by. Above: refused, and the connection ends.
inline constexpr size_t bodies_named_max = 64;

/// Pieces in one message of those that are kept, or are no more. More come in several.
inline constexpr size_t kept_pieces_max = 1024;

/// Persons on foot in one message. More are on foot without a word of whose body is which.
inline constexpr size_t person_bodies_max = 4096;

/// Length of a line of chat, bytes: two lines of a screen. Above: refused; a server's own are cut.
inline constexpr size_t line_bytes_max = 200;

/// Persons in one list. Above: the others are counted.
inline constexpr size_t persons_max = 64;

/// Cursors in one message. Above: the others are not shown.
inline constexpr size_t cursors_max = 64;

/// Bodies, corners of one body, contacts and bricks in one Physics message: about 150 KiB at most. The rest
/// is left out.
inline constexpr size_t physics_bodies_max = 1024;
inline constexpr size_t hull_corners_max = 64;
inline constexpr size_t physics_contacts_max = 4096;
inline constexpr size_t physics_bricks_max = 1024;

/// Blows that one message tells of; beyond, the weakest are left out.
inline constexpr size_t contact_events_max = 256;

/// Stages of a tick in a status, and the length of a stage's name in bytes.
inline constexpr size_t stages_max = 32;
inline constexpr size_t stage_name_bytes_max = 32;

/// Work that fits into a tick, microseconds: a tick takes a second at most.
inline constexpr uint32_t tick_budget_max_us = 1'000'000;

/// Voxels of the pieces of a world, all together: 256 MiB of codes, for a volume of air packs into a few
/// bytes. 20,000 pieces of 4,000 voxels take a third. Above: a client gives the connection up, and a
/// recording's keyframe is refused.
inline constexpr size_t piece_voxels_max = size_t{1} << 28;

/// Reasons for refusals that a status counts, and the length of one's name, bytes: more than twice what there
/// are and need. Above: refused.
inline constexpr size_t refusal_counts_max = 128;
inline constexpr size_t refusal_name_bytes_max = 32;

/// Faults of a server's health: more than there are kinds. Above: refused.
inline constexpr size_t health_faults_max = 16;

/// Length of the word by which a status says how the world is saved, bytes. Above: refused.
inline constexpr size_t saving_bytes_max = 32;

/// A stage of a request's way through a server, microseconds: a minute, longer than any request waits. An
/// encoder states no more; a receiver refuses more.
inline constexpr uint32_t latency_max_us = 60'000'000;

/// Length of a refusal or a reply's reason, bytes; an encoder cuts a longer one.
inline constexpr size_t reason_bytes_max = 1024;

/// Voxel coordinates lie within ± this, so that no sum of a coordinate and a window's side overflows an
/// int32.
inline constexpr int32_t voxel_coordinate_max = 1 << 24;

/// Quantised positions lie within ± this, just under 2^20 m: with their sign they fit 31 bits.
inline constexpr int32_t pose_coordinate_max = (1 << 30) - 1;

}  // namespace scree::limits
