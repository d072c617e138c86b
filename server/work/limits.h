// Bounds and constants of the tick's budget and of clients' shares. Each says its unit and its reason.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/operation/limits.h"

namespace scree::limits {

/// Percent of a tick's length that its work may take by the model, at most and at least: the rest is for work
/// outside the model, and for other threads. Above: requests wait, pieces merge sooner, fewer break. At
/// least: what bodies at rest and their merges need.
inline constexpr uint32_t work_percent_max = 65;
inline constexpr uint32_t work_percent_min = 15;

/// Share of that budget above which the bodies alone count as a crowd: half of the rest time is enough.
inline constexpr float crowded_share = 0.5F;

/// The model (with shared/operation/limits.h), microseconds as measured: a body that is awake, a point of its
/// surface that is compared with the ground, a point of contact, and a pair of bodies whose bounds meet, in a
/// step. Fitted by `bench run model` to ticks of 4 ms and more, in crowds, heaps and large carves.
inline constexpr float body_cost_us = 1.0F;
inline constexpr float ground_point_cost_us = 0.02F;
inline constexpr float contact_cost_us = 1.7F;
inline constexpr float pair_cost_us = 0.45F;

/// A joint of a body that is awake, in a step: up to eight rows, and factors with those of its neighbours.
inline constexpr float joint_cost_us = 8.0F;

/// A piece that is alive, moving or not, in a tick: its rest, its place in what is published, the look
/// whether it is buried. It is no part of the load by bodies: frozen pieces are no crowd.
inline constexpr float piece_cost_us = 1.0F;

/// A pair of hulls that overlap, whose depth is sought: as they do where rubble swells under a heap.
inline constexpr float overlap_cost_us = 13.0F;

/// A piece near terrain that gained rock: the look whether it is buried. And one that is, and waits frozen.
inline constexpr float buried_look_cost_us = 2.5F;
inline constexpr float buried_wait_cost_us = 12.0F;

/// Relaxing the seeds of the pattern `even`: at least, and a seed (server/fracture/even_seeds.h).
inline constexpr float relax_cost_us = 2200.0F;
inline constexpr float relax_seed_cost_us = 70.0F;

/// A dent, and the crushing of a neck, whose sizes vary little.
inline constexpr float dent_cost_us = 700.0F;

/// A speck that becomes dust: it is lifted like an island, but has no hull and no body.
inline constexpr float speck_cost_us = 200.0F;

/// A brick of a search for islands; a part of the terrain in a search for support
/// (shared/falling/support_search.h).
inline constexpr float island_brick_cost_us = 1.0F;
/// A chunk that such a search, or a look at a slope, may have to generate: it goes to where no client has
/// looked.
inline constexpr float ground_chunk_cost_us = 300.0F;
inline constexpr float support_part_cost_us = 0.7F;
/// A part of the terrain in a search for what a blow breaks, and what such a search must find room for.
inline constexpr float blow_part_cost_us = 1.0F;
inline constexpr float blow_cost_us = 6000.0F;
/// A brick and a joint of a search for spans, and a product of blocks in its solutions
/// (shared/falling/spans.h).
inline constexpr float span_brick_cost_us = 1.3F;
inline constexpr float span_joint_cost_us = 36.0F;
inline constexpr float span_product_cost_us = 0.3F;

/// A place whose rubble may lie too steep: whether there is any, and how steep it is; and what a tick must
/// have left for a place.
inline constexpr float slide_glance_cost_us = 5.0F;
inline constexpr float slide_look_cost_us = 45.0F;
inline constexpr float slide_least_us = 1300.0F;

/// Share of the budget that slides leave to falls and support, which come after them.
inline constexpr float slide_reserve_share = 0.25F;

/// Where the tick's budget never has that, a place is looked at every so many seconds.
inline constexpr float slide_rest_s = 0.2F;

/// A prop that is added or put elsewhere, and each of its parts; of a hull each of its corners, and their
/// cube, for its faces are found by trying planes through three of them. One that is pushed or taken away,
/// and a joint that is added, changed or taken away. And the voxels of a piece that a request breaks, as a
/// rule.
inline constexpr float prop_cost_us = 60.0F;
inline constexpr float prop_part_cost_us = 40.0F;
inline constexpr float prop_corner_cost_us = 3.0F;
inline constexpr float prop_plane_cost_us = 0.001F;
inline constexpr float prop_touch_cost_us = 5.0F;
inline constexpr float broken_voxels = 4096.0F;
/// A piece that a request brings, and a voxel of its box: read, redistanced, and with hull and body.
inline constexpr float added_cost_us = 400.0F;
inline constexpr float added_voxel_cost_us = 0.2F;
/// A voxel that is looked at for what a blast breaks.
inline constexpr float blast_voxel_cost_us = 0.01F;

/// Price of the most pieces that a volume is cut into at once. Above: it is cut into fewer, which are cut on
/// in later ticks.
inline constexpr float first_fracture_us = 4000.0F;

/// Waiting pieces are cut while the tick's budget has room; where it never has, one every so many seconds.
inline constexpr float refracture_rest_s = 0.1F;

/// By how much longer it is at most, because bodies leave no room.
inline constexpr float refracture_overload_max = 5.0F;

/// Islands fall while the tick's budget has room and bodies are no crowd; where that never is so, one every
/// so many seconds.
inline constexpr float island_rest_s = 0.2F;

/// Sooner where the budget has room to spare, but never enough for the next: as soon as this part of that
/// room has paid for it. A whole would leave late ticks nothing to catch up by.
inline constexpr float spare_share = 0.5F;

/// Pieces that a volume is cut into at once, however large it is.
inline constexpr uint32_t first_fracture_pieces_min = 8;

/// Price of a carve's voxels and of its first cut, by `field`, above which it takes its volume out whole:
/// that is cut from the next tick on. A longer tick's budget, where that is more.
inline constexpr float carve_at_once_us = 12000.0F;

/// Price of a volume, cut by a cutter of polygons into two, above which `field` makes the first cut: in a
/// carve or a break, and in the cuts of later ticks, which are many.
inline constexpr float polygons_at_once_us = 12000.0F;
inline constexpr float polygons_later_us = 5200.0F;

/// Load by bodies, as a share of the budget, above which requests wait until they fit; one every
/// `request_rest_s` does not.
inline constexpr float load_max = 0.5F;
inline constexpr float request_rest_s = 0.5F;

/// Share of the budget that merges of pieces at rest may keep from requests: they take load away for good.
inline constexpr float relief_share = 0.5F;

/// Share of the budget up to which clients may fill it with bodies when there are several of them.
inline constexpr float bodies_share = 0.6F;

/// Share of the budget that clients' requests are promised: the rest is for bodies and merges.
inline constexpr float requests_share = 0.5F;

/// A request that is refused costs so much, microseconds.
inline constexpr float refusal_cost_us = 10.0F;

/// Debt of a request that cost more than its tick had left, in budgets of a tick. Above: forgiven.
inline constexpr float debt_budgets_max = 16.0F;

/// Share of a tick's budget that pays back debt at least, however many bodies there are.
inline constexpr float payback_share = 0.1F;

/// Memory, bytes: the program with its libraries and threads; chunks that wait to be written, or were read
/// and wait to be taken (server/store/limits.h), what SQLite and the network keep of chunks
/// (server/publish/limits.h); pieces and clients.
inline constexpr double fixed_memory_bytes = (40.0 + 10.0 + 9.0 + 4.0 + 16.0 + 11.0) * 1024.0 * 1024.0;

/// An edited brick: OpenVDB's leaf and its codes take 640, the published state's brick and its place among
/// the chunk's 656, as malloc rounds them. A region of OpenVDB's tree, 16 bricks wide, that holds some.
inline constexpr double brick_memory_bytes = 1296.0;
inline constexpr double region_memory_bytes = 36.0 * 1024.0;
inline constexpr int region_bits = 4;

/// Generated chunks take so much more than their bytes in the heap.
inline constexpr double generated_heap_factor = 1.1;

/// What is left in memory of an edited chunk that is out, in the field and in the published state, bytes.
inline constexpr double chunk_out_bytes = 512.0;

/// Share of all memory that generated chunks may take; the share that requests leave to merges of pieces,
/// which never wait; and the share that is free after chunks went out.
inline constexpr double generated_memory_share = 0.125;
inline constexpr double merge_memory_share = 0.0625;
inline constexpr double page_out_share = 0.125;

/// Requests of all clients that wait for a tick with room for them. A client may have as many waiting as
/// there are places left, so that one more client always finds one. Above: refused.
inline constexpr size_t requests_waiting_max = 1024;

/// Estimated work of one client that may wait, as seconds of its share of the server; one request may always
/// wait. Above: refused.
inline constexpr float waiting_work_max_s = 1.0F;

/// How long a carve waits for room for its pieces when other clients hold more than their share, seconds.
/// Above: refused.
inline constexpr float room_wait_max_s = 0.75F;
/// The same, where it then gets the least: others' large pieces may leave no room for long.
inline constexpr float room_wait_least_s = 0.25F;

/// When several clients have pieces: a carve gets at most one of so many pieces that its client may still
/// make, so that there is something left for its next carves.
inline constexpr uint32_t room_parts = 4;

/// Such a carve gets fewer pieces than it asked for, down to one of so many. Below: it waits or is refused.
inline constexpr uint32_t seeds_cut_max = 32;

}  // namespace scree::limits
