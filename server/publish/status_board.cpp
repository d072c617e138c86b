#include "server/publish/status_board.h"

namespace scree {

StatusMessage StatusBoard::status(const PublishedState& state, size_t clients) const {
  StatusMessage status;
  status.tick = state.tick();
  status.clients = static_cast<uint32_t>(clients);
  status.pieces = static_cast<uint32_t>(state.pieces().size());
  status.props = static_cast<uint32_t>(state.props().size());
  status.ledger_terrain = state.ledger().terrain;
  status.ledger_pieces = state.ledger().pieces;
  status.ledger_dust = state.ledger().dust;
  status.ledger_poured = state.ledger().poured;
  status.ledger_moved = state.ledger().moved;
  status.ledger_stored = state.ledger().stored;
  status.materials = state.materials();
  status.tick_median_ms = clock_.median_ms();
  status.tick_worst_ms = clock_.worst_ms();
  status.stages = clock_.stages();
  status.work = clock_.work();
  status.pieces_made = state.pieces_made();
  status.pieces_merged = state.pieces_merged();
  status.field_hash = state.field_hash();
  status.settings = state.settings();
  status.latency = latency_;
  status.saving = saving_.how;
  status.saved_tick = saving_.tick;
  status.paging = saving_.paging;
  for (size_t i = 0; i < refusal_reasons; ++i) {
    const auto reason = static_cast<Refusal>(i);
    if (refusals_.of(reason) > 0)
      status.refusals.push_back({std::string(name_of(reason)), refusals_.of(reason)});
  }
  return status;
}

}  // namespace scree
