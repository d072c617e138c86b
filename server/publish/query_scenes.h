// What questions are asked of: the published terrain and bodies of the newest tick and of those shortly
// before. It answers a question in steps of bounded cost, so that ground is generated bit by bit. It reads
// the published state alone, and changes nothing. Not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "server/publish/published_field.h"
#include "server/publish/query_past.h"
#include "shared/query/question.h"

namespace scree {

class QueryScenes {
 public:
  /// The state outlives it.
  QueryScenes(const TerrainSource& source, uint32_t tick_rate_hz, const PublishedState& state);

  /// The state is another one than before.
  void restart();
  /// As of QueryPast.
  void before(const TickDelta& delta);
  void after(const TickDelta& delta);

  /// Whether a client may ask for that tick now.
  bool may_ask_for(Tick tick) const;
  /// Begins the questions of a tick. False: not yet, the field still follows the state.
  [[nodiscard]] bool begin();
  /// There are no questions in this tick.
  void rest();

  enum class Outcome : uint8_t {
    answered,
    goes_on,  ///< ground was generated: call again
    missing,  ///< a chunk is out of memory (take_missing)
    gone,     ///< that tick, or its terrain there, is not kept
  };
  struct Step {
    Outcome outcome = Outcome::gone;
    QuestionAnswer answer{};
    uint64_t cost = 0;  ///< as of limits::query_steps_per_tick
  };
  /// One step, between begin() and the next tick. The question is valid. `progress`: how far its ground was
  /// looked at, 0 at the first step.
  Step step(const Question& question, Tick tick, float& progress);
  /// Chunks that were missing since the last call.
  std::vector<ChunkCoord> take_missing() { return std::exchange(missing_, {}); }

 private:
  /// A tick's scene, with a layer over the field where terrain has changed since.
  struct OfTick {
    std::unique_ptr<MapField> layer;
    std::vector<BrickCoord> unknown;  ///< bricks whose codes then are not kept
    std::unique_ptr<HeldScene> scene;
  };
  /// Null: that tick is not kept.
  const OfTick* scene_of(Tick tick, uint64_t& cost);
  void lay_over(OfTick& scene, const std::vector<const BrickBefore*>& changed) const;
  Step try_step(const Question& question, Tick tick, float& progress);
  /// Whether all the ground that decides a cast of the question is generated.
  bool is_way_generated(const Question& question, float from_m) const;
  /// Generates a few chunks of those that decide the question; true: there are more.
  bool generate_some(const Question& question, float& progress) const;

  TerrainSource source_;
  const PublishedState& state_;
  Tick asked_back_;  ///< ticks
  QueryPast past_;
  std::unique_ptr<PublishedField> field_;  ///< null: nobody asked lately
  SceneMaker maker_;
  std::map<Tick, OfTick> scenes_;  ///< of this tick's questions
  std::vector<ChunkCoord> missing_;
  Tick asked_ = 0;  ///< the last tick with questions
  Tick idle_ticks_;
};

}  // namespace scree
