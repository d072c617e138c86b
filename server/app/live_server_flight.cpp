// LiveServer's flight recorder: what it is told, and what administrators are told of it.
#include <algorithm>

#include "server/app/live_server_state.h"
#include "server/rules/request_table.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

SlowTickRow row_of_slow(const SlowEpisode& slow) {
  const FlightTick& tick = slow.worst;
  SlowTickRow row{.tick = tick.tick,
                  .unix_ms = tick.unix_ms,
                  .ticks = slow.ticks,
                  .late_ms = tick.late_ms(),
                  .wall_ms = tick.wall_ms,
                  .cpu_ms = tick.thread_cpu_ms,
                  .culprit = std::string(name_of(slow.diagnosis.culprit)),
                  .name = slow.name,
                  .words = slow.words};
  const Culprit culprit = slow.diagnosis.culprit;
  if (culprit != Culprit::work && culprit != Culprit::crowd) return row;
  const size_t at = index_of(slow.diagnosis.stage);
  row.stage = std::string(row_of(slow.diagnosis.stage).name);
  row.clock_ms = tick.stage_ms[at];
  row.price_ms = tick.model_ms[at];
  if (culprit == Culprit::crowd) {
    row.party = tick.crowd.party;
    row.place_m = tick.crowd.place_m;
  } else if (const auto& cause = slow.diagnosis.cause) {
    row.clock_ms = cause->clock_ms;
    row.price_ms = cause->price_ms;
    row.party = cause->party;
    row.session = cause->session;
    if (cause->request != FlightCause::no_request) row.request = std::string(kind_at(cause->request));
    row.place_m = cause->place_m;
  }
  return row;
}

std::vector<SlowTickRow> ticks_for(const FlightRecorder& flight, const ListFlightRequest& request) {
  const uint64_t now_ms = unix_now_ms();
  const uint64_t since_ms =
      request.since_s == 0 ? 0 : now_ms - std::min(now_ms, request.since_s * uint64_t{1000});
  std::vector<SlowTickRow> rows;
  const bool is_slow = request.list == FlightList::slow;
  for (const SlowEpisode& slow : is_slow ? flight.slow(since_ms) : flight.worst(since_ms, request.most))
    rows.push_back(row_of_slow(slow));
  return rows;
}

std::vector<PartyRow> parties_of(const FlightRecorder& flight) {
  std::vector<PartyRow> rows;
  for (PartyWork& work : flight.parties())
    rows.push_back({.party = work.party,
                    .name = std::move(work.name),
                    .clock_us_per_s = static_cast<float>(work.clock_us_per_s),
                    .price_us_per_s = static_cast<float>(work.price_us_per_s),
                    .pieces = work.pieces,
                    .requests = work.requests});
  return rows;
}

}  // namespace

Result<void> LiveServer::State::open_flight() {
  const auto name_of_request = [](uint8_t request) { return kind_at(request); };
  auto opened = TRY(FlightRecorder::open({config.world.tick_rate_hz, config.world.terrain.voxel_size_m,
                                          config.slow, config.slow_log_path, name_of_request}));
  flight = std::move(opened);
  config.net.flight.ticks = [recorder = flight.get()](const ListFlightRequest& request) {
    return ticks_for(*recorder, request);
  };
  config.net.flight.parties = [recorder = flight.get()] { return parties_of(*recorder); };
  return {};
}

}  // namespace scree
