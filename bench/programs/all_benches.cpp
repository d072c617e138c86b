#include <algorithm>
#include <iterator>

#include "bench/support/benches.h"

namespace scree {

namespace {

std::vector<Bench> benches_to_k() {
  return {
      {"blows",
       "a roof, a pillar, ten towers in a row, a wall and a plate, struck at several speeds: what breaks",
       run_blows_bench},
      {"buried", "scenes that enclose pieces in rock: none may travel through it, or be left",
       run_buried_bench},
      {"capacity", "bots that carve once a second: how many until carves are refused or ticks late",
       run_capacity_bench},
      {"carve", "a 2 m carve into 64 pieces: each stage of the server's tick", run_carve_bench, {}, true},
      {"colliders", "terrain colliders field, mesh and rays: depth, falls, time of a tick and of a carve",
       run_colliders_bench},
      {"crowd",
       "a bot that carves twice a second beside bots that ask for all they can, and beside attacks",
       run_crowd_bench,
       {"carves", "fills", "ground", "interest", "talk", "churn"}},
      {"cutters", "a 2 m carve into 64 pieces by every cutter, with bodies by every simplifier",
       run_cutters_bench},
      {"draw",
       "every drawing method at every resolution: time of a frame, time until an edit is shown, memory",
       run_draw_bench,
       {},
       true},
      {"edges",
       "what sharp edges and settled stones cost: remeshing, rays, a flight by each quality, beside the same "
       "without",
       run_edges_bench,
       {"remesh", "rays", "flight"}},
      {"fanout", "a storm seen by 100 to 3,000 viewers on this machine's cores: the age of their frames",
       run_fanout_bench},
      {"bodies", "crates, capsules and hulls beside broken rock: ticks, the same hashes, bits on the wire",
       run_bodies_bench},
      {"fights", "four fights far apart on one, two and four threads: throughput, the same hashes",
       run_fights_bench},
      {"figures", "a storm of 1,000 pieces: what a server's figures cost a tick, and their page",
       run_figures_bench},
      {"heaps", "stones of three materials that fall into heaps and merge: pores, swell, angle at rest",
       run_heaps_bench},
      {"islands", "the search for loose rock: towers and arches, in 64 m and 1,024 m of edited terrain",
       run_islands_bench},
      {"join", "joining a world with 10,000 carves, and coming back with a cache: bytes and seconds",
       run_join_bench},
      {"latency",
       "100 viewers that carve: time from request to picture, by stages; frames until the prediction",
       run_latency_bench},
      {"ledger", "mass over many carves and merges: the ledger against the field measured afresh",
       run_ledger_bench},
  };
}

std::vector<Bench> benches_from_l() {
  return {
      {"library", "libscree_client beside the C++ that it stands for: messages of a storm, meshes, poses",
       run_library_bench},
      {"link", "a session by links of 0 to 200 ms and 10 Mbit/s to 100 kbit/s, and cut ones: age, hashes",
       run_link_bench},
      {"loose", "40 blasts in each of 35 scenes: dust at every tick, and loose rock at the end",
       run_loose_bench},
      {"memory", "edits all over 4 km under a limit of memory", run_memory_bench},
      {"mesh", "surface nets of a changed block, beside OpenVDB's volumeToMesh; from a change to its picture",
       run_mesh_bench},
      {"model",
       "the model of work against the clock, by scene and stage, and a fit of its prices",
       run_model_bench,
       {"slab_at_1_m", "slab_at_5_m", "crowd", "crowd_of_small", "heap", "hundred_carves", "carves_2_m",
        "carves_4_m", "carves_8_m", "large_pieces", "slice", "conform", "large_slice", "large_conform"}},
      {"persons", "64 persons who walk on rubble that moves, beside the same world without them",
       run_persons_bench},
      {"prices",
       "bytes out and processor time for each byte in, by kinds of message, of 60 sessions of one address",
       run_prices_bench,
       {"hello", "health", "interest", "carve", "fill", "paint", "repair", "ack", "admin", "cursor", "watch",
        "say", "ground", "tiles", "offer", "unknown", "http_file", "http_no_file"}},
      {"quality", "a frame by each preset of quality, standing and carving", run_quality_bench},
      {"query",
       "questions about space, of each kind: time and steps; 100,000 rays against every polygon of the mesh",
       run_query_bench},
      {"rates", "blows at 10 to 240 ticks a second: time to rest, height, speed", run_rates_bench},
      {"raymarch",
       "a frame after 0 to 10,000 carves: the atlas of bricks, the paper's list of carves",
       run_raymarch_bench,
       {},
       true},
      {"recombine", "merging by stamp, slices and sphere, against OpenVDB's meshToVolume and csgUnion",
       run_recombine_bench},
      {"regions", "the same blows with 256 regions far away, in each other, and counting", run_regions_bench},
      {"undo", "what remembering edits costs, and taking them back", run_undo_bench},
      {"rules", "a storm of 1,000 pieces with a handler of a script for each event; a reload",
       run_rules_bench},
      {"replay",
       "recording: ticks with and without, bytes, keyframes of a large world; seeking and verifying a "
       "session of "
       "--minutes",
       run_replay_bench},
      {"seams", "50 carves of a ball merged back in place: the error of the surface", run_seams_bench},
      {"sizes",
       "sizes of fragments by seed pattern: Rosin and Rammler's n, fines, the gradient, at once and in "
       "stages",
       run_sizes_bench},
      {"storage",
       "a kept world: ticks with saving and without, bytes of a carve, a start after so many carves",
       run_storage_bench,
       {"ticks", "crowd", "start", "million", "roam"}},
      {"storm",
       "1,000 pieces alive at once, and one blast of 64, with recombination and without",
       run_storm_bench,
       {},
       true},
      {"beams", "beams, plates and arches of many heights against theory, and the search's time",
       run_beams_bench},
      {"support", "beams of three heights and materials against the formula, and the search's time",
       run_support_bench},
      {"transforms", "900 boxes pushed about, and a blast of 1,000 pieces: bits of a pose, four ways",
       run_transforms_bench},
      {"voxels", "a carve of 2 m in voxels of 0.25, 0.15 and 0.1 m: time, memory and bytes of an edit",
       run_voxels_bench},
      {"wire", "bytes on the wire of a 2 m carve into 64 pieces, and of each merge", run_wire_bench},
      {"worst", "the most expensive ticks: modelled time against measured time", run_worst_bench},
  };
}

}  // namespace

const std::vector<Bench>& all_benches() {
  static const std::vector<Bench> benches = [] {
    std::vector<Bench> all = benches_to_k();
    std::ranges::move(benches_from_l(), std::back_inserter(all));
    return all;
  }();
  return benches;
}

}  // namespace scree
