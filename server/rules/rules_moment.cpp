#include "server/rules/rules_moment.h"

#include "server/rules/api.h"
#include "server/rules/values.h"
#include "shared/base/check.h"

namespace scree {

const QueryScene& RulesMoment::scene() {
  CHECK(world != nullptr);
  if (!held_) held_ = std::make_unique<HeldScene>(world->scene());
  return held_->scene();
}

const std::vector<PersonPlace>& RulesMoment::places() {
  CHECK(world != nullptr);
  if (!places_) places_ = world->persons();
  return *places_;
}

void write_reply(ScriptWriter& to, const Reply& reply, const RulesMoment& moment) {
  to.open_table();
  to.name("done");
  to.boolean(reply.refusal.empty());
  if (!reply.refusal.empty()) {
    to.name("refusal");
    to.text(reply.refusal);
    to.name("reason");
    to.text(refusal_name(reply));
  }
  to.name("pieces");
  to.integer(reply.pieces);
  if (reply.prop) {
    to.name("body");
    write_body(to, *reply.prop);
  }
  if (reply.joint) {
    to.name("joint");
    write_joint(to, *reply.joint);
  }
  if (reply.mass) {
    to.name("volume");
    to.number(cubic_metres(*reply.mass, moment));
  }
  to.close_table();
}

uint64_t RulesMoment::person_of(uint64_t party) const {
  if (parties != nullptr)
    if (const auto last = parties->find(party); last != parties->end() && persons->contains(last->second))
      return last->second;
  return persons->contains(party) ? party : 0;
}

}  // namespace scree
