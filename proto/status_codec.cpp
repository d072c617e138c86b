#include "proto/status_codec.h"

#include <fmt/format.h>

#include "proto/content_codec.h"
#include "shared/base/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

void write(wire::Work& to, const WorkStatus& from) {
  to.set_budget_us(from.budget_us);
  to.set_worst_us(from.worst_us);
  to.set_requests_waiting(from.requests_waiting);
  to.set_merges_put_off(from.merges_put_off);
  to.set_breaks_left_out(from.breaks_left_out);
  to.set_dents_left_out(from.dents_left_out);
  to.set_ticks_cut_short(from.ticks_cut_short);
  to.set_ticks_merging_sooner(from.ticks_merging_sooner);
  to.set_supports_put_off(from.supports_put_off);
  to.set_islands_put_off(from.islands_put_off);
  to.set_islands_too_large(from.islands_too_large);
}

void write(wire::Latency& to, const LatencyStatus& from, uint32_t ServerLatency::*stage) {
  to.set_median_us(from.median.*stage);
  to.set_worst_us(from.worst.*stage);
}

WorkStatus read(const wire::Work& from, FieldChecker& check) {
  WorkStatus work;
  work.budget_us = check.within(from.budget_us(), 0, limits::tick_budget_max_us, "budget_us");
  work.worst_us = from.worst_us();
  work.requests_waiting = from.requests_waiting();
  work.merges_put_off = from.merges_put_off();
  work.breaks_left_out = from.breaks_left_out();
  work.dents_left_out = from.dents_left_out();
  work.ticks_cut_short = check.within(from.ticks_cut_short(), 0, limits::tick_rate_max_hz, "ticks_cut_short");
  work.ticks_merging_sooner =
      check.within(from.ticks_merging_sooner(), 0, limits::tick_rate_max_hz, "ticks_merging_sooner");
  work.supports_put_off = from.supports_put_off();
  work.islands_put_off = from.islands_put_off();
  work.islands_too_large = from.islands_too_large();
  return work;
}

void read(const wire::Latency& from, uint32_t ServerLatency::*stage, LatencyStatus& to, FieldChecker& check) {
  to.median.*stage = read_latency(from.median_us(), check);
  to.worst.*stage = read_latency(from.worst_us(), check);
}

}  // namespace

uint32_t read_latency(uint32_t us, FieldChecker& check) {
  return check.within(us, 0, limits::latency_max_us, "microseconds of a stage");
}

void write(wire::Status& to, const StatusMessage& from) {
  to.set_tick(from.tick);
  to.set_clients(from.clients);
  to.set_pieces(from.pieces);
  to.set_props(from.props);
  to.set_ledger_terrain(from.ledger_terrain);
  to.set_ledger_pieces(from.ledger_pieces);
  to.set_ledger_dust(from.ledger_dust);
  to.set_ledger_poured(from.ledger_poured);
  to.set_ledger_moved(from.ledger_moved);
  to.set_tick_median_ms(from.tick_median_ms);
  to.set_tick_worst_ms(from.tick_worst_ms);
  to.set_sent_bytes(from.sent_bytes);
  to.set_pieces_made(from.pieces_made);
  to.set_pieces_merged(from.pieces_merged);
  to.set_field_hash(from.field_hash);
  to.set_repairs(from.repairs);
  write(*to.mutable_settings(), from.settings);
  for (const StageTime& stage : from.stages) {
    wire::StageTime& one = *to.add_stages();
    one.set_name(showable(stage.name, limits::stage_name_bytes_max));
    one.set_ms(stage.ms);
  }
  write(*to.mutable_work(), from.work);
  write(*to.mutable_waiting(), from.latency, &ServerLatency::waiting_us);
  write(*to.mutable_ticking(), from.latency, &ServerLatency::tick_us);
  write(*to.mutable_sending(), from.latency, &ServerLatency::sending_us);
  to.set_saving(showable(from.saving, limits::saving_bytes_max));
  to.set_saved_tick(from.saved_tick);
  to.set_chunks_waiting(from.chunks_waiting);
  to.set_chunks_in(from.paging.chunks_in);
  to.set_chunks_out(from.paging.chunks_out);
  to.set_chunks_read(from.paging.chunks_read);
  to.set_chunk_waits(from.paging.chunk_waits);
  to.set_requests_held(from.paging.requests_held);
  to.set_materials(pack_ledger(from.materials));
  to.set_ledger_stored(from.ledger_stored);
  to.set_materials_stored(pack_stored(from.materials));
  for (const RefusalCount& refusal : from.refusals) {
    wire::RefusalCount& added = *to.add_refusals();
    added.set_reason(showable(refusal.reason, limits::refusal_name_bytes_max));
    added.set_count(refusal.count);
  }
}

StatusMessage read(const wire::Status& from, FieldChecker& check) {
  StatusMessage status;
  status.tick = from.tick();
  status.clients = from.clients();
  status.pieces = from.pieces();
  status.props = from.props();
  status.ledger_terrain = ledger_mass(from.ledger_terrain(), check);
  status.ledger_pieces = ledger_mass(from.ledger_pieces(), check);
  status.ledger_dust = ledger_mass(from.ledger_dust(), check);
  status.ledger_poured = ledger_mass(from.ledger_poured(), check);
  status.ledger_moved = ledger_mass(from.ledger_moved(), check);
  status.tick_median_ms = check.finite(from.tick_median_ms(), "tick_median_ms");
  status.tick_worst_ms = check.finite(from.tick_worst_ms(), "tick_worst_ms");
  status.sent_bytes = from.sent_bytes();
  status.pieces_made = from.pieces_made();
  status.pieces_merged = from.pieces_merged();
  status.field_hash = from.field_hash();
  status.repairs = from.repairs();
  status.settings = check.settings(from.settings());
  if (static_cast<size_t>(from.stages_size()) > limits::stages_max)
    check.refuse(fmt::format("{} stages are over the limit of {}", from.stages_size(), limits::stages_max));
  for (const wire::StageTime& stage : from.stages()) {
    if (check.failed()) break;
    status.stages.push_back({check.text(stage.name(), limits::stage_name_bytes_max, "name of a stage"),
                             check.not_negative(stage.ms(), "ms of a stage")});
  }
  status.work = read(from.work(), check);
  read(from.waiting(), &ServerLatency::waiting_us, status.latency, check);
  read(from.ticking(), &ServerLatency::tick_us, status.latency, check);
  read(from.sending(), &ServerLatency::sending_us, status.latency, check);
  status.saving = check.text(from.saving(), limits::saving_bytes_max, "saving");
  status.saved_tick = from.saved_tick();
  status.chunks_waiting = from.chunks_waiting();
  status.paging = {from.chunks_in(), from.chunks_out(), from.chunks_read(), from.chunk_waits(),
                   from.requests_held()};
  status.materials = unpack_ledger(from.materials(), from.materials_stored(), check);
  status.ledger_stored = ledger_mass(from.ledger_stored(), check);
  if (static_cast<size_t>(from.refusals_size()) > limits::refusal_counts_max)
    check.refuse(fmt::format("more than {} reasons for refusals", limits::refusal_counts_max));
  else
    for (const wire::RefusalCount& refusal : from.refusals())
      status.refusals.push_back(
          {check.text(refusal.reason(), limits::refusal_name_bytes_max, "reason of refusals"),
           refusal.count()});
  return status;
}

}  // namespace scree
