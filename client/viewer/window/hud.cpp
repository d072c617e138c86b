#include "client/viewer/window/hud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui/imgui.h>
#include <span>

#include "proto/person_name.h"

namespace scree {
namespace {

const ImVec4 warning_colour(1.0F, 0.75F, 0.4F, 1.0F);
constexpr float progress_width_in_text = 24.0F;  ///< heights of the text
/// The same while one is in the world: it tells, and hides nothing.
constexpr float slim_width_in_text = 8.0F, slim_height_in_text = 0.25F;
constexpr float said_width_in_text = 36.0F;  ///< about 65 letters: longer lines are hard to read
constexpr float menu_width_in_text = 22.0F;  ///< likewise

glm::vec2 screen_size() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  return {size.x, size.y};
}

/// The greatest width of a line of the middle's strips.
float line_width() {
  const float width = screen_size().x - 2.0F * (panel_margin + ImGui::GetStyle().WindowPadding.x);
  return std::max(std::min(width, said_width_in_text * ImGui::GetFontSize()), 1.0F);
}

/// How high it is, with the gap to the next one.
float height_of(const std::string& line) {
  return ImGui::CalcTextSize(line.c_str(), nullptr, false, line_width()).y + ImGui::GetStyle().ItemSpacing.y;
}

/// The last ones that there is room for in a strip, beside something of height `taken`; the last in any case.
std::span<const std::string> last_lines(const std::vector<std::string>& lines, float taken) {
  float room = (screen_size().y - 2.0F * panel_margin) * strip_share_max + ImGui::GetStyle().ItemSpacing.y -
               2.0F * ImGui::GetStyle().WindowPadding.y - taken;
  size_t first = lines.size();
  while (first > 0) {
    room -= height_of(lines[first - 1]);
    if (room < 0.0F && first < lines.size()) break;
    --first;
  }
  return std::span(lines).subspan(first);
}

/// A line of the middle's strips, broken where it gets too wide.
void say(const std::string& text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(ImGui::GetStyle().WindowPadding.x + line_width());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// Returns how high it is, with the gap to what comes next.
float show_progress(const Preparing& preparing) {
  const float text = ImGui::GetFontSize(), share = preparing.share();
  if (preparing.goes_on) {
    ImGui::ProgressBar(share, ImVec2(slim_width_in_text * text, slim_height_in_text * text), "");
  } else {
    const std::string words = "making the world: " + std::to_string(std::lround(100.0F * share)) + " %";
    ImGui::ProgressBar(share, ImVec2(progress_width_in_text * text, 0.0F), words.c_str());
  }
  return ImGui::GetItemRectSize().y + ImGui::GetStyle().ItemSpacing.y;
}

/// With a shadow, to be read on anything.
void write_in_picture(ImDrawList& list, ImVec2 at, ImU32 colour, const std::string& text) {
  list.AddText(ImVec2(at.x + 1.0F, at.y + 1.0F), IM_COL32(0, 0, 0, 200), text.c_str());
  list.AddText(at, colour, text.c_str());
}

}  // namespace

int Hud::text_px(float text_scale) {
  constexpr float unscaled_px = 13.0F;
  return panels_.text_px(static_cast<int>(std::lround(unscaled_px * text_scale)));
}

void Hud::begin(bool mouse_is_free) {
  panels_.begin_frame(screen_size(), mouse_is_free);
}

void Hud::crosshair(const HudFacts& facts) {
  const glm::vec2 c = screen_size() * 0.5F;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  if (facts.mark == StrikeMark::refused) {
    const ImU32 warning = ImGui::GetColorU32(warning_colour);
    list->AddLine(ImVec2(c.x - 8, c.y - 8), ImVec2(c.x + 8, c.y + 8), warning, 2.5F);
    list->AddLine(ImVec2(c.x - 8, c.y + 8), ImVec2(c.x + 8, c.y - 8), warning, 2.5F);
    const ImVec2 text = ImGui::CalcTextSize(facts.refused.c_str());
    write_in_picture(*list, {c.x - 0.5F * text.x, c.y + 14.0F}, warning, facts.refused);
    return;
  }
  if (facts.mark == StrikeMark::hit) {
    const ImU32 struck = IM_COL32(255, 255, 255, 240);
    for (const glm::vec2 way : {glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(-1, -1)})
      list->AddLine(ImVec2(c.x + 6 * way.x, c.y + 6 * way.y), ImVec2(c.x + 12 * way.x, c.y + 12 * way.y),
                    struck, 2.0F);
  }
  const ImU32 colour = IM_COL32(255, 255, 255, 190);
  list->AddLine(ImVec2(c.x - 9, c.y), ImVec2(c.x - 3, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x + 3, c.y), ImVec2(c.x + 9, c.y), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y - 9), ImVec2(c.x, c.y - 3), colour, 1.5F);
  list->AddLine(ImVec2(c.x, c.y + 3), ImVec2(c.x, c.y + 9), colour, 1.5F);
}

bool Hud::lost(const HudFacts& facts) {
  panels_.begin(PanelPlace::top);
  say(facts.connection, warning_colour);
  bool now = false;
  if (facts.retry_s) {
    ImGui::Text("next attempt in %.0f s", std::ceil(*facts.retry_s));
    ImGui::SameLine();
    now = ImGui::SmallButton("try now (Enter)");
  }
  panels_.end();
  return now;
}

MenuChoice Hud::menu(MenuKeys& keys, std::string_view note) {
  constexpr std::array<const char*, MenuKeys::buttons> words{"back to the world (Esc)", "all keys", "end"};
  const glm::vec2 middle = screen_size() * 0.5F;
  ImGui::SetNextWindowPos(ImVec2(middle.x, middle.y), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowFocus();
  ImGui::Begin("menu", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
  const ImVec2 size(menu_width_in_text * ImGui::GetFontSize(), 1.8F * ImGui::GetFontSize());
  MenuChoice choice = keys.chosen ? static_cast<MenuChoice>(keys.at) : MenuChoice::none;
  for (int i = 0; i < MenuKeys::buttons; ++i) {
    // Only the button that Enter would choose is lit; the mouse takes it along.
    const ImVec4 colour = ImGui::GetStyleColorVec4(i == keys.at ? ImGuiCol_ButtonActive : ImGuiCol_Button);
    ImGui::PushStyleColor(ImGuiCol_Button, colour);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colour);
    if (ImGui::Button(words[static_cast<size_t>(i)], size)) choice = static_cast<MenuChoice>(i);
    ImGui::PopStyleColor(2);
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (ImGui::IsItemHovered() && (moved.x != 0.0F || moved.y != 0.0F)) keys.at = i;
  }
  ImGui::TextDisabled("arrow keys and Enter choose");
  if (!note.empty()) {
    ImGui::PushTextWrapPos(ImGui::GetStyle().WindowPadding.x + size.x);
    ImGui::TextUnformatted(note.data(), note.data() + note.size());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  return choice;
}

void Hud::messages(const HudFacts& facts, const std::vector<std::string>& lines) {
  if (!facts.preparing && facts.notice.empty() && lines.empty()) return;
  panels_.begin(PanelPlace::bottom);
  float taken = facts.preparing ? show_progress(*facts.preparing) : 0.0F;
  if (!facts.notice.empty()) {
    say(facts.notice, warning_colour);
    taken += height_of(facts.notice);
  }
  for (const std::string& line : last_lines(lines, taken)) say(line, ImGui::GetStyleColorVec4(ImGuiCol_Text));
  panels_.end();
}

void Hud::help(Telling telling, bool gamepad, ControlsOf of) {
  if (telling == Telling::nothing) return;
  panels_.begin(PanelPlace::lower_left);
  ImGui::TextUnformatted(describe_controls(telling, gamepad, of).c_str());
  panels_.end();
}

void Hud::names(const Figures& figures, const glm::mat4& view_projection,
                std::optional<uint64_t> looked_through) {
  const glm::vec2 size = screen_size();
  for (const auto& [session, figure] : figures.all()) {
    const std::optional<glm::vec2> place = Figures::place_of_name(figure, view_projection);
    if (!place || session == looked_through) continue;
    const std::string name = called(session, figure.name);
    const ImVec2 text = ImGui::CalcTextSize(name.c_str());
    const ImVec2 at(place->x * size.x - 0.5F * text.x, place->y * size.y - text.y);
    write_in_picture(*ImGui::GetBackgroundDrawList(), at, IM_COL32(255, 255, 255, 255), name);
  }
}

void Hud::lower_right(const HudFacts& facts, const PersonsMessage* persons, const PersonColours& colours,
                      bool with_graphs) {
  if (persons == nullptr && !with_graphs) return;
  panels_.begin(PanelPlace::lower_right);
  if (persons != nullptr) {
    ImGui::Text("persons: %zu", persons->persons.size() + persons->more);
    for (const Person& person : persons->persons) {
      const LineColour colour = colours.of(person.session);
      ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(colour.red, colour.green, colour.blue, 255));
      ImGui::TextUnformatted(called(person.session, person.name).c_str());
      ImGui::PopStyleColor();
      ImGui::SameLine();
      ImGui::TextUnformatted(std::string(name_of(person.role)).c_str());
    }
    if (persons->more > 0) ImGui::Text("and %u more", persons->more);
    if (persons->persons.size() + persons->more < 2) ImGui::TextUnformatted("nobody else is here");
    ImGui::TextUnformatted(persons->chat ? "Enter: say something to all" : "there is no chat here");
  }
  if (with_graphs) graphs(facts);
  panels_.end();
}

}  // namespace scree
