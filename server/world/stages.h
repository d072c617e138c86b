// The stages of a tick, in the order in which it goes through them, and how long each took. Everything that
// runs, times, reports or draws stages goes by this table. To add one: a member and a row here, and the
// function that it runs in world.cpp.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

enum class TickStage : uint8_t {
  requests,    ///< carves, fills, paint, settings
  refracture,  ///< pieces of large carves that are cut into smaller ones
  spawn,       ///< hulls and bodies of new pieces, whichever stage made them
  persons,     ///< persons on foot walk
  bodies,      ///< terrain contacts and the Bullet step; pieces beyond the world's bounds
  impacts,     ///< breaks and dents
  rest,        ///< rest detection
  recombine,   ///< planning and applying stamps
  buried,      ///< merges of pieces that were enclosed in rock
  slides,      ///< rubble that lies too steep runs down
  islands,     ///< search for what hangs loose, and its fall
  support,     ///< search for what is too heavy for what holds it
  specks,      ///< crumbs that merges and islands left
  publish,     ///< hashes, copies of changed bricks, transforms
};

struct TickStageRow {
  TickStage stage{};
  std::string_view name;
  /// Reports judge the stage by the ticks in which it changed something, not by all: most ticks have nothing
  /// for it to do.
  bool only_when_acting = false;
};

constexpr TickStageRow row_of(TickStage stage) {
  switch (stage) {
    case TickStage::requests:
      return {stage, "requests", true};
    case TickStage::refracture:
      return {stage, "cut", true};
    case TickStage::spawn:
      return {stage, "spawn", true};
    case TickStage::persons:
      return {stage, "persons", false};
    case TickStage::bodies:
      return {stage, "bodies", false};
    case TickStage::impacts:
      return {stage, "impacts", false};
    case TickStage::rest:
      return {stage, "rest", false};
    case TickStage::recombine:
      return {stage, "recombine", true};
    case TickStage::buried:
      return {stage, "buried", true};
    case TickStage::slides:
      return {stage, "slides", true};
    case TickStage::islands:
      return {stage, "islands", false};
    case TickStage::support:
      return {stage, "support", false};
    case TickStage::specks:
      return {stage, "specks", false};
    case TickStage::publish:
      return {stage, "publish", false};
  }
  return {};
}

inline constexpr auto tick_stages = kind_rows<TickStage>;

constexpr size_t index_of(TickStage stage) {
  return static_cast<size_t>(stage);
}

/// Milliseconds that each stage of a tick took. Reported only; the simulation never reads them.
struct StageTimes {
  std::array<double, tick_stages.size()> ms{};
  std::array<double, tick_stages.size()>
      model_ms{};                         ///< the same by the model of work; spawns are in other stages
  std::bitset<tick_stages.size()> acted;  ///< stages that changed something

  double& operator[](TickStage stage) { return ms[index_of(stage)]; }
  double operator[](TickStage stage) const { return ms[index_of(stage)]; }
  double total_ms() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
};

/// Charges the time that passes to one stage after the other. A stage within a stage (spawn) takes its time
/// out of the outer one's.
class StageStopwatch {
 public:
  /// The time from now on is the stage's. Returns the one whose it was.
  TickStage switch_to(TickStage stage, StageTimes& times) {
    const auto now = std::chrono::steady_clock::now();
    times[stage_] += std::chrono::duration<double, std::milli>(now - since_).count();
    since_ = now;
    const TickStage before = stage_;
    stage_ = stage;
    return before;
  }
  TickStage stage() const { return stage_; }
  /// A tick begins: nothing is charged for the time since the last one.
  void restart(TickStage stage) {
    since_ = std::chrono::steady_clock::now();
    stage_ = stage;
  }

 private:
  TickStage stage_ = TickStage::requests;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace scree
