#include "client/viewer/window/hud_panels.h"

#include <algorithm>
#include <imgui/imgui.h>
#include <utility>

#include "shared/base/check.h"

namespace scree {
namespace {

constexpr std::array<const char*, panel_places> names{
    "top", "bottom", "upper left", "lower left", "upper right", "lower right", "lowest"};

}  // namespace

void HudPanels::begin_frame(glm::vec2 screen, bool mouse_is_free) {
  mouse_is_free_ = mouse_is_free;
  wanted_ = measured_;
  measured_ = {};
  seen_ = {};
  placed_ = lay_out(screen, wanted_);
  fit_text(screen);
}

int HudPanels::text_px(int asked) {
  if (std::exchange(asked_px_, asked) != asked) fitting_px_ = asked;
  return std::clamp(fitting_px_, std::min(asked, text_px_min), asked);
}

/// Text becomes only smaller while the same panels are shown, so that it never goes to and fro.
void HudPanels::fit_text(glm::vec2 screen) {
  unsigned places = 0;
  for (size_t i = 0; i < panel_places; ++i)
    if (wanted_[i].x > 0.0F) places |= 1U << i;
  const bool same_screen = std::exchange(screen_, screen) == screen;
  const bool same_places = std::exchange(shown_places_, places) == places;
  const float wanted = columns_width(wanted_);
  if (!same_screen || !same_places) {
    fitting_px_ = asked_px_;
  } else if (wanted > screen.x) {
    fitting_px_ = std::min(fitting_px_, static_cast<int>(measured_px_ * screen.x / wanted));
  }
  measured_px_ = ImGui::GetFontSize();
}

void HudPanels::begin(PanelPlace place) {
  open_ = place;
  const size_t i = index_of(place);
  CHECK(measured_[i] == glm::vec2(0.0F));
  const bool known = placed_[i].size.x > 0.0F;
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                           ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                           ImGuiWindowFlags_NoNav;
  if (!mouse_is_free_) flags |= ImGuiWindowFlags_NoInputs;
  if (!scrolls(place)) flags |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  seen_[i] = placed_[i];
  const ImVec2 out_of_sight(-10000.0F, -10000.0F);
  ImGui::SetNextWindowPos(known ? ImVec2(placed_[i].at.x, placed_[i].at.y) : out_of_sight);
  ImGui::SetNextWindowSize(known ? ImVec2(placed_[i].size.x, placed_[i].size.y) : ImVec2(1.0F, 1.0F));
  ImGui::SetNextWindowBgAlpha(0.55F);
  ImGui::Begin(names[i], nullptr, flags);
  ImGui::BeginGroup();
}

void HudPanels::end() {
  ImGui::EndGroup();
  const size_t i = index_of(open_);
  const ImVec2 content = ImGui::GetItemRectSize(), padding = ImGui::GetStyle().WindowPadding;
  measured_[i] = {content.x + 2.0F * padding.x, content.y + 2.0F * padding.y};
  if (scrolls(open_)) measured_[i].x += ImGui::GetStyle().ScrollbarSize;
  ImGui::End();
}

bool HudPanels::scrolls(PanelPlace place) const {
  const size_t i = index_of(place);
  return placed_[i].size.y > 0.0F && placed_[i].size.y < wanted_[i].y;
}

bool HudPanels::clips(PanelPlace place) const {
  const size_t i = index_of(place);
  return placed_[i].size.x > 0.0F && placed_[i].size.x < wanted_[i].x;
}

}  // namespace scree
