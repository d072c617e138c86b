// Scree beside each peer. Every function measures both sides in turns, `runs` times, and says what each did.
#pragma once

#include <functional>

#include "studies/peers/comparison.h"

namespace scree {

struct PeerOptions {
  bool quick = false;  ///< smaller scenes, only to show that it runs
  int runs = 3;
  std::function<void(double fraction)> progress = [](double) {};  ///< of this peer
};

PeerFindings beside_openvdb(const PeerOptions& options);
PeerFindings beside_level_set_fracture(const PeerOptions& options);
PeerFindings beside_voronoi(const PeerOptions& options);
PeerFindings beside_nanovdb(const PeerOptions& options);
PeerFindings beside_bullet(const PeerOptions& options);
PeerFindings beside_zstd(const PeerOptions& options);
PeerFindings beside_luanti(const PeerOptions& options);

}  // namespace scree
