#include "server/app/config_reload.h"

#include <algorithm>
#include <fmt/format.h>

#include "server/world/settings.h"

namespace scree {

namespace {

constexpr std::string_view log_level = "log";

bool is_setting(const std::string& name) {
  return std::ranges::find(settings(), name, &Setting::name) != settings().end();
}

/// For the log, where a secret has no words.
std::string words_of(const OptionValue& option) {
  if (option.is_secret) return "another one";
  return option.values.empty() ? "nothing" : option.text();
}

bool changes_now(const OptionValue& now) {
  return (is_setting(now.name) && now.source != OptionSource::standard) || now.name == log_level;
}

}  // namespace

OptionChanges changes_between(const std::vector<OptionValue>& before, const std::vector<OptionValue>& now) {
  OptionChanges changes;
  for (const OptionValue& option : now) {
    const auto was = std::ranges::find(before, option.name, &OptionValue::name);
    if (was == before.end() || was->values == option.values) continue;
    if (option.name == log_level)
      changes.level = option.text();
    else if (changes_now(option))
      changes.settings.push_back({option.name, option.text()});
    else if (is_setting(option.name))
      changes.later.push_back(fmt::format("{} is not told any more, and stays as it is", option.name));
    else
      changes.later.push_back(
          fmt::format("{} is {} now, which holds from the next start on", option.name, words_of(option)));
  }
  return changes;
}

ConfigReload::ConfigReload(int argc, const char* const* argv, const ServerOptions& options)
    : arguments_(argv, argv + argc), has_file_(!options.config_path.empty()), values_(options.values) {}

Result<std::optional<OptionChanges>> ConfigReload::read() {
  if (!has_file_) return std::optional<OptionChanges>();
  const auto read =
      read_server_options(static_cast<int>(arguments_.size()), arguments_.data(), OptionsUse::look);
  if (const auto* end = std::get_if<OptionsEnd>(&read)) {
    std::string said = end->err.empty() ? end->out : end->err;
    said.erase(said.find_last_not_of('\n') + 1);
    return fail(said);
  }
  const auto& now = std::get<ServerOptions>(read).values;
  OptionChanges changes = changes_between(values_, now);
  changes.log = std::get<ServerOptions>(read).log;
  for (const OptionValue& option : now) {
    const auto held = std::ranges::find(values_, option.name, &OptionValue::name);
    if (held != values_.end() && (changes_now(option) || is_setting(option.name))) *held = option;
  }
  return std::optional(changes);
}

}  // namespace scree
