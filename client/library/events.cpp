// From what the client applies to events, one after another.
#include <algorithm>
#include <type_traits>
#include <utility>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "client/library/mesher.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {

const scree_event& ToldEvent::view() {
  event.size = sizeof event;
  event.name = name.c_str();
  event.text = text.c_str();
  event.data = data.empty() ? nullptr : data.data();
  event.data_bytes = data.size();
  event.coords = coords.empty() ? nullptr : coords.data();
  event.coord_count = coords.size() / 3;
  return event;
}

namespace {

ToldEvent of_id(uint32_t kind, uint32_t id) {
  ToldEvent told(kind);
  told.event.id = id;
  return told;
}

ToldEvent event_of(const ReplyMessage& reply) {
  ToldEvent told(SCREE_EVENT_REPLY);
  told.event.request = reply.request;
  told.event.tick = reply.tick;
  told.event.id = reply.prop.value_or(0);
  told.event.number = reply.mass ? *reply.mass : reply.painted ? *reply.painted : reply.pieces;
  told.name = reply.refusal_name;
  told.text = reply.refusal;
  return told;
}

ToldEvent event_of(const Sign& sign, bool first) {
  ToldEvent told(SCREE_EVENT_SIGN);
  told.event.flags = first ? 1 : 0;
  told.event.number = static_cast<int64_t>(sign.kind);
  told.event.value = sign.share;
  write_vec3(sign.place_m, told.event.position);
  told.name = sign.name;
  told.text = sign.text;
  return told;
}

/// What a message says besides what it changes in the mirror.
class Teller {
 public:
  explicit Teller(std::deque<ToldEvent>& told) : told_(told) {}

  void operator()(const FrameMessage& frame) { add(SCREE_EVENT_FRAME).event.tick = frame.tick; }
  void operator()(const ReplyMessage& reply) { told_.push_back(event_of(reply)); }
  void operator()(const StatusMessage& status) { add(SCREE_EVENT_STATUS).event.tick = status.tick; }
  void operator()(const SaidMessage& said) {
    ToldEvent& told = add(SCREE_EVENT_SAID);
    told.event.session = said.session;
    told.name = said.name;
    told.text = said.text;
  }
  void operator()(const PersonsMessage& persons) {
    bool first = true;
    for (const Person& person : persons.persons) {
      ToldEvent& told = add(SCREE_EVENT_PERSON);
      told.event.flags = std::exchange(first, false) ? 1 : 0;
      told.event.session = person.session;
      told.event.number = static_cast<int64_t>(person.role);
      told.name = person.name;
    }
  }
  void operator()(const ChannelMessage& message) {
    ToldEvent& told = add(SCREE_EVENT_MESSAGE);
    told.name = message.channel;
    told.data = message.bytes;
  }
  void operator()(const SignsMessage& signs) {
    if (signs.signs.empty()) add(SCREE_EVENT_SIGN).event.flags = 1;
    bool first = true;
    for (const Sign& sign : signs.signs) told_.push_back(event_of(sign, std::exchange(first, false)));
  }
  void operator()(const CuesMessage& cues) {
    for (const Cue& cue : cues.cues) {
      ToldEvent& told = add(SCREE_EVENT_CUE);
      told.event.tick = cues.tick;
      told.event.value = cue.energy_j;
      write_vec3(cue.place_m, told.event.position);
      told.name = name_of(cue.kind);
    }
  }
  void operator()(const ContactsMessage& contacts) {
    for (const ContactEvent& contact : contacts.contacts) {
      ToldEvent& told = add(SCREE_EVENT_CONTACT);
      told.event.tick = contacts.tick;
      told.event.id = contact.body;
      told.event.number = contact.other;
      told.event.value = contact.energy_j;
      write_vec3(contact.place_m, told.event.position);
    }
  }
  template <typename Other>
  void operator()(const Other&) {}

 private:
  ToldEvent& add(uint32_t kind) { return told_.emplace_back(kind); }

  std::deque<ToldEvent>& told_;
};

std::vector<int32_t> triples_of(std::vector<BrickCoord> bricks) {
  std::sort(bricks.begin(), bricks.end());
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  std::vector<int32_t> triples;
  for (const BrickCoord& brick : bricks) triples.insert(triples.end(), {brick.x, brick.y, brick.z});
  return triples;
}

}  // namespace
}  // namespace scree

using namespace scree;

void scree_client::tell(const MirrorChanges& changes) {
  for (const PieceId id : changes.pieces_removed) told_.push_back(of_id(SCREE_EVENT_PIECE_REMOVED, id));
  for (const PieceId id : changes.pieces_added) told_.push_back(of_id(SCREE_EVENT_PIECE_ADDED, id));
  for (const PieceId id : changes.props_removed) told_.push_back(of_id(SCREE_EVENT_BODY_REMOVED, id));
  for (const PieceId id : changes.props_added) told_.push_back(of_id(SCREE_EVENT_BODY_ADDED, id));
  for (const SettledStone& stone : changes.stones) {
    if ((flags & SCREE_STONES) == 0) break;
    scree_event& event = told_.emplace_back(of_id(SCREE_EVENT_STONE, stone.id)).event;
    write_pose(dequantise(stone.pose), event.position, event.rotation);
  }
  if (!changes.bricks.empty()) {
    ToldEvent& told = told_.emplace_back(SCREE_EVENT_TERRAIN);
    told.event.tick = client.mirror()->tick();
    told.coords = triples_of(changes.bricks);
  }
  if (changes.palette) told_.emplace_back(SCREE_EVENT_PALETTE);
}

void scree_client::tell(const Client::Joined& joined) {
  attempts_.joined(steady_now_s());
  const WelcomeMessage& welcome = *client.welcome();
  walk.emplace(welcome.tick_rate_hz);
  for (scree_mesher* const mesher : meshers) mesher->restart();
  ToldEvent& told = told_.emplace_back(SCREE_EVENT_JOINED);
  told.event.flags = (joined.other_world ? 1U : 0U) | (welcome.replay ? 2U : 0U);
  told.event.session = welcome.session;
  told.event.tick = welcome.tick;
  if (contacts_j_ > 0.0F) client.send(PhysicsSubscriptionMessage{false, contacts_j_});
}

void scree_client::tell(const Client::Applied& applied) {
  note(applied.changes);
  tell(applied.changes);
  if (walk) walk->follow(*client.mirror());
  std::visit(Teller(told_), applied.received.message);
}

void scree_client::tell(const Client::Lost& lost) {
  attempts_.lost(steady_now_s(), lost.end.refusal);
  walk.reset();
  for (const auto& [number, wish] : wishes_) {
    ToldEvent& told = told_.emplace_back(SCREE_EVENT_REPLY);
    told.event.request = number;
    told.name = "connection_lost";
    told.text = "the connection ended before the server answered";
  }
  ToldEvent& told = told_.emplace_back(SCREE_EVENT_LOST);
  told.event.flags = attempts_.gave_up() || (flags & SCREE_ONCE) != 0 ? 1 : 0;
  told.name = lost.end.refusal;
  told.text = lost.end.message;
}

void scree_client::note(const MirrorChanges& changes) {
  for (scree_mesher* const mesher : meshers) mesher->changed(changes);
}

/// Once after the events of a poll: what predictions show, and no longer show.
void scree_client::settle() {
  if (std::exchange(settled_, true) || client.mirror() == nullptr || (flags & SCREE_PREDICT) == 0) return;
  MirrorChanges changes;
  client.settle(steady_now_s(), changes);
  note(changes);
  tell(changes);
}

/// Whether the program's own function has got the reply.
bool scree_client::hand_over(ToldEvent& reply) {
  if (reply.event.kind != SCREE_EVENT_REPLY) return false;
  const auto found = wishes_.find(reply.event.request);
  if (found == wishes_.end()) return false;
  const ReplyWish wish = found->second;
  wishes_.erase(found);
  if (wish.reply == nullptr) return false;
  calling_ = true;
  wish.reply(wish.user, &reply.view());
  calling_ = false;
  return true;
}

const scree_event* scree_client::next() {
  while (!ended_) {
    while (!told_.empty() && !ended_) {
      taken_.emplace(std::move(told_.front()));
      told_.pop_front();
      if (!hand_over(*taken_)) return &taken_->view();
    }
    if (ended_) return nullptr;
    const std::optional<Client::Event> event = client.next();
    if (event)
      std::visit([&](const auto& one) { tell(one); }, *event);
    else
      settle();
    if (!event && told_.empty()) return nullptr;
  }
  return nullptr;
}

extern "C" {

scree_result scree_client_next(scree_client* client, scree_event* event) {
  return guarded([&] {
    if (client == nullptr || !has_size(event))
      return fail(SCREE_INVALID, "a client and an event with its size are needed");
    if (client->is_calling()) return fail(SCREE_REFUSED, no_call_from_callbacks);
    const scree_event* const told = client->next();
    if (client->has_ended()) {
      delete client;
      return nothing;
    }
    if (told == nullptr) return nothing;
    write_struct(*told, event);
    return done;
  });
}
}
