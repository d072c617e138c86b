// The blows of pieces are told like those of props, and what becomes of props and joints.
#include <algorithm>

#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"

namespace scree {
namespace {

CarveRequest blow_at(glm::vec3 at_m) {
  CarveRequest carve;
  carve.shape = sphere(at_m, 1.5F);
  carve.seeds = 8;
  carve.impact_m = at_m;
  carve.blast_speed_m_s = 8.0F;
  return carve;
}

TEST(PieceContacts, rock_that_falls_tells_of_its_hard_blows_alone) {
  PropWorld world(rock_world());
  world.ask(FillRequest{sphere({0.0F, 8.0F, 0.0F}, 1.5F)});
  size_t events = 0;
  bool on_terrain = false;
  for (int i = 0; i < 240; ++i) {
    const std::vector<ContactEvent>& contacts = world.step().contacts;
    EXPECT_LE(contacts.size(), size_t{64});
    EXPECT_TRUE(std::ranges::is_sorted(contacts, std::ranges::greater{}, &ContactEvent::energy_j));
    for (const ContactEvent& contact : contacts) {
      ++events;
      EXPECT_GE(contact.energy_j, 1.0F);
      EXPECT_NE(contact.body, 0U);
      on_terrain = on_terrain || contact.other == 0;
    }
  }
  EXPECT_GE(events, 1U);
  EXPECT_TRUE(on_terrain);
}

TEST(PieceContacts, rubble_leaves_room_for_the_blows_of_props) {
  PropWorld world(rock_world());
  for (int i = 0; i < 3; ++i) world.ask(blow_at({4.0F * static_cast<float>(i), 0.0F, 0.0F}));
  const PieceId id = world.add(crate(0.5F, 20.0F), {-6.0F, 2.0F, 0.0F});
  bool struck = false;
  for (int i = 0; i < 120; ++i)
    for (const ContactEvent& contact : world.step().contacts) struck = struck || contact.body == id;
  EXPECT_TRUE(struck);
}

TEST(ToldEvents, say_who_added_and_removed_a_prop_and_why_a_joint_ended) {
  JointWorld world(rock_world());
  Prop box = crate();
  box.tag = 9;
  const PieceId id = world.add(box, {0.0F, 3.0F, 0.0F});
  ASSERT_EQ(world.last().told.size(), 1U);
  EXPECT_EQ(world.last().told[0].kind, EventKind::prop_added);
  EXPECT_EQ(world.last().told[0].body, id);
  EXPECT_EQ(world.last().told[0].tag, 9U);
  const PieceId post = world.add_post({0.0F, 5.0F, 0.0F});
  const Joint rope = line_between(JointKind::rope, world.frame(post), {0.0F, 5.0F, 0.0F}, world.frame(id),
                                  world.place_m(id));
  world.join(rope);
  world.step({{42, 1, RemovePropRequest{id}}});
  const std::vector<Event>& told = world.last().told;
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].kind, EventKind::prop_removed);
  EXPECT_EQ(told[0].session, 42U);
  EXPECT_EQ(told[1].kind, EventKind::joint_ended);
  EXPECT_EQ(told[1].text, "body_gone");
  EXPECT_EQ(told[1].body, post);
  EXPECT_EQ(told[1].other, id);
  ASSERT_TRUE(told[1].place_m.has_value());
  EXPECT_NEAR(told[1].place_m->y, 5.0F, 0.01F) << "at the side that is still there";
}

}  // namespace
}  // namespace scree
