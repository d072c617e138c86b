#include "server/flight/diagnosis.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "server/flight/limits.h"

namespace scree {

namespace {

/// Where a tick's time went.
struct Shares {
  float away_ms = 0.0F;  ///< no thread of the process ran
  float disk_ms = 0.0F;
  float network_ms = 0.0F;
  float work_ms = 0.0F;
};

/// While the simulation's thread waits for its helpers, these have the processors.
Shares shares_of(const FlightTick& tick) {
  Shares shares;
  shares.disk_ms = tick.record_ms;
  if (tick.chunk_waits > 0) shares.disk_ms += std::max(0.0F, tick.world_ms - tick.thread_cpu_ms);
  shares.network_ms = tick.hand_over_ms;
  const float ran_ms = std::max(tick.thread_cpu_ms, std::min(tick.wall_ms, tick.process_cpu_ms));
  const float stood_ms = std::max(0.0F, tick.wall_ms - ran_ms - shares.disk_ms - shares.network_ms);
  shares.away_ms = tick.began_late_ms + stood_ms;
  shares.work_ms = std::max(0.0F, tick.wall_ms - stood_ms - shares.disk_ms - shares.network_ms);
  return shares;
}

TickStage longest_stage(const FlightTick& tick) {
  const auto longest = std::ranges::max_element(tick.stage_ms);
  return tick_stages[static_cast<size_t>(longest - tick.stage_ms.begin())].stage;
}

/// Those whose time grows with the bodies, whatever somebody asks for.
bool is_of_bodies(TickStage stage) {
  return stage == TickStage::bodies || stage == TickStage::rest || stage == TickStage::publish;
}

Diagnosis work_in(const FlightTick& tick, std::span<const FlightCause> causes, float work_ms) {
  Diagnosis found{.culprit = Culprit::work, .stage = longest_stage(tick), .culprit_ms = work_ms};
  // Hulls and bodies are made for the stage that broke the rock.
  const TickStage asked = found.stage == TickStage::spawn ? TickStage::requests : found.stage;
  for (const FlightCause& cause : causes)
    if (cause.stage == asked && (!found.cause || cause.clock_ms > found.cause->clock_ms)) found.cause = cause;
  if (is_of_bodies(found.stage) && tick.crowd.pieces > 0) found.culprit = Culprit::crowd;
  return found;
}

std::string whom(uint64_t party, uint64_t session, const FlightNames& names) {
  const uint64_t who = session != 0 ? session : party;
  if (who == 0) return "the server itself";
  const std::string name = names.session ? names.session(who) : std::string();
  return name.empty() ? fmt::format("session {}", who) : fmt::format("{} (session {})", name, who);
}

std::string place_text(const glm::vec3& at) {
  return fmt::format("({:.0f}, {:.0f}, {:.0f})", at.x, at.y, at.z);
}

std::string work_words(const FlightTick& tick, const Diagnosis& found, const FlightNames& names) {
  const size_t at = index_of(found.stage);
  const std::string_view stage = row_of(found.stage).name;
  if (!found.cause)
    return fmt::format("the stage {} took {:.0f} ms, {:.0f} ms by its price, for nobody in particular", stage,
                       tick.stage_ms[at], tick.model_ms[at]);
  const FlightCause& cause = *found.cause;
  const bool is_asked = cause.request != FlightCause::no_request;
  const std::string what =
      is_asked ? fmt::format("{} {} of {}", cause.count,
                             names.request ? names.request(cause.request) : std::string_view("requests"),
                             whom(cause.party, cause.session, names))
               : fmt::format("{} operations on rock that {} broke", cause.count,
                             whom(cause.party, cause.session, names));
  return fmt::format("{} at {} took {:.0f} ms of the stage {}, {:.0f} ms by their price", what,
                     place_text(cause.place_m), cause.clock_ms, stage, cause.price_ms);
}

std::string disk_words(const FlightTick& tick) {
  if (tick.chunk_waits > 0)
    return fmt::format("the disk was slow: the tick waited {} times for terrain from the world's file",
                       tick.chunk_waits);
  if (tick.record_ms > tick.tick_ms)
    return fmt::format("the disk was slow: the recording's queue was full for {:.0f} ms", tick.record_ms);
  return fmt::format("the disk was slow: a save took {:.0f} ms", tick.save_ms);
}

std::string network_words(const FlightTick& tick) {
  const bool is_busy = tick.net_cpu_ms > limits::flight_busy_share * (tick.net_lag_ms + tick.net_busy_ms);
  if (is_busy)
    return fmt::format(
        "the network thread had too much to do: a tick's messages took {:.0f} ms, {:.0f} ms after it",
        tick.net_busy_ms, tick.net_lag_ms);
  return fmt::format(
      "the network thread was starved: it took a tick {:.0f} ms after it, and had a processor for {:.1f} ms "
      "of that",
      tick.net_lag_ms, tick.net_cpu_ms);
}

}  // namespace

Diagnosis diagnose(const FlightTick& tick, std::span<const FlightCause> causes, const SlowLimits& limits) {
  if (static_cast<double>(tick.late_ms()) <= limits.late_ms) {
    if (static_cast<double>(tick.save_ms) > limits.save_ms)
      return {.culprit = Culprit::disk, .culprit_ms = tick.save_ms};
    if (static_cast<double>(tick.net_lag_ms) > limits.late_ms)
      return {.culprit = Culprit::network, .culprit_ms = tick.net_lag_ms};
    return {};
  }
  const Shares shares = shares_of(tick);
  const float most = std::max({shares.away_ms, shares.disk_ms, shares.network_ms, shares.work_ms});
  if (shares.away_ms == most)
    return {.culprit =
                tick.major_faults >= limits::flight_swap_pages ? Culprit::swapped_out : Culprit::not_running,
            .culprit_ms = most};
  if (shares.disk_ms == most) return {.culprit = Culprit::disk, .culprit_ms = most};
  if (shares.network_ms == most) return {.culprit = Culprit::network, .culprit_ms = most};
  return work_in(tick, causes, most);
}

std::string words_of(const FlightTick& tick, const Diagnosis& found, const FlightNames& names) {
  switch (found.culprit) {
    case Culprit::none:
      return "nothing was slow";
    case Culprit::work:
      return work_words(tick, found, names);
    case Culprit::crowd:
      return fmt::format(
          "{} pieces with {} contacts, {} of them of {}: they lie closest at {}, {} within {:.0f} m; the "
          "stage {} took "
          "{:.0f} ms",
          tick.pieces, tick.contacts, tick.crowd.party_pieces, whom(tick.crowd.party, 0, names),
          place_text(tick.crowd.place_m), tick.crowd.pieces, limits::flight_crowd_m, row_of(found.stage).name,
          tick.stage_ms[index_of(found.stage)]);
    case Culprit::disk:
      return disk_words(tick);
    case Culprit::network:
      return network_words(tick);
    case Culprit::swapped_out:
      return fmt::format("the process was swapped out: it waited {:.0f} ms for {} pages from the disk",
                         found.culprit_ms, tick.major_faults);
    case Culprit::not_running:
      return fmt::format(
          "the process did not run for {:.0f} ms: it was stopped, or the machine gave its processors to "
          "others",
          found.culprit_ms);
  }
  return {};
}

}  // namespace scree
