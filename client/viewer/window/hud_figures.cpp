// The HUD's figures and graphs.
#include <algorithm>
#include <cfloat>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <imgui/imgui.h>

#include "client/viewer/window/hud.h"
#include "shared/field/mass.h"

namespace scree {
namespace {

const ImVec4 slow_colour(1.0F, 0.6F, 0.4F, 1.0F);
constexpr double pace_worth_a_word = 0.98;
constexpr float line_width_in_text = 34.0F;   ///< heights of the text, before a long line is broken
constexpr float graph_width_in_text = 18.0F;  ///< likewise
constexpr double kib = 1024.0;
constexpr double mib = 1024.0 * 1024.0;

double as_mib(size_t bytes) {
  return static_cast<double>(bytes) / mib;
}

/// The server's pieces, all of one moment: made = alive + merged + those of the last number.
void show_pieces(const StatusMessage& status) {
  const uint64_t ended = status.pieces_made - std::min<uint64_t>(status.pieces_made, status.pieces);
  const uint64_t other = ended - std::min(ended, status.pieces_merged);
  ImGui::Text("pieces: %u alive, %" PRIu64 " merged, %" PRIu64 " broke", status.pieces, status.pieces_merged,
              other);
}

void show_ledger(const HudFacts& facts, const StatusMessage& status) {
  const double voxel_m3 = std::pow(static_cast<double>(facts.voxel_size_m), 3.0);
  const auto row = [&](const char* name, int64_t units) {
    ImGui::Text("%-8s %+14.3f m3", name, static_cast<double>(units) * voxel_m3 / units_per_voxel);
  };
  row("terrain", status.ledger_terrain);
  row("pieces", status.ledger_pieces);
  row("dust", status.ledger_dust);
  if (status.ledger_stored != 0) row("stored", status.ledger_stored);
  row("poured", status.ledger_poured);
  const int64_t error = status.ledger_terrain + status.ledger_pieces + status.ledger_dust +
                        status.ledger_stored - status.ledger_poured;
  ImGui::Text("error    %14" PRId64 " units", error);
}

/// A world that is slower than the clock now is everybody's business.
void show_pace(const HudFacts& facts) {
  if (facts.is_replay || facts.pace >= pace_worth_a_word) return;
  ImGui::TextColored(slow_colour, "the world is slow: time x %.2f", facts.pace);
}

/// Shows the work of the server's ticks against their budget, and the work that did not fit.
void show_work(const WorkStatus& work) {
  if (work.budget_us == 0) return;
  constexpr double us_per_ms = 1000.0;
  ImGui::Text("work %.1f of %.1f ms%s", work.worst_us / us_per_ms, work.budget_us / us_per_ms,
              work.ticks_merging_sooner > 0 ? ", merging sooner" : "");
  if (work.requests_waiting + work.merges_put_off > 0)
    ImGui::Text("put off: %u requests, %u merges", work.requests_waiting, work.merges_put_off);
  if (work.islands_put_off + work.islands_too_large > 0)
    ImGui::Text("islands: %u put off, %u too large", work.islands_put_off, work.islands_too_large);
  if (work.breaks_left_out + work.dents_left_out > 0)
    ImGui::Text("left out: %u breaks, %u dents", work.breaks_left_out, work.dents_left_out);
}

double as_ms(uint32_t us) {
  return static_cast<double>(us) / 1000.0;
}

/// The way of one's own last request, and of all clients' in the last second, by stages.
void show_latency(const HudFacts& facts) {
  if (facts.latency) {
    ImGui::Text("your request: %.1f ms", facts.latency->total_ms);
    ImGui::Text("  network %.1f", facts.latency->network_ms());
    for (const LatencyStageRow& stage : latency_stages) {
      ImGui::SameLine(0.0F, 0.0F);
      ImGui::Text(", %s %.1f", stage.name.data(), as_ms(facts.latency->server.*stage.us));
    }
    ImGui::SameLine(0.0F, 0.0F);
    ImGui::TextUnformatted(" ms");
  }
  if (facts.status && facts.status->latency != LatencyStatus{})
    for (const LatencyStageRow& stage : latency_stages)
      ImGui::Text("all: %-8s median %6.1f, worst %6.1f ms", stage.name.data(),
                  as_ms(facts.status->latency.median.*stage.us),
                  as_ms(facts.status->latency.worst.*stage.us));
  if (facts.predictions > 0) ImGui::Text("%zu carves not answered yet", facts.predictions);
}

void show_memory(const MemoryCounts& counts) {
  ImGui::TextUnformatted("MiB              CPU     GPU");
  for (const MemoryCount& count : counts)
    ImGui::Text("%-13s %6.1f  %6.1f", std::string(count.category).c_str(), as_mib(count.cpu_bytes),
                as_mib(count.gpu_bytes));
  ImGui::Text("%-13s %6.1f", "process", as_mib(process_memory_bytes()));
}

void show_graph(const char* name, const History& history, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f %s, worst %.1f", static_cast<double>(history.mean()), unit,
                static_cast<double>(history.worst()));
  ImGui::PlotLines(name, history.data(), static_cast<int>(History::length), history.offset(), text, 0.0F,
                   FLT_MAX, ImVec2(graph_width_in_text * ImGui::GetFontSize(), 3.0F * ImGui::GetFontSize()));
}

/// A bar for each stage of the server's tick, against the tick's length.
void show_stages(const StatusMessage& status, double tick_rate_hz) {
  const auto tick_ms = static_cast<float>(1000.0 / tick_rate_hz);
  for (const StageTime& stage : status.stages) {
    char text[48];
    std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(stage.ms));
    ImGui::ProgressBar(stage.ms / tick_ms, ImVec2(graph_width_in_text * ImGui::GetFontSize(), 0.0F), text);
    ImGui::SameLine();
    ImGui::TextUnformatted(stage.name.c_str());
  }
}

/// What a developer or an operator wants to know beside.
void show_all(const HudFacts& facts) {
  ImGui::Separator();
  ImGui::Text("tick %" PRIu64 ", time x %.2f", facts.tick, facts.pace);
  if (!facts.is_replay) {
    ImGui::SameLine(0.0F, 0.0F);
    ImGui::Text(", %" PRIu64 " ticks lost", facts.lost_ticks);
  }
  if (facts.mismatches > 0) ImGui::Text("%" PRIu64 " frames differed", facts.mismatches);
  if (facts.status) {
    show_ledger(facts, *facts.status);
    show_work(facts.status->work);
  }
  show_latency(facts);
  ImGui::Separator();
  ImGui::Text("chunks: %zu followed, %zu edited, %zu bricks", facts.held_chunks, facts.edited_chunks,
              facts.edited_bricks);
  show_memory(facts.memory);
  ImGui::Separator();
  // Pieces that merged go on being drawn, as stones.
  ImGui::Text("%s: %zu draws, %zu k triangles, %zu pieces and %zu stones", facts.method.c_str(),
              facts.draw.draws, facts.draw.triangles / 1000, facts.pieces_near, facts.stones);
  ImGui::Text("%zu blocks or bricks kept, %zu waiting", facts.draw.resident, facts.draw.waiting);
}

}  // namespace

void Hud::figures(const HudFacts& facts, bool all) {
  panels_.begin(PanelPlace::upper_left);
  ImGui::PushTextWrapPos(line_width_in_text * ImGui::GetFontSize());
  ImGui::TextUnformatted(facts.connection.c_str());
  ImGui::PopTextWrapPos();
  ImGui::TextUnformatted(facts.camera.c_str());
  const auto frame_ms = static_cast<double>(frame_.mean());
  ImGui::Text("%.1f ms a frame (%.0f Hz), %.1f KiB/s", frame_ms, frame_ms > 0.0 ? 1000.0 / frame_ms : 0.0,
              facts.bytes_per_s / kib);
  show_pace(facts);
  if (facts.status) show_pieces(*facts.status);
  if (facts.props_near > 0) ImGui::Text("props: %zu here", facts.props_near);
  if (facts.kept_near > 0) ImGui::Text("kept pieces: %zu here", facts.kept_near);
  if (all) show_all(facts);
  panels_.end();
}

void Hud::note(const HudFacts& facts, const FrameParts& parts) {
  frame_.add(parts.frame_ms);
  update_.add(parts.update_ms);
  draw_.add(parts.draw_ms);
  network_.add(static_cast<float>(facts.bytes_per_s / kib));
  tick_.add(facts.status ? facts.status->tick_median_ms : 0.0F);
}

void Hud::graphs(const HudFacts& facts) {
  ImGui::PushTextWrapPos(line_width_in_text * ImGui::GetFontSize());
  ImGui::TextUnformatted(facts.driver.c_str());
  ImGui::PopTextWrapPos();
  show_graph("frame", frame_, "ms");
  show_graph("update", update_, "ms");
  show_graph("draw", draw_, "ms");
  show_graph("network", network_, "KiB/s");
  show_graph("server tick", tick_, "ms");
  for (const GpuTime& time : facts.gpu_times)
    ImGui::Text("GPU %-9s %7.2f ms", std::string(time.name).c_str(), time.ms);
  if (facts.status) show_stages(*facts.status, facts.tick_rate_hz);
}

}  // namespace scree
