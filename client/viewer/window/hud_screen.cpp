#include "client/viewer/window/hud_screen.h"

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>
#include <utility>

namespace scree {
namespace {

/// In smaller letters the dot in a zero makes it an eight.
constexpr int dotted_zero_px_min = 13;

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
}

HudScreen::~HudScreen() {
  if (has_window_) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
  }
  ImGui::DestroyContext();
}

/// Letters of that height, pixel by pixel: letters of another height, made larger or smaller, lose their
/// dots.
void HudScreen::make_font(int text_px) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  ImFontConfig config;
  config.SizePixels = static_cast<float>(text_px);
  config.OversampleH = 1;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  ImFont* font = fonts.AddFontDefault(&config);
  fonts.Build();
  if (text_px < dotted_zero_px_min) font->AddRemapChar('0', 'O');
  if (!has_window_) return;
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void HudScreen::begin(bool mouse_is_free, int text_px) {
  ImGui::GetIO().ConfigFlags =
      mouse_is_free ? ImGuiConfigFlags_None : ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange;
  if (has_window_) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
  }
  if (std::exchange(text_px_, text_px) != text_px) make_font(text_px);
  ImGui::NewFrame();
}

float HudScreen::shown_px() {
  return ImGui::GetFontSize();
}

float HudScreen::made_px() {
  return ImGui::GetFont()->FontSize;
}

void HudScreen::end() {
  ImGui::Render();
  if (has_window_) ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace scree
