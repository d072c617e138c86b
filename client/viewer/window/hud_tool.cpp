// The HUD's tool line: what a click does, and what one carries.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui/imgui.h>

#include "client/viewer/window/hud.h"

namespace scree {
namespace {

const ImVec4 in_hand_colour(1.0F, 0.82F, 0.45F, 1.0F);
const ImVec4 full_colour(1.0F, 0.75F, 0.4F, 1.0F);
constexpr float bar_height_in_line = 0.6F;
constexpr float part_width_min = 3.0F;  ///< pixels of a material in the bar: a little is seen, too
constexpr double full_share = 0.97;     ///< of the store, over which the next bite may not fit

/// The uses with their keys; the one in hand is bright.
void show_uses(Tool& tool) {
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.0F, 0.0F, 0.0F, 0.0F));
  for (const ToolUse use : all_kinds<ToolUse>) {
    const std::string text = std::to_string(static_cast<int>(use) + 1) + " " + std::string(name_of(use));
    ImGui::PushStyleColor(ImGuiCol_Text,
                          use == tool.use ? in_hand_colour : ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (ImGui::SmallButton(text.c_str())) take_up(tool, use);
    ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  ImGui::PopStyleColor();
}

/// "takes    6.2 m³", always as wide: it changes with every look.
std::string amount_text(const Tool& tool, const std::optional<ToolAim>& aim, const Palette& palette) {
  const bool takes = tool.use == ToolUse::dig || tool.use == ToolUse::carve;
  const char* const verb = takes ? "takes" : "puts ";
  char text[32];
  if (tool.use == ToolUse::paint || !aim || !aim->volume_m3)
    std::snprintf(text, sizeof text, "%-15s", aim && aim->is_beyond ? "too far away" : "");
  else
    std::snprintf(text, sizeof text, "%s%7.1f m³", verb, *aim->volume_m3);
  if (!aim || !aim->material) return text;
  return text + (" " + palette.row_or_first(*aim->material).name);
}

ImU32 shown(const std::array<float, 3>& linear) {
  const auto& [red, green, blue] = linear;
  return ImGui::ColorConvertFloat4ToU32(ImVec4(std::sqrt(red), std::sqrt(green), std::sqrt(blue), 1.0F));
}

/// A part of the bar for each material, from the left; the whole of it is what the store holds.
void show_bar(const HudFacts& facts, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = std::round(bar_height_in_line * ImGui::GetFontSize());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, ImVec2(at.x + width, at.y + height), IM_COL32(255, 255, 255, 30));
  double all_m3 = facts.store_room_m3.value_or(0.0F);
  for (const CarriedRow& row : facts.carried)
    if (!facts.store_room_m3) all_m3 += row.volume_m3;
  float x = at.x;
  for (const CarriedRow& row : facts.carried) {
    const auto share = static_cast<float>(row.volume_m3 / std::max(all_m3, row.volume_m3));
    const float end = std::min(x + std::max(width * share, part_width_min), at.x + width);
    list.AddRectFilled(ImVec2(x, at.y), ImVec2(end, at.y + height), shown(row.colour));
    x = end;
  }
  ImGui::Dummy(ImVec2(width, height));
}

void show_carried(const HudFacts& facts) {
  double sum_m3 = 0.0;
  std::string text;
  char part[64];
  for (const CarriedRow& row : facts.carried) {
    sum_m3 += row.volume_m3;
    std::snprintf(part, sizeof part, "%s%.1f %s", text.empty() ? "" : ", ", row.volume_m3,
                  row.material.c_str());
    text += part;
  }
  const double room_m3 = facts.store_room_m3.value_or(0.0F);
  if (facts.store_room_m3 && sum_m3 >= full_share * room_m3)
    ImGui::TextColored(full_colour, "your store of %.0f m³ is full: 2 places rock, U gives all to the world",
                       room_m3);
  else if (facts.carried.empty())
    ImGui::TextDisabled("you carry nothing");
  else if (facts.store_room_m3)
    ImGui::Text("you carry %.1f of %.0f m³: %s", sum_m3, room_m3, text.c_str());
  else
    ImGui::Text("you carry %.1f m³: %s", sum_m3, text.c_str());
}

}  // namespace

void Hud::tool_line(Tool& tool, const std::optional<ToolAim>& aim, const HudFacts& facts,
                    const Palette& palette) {
  panels_.begin(PanelPlace::lowest);
  ImGui::BeginGroup();
  show_uses(tool);
  ImGui::Text(" %-6s %.2f m  %s", std::string(name_of(tool.kind)).c_str(), static_cast<double>(tool.radius_m),
              amount_text(tool, aim, palette).c_str());
  ImGui::EndGroup();
  const bool stores = tool.use == ToolUse::dig || tool.use == ToolUse::place;
  if (stores || !facts.carried.empty()) {
    show_bar(facts, ImGui::GetItemRectSize().x);
    show_carried(facts);
  }
  panels_.end();
}

}  // namespace scree
