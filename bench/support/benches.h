// The benchmarks, one function each, and the table that names them.
#pragma once

#include "bench/support/bench.h"

namespace scree {

BenchReport run_blows_bench(const BenchOptions& options);
BenchReport run_buried_bench(const BenchOptions& options);
BenchReport run_capacity_bench(const BenchOptions& options);
BenchReport run_carve_bench(const BenchOptions& options);
BenchReport run_colliders_bench(const BenchOptions& options);
BenchReport run_crowd_bench(const BenchOptions& options);
BenchReport run_cutters_bench(const BenchOptions& options);
BenchReport run_draw_bench(const BenchOptions& options);
BenchReport run_edges_bench(const BenchOptions& options);
BenchReport run_fanout_bench(const BenchOptions& options);
BenchReport run_bodies_bench(const BenchOptions& options);
BenchReport run_fights_bench(const BenchOptions& options);
BenchReport run_figures_bench(const BenchOptions& options);
BenchReport run_heaps_bench(const BenchOptions& options);
BenchReport run_islands_bench(const BenchOptions& options);
BenchReport run_join_bench(const BenchOptions& options);
BenchReport run_latency_bench(const BenchOptions& options);
BenchReport run_ledger_bench(const BenchOptions& options);
BenchReport run_library_bench(const BenchOptions& options);
BenchReport run_link_bench(const BenchOptions& options);
BenchReport run_loose_bench(const BenchOptions& options);
BenchReport run_memory_bench(const BenchOptions& options);
BenchReport run_mesh_bench(const BenchOptions& options);
BenchReport run_model_bench(const BenchOptions& options);
BenchReport run_persons_bench(const BenchOptions& options);
BenchReport run_prices_bench(const BenchOptions& options);
BenchReport run_quality_bench(const BenchOptions& options);
BenchReport run_rates_bench(const BenchOptions& options);
BenchReport run_query_bench(const BenchOptions& options);
BenchReport run_raymarch_bench(const BenchOptions& options);
BenchReport run_recombine_bench(const BenchOptions& options);
BenchReport run_regions_bench(const BenchOptions& options);
BenchReport run_rules_bench(const BenchOptions& options);
BenchReport run_undo_bench(const BenchOptions& options);
BenchReport run_replay_bench(const BenchOptions& options);
BenchReport run_seams_bench(const BenchOptions& options);
BenchReport run_sizes_bench(const BenchOptions& options);
BenchReport run_storage_bench(const BenchOptions& options);
BenchReport run_storm_bench(const BenchOptions& options);
BenchReport run_beams_bench(const BenchOptions& options);
BenchReport run_support_bench(const BenchOptions& options);
BenchReport run_transforms_bench(const BenchOptions& options);
BenchReport run_voxels_bench(const BenchOptions& options);
BenchReport run_wire_bench(const BenchOptions& options);
BenchReport run_worst_bench(const BenchOptions& options);

/// Every benchmark, in alphabetical order (bench/programs/all_benches.cpp).
const std::vector<Bench>& all_benches();

}  // namespace scree
