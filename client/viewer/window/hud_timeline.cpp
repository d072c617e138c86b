// The HUD's timeline of a replay: a bar with the events, and the buttons under it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <imgui/imgui.h>

#include "client/viewer/window/hud.h"

namespace scree {
namespace {

constexpr float bar_height_in_text = 2.2F;
constexpr float mark_width_min = 2.0F;  ///< pixels
constexpr float near_pixels = 3.0F;     ///< of the mouse: these events are told

const ImU32 ground_colour = IM_COL32(10, 12, 16, 200);
const ImU32 played_colour = IM_COL32(255, 255, 255, 26);
const ImU32 unread_colour = IM_COL32(255, 255, 255, 14);
const ImU32 hand_colour = IM_COL32(255, 255, 255, 240);
const ImU32 grows_colour = IM_COL32(255, 105, 95, 255);
const ImVec4 refusal_colour(1.0F, 0.75F, 0.4F, 1.0F);

ImVec4 colour_of(EventKind kind) {
  switch (kind) {
    case EventKind::carve:
      return {1.00F, 0.70F, 0.25F, 1.0F};
    case EventKind::fill:
      return {0.45F, 0.90F, 0.50F, 1.0F};
    case EventKind::paint:
      return {0.95F, 0.60F, 0.90F, 1.0F};
    case EventKind::dent:
      return {0.75F, 0.65F, 0.50F, 1.0F};
    case EventKind::crush:
      return {0.85F, 0.45F, 0.30F, 1.0F};
    case EventKind::broke:
      return {1.00F, 0.40F, 0.35F, 1.0F};
    case EventKind::fall:
      return {0.98F, 0.92F, 0.40F, 1.0F};
    case EventKind::merge:
      return {0.40F, 0.75F, 1.00F, 1.0F};
    case EventKind::setting:
      return {0.70F, 0.60F, 1.00F, 1.0F};
    case EventKind::rebuild:
      return {0.85F, 0.85F, 0.85F, 1.0F};
    case EventKind::join:
      return {0.35F, 0.90F, 0.85F, 1.0F};
    case EventKind::leave:
      return {0.30F, 0.60F, 0.60F, 1.0F};
    case EventKind::slow:
      return {1.00F, 0.30F, 0.65F, 1.0F};
    case EventKind::contact:
      return {0.90F, 0.85F, 0.75F, 1.0F};
    case EventKind::joint_ended:
      return {0.80F, 0.55F, 0.20F, 1.0F};
    case EventKind::prop_added:
      return {0.60F, 0.80F, 0.30F, 1.0F};
    case EventKind::prop_removed:
      return {0.45F, 0.55F, 0.25F, 1.0F};
    case EventKind::region_enter:
      return {0.35F, 0.65F, 0.95F, 1.0F};
    case EventKind::region_leave:
      return {0.25F, 0.40F, 0.70F, 1.0F};
    case EventKind::hurt:
      return {1.00F, 0.20F, 0.20F, 1.0F};
    case EventKind::buried:
      return {0.60F, 0.25F, 0.20F, 1.0F};
    case EventKind::dig:
      return {0.65F, 0.50F, 0.90F, 1.0F};
    case EventKind::place:
      return {0.45F, 0.75F, 0.90F, 1.0F};
  }
  return {};
}

/// The kinds that there are, by which the bar has its rows; and of each the most in a column.
struct Rows {
  explicit Rows(const MarksMessage& marks) {
    for (const Mark& mark : marks.marks) {
      uint32_t& most_of_kind = most[static_cast<size_t>(mark.kind)];
      if (most_of_kind == 0) kinds.push_back(mark.kind);
      most_of_kind = std::max(most_of_kind, mark.count);
    }
  }
  std::vector<EventKind> kinds;
  std::array<uint32_t, kind_count<EventKind>> most{};
};

/// The bar's rectangle on the screen, and the recording's ticks in it.
struct Bar {
  ImVec2 at;
  ImVec2 size;
  double first = 0.0, last = 1.0;

  Bar(ImVec2 upper_left, ImVec2 extent, const PlaybackMessage& playback)
      : at(upper_left),
        size(extent),
        first(static_cast<double>(playback.first)),
        last(std::max(static_cast<double>(playback.last), first + 1.0)) {}

  float x_of(double tick) const {
    return at.x + size.x * static_cast<float>(std::clamp((tick - first) / (last - first), 0.0, 1.0));
  }
  double tick_at(float x) const {
    return first + (last - first) * std::clamp(static_cast<double>((x - at.x) / size.x), 0.0, 1.0);
  }
  /// Left and right end of a mark.
  std::pair<float, float> span_of(const Mark& mark, const MarksMessage& marks) const {
    const auto length = static_cast<double>(marks.ticks_per_column);
    const double begin = static_cast<double>(marks.first) + length * mark.column;
    const float left = x_of(begin);
    return {left, std::min(std::max(x_of(begin + length), left + mark_width_min), at.x + size.x)};
  }
};

/// A row for each kind that there is; the more events, the brighter.
void draw_marks(ImDrawList& list, const Bar& bar, const MarksMessage& marks) {
  const Rows rows(marks);
  if (rows.kinds.empty()) return;
  const float height = bar.size.y / static_cast<float>(rows.kinds.size());
  for (const Mark& mark : marks.marks) {
    const auto row = static_cast<float>(std::ranges::find(rows.kinds, mark.kind) - rows.kinds.begin());
    const auto [left, right] = bar.span_of(mark, marks);
    ImVec4 colour = colour_of(mark.kind);
    const auto most = static_cast<float>(rows.most[static_cast<size_t>(mark.kind)]);
    colour.w = 0.55F + 0.45F * std::log1p(static_cast<float>(mark.count)) / std::log1p(most);
    const float top = bar.at.y + row * height;
    list.AddRectFilled(ImVec2(left, top), ImVec2(right, top + std::max(height - 1.0F, 1.0F)),
                       ImGui::ColorConvertFloat4ToU32(colour));
  }
}

void draw_bar(const Bar& bar, const Timeline& timeline, double moment) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(bar.at.x + bar.size.x, bar.at.y + bar.size.y);
  list.AddRectFilled(bar.at, end, ground_colour);
  const float x = bar.x_of(moment);
  list.AddRectFilled(bar.at, ImVec2(x, end.y), played_colour);
  const float read = bar.x_of(static_cast<double>(timeline.marks().read_to));
  if (!timeline.marks().marks.empty()) list.AddRectFilled(ImVec2(read, bar.at.y), end, unread_colour);
  draw_marks(list, bar, timeline.marks());
  if (timeline.playback().grows) list.AddRectFilled(ImVec2(end.x - 2.0F, bar.at.y), end, grows_colour);
  const float half = 0.18F * bar.size.y;
  list.AddRectFilled(ImVec2(x - 1.0F, bar.at.y), ImVec2(x + 1.0F, end.y), hand_colour);
  list.AddTriangleFilled(ImVec2(x - half, bar.at.y), ImVec2(x + half, bar.at.y),
                         ImVec2(x, bar.at.y + 1.4F * half), hand_colour);
}

/// "3 carve, 1 fall": of the columns near the mouse.
std::string events_near(const Bar& bar, const MarksMessage& marks, float x) {
  std::array<uint64_t, kind_count<EventKind>> counts{};
  for (const Mark& mark : marks.marks) {
    const auto [left, right] = bar.span_of(mark, marks);
    if (left <= x + near_pixels && right >= x - near_pixels)
      counts[static_cast<size_t>(mark.kind)] += mark.count;
  }
  std::string text;
  for (const EventKind kind : all_kinds<EventKind>)
    if (const uint64_t count = counts[static_cast<size_t>(kind)]; count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(name_of(kind));
  return text;
}

std::string moment_text(const Timeline& timeline, double tick) {
  return time_text(tick, timeline.tick_rate_hz()) + " of " +
         time_text(static_cast<double>(timeline.playback().last), timeline.tick_rate_hz());
}

/// Above the bar, so that it hides neither that nor what stands under it.
void tell_what_is_near(const Bar& bar, const Timeline& timeline) {
  const float x = ImGui::GetIO().MousePos.x;
  const float middle = std::clamp(x, bar.at.x, bar.at.x + bar.size.x);
  ImGui::SetNextWindowPos(ImVec2(middle, bar.at.y - ImGui::GetStyle().WindowPadding.y), ImGuiCond_Always,
                          ImVec2((middle - bar.at.x) / bar.size.x, 1.0F));
  const double tick = bar.tick_at(x);
  const std::string near = events_near(bar, timeline.marks(), x);
  ImGui::SetTooltip("%s, tick %.0f%s%s", time_text(tick, timeline.tick_rate_hz()).c_str(), tick,
                    near.empty() ? "" : "\n", near.c_str());
}

/// Dragging goes through the recording.
void show_bar(Timeline& timeline, float width, double now_s) {
  const ImVec2 size(width, std::max(std::round(bar_height_in_text * ImGui::GetFontSize()), 1.0F));
  const Bar bar(ImGui::GetCursorScreenPos(), size, timeline.playback());
  ImGui::InvisibleButton("bar", size);
  if (ImGui::IsItemActive()) timeline.seek(bar.tick_at(ImGui::GetIO().MousePos.x));
  draw_bar(bar, timeline, timeline.moment(now_s));
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) tell_what_is_near(bar, timeline);
}

void show_buttons(Timeline& timeline) {
  const PlaybackMessage& playback = timeline.playback();
  const auto button = [&](const char* text, Action action, const char* does) {
    if (ImGui::SmallButton(text)) timeline.act(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", does);
    ImGui::SameLine();
  };
  ImGui::BeginDisabled(!timeline.may_control());
  button(playback.playing ? "hold" : "play", Action::replay_play, "J");
  button(playback.speed > 0.0F ? "backwards" : "forwards ", Action::replay_turn, "Y");
  button("-", Action::replay_slower, "slower (Down)");
  button("+", Action::replay_faster, "faster (Up)");
  std::array<char, 16> speed{};
  std::snprintf(speed.data(), speed.size(), "%gx", static_cast<double>(playback.speed));
  ImGui::Text("%-5s", speed.data());
  ImGui::SameLine();
  button("< event", Action::replay_previous_event, "the previous event (9)");
  button("event >", Action::replay_next_event, "the next event (0)");
  ImGui::EndDisabled();
}

/// As much of it as there is room for up to `right`, on the screen.
class Rest {
 public:
  explicit Rest(float right) : right_(right) {}

  void text(const std::string& text, const ImVec4& colour) {
    if (!has_room(ImGui::CalcTextSize(text.c_str()).x)) return;
    ImGui::TextColored(colour, "%s", text.c_str());
    ImGui::SameLine();
  }
  /// Squares of the kinds' colours, and their names: all, or none.
  void legend(const std::vector<EventKind>& kinds) {
    float width = 0.0F;
    for (const EventKind kind : kinds) width += width_of(kind);
    if (!has_room(width)) return;
    for (const EventKind kind : kinds) add(kind);
  }

 private:
  static constexpr float gap = 4.0F;  ///< pixels, between a square and its name

  bool has_room(float width) const { return ImGui::GetCursorScreenPos().x + width <= right_; }
  static float side() { return 0.7F * ImGui::GetFontSize(); }
  static float width_of(EventKind kind) {
    return side() + gap + ImGui::CalcTextSize(std::string(name_of(kind)).c_str()).x +
           ImGui::GetStyle().ItemSpacing.x;
  }
  static void add(EventKind kind) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5F * (ImGui::GetFontSize() - side());
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, top), ImVec2(at.x + side(), top + side()),
                                              ImGui::ColorConvertFloat4ToU32(colour_of(kind)));
    ImGui::Dummy(ImVec2(side(), ImGui::GetFontSize()));
    ImGui::SameLine(0.0F, gap);
    ImGui::TextUnformatted(std::string(name_of(kind)).c_str());
    ImGui::SameLine();
  }

  float right_;
};

void show_rest(const Timeline& timeline, double moment, float right) {
  const ImVec4 plain = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  Rest rest(right);
  rest.text(moment_text(timeline, moment), plain);
  if (timeline.playback().grows) rest.text("being recorded", ImGui::ColorConvertU32ToFloat4(grows_colour));
  rest.text("tick " + std::to_string(std::llround(moment)), ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  rest.legend(Rows(timeline.marks()).kinds);
  ImGui::NewLine();
}

}  // namespace

void Hud::timeline(Timeline& timeline, double now_s) {
  if (!timeline.is_known()) return;
  const float around = panel_margin + ImGui::GetStyle().WindowPadding.x;
  const float width = std::max(ImGui::GetIO().DisplaySize.x - 2.0F * around, 1.0F);
  panels_.begin(PanelPlace::lowest);
  const float right = ImGui::GetCursorScreenPos().x + width;
  show_bar(timeline, width, now_s);
  show_buttons(timeline);
  show_rest(timeline, timeline.moment(now_s), right);
  if (!timeline.may_control()) {
    ImGui::PushTextWrapPos(width + ImGui::GetStyle().WindowPadding.x);
    ImGui::TextColored(refusal_colour, "you may only look on: %s", timeline.playback().refusal.c_str());
    ImGui::PopTextWrapPos();
  }
  panels_.end();
}

}  // namespace scree
