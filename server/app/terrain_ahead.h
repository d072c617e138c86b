// Generates terrain before anything touches it: around clients' eyes, and where edits wait for it, so that
// the first carve at a place costs a tick no more than later ones. A chunk's content is a function of its
// place, so the thread and the time of its generation make no difference to the simulation.
//
// One worker thread; the simulation thread calls the public functions.
#pragma once

#include <condition_variable>
#include <deque>
#include <glm/vec3.hpp>
#include <mutex>
#include <span>
#include <thread>
#include <unordered_set>
#include <vector>

#include "shared/field/field.h"

namespace scree {

/// The chunks of a ball, relative to its middle one, nearest first.
std::vector<ChunkCoord> ball_of_chunks(int radius);

class TerrainAhead {
 public:
  explicit TerrainAhead(const TerrainSource& source);
  /// Drops chunks that are not handed over yet.
  ~TerrainAhead();
  TerrainAhead(const TerrainAhead&) = delete;
  TerrainAhead& operator=(const TerrainAhead&) = delete;

  /// Hands the generated chunks to the field, which has the constructor's source, and requests chunks that it
  /// lacks around the eyes (metres): the nearest first, limits::ahead_chunks_per_tick at a time; those that
  /// it has count as used. Requests none when all that lies around the eyes would fill more than half of what
  /// the field may keep (Field::generated_bytes_max): it would drop what was made before. Call once a tick.
  void serve(const Field& field, std::span<const glm::vec3> eyes_m);

  /// Whether the field has the terrain of all chunks that the box touches; they count as used. Those that it
  /// lacks are generated before what lies around eyes, at most limits::ahead_asked_max at a time, and handed
  /// over by serve().
  bool has(const Field& field, const VoxelBox& box);
  /// The same for chunks that something will touch soon.
  bool has(const Field& field, std::span<const ChunkCoord> chunks);

 private:
  struct Ready {
    ChunkCoord coord;
    GeneratedChunk chunk;
  };

  std::vector<ChunkCoord> missing_around(const Field& field, std::span<const glm::vec3> eyes_m);
  void run();

  const TerrainSource source_;
  std::vector<ChunkCoord> around_;                    ///< chunks relative to an eye, nearest first
  size_t eye_ = 0;                                    ///< the eye at which the next look begins
  size_t step_ = 0;                                   ///< the entry of `around_` at which it begins
  std::unordered_set<ChunkCoord, CoordHash> round_;   ///< looked at since all eyes were
  std::unordered_set<ChunkCoord, CoordHash> coming_;  ///< asked for by has(), and not handed over

  std::mutex mutex_;  ///< guards the members below
  std::condition_variable wake_;
  bool stopping_ = false;
  std::deque<ChunkCoord> asked_;    ///< chunks to generate first
  std::vector<ChunkCoord> wanted_;  ///< then these, the next one last
  std::vector<Ready> ready_;
  std::thread thread_;
};

}  // namespace scree
