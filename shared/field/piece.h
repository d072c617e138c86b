// A piece of broken terrain: a small field of its own, and how it lies in the world.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>

#include "shared/base/ids.h"
#include "shared/field/mass.h"
#include "shared/field/material_window.h"
#include "shared/field/window.h"

namespace scree {

/// A piece's shape, in the voxel frame of the terrain that it was cut from. Outside the window is air.
struct Volume {
  Window window;
  MassUnits mass = 0;  ///< mass that the terrain lost to the piece; never changes
  glm::vec3 centre_voxels{
      0.0F};                   ///< centre of volume, in the window's frame, voxels: the origin of its poses
  MaterialWindow materials{};  ///< of its voxels; over the window's box where they are not all one
  MaterialMasses masses{};     ///< of `mass`, by material; empty where that is all of one
};

/// The mass of a volume by material.
inline MaterialMasses masses_of(const Volume& volume) {
  if (!volume.masses.empty()) return volume.masses;
  return {{volume.materials.all, volume.mass}};
}

/// The material that most of a volume is of.
inline Material main_material(const Volume& volume) {
  const MaterialMass* most = nullptr;
  for (const MaterialMass& one : volume.masses)
    if (most == nullptr || one.mass > most->mass) most = &one;
  return most == nullptr ? volume.materials.all : most->material;
}

/// Where a piece is: its volume's centre, and the rotation from its volume's axes to the world's.
struct Pose {
  glm::vec3 position_m{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
};

/// A pose as it crosses the wire, and the only form in which the field kernels see one.
/// Position: multiples of 1/1024 m. Rotation: "smallest three", 2 + 3·10 bits (Fiedler, Snapshot
/// Compression).
struct QuantisedPose {
  int32_t x = 0;
  int32_t y = 0;
  int32_t z = 0;
  uint32_t rotation = 0;

  bool operator==(const QuantisedPose&) const = default;
};

inline constexpr float pose_steps_per_m = 1024.0F;

/// Positions must lie within ±2^20 m, rotations must have unit length.
QuantisedPose quantise(const Pose& pose);
/// The same bits everywhere. Any bits give a rotation of unit length.
Pose dequantise(const QuantisedPose& pose);

/// Where a piece is after a tick.
struct PieceState {
  PieceId id = 0;
  QuantisedPose pose;

  bool operator==(const PieceState&) const = default;
};

/// Ordered by id, so that every walk over it has the same order everywhere.
using PieceTable = std::map<PieceId, std::shared_ptr<const Volume>>;

}  // namespace scree
