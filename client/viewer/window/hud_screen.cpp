#include "client/viewer/window/hud_screen.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

namespace scree {
namespace {

void begin_context() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4.0F;
  ImGui::GetStyle().WindowMinSize = ImVec2(1.0F, 1.0F);
}

}  // namespace

HudScreen::HudScreen(const AppWindow& window) : has_window_(true) {
  begin_context();
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init();
}

HudScreen::HudScreen(glm::vec2 size) : has_window_(false) {
  begin_context();
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(size.x, size.y);
  io.DeltaTime = 1.0F / 60.0F;
  io.Fonts->Build();
}

HudScreen::~HudScreen() {
  if (has_window_) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
  }
  ImGui::DestroyContext();
}

void HudScreen::begin(bool mouse_is_free, float text_scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags =
      mouse_is_free ? ImGuiConfigFlags_None : ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange;
  io.FontGlobalScale = text_scale;
  if (has_window_) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
  }
  ImGui::NewFrame();
}

void HudScreen::end() {
  ImGui::Render();
  if (has_window_) ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace scree
