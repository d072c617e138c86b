// What the parts of kernels_golden share.
#pragma once

#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "shared/base/random.h"
#include "shared/fracture/cutter.h"

namespace scree {

/// FNV-1a, so that the hash under test (brick_hash) does not judge itself.
class GoldenHash {
 public:
  void add(uint64_t value) {
    for (int i = 0; i < 8; ++i) add_byte(static_cast<uint8_t>(value >> (8 * i)));
  }
  void add(float value) { add(uint64_t{std::bit_cast<uint32_t>(value)}); }
  void add(glm::vec3 v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Window& window) {
    for (const int side : {window.box.lo.x, window.box.lo.y, window.box.lo.z, window.box.hi.x,
                           window.box.hi.y, window.box.hi.z})
      add(static_cast<uint64_t>(side));
    for (const Code code : window.codes) add_byte(static_cast<uint8_t>(code));
  }
  void add(const Volume& volume) {
    add(volume.window);
    add(static_cast<uint64_t>(volume.mass));
    add(volume.centre_voxels);
  }
  void add(const Cut& cut) {
    for (const CutPiece& piece : cut.pieces) {
      add(piece.volume);
      for (const uint32_t seed : piece.seeds) add(uint64_t{seed});
    }
    add(static_cast<uint64_t>(cut.dust));
  }
  void add(const Pose& pose) {
    add(pose.position_m);
    for (int i = 0; i < 4; ++i) add(pose.rotation[i]);
  }
  void print(const std::string& name) const { std::printf("%-28s %016" PRIx64 "\n", name.c_str(), hash_); }

 private:
  void add_byte(uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3ULL; }
  uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// Some pose near `position_m`, turned anyhow.
inline QuantisedPose some_pose(glm::vec3 position_m, Random& random) {
  return {static_cast<int32_t>(position_m.x * pose_steps_per_m) + static_cast<int32_t>(random.below(2000)),
          static_cast<int32_t>(position_m.y * pose_steps_per_m) + static_cast<int32_t>(random.below(2000)),
          static_cast<int32_t>(position_m.z * pose_steps_per_m) + static_cast<int32_t>(random.below(2000)),
          random.next()};
}

/// Prints the hashes of operations on terrain of several materials.
void print_materials();

/// Prints the hashes of answers to questions about space.
void print_queries();

}  // namespace scree
