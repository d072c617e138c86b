#include "server/world/prop_contacts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "proto/limits.h"
#include "server/world/limits.h"

namespace scree {

std::vector<ContactEvent> contacts_of_props(const World::State& state) {
  std::map<std::pair<PieceId, PieceId>, ContactEvent> by_pair;
  for (const BodyImpact& impact : state.bodies.impacts(limits::contact_event_min_m_s)) {
    if (impact.nears_m_s < limits::contact_event_min_m_s) continue;  // it only presses
    const PieceId other = impact.other.value_or(0);
    if (!state.props.contains(impact.id) && !state.props.contains(other)) continue;
    const bool is_first = other == 0 || impact.id < other;
    const ContactEvent event{is_first ? impact.id : other,
                             is_first ? other : impact.id,
                             impact.point_m,
                             is_first ? impact.normal : -impact.normal,
                             impact.impulse_n_s,
                             impact.energy_j};
    if (event.energy_j < limits::contact_event_min_j) continue;
    ContactEvent& known = by_pair[{event.body, event.other}];
    if (event.energy_j > known.energy_j) known = event;
  }
  std::vector<ContactEvent> contacts;
  for (const auto& [pair, event] : by_pair) contacts.push_back(event);
  std::ranges::stable_sort(contacts, std::ranges::greater{}, &ContactEvent::energy_j);
  if (contacts.size() > limits::contact_events_max) contacts.resize(limits::contact_events_max);
  return contacts;
}

}  // namespace scree
