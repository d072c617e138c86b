#include "server/world/body_contacts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "proto/limits.h"
#include "server/world/limits.h"

namespace scree {

namespace {

ContactEvent contact_of(const BodyImpact& impact) {
  const PieceId other = impact.other.value_or(0);
  const bool is_first = other == 0 || impact.id < other;
  return {is_first ? impact.id : other,
          is_first ? other : impact.id,
          impact.point_m,
          is_first ? impact.normal : -impact.normal,
          impact.impulse_n_s,
          impact.energy_j};
}

bool has_prop(const World::State& state, const ContactEvent& contact) {
  return state.props.contains(contact.body) || state.props.contains(contact.other);
}

/// Leaves out the weakest, so that rubble leaves room for what a game put there.
void keep_hardest(const World::State& state, std::vector<ContactEvent>& contacts) {
  std::ranges::stable_sort(contacts, std::ranges::greater{}, &ContactEvent::energy_j);
  size_t of_rock = 0;
  std::erase_if(contacts, [&](const ContactEvent& contact) {
    return !has_prop(state, contact) && ++of_rock > limits::contact_events_of_rock_max;
  });
  if (contacts.size() > limits::contact_events_max) contacts.resize(limits::contact_events_max);
}

}  // namespace

std::vector<ContactEvent> contacts_of_bodies(World::State& state) {
  const float least_m_s = state.props.empty() ? limits::impact_speed_min_m_s : limits::contact_event_min_m_s;
  struct Part {
    ContactEvent event;
    bool goes_on = false;
  };
  std::map<std::pair<PieceId, PieceId>, Part> by_pair;
  for (const BodyImpact& impact : state.bodies.impacts(least_m_s)) {
    if (impact.nears_m_s < least_m_s) continue;  // it only presses
    const ContactEvent event = contact_of(impact);
    if (impact.give_m_s < limits::impact_speed_min_m_s && !has_prop(state, event)) continue;
    Part& known = by_pair[{event.body, event.other}];
    const bool may_go_on = event.other != 0 && has_prop(state, event);
    if (event.energy_j > known.event.energy_j) known = {event, may_go_on && impact.still_m_s >= least_m_s};
  }
  for (const auto& [pair, part] : by_pair)
    if (part.event.energy_j > 0.0F) state.contact_sums.add(part.event, part.goes_on);
  const auto ticks_max =
      static_cast<uint32_t>(limits::contact_sum_s * static_cast<float>(state.config.tick_rate_hz));
  std::vector<ContactEvent> contacts = state.contact_sums.take_ended(std::max(ticks_max, 1U));
  std::erase_if(contacts, [](const ContactEvent& one) { return one.energy_j < limits::contact_event_min_j; });
  keep_hardest(state, contacts);
  return contacts;
}

}  // namespace scree
