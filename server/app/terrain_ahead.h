// Generates the terrain around clients' eyes before anything touches it, so that the first carve there costs
// a tick no more than the next. What a chunk holds is a function of its place: who generates it, and when,
// makes no difference to the simulation.
//
// One thread of its own; the public functions are for the simulation's.
#pragma once

#include <condition_variable>
#include <glm/vec3.hpp>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "shared/field/field.h"

namespace scree {

class TerrainAhead {
 public:
  explicit TerrainAhead(const TerrainSource& source);
  /// What is being generated is dropped.
  ~TerrainAhead();
  TerrainAhead(const TerrainAhead&) = delete;
  TerrainAhead& operator=(const TerrainAhead&) = delete;

  /// Once a tick: gives the field, which has the constructor's source, what is ready, and looks for more
  /// around the eyes (metres), nearest chunks first, a bounded part of them at a time. Stops short of what
  /// would make the field drop its generated chunks (limits::generated_chunks_max).
  void serve(Field& field, std::span<const glm::vec3> eyes_m);

 private:
  struct Ready {
    ChunkCoord coord;
    GeneratedChunk chunk;
  };

  std::vector<ChunkCoord> look_around(const Field& field, std::span<const glm::vec3> eyes_m);
  void run();

  const TerrainSource source_;
  std::vector<ChunkCoord> around_;  ///< chunks relative to an eye's, nearest first
  size_t eye_ = 0;                  ///< where the look around goes on: of the eyes,
  size_t step_ = 0;                 ///< and of `around_`

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  std::vector<ChunkCoord> wanted_;  ///< the next one last
  std::vector<Ready> ready_;
  std::thread thread_;
};

}  // namespace scree
