#include "client/viewer/window/hud.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>

#include "client/viewer/window/hud_style.h"

namespace scree {

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

void Hud::begin(bool mouse_is_free) {
  mouse_is_free_ = mouse_is_free;
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags =
      mouse_is_free ? ImGuiConfigFlags_None : ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Hud::crosshair() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const ImVec2 c(size.x * 0.5F, size.y * 0.5F);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImU32 colour = IM_COL32(255, 255, 255, 190);
  list->AddLine(ImVec2(c.x - 9, c.y), ImVec2(c.x - 3, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x + 3, c.y), ImVec2(c.x + 9, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y - 9), ImVec2(c.x, c.y - 3), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y + 3), ImVec2(c.x, c.y + 9), colour, 1.5F);
}

void Hud::banner(const std::string& text) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_overlay("banner", ImVec2(size.x * 0.5F, size.y * 0.25F), ImVec2(0.5F, 0.5F));
  ImGui::TextColored(ImVec4(1.0F, 0.75F, 0.4F, 1.0F), "%s", text.c_str());
  ImGui::End();
}

void Hud::help() {
  begin_overlay("help", ImVec2(12.0F, ImGui::GetIO().DisplaySize.y - 12.0F), ImVec2(0.0F, 1.0F));
  ImGui::TextUnformatted(describe_controls().c_str());
  ImGui::End();
}

void Hud::names(const std::vector<PlayerCursor>& cursors, const glm::mat4& view_projection) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  for (const PlayerCursor& cursor : cursors) {
    const glm::vec4 place = view_projection * glm::vec4(cursor.aim_m, 1.0F);
    if (place.w <= 0.0F) continue;
    const ImVec2 at((place.x / place.w * 0.5F + 0.5F) * size.x + 8.0F,
                    (0.5F - place.y / place.w * 0.5F) * size.y - 8.0F);
    const std::string name = cursor.name.empty() ? "client " + std::to_string(cursor.session) : cursor.name;
    ImGui::GetBackgroundDrawList()->AddText(at, IM_COL32(120, 240, 255, 255), name.c_str());
  }
}

void Hud::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace scree
