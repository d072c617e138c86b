// The HUD's panel: the tool, the view, and for developers the drawing.
#include <algorithm>
#include <array>
#include <cmath>
#include <imgui/imgui.h>

#include "client/viewer/base/limits.h"
#include "client/viewer/window/hud.h"
#include "shared/base/limits.h"

namespace scree {
namespace {

constexpr float slider_width_in_text = 11.5F;  ///< heights of the text

template <typename E, size_t n>
void choose(E& value, const std::array<E, n>& all) {
  constexpr size_t on_line = 5;  // more would make the panel wide
  for (size_t i = 0; i < n; ++i) {
    if (i % on_line != 0) ImGui::SameLine();
    const std::string name(name_of(all[i]));
    if (ImGui::RadioButton(name.c_str(), value == all[i])) value = all[i];
  }
}

/// Three on a line. Methods that this driver cannot make are grey, with the reason.
const MethodEntry* choose_method(const MethodEntry& chosen) {
  const MethodEntry* picked = nullptr;
  int on_line = 0;
  for (const MethodEntry& entry : all_methods()) {
    const std::optional<std::string> missing = entry.missing();
    if (on_line++ % 3 != 0) ImGui::SameLine();
    const std::string name(entry.name);
    ImGui::BeginDisabled(missing.has_value());
    if (ImGui::RadioButton(name.c_str(), &entry == &chosen) && &entry != &chosen) picked = &entry;
    ImGui::EndDisabled();
    if (!missing) continue;
    ImGui::TextDisabled("    %s", missing->c_str());
    on_line = 0;
  }
  return picked;
}

/// A number by a slider that goes from value to value, a name by a button for each.
void choose_option(const DrawOption& option, DrawOptionValues& values) {
  const int chosen = values.of(option);
  if (option.is_number()) {
    auto place = static_cast<int>(index_of(option, chosen));
    const std::string text = std::to_string(chosen) + " " + std::string(option.unit);
    if (ImGui::SliderInt(std::string(option.label).c_str(), &place, 0,
                         static_cast<int>(option.values.size()) - 1, text.c_str(),
                         ImGuiSliderFlags_AlwaysClamp))
      values.set(option, option.values[static_cast<size_t>(place)]);
    return;
  }
  for (const int value : option.values) {
    if (value != option.values.front()) ImGui::SameLine();
    if (ImGui::RadioButton(text_of(option, value).c_str(), value == chosen)) values.set(option, value);
  }
}

void choose_quality(std::optional<Quality>& quality) {
  const std::string name(auto_name);
  if (ImGui::RadioButton(name.c_str(), !quality)) quality.reset();
  for (const Quality one : all_kinds<Quality>) {
    ImGui::SameLine();
    if (ImGui::RadioButton(std::string(name_of(one)).c_str(), quality == one)) quality = one;
  }
}

constexpr const char* as_the_ground = "as the ground";

/// A line of the list: a swatch, and the name.
bool material_line(const MaterialRow& row, bool chosen) {
  const auto& [red, green, blue] = row.look.colour;
  const auto bright = [](float part) { return std::sqrt(part); };  // linear to what a screen shows, about
  const ImVec4 colour(bright(red), bright(green), bright(blue), 1.0F);
  ImGui::PushID(row.name.c_str());
  const float side = ImGui::GetTextLineHeight();
  ImGui::ColorButton("##colour", colour, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                     ImVec2(side, side));
  ImGui::SameLine();
  const bool picked = ImGui::Selectable(row.name.c_str(), chosen);
  ImGui::PopID();
  return picked;
}

/// What is filled or painted with: the palette's rows, and before them nothing of one's own for a fill.
void choose_material(Tool& tool, const Palette& palette) {
  const std::optional<Material> chosen = material_of(tool, palette);
  const std::string shown = chosen ? palette.row(*chosen).name : as_the_ground;
  if (!ImGui::BeginCombo("material", shown.c_str())) return;
  if (traits_of(tool.use).as_ground && ImGui::Selectable(as_the_ground, !chosen)) tool.material.clear();
  for (size_t i = 0; i < palette.rows.size(); ++i)
    if (material_line(palette.rows[i], chosen == static_cast<Material>(i)))
      tool.material = palette.rows[i].name;
  ImGui::EndCombo();
}

/// What a carve breaks into, or what is filled or painted with.
void choose_use(Tool& tool, const Palette& palette) {
  // What is placed is one of those that one carries: the tool line and its key say which.
  if (traits_of(tool.use).has_material && tool.use != ToolUse::place) choose_material(tool, palette);
  if (tool.use != ToolUse::carve) return;
  ImGui::SliderFloat("blast", &tool.blast_speed_m_s, 0.0F, limits::blast_speed_max_m_s, "%.0f m/s");
  choose(tool.pattern, tool_patterns);
  auto seeds = static_cast<int>(tool.seeds);
  const std::string text =
      tool.seeds > 0 ? "about %d" : "about " + std::to_string(seeds_of(tool)) + ", by size";
  if (ImGui::SliderInt("pieces", &seeds, 0, static_cast<int>(tool_seeds_max), text.c_str()))
    tool.seeds = static_cast<uint32_t>(std::max(seeds, 0));
}

/// How it is drawn, and what else only a developer asks for.
const MethodEntry* choose_drawing(const MethodEntry& chosen, const PanelValues& values) {
  ImGui::Separator();
  const MethodEntry* picked = choose_method(chosen);
  for (const DrawOption& option : options_of(chosen)) choose_option(option, values.method_options);
  ImGui::Checkbox("show own carves at once", &values.predict);
  OverlayChoice& overlay = values.overlay;
  ImGui::Checkbox("overlay", &overlay.shown);
  ImGui::BeginDisabled(!overlay.shown);
  ImGui::Checkbox("interest", &overlay.interest);
  ImGui::SameLine();
  ImGui::Checkbox("chunks", &overlay.chunks);
  ImGui::SameLine();
  ImGui::Checkbox("pieces", &overlay.pieces);
  ImGui::Checkbox("bodies, contacts, islands (by the server)", &overlay.physics);
  ImGui::EndDisabled();
  return picked;
}

void choose_tool(Tool& tool, const Palette& palette) {
  ToolUse use = tool.use;
  choose(use, all_kinds<ToolUse>);
  if (use != tool.use) take_up(tool, use);
  choose(tool.kind, all_kinds<ToolKind>);
  ImGui::SliderFloat("radius", &tool.radius_m, tool_radius_min_m, tool_radius_max_m, "%.2f m");
  choose_use(tool, palette);
  ImGui::Separator();
}

}  // namespace

const MethodEntry* Hud::panel(const MethodEntry& chosen, const PanelValues& values, PanelOf of) {
  panels_.begin(PanelPlace::upper_right);
  ImGui::PushItemWidth(slider_width_in_text * ImGui::GetFontSize());
  if (!of.replay) choose_tool(values.tool, values.palette);
  choose_quality(values.quality);
  ImGui::Checkbox("dust, grit and splinters", &values.particles);
  ImGui::Checkbox("grass, bushes and stones", &values.details);
  ImGui::Checkbox("blows shake the eye", &values.shake);
  HandChoice& hand = values.hand;
  ImGui::SliderFloat("field of view", &hand.field_of_view_degrees, field_of_view_min_degrees,
                     field_of_view_max_degrees, "%.0f degrees", ImGuiSliderFlags_AlwaysClamp);
  ImGui::SliderFloat("mouse", &hand.mouse_speed, mouse_speed_min, mouse_speed_max, "x %.2f",
                     ImGuiSliderFlags_AlwaysClamp);
  const MethodEntry* picked = of.developer ? choose_drawing(chosen, values) : nullptr;
  ImGui::PopItemWidth();
  panels_.end();
  return picked;
}

}  // namespace scree
