// The HUD's figures and graphs.
#include <cfloat>
#include <cinttypes>
#include <cstdio>

#include "client/viewer/window/hud.h"
#include "client/viewer/window/hud_style.h"

namespace scree {
namespace {

constexpr double kib = 1024.0;
constexpr double mib = 1024.0 * 1024.0;

double as_mib(size_t bytes) {
  return static_cast<double>(bytes) / mib;
}

void show_ledger(const StatusMessage& status) {
  const int64_t error =
      status.ledger_terrain + status.ledger_pieces + status.ledger_dust - status.ledger_poured;
  ImGui::Text("terrain  %+14" PRId64, status.ledger_terrain);
  ImGui::Text("pieces   %14" PRId64, status.ledger_pieces);
  ImGui::Text("dust     %14" PRId64, status.ledger_dust);
  ImGui::Text("poured   %14" PRId64, status.ledger_poured);
  ImGui::Text("error    %14" PRId64, error);
  ImGui::Text("made %" PRIu64 ", merged %" PRIu64 ", alive %u", status.pieces_made, status.pieces_merged,
              status.pieces);
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
    ImGui::Text("your request: %.1f ms, network %.1f", facts.latency->total_ms, facts.latency->network_ms());
    for (const LatencyStageRow& stage : latency_stages) {
      ImGui::SameLine(0.0F, 0.0F);
      ImGui::Text(", %s %.1f", stage.name.data(), as_ms(facts.latency->server.*stage.us));
    }
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
                   FLT_MAX, ImVec2(240.0F, 38.0F));
}

/// A bar for each stage of the server's tick, against the tick's length.
void show_stages(const StatusMessage& status) {
  constexpr float tick_ms = 1000.0F / 60.0F;
  for (const StageTime& stage : status.stages) {
    char text[48];
    std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(stage.ms));
    ImGui::ProgressBar(stage.ms / tick_ms, ImVec2(240.0F, 14.0F), text);
    ImGui::SameLine();
    ImGui::TextUnformatted(stage.name.c_str());
  }
}

}  // namespace

void Hud::figures(const HudFacts& facts) {
  begin_overlay("figures", ImVec2(12.0F, 12.0F), ImVec2(0.0F, 0.0F));
  ImGui::TextUnformatted(facts.connection.c_str());
  ImGui::Text("tick %" PRIu64 "   pieces %zu", facts.tick, facts.pieces);
  const auto frame_ms = static_cast<double>(frame_.mean());
  ImGui::Text("%.1f ms a frame (%.0f Hz)", frame_ms, frame_ms > 0.0 ? 1000.0 / frame_ms : 0.0);
  ImGui::Text("%.1f KiB/s received", facts.bytes_per_s / kib);
  if (facts.mismatches > 0) ImGui::Text("%" PRIu64 " frames differed", facts.mismatches);
  ImGui::Separator();
  if (facts.status) {
    show_ledger(*facts.status);
    show_work(facts.status->work);
  }
  show_latency(facts);
  ImGui::Separator();
  ImGui::Text("chunks: %zu followed, %zu edited, %zu bricks", facts.held_chunks, facts.edited_chunks,
              facts.edited_bricks);
  show_memory(facts.memory);
  ImGui::Separator();
  ImGui::Text("%s: %zu draws, %zu k triangles, %zu pieces", facts.method.c_str(), facts.draw.draws,
              facts.draw.triangles / 1000, facts.draw.pieces);
  ImGui::Text("%zu blocks or bricks kept", facts.draw.kept);
  if (facts.draw.waiting > 0) ImGui::Text("%zu waiting", facts.draw.waiting);
  if (!facts.notice.empty()) ImGui::TextColored(ImVec4(1.0F, 0.6F, 0.4F, 1.0F), "%s", facts.notice.c_str());
  ImGui::End();
}

void Hud::note(const HudFacts& facts, const FrameParts& parts) {
  frame_.add(parts.frame_ms);
  update_.add(parts.update_ms);
  draw_.add(parts.draw_ms);
  network_.add(static_cast<float>(facts.bytes_per_s / kib));
  tick_.add(facts.status ? facts.status->tick_median_ms : 0.0F);
}

void Hud::graphs(const HudFacts& facts) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_overlay("graphs", ImVec2(size.x - 12.0F, size.y - 12.0F), ImVec2(1.0F, 1.0F));
  ImGui::TextUnformatted(facts.driver.c_str());
  show_graph("frame", frame_, "ms");
  show_graph("update", update_, "ms");
  show_graph("draw", draw_, "ms");
  show_graph("network", network_, "KiB/s");
  show_graph("server tick", tick_, "ms");
  for (const GpuTime& time : facts.gpu_times)
    ImGui::Text("GPU %-9s %7.2f ms", std::string(time.name).c_str(), time.ms);
  if (facts.status) show_stages(*facts.status);
  ImGui::End();
}

}  // namespace scree
