#include "client/viewer/viewing/settings.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/viewer/base/files.h"
#include "client/viewer/base/json_depth.h"
#include "client/viewer/base/limits.h"
#include "shared/base/xdg_folder.h"
#include "shared/material/material_members.h"

namespace scree {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Reads one field after the other; keeps the first error.
class Reader {
 public:
  explicit Reader(const OrderedJson& json) : json_(json) {}

  void flag(const char* name, bool& value) {
    if (const OrderedJson* found = find(name, &OrderedJson::is_boolean)) value = found->get<bool>();
  }
  template <typename T>
  void number(const char* name, T& value, T min, T max) {
    const OrderedJson* found = find(name, &OrderedJson::is_number);
    if (found == nullptr) return;
    const auto given = found->get<double>();
    if (!(given >= static_cast<double>(min) && given <= static_cast<double>(max)))
      return wrong(name, "is out of range");
    value = static_cast<T>(given);
  }
  /// The place in `names`.
  template <typename E, size_t n>
  void choice(const char* name, E& value, const std::array<E, n>& all) {
    const OrderedJson* found = find(name, &OrderedJson::is_string);
    if (found == nullptr) return;
    for (const E one : all) {
      if (name_of(one) != found->get<std::string>()) continue;
      value = one;
      return;
    }
    wrong(name, "has no such value");
  }
  void text(const char* name, std::string& value) {
    if (const OrderedJson* found = find(name, &OrderedJson::is_string)) value = found->get<std::string>();
  }
  void option(const DrawOption& option, DrawOptionValues& values) {
    const std::string key = key_of(option);
    const OrderedJson* found =
        find(key.c_str(), option.is_number() ? &OrderedJson::is_number : &OrderedJson::is_string);
    if (found == nullptr) return;
    for (const int value : option.values) {
      const bool is_this = option.is_number() ? found->get<double>() == value
                                              : found->get<std::string>() == text_of(option, value);
      if (is_this) return values.set(option, value);
    }
    wrong(key.c_str(), "has no such value");
  }
  void wrong(const char* name, const char* how) {
    if (error_.empty()) error_ = std::string(name) + " " + how;
  }
  const std::string& error() const { return error_; }

 private:
  const OrderedJson* find(const char* name, bool (OrderedJson::*is_right)() const noexcept) {
    const auto found = json_.find(name);
    if (found == json_.end()) return nullptr;
    if (((*found).*is_right)()) return &*found;
    wrong(name, "is of another kind");
    return nullptr;
  }

  const OrderedJson& json_;
  std::string error_;
};

/// The value at the `end` if it changed since the `start`, else the loaded one.
template <typename T>
T merged(const T& loaded, const T& start, const T& end) {
  return start == end ? loaded : end;
}

}  // namespace

std::string settings_file() {
  const std::string folder = xdg_folder("XDG_CONFIG_HOME", ".config");
  return folder.empty() ? folder : folder + "/viewer.json";
}

Result<Settings> parse_settings(const std::string& text) {
  TRY(check_json_depth(text));
  const OrderedJson json = OrderedJson::parse(text, nullptr, false);
  if (!json.is_object()) return fail("it is not a JSON object");
  Settings settings;
  Reader reader(json);
  reader.number("width", settings.width, 1, limits::image_side_max);
  reader.number("height", settings.height, 1, limits::image_side_max);
  reader.text("method", settings.method);
  if (!settings.method.empty() && method_named(settings.method) == nullptr)
    reader.wrong("method", "has no such value");
  std::string quality(auto_name);
  reader.text("quality", quality);
  settings.quality = kind_named<Quality>(quality);
  if (!settings.quality && quality != auto_name) reader.wrong("quality", "has no such value");
  for (const DrawOption* option : all_draw_options()) reader.option(*option, settings.method_options);
  reader.choice("controls", settings.hud.help, all_kinds<Telling>);
  reader.flag("figures", settings.hud.figures);
  reader.flag("all_figures", settings.hud.all_figures);
  reader.flag("graphs", settings.hud.graphs);
  reader.flag("panel", settings.hud.panel);
  reader.flag("persons", settings.hud.persons);
  reader.number("field_of_view_degrees", settings.hand.field_of_view_degrees, field_of_view_min_degrees,
                field_of_view_max_degrees);
  reader.number("mouse_speed", settings.hand.mouse_speed, mouse_speed_min, mouse_speed_max);
  reader.number("text_scale", settings.hand.text_scale, text_scale_min, text_scale_max);
  reader.flag("overlay", settings.overlay.shown);
  reader.flag("overlay_interest", settings.overlay.interest);
  reader.flag("overlay_chunks", settings.overlay.chunks);
  reader.flag("overlay_pieces", settings.overlay.pieces);
  reader.flag("overlay_physics", settings.overlay.physics);
  reader.choice("tool", settings.tool.kind, all_kinds<ToolKind>);
  reader.choice("use", settings.tool.use, all_kinds<ToolUse>);
  reader.text("material", settings.tool.material);
  // A world need not have it: then its first one is taken.
  if (!settings.tool.material.empty() && !check_material_name(settings.tool.material))
    reader.wrong("material", "is no name of a material");
  reader.number("radius_m", settings.tool.radius_m, tool_radius_min_m, tool_radius_max_m);
  reader.number("blast_speed_m_s", settings.tool.blast_speed_m_s, 0.0F, limits::blast_speed_max_m_s);
  reader.choice("pattern", settings.tool.pattern, tool_patterns);
  reader.number("seeds", settings.tool.seeds, 0U, tool_seeds_max);
  reader.flag("particles", settings.particles);
  reader.flag("details", settings.details);
  reader.flag("shake", settings.shake);
  reader.flag("predict", settings.predict);
  reader.flag("sound", settings.sound);
  if (!reader.error().empty()) return fail(reader.error());
  return settings;
}

std::string to_text(const Settings& settings) {
  OrderedJson json{{"width", settings.width},
                   {"height", settings.height},
                   {"method", settings.method},
                   {"quality", settings.quality ? name_of(*settings.quality) : auto_name},
                   {"controls", name_of(settings.hud.help)},
                   {"figures", settings.hud.figures},
                   {"all_figures", settings.hud.all_figures},
                   {"graphs", settings.hud.graphs},
                   {"panel", settings.hud.panel},
                   {"persons", settings.hud.persons},
                   {"field_of_view_degrees", settings.hand.field_of_view_degrees},
                   {"mouse_speed", settings.hand.mouse_speed},
                   {"text_scale", settings.hand.text_scale},
                   {"overlay", settings.overlay.shown},
                   {"overlay_interest", settings.overlay.interest},
                   {"overlay_chunks", settings.overlay.chunks},
                   {"overlay_pieces", settings.overlay.pieces},
                   {"overlay_physics", settings.overlay.physics},
                   {"tool", name_of(settings.tool.kind)},
                   {"use", name_of(settings.tool.use)},
                   {"material", settings.tool.material},
                   {"radius_m", settings.tool.radius_m},
                   {"blast_speed_m_s", settings.tool.blast_speed_m_s},
                   {"pattern", name_of(settings.tool.pattern)},
                   {"seeds", settings.tool.seeds},
                   {"particles", settings.particles},
                   {"details", settings.details},
                   {"shake", settings.shake},
                   {"predict", settings.predict},
                   {"sound", settings.sound}};
  for (const DrawOption* option : all_draw_options()) {
    const int value = settings.method_options.of(*option);
    json[key_of(*option)] = option->is_number() ? OrderedJson(value) : OrderedJson(text_of(*option, value));
  }
  return json.dump(2) + "\n";
}

void apply_settings(const Settings& settings, ViewerOptions& options) {
  if (!options.given.size) {
    options.width = settings.width;
    options.height = settings.height;
  }
  if (!options.given.quality) options.quality = settings.quality;
  for (const DrawOption* option : all_draw_options())
    if (!options.given.method_options.contains(option->name))
      options.method_options.set(*option, settings.method_options.of(*option));
  if (!options.given.particles) options.particles = settings.particles;
  if (!options.given.details) options.details = settings.details;
  if (!options.given.shake) options.shake = settings.shake;
  if (!options.given.predict) options.predict = settings.predict;
  if (!options.given.sound) options.sound = settings.sound;
  const MethodEntry* method = method_named(settings.method);
  if (!options.given.method && method != nullptr) options.method = method;
}

SettingsFile::SettingsFile(std::string file) : file_(std::move(file)) {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  const Result<std::string> text = read_text(file_);
  const Result<Settings> settings = text ? parse_settings(*text) : fail(text.error().message);
  if (settings) {
    loaded_ = *settings;
    return;
  }
  std::fprintf(stderr, "scree-viewer: warning: settings %s are ignored, and kept as they are: %s\n",
               file_.c_str(), settings.error().message.c_str());
  file_.clear();
}

void SettingsFile::save(const Settings& start, const Settings& end) const {
  if (file_.empty() || start == end) return;
  Settings changed;
  changed.width = merged(loaded_.width, start.width, end.width);
  changed.height = merged(loaded_.height, start.height, end.height);
  changed.method = merged(loaded_.method, start.method, end.method);
  changed.quality = merged(loaded_.quality, start.quality, end.quality);
  for (const DrawOption* option : all_draw_options())
    changed.method_options.set(*option,
                               merged(loaded_.method_options.of(*option), start.method_options.of(*option),
                                      end.method_options.of(*option)));
  changed.particles = merged(loaded_.particles, start.particles, end.particles);
  changed.details = merged(loaded_.details, start.details, end.details);
  changed.shake = merged(loaded_.shake, start.shake, end.shake);
  changed.predict = merged(loaded_.predict, start.predict, end.predict);
  changed.sound = merged(loaded_.sound, start.sound, end.sound);
  changed.hud = end.hud;
  changed.hand = end.hand;
  changed.overlay = end.overlay;
  changed.tool = end.tool;
  changed.tool.pattern = merged(loaded_.tool.pattern, start.tool.pattern, end.tool.pattern);
  if (const Result<void> written = write_text(file_, to_text(changed)); !written)
    std::fprintf(stderr, "scree-viewer: warning: %s\n", written.error().message.c_str());
}

}  // namespace scree
