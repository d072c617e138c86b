// Settings that a LiveServer changes by itself: those that it was told, and the governor's.
#include <algorithm>
#include <fmt/format.h>

#include "server/app/live_server_state.h"
#include "server/log/log.h"

namespace scree {

namespace {

/// Requests without a session are the server's own; by this number it knows the answer.
constexpr uint32_t told_request = 1;

bool sets_work_percent(const Command& command) {
  const auto* change = std::get_if<SettingsRequest>(&command.body);
  const auto is_it = [](const SettingValue& setting) { return setting.name == "work-percent"; };
  return change != nullptr && std::ranges::any_of(change->settings, is_it);
}

}  // namespace

bool LiveServer::State::add_settings(std::vector<Command>& commands) {
  if (!limits_to_set.empty())  // a recording has them as any change of settings
    commands.insert(commands.begin(), {0, 0, SettingsRequest{std::exchange(limits_to_set, {})}});
  {
    const std::scoped_lock lock(mutex);
    if (!settings_told.empty())
      commands.push_back({0, told_request, SettingsRequest{std::exchange(settings_told, {})}});
  }
  const bool is_chosen = std::ranges::any_of(commands, sets_work_percent);
  if (work_percent_next && !is_chosen)
    commands.push_back({0, 0, SettingsRequest{{{"work-percent", std::to_string(*work_percent_next)}}}});
  work_percent_next.reset();
  return is_chosen;
}

void LiveServer::State::tell_settings(const TickDelta& delta) const {
  for (const Reply& reply : delta.replies)
    if (reply.session == 0 && reply.request == told_request && reply.reason == Refusal::settings_invalid)
      log_of(LogPart::app).error("the settings of the file of options are not changed: {}", reply.refusal);
}

Result<void> LiveServer::change_settings(const SettingValues& changes) {
  if (state_->config.told != nullptr) return fail("an edge has the settings of the simulating server");
  if (state_->config.net.replay) return fail("a replay has the settings of its recording");
  if (changes.size() > limits::settings_max) return fail("too many settings at once (limits.settings_max)");
  const std::scoped_lock lock(state_->mutex);
  for (const SettingValue& change : changes) {
    std::erase_if(state_->settings_told, [&](const auto& told) { return told.name == change.name; });
    state_->settings_told.push_back(change);
  }
  return {};
}

}  // namespace scree
