// The blows of props are told: to the host in each tick, and to clients that asked.
#include <cmath>

#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

TEST(PropContacts, a_crate_that_strikes_the_ground_tells_place_normal_and_energy) {
  PropWorld world(rock_world());
  const PieceId id = world.add(crate(0.5F, 200.0F), {0.0F, 5.5F, 0.0F});
  float most_j = 0.0F;
  ContactEvent hardest;
  for (int i = 0; i < 120; ++i)
    for (const ContactEvent& contact : world.step().contacts)
      if (contact.energy_j > most_j) {
        most_j = contact.energy_j;
        hardest = contact;
      }
  EXPECT_EQ(hardest.body, id);
  EXPECT_EQ(hardest.other, 0U);
  EXPECT_NEAR(hardest.normal.y, 1.0F, 0.05F);
  EXPECT_NEAR(hardest.place_m.y, 0.0F, 0.1F);
  EXPECT_NEAR(hardest.energy_j / (200.0F * 9.81F * 5.0F), 1.1F, 0.15F) << "what it fell, and bounces back";
  world.steps(60);
  EXPECT_TRUE(world.last().contacts.empty()) << "what lies still strikes nothing";
}

TEST(PropContacts, two_props_make_one_event) {
  PropWorld world(rock_world());
  Prop still = crate();
  still.motion = PropMotion::fixed;
  const PieceId a = world.add(still, {0.0F, 0.5F, 0.0F}),
                b = world.add(ball(0.4F, 50.0F), {0.0F, 4.0F, 0.0F});
  size_t events = 0;
  for (int i = 0; i < 60; ++i)
    for (const ContactEvent& contact : world.step().contacts) {
      ++events;
      EXPECT_EQ(contact.body, a);
      EXPECT_EQ(contact.other, b);
      EXPECT_LT(contact.normal.y, -0.9F);
    }
  EXPECT_GE(events, 1U);
}

}  // namespace
}  // namespace scree
