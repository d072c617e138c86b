// Contact shadows: what a piece lies on is darker beside it, and nothing else is.
#include "client/render/scene/limits.h"
#include "tests/support/offscreen_fixture.h"

namespace scree {
namespace {

class Contacts : public OffscreenTest, public testing::WithParamInterface<const char*> {
 protected:
  Contacts() : OffscreenTest(GetParam(), {TerrainKind::flat, 1, 0.25F}) {}
  void SetUp() override {
    OffscreenTest::SetUp();
    ground_m_ = ground_height_m(field_.source(), 0.0F, 0.0F);
    camera_.eye_m.y = ground_m_ + 3.0F;
    finish();
  }
  /// A ball that touches the ground before the eye; the piece itself is not drawn.
  Contact lying(float up_m) const { return {{0.0F, ground_m_ + up_m, 1.0F}, 0.5F}; }
  static int brightness(const Image& image, int x, int y) {
    const auto at = 3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    return image.rgb[at] + image.rgb[at + 1] + image.rgb[at + 2];
  }
  float ground_m_ = 0.0F;
};

TEST_P(Contacts, darken_the_ground_that_a_piece_lies_on_and_nothing_else) {
  const Image bare = draw();
  renderer_->set_contacts({lying(0.5F)});
  const Image touched = draw();
  const size_t changed = differing_pixels(touched, bare, 1);
  EXPECT_GT(changed, 100U);
  EXPECT_LT(changed, static_cast<size_t>(width * height) / 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_LE(brightness(touched, x, y), brightness(bare, x, y) + 3) << x << " " << y;

  renderer_->set_contacts({lying(3.0F)});
  EXPECT_EQ(differing_pixels(draw(), bare, 1), 0U) << "it is in the air";
  renderer_->set_contacts({lying(0.5F)});
  renderer_->set_fineness({.contacts = false});
  EXPECT_EQ(differing_pixels(draw(), bare, 0), 0U);
}

TEST(ContactsOf, are_balls_of_the_pieces_volumes_and_bounded) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  PieceTable table;
  apply(CarveOperation{sphere({}, 1.0F), SeedPattern::uniform, 1, 5, {}, 1}, field, table);
  ASSERT_FALSE(table.empty());
  const std::shared_ptr<const Volume> volume = table.begin()->second;
  ScenePieces pieces;
  for (PieceId id = 1; id <= limits::contacts_max + 50; ++id)
    pieces[id] = {volume, {{static_cast<float>(id), 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}}};
  const std::vector<Contact> contacts = contacts_of(Scene{field, pieces}, {});
  ASSERT_EQ(contacts.size(), limits::contacts_max);
  // Half of the ball lay in the flat ground.
  EXPECT_NEAR(contacts.front().radius_m, std::cbrt(0.5F), 0.08F);
  for (const Contact& contact : contacts)
    EXPECT_LE(contact.centre_m.x, static_cast<float>(limits::contacts_max));
}

INSTANTIATE_TEST_SUITE_P(Methods, Contacts, testing::Values("mesh", "raymarch"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scree
