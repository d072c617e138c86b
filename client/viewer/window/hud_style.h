// The style of the HUD's windows. Used by hud*.cpp only.
#pragma once

#include <imgui/imgui.h>

namespace scree {

/// A window without a frame around it, at a place of the screen; `pivot` says which of its points lies there.
/// Ended by ImGui::End().
inline void begin_overlay(const char* name, ImVec2 place, ImVec2 pivot, bool takes_input = false) {
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                           ImGuiWindowFlags_NoMove;
  if (!takes_input) flags |= ImGuiWindowFlags_NoInputs;
  ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.55F);
  ImGui::Begin(name, nullptr, flags);
}

}  // namespace scree
