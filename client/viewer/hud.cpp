#include "client/viewer/hud.h"

#include <cinttypes>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

namespace scree {
namespace {

constexpr ImGuiWindowFlags overlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoNav;

void draw_crosshair() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const ImVec2 c(size.x * 0.5F, size.y * 0.5F);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImU32 colour = IM_COL32(255, 255, 255, 190);
  list->AddLine(ImVec2(c.x - 9, c.y), ImVec2(c.x - 3, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x + 3, c.y), ImVec2(c.x + 9, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y - 9), ImVec2(c.x, c.y - 3), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y + 3), ImVec2(c.x, c.y + 9), colour, 1.5F);
}

void draw_banner(const std::string& text) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x * 0.5F, size.y * 0.25F), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowBgAlpha(0.85F);
  ImGui::Begin("banner", nullptr, overlay);
  ImGui::TextColored(ImVec4(1.0F, 0.75F, 0.4F, 1.0F), "%s", text.c_str());
  ImGui::End();
}

void draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(12.0F, size.y - 12.0F), ImGuiCond_Always, ImVec2(0.0F, 1.0F));
  ImGui::SetNextWindowBgAlpha(0.55F);
  ImGui::Begin("help", nullptr, overlay);
  ImGui::TextUnformatted(
      "click       take the mouse, then carve\n"
      "wheel       radius\n"
      "W A S D     fly (Shift: faster)\n"
      "Space C     up, down\n"
      "M           draw by the next method\n"
      "Tab         free the mouse\n"
      "H           this help\n"
      "Esc         end");
  ImGui::End();
}

void draw_ledger(const StatusMessage& status) {
  const int64_t error =
      status.ledger_terrain + status.ledger_pieces + status.ledger_dust - status.ledger_poured;
  ImGui::Text("terrain  %+14" PRId64, status.ledger_terrain);
  ImGui::Text("pieces   %14" PRId64, status.ledger_pieces);
  ImGui::Text("dust     %14" PRId64, status.ledger_dust);
  ImGui::Text("error    %14" PRId64, error);
  ImGui::Text("made %" PRIu64 ", merged %" PRIu64, status.pieces_made, status.pieces_merged);
  ImGui::Text("server tick %.2f ms, worst %.2f", static_cast<double>(status.tick_median_ms),
              static_cast<double>(status.tick_worst_ms));
}

double mebibytes(size_t bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

void draw_memory(const MemoryCounts& counts) {
  ImGui::TextUnformatted("MiB            CPU     GPU");
  for (const MemoryCount& count : counts)
    ImGui::Text("%-10s %7.1f %7.1f", std::string(count.category).c_str(), mebibytes(count.cpu_bytes),
                mebibytes(count.gpu_bytes));
  ImGui::Text("%-10s %7.1f", "process", mebibytes(process_memory_bytes()));
}

}  // namespace

Hud::Hud(const AppWindow& window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4.0F;
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init();
}

Hud::~Hud() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Hud::draw_figures(const HudFacts& facts) const {
  ImGui::SetNextWindowPos(ImVec2(12.0F, 12.0F));
  ImGui::SetNextWindowBgAlpha(0.55F);
  ImGui::Begin("figures", nullptr, overlay);
  ImGui::Text("%s", facts.connection.c_str());
  ImGui::Text("tick %" PRIu64 "   pieces %zu", facts.tick, facts.pieces);
  ImGui::Text("%.1f ms a frame (%.0f Hz)", static_cast<double>(frame_ms_),
              frame_ms_ > 0.0F ? 1000.0 / static_cast<double>(frame_ms_) : 0.0);
  ImGui::Text("%.1f KiB/s received", facts.bytes_per_s / 1024.0);
  if (facts.mismatches > 0) ImGui::Text("%" PRIu64 " frames differed", facts.mismatches);
  ImGui::Separator();
  if (facts.status) draw_ledger(*facts.status);
  ImGui::Separator();
  ImGui::Text("%s: %zu draws, %zu k triangles", facts.method.c_str(), facts.draw.draws,
              facts.draw.triangles / 1000);
  for (const GpuTime& time : facts.gpu_times)
    ImGui::Text("GPU %-9s %7.2f ms", std::string(time.name).c_str(), time.ms);
  draw_memory(facts.draw.memory);
  if (facts.draw.waiting > 0) ImGui::Text("%zu waiting", facts.draw.waiting);
  ImGui::Text("carve radius %.2f m", static_cast<double>(facts.carve_radius_m));
  if (!facts.notice.empty()) ImGui::TextColored(ImVec4(1.0F, 0.6F, 0.4F, 1.0F), "%s", facts.notice.c_str());
  ImGui::End();
}

void Hud::draw(const HudFacts& facts, float frame_ms) {
  frame_ms_ += (frame_ms - frame_ms_) * (frame_ms_ > 0.0F ? 0.1F : 1.0F);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  draw_crosshair();
  draw_figures(facts);
  if (help_) draw_help();
  if (facts.lost) draw_banner(facts.connection);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace scree
