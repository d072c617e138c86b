// The geometry of regions, and what is refused of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

#include "shared/region/limits.h"
#include "tests/regions/some_regions.h"

namespace scree {
namespace {

constexpr std::array<RegionForm, 3> forms = all_kinds<RegionForm>;

class Places {
 public:
  glm::vec3 next(float reach_m) {
    const auto one = [&] {
      state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
      return (static_cast<float>(state_ >> 40U) / 8388608.0F - 1.0F) * reach_m;
    };
    const float x = one(), y = one(), z = one();
    return {x, y, z};
  }

 private:
  uint64_t state_ = 7;
};

TEST(RegionValues, a_place_is_in_it_where_its_form_says_so) {
  const Region box = region_of(RegionForm::box, {1.0F, 2.0F, 3.0F}, {2.0F, 3.0F, 4.0F});
  const Region ball = region_of(RegionForm::sphere, {1.0F, 2.0F, 3.0F}, {2.0F, 9.0F, 9.0F});
  const Region post = region_of(RegionForm::cylinder, {1.0F, 2.0F, 3.0F}, {2.0F, 5.0F, 9.0F});
  EXPECT_TRUE(holds(box, {2.9F, 4.9F, 6.9F}));
  EXPECT_FALSE(holds(box, {3.1F, 2.0F, 3.0F}));
  EXPECT_FALSE(holds(ball, {2.5F, 3.5F, 3.0F}));
  EXPECT_TRUE(holds(ball, {2.3F, 3.3F, 3.0F}));
  EXPECT_TRUE(holds(post, {2.3F, 6.9F, 4.3F}));
  EXPECT_FALSE(holds(post, {2.5F, 2.0F, 4.5F}));
  EXPECT_FALSE(holds(post, {1.0F, 7.1F, 3.0F}));
}

TEST(RegionValues, boxes_balls_and_ways_meet_it_where_a_place_of_theirs_does) {
  Places places;
  for (const RegionForm form : forms)
    for (int time = 0; time < 300; ++time) {
      const Region region = region_of(form, places.next(2.0F), {1.5F, 2.5F, 1.0F});
      const glm::vec3 lo = places.next(4.0F), hi = lo + glm::abs(places.next(1.0F));
      bool any = false;
      for (int i = 0; i < 1000; ++i) {
        const glm::vec3 part = 0.5F + 0.5F * places.next(1.0F);
        any = any || holds(region, lo + (hi - lo) * part);
      }
      EXPECT_TRUE(!any || meets(region, lo, hi)) << name_of(form);
      const glm::vec3 far = hi + 3.0F;
      bool on_way = false;
      for (int i = 0; i <= 1000; ++i)
        on_way = on_way || holds(region, lo + (far - lo) * (static_cast<float>(i) / 1000.0F));
      const auto first = first_in(region, lo, far);
      if (on_way) {
        ASSERT_TRUE(first.has_value()) << name_of(form);
        EXPECT_TRUE(distance(region, lo + (far - lo) * *first) < 1e-3F);
        if (*first > 0.01F) {
          EXPECT_GT(distance(region, lo + (far - lo) * (*first - 0.01F)), 0.0F);
        }
      }
      if (first) {
        EXPECT_LT(distance(region, lo + (far - lo) * *first), 1e-3F);
        EXPECT_TRUE(meets(region, glm::min(lo, far), glm::max(lo, far)));
      }
      if (meets(region, capsule(lo, far, 0.25F)) && !first) {
        float least = 1e9F;
        for (int i = 0; i <= 1000; ++i)
          least = std::min(least, distance(region, lo + (far - lo) * (static_cast<float>(i) / 1000.0F)));
        EXPECT_LT(least, 0.26F);
      }
    }
}

TEST(RegionValues, distance_grows_by_no_more_than_the_way) {
  Places places;
  for (const RegionForm form : forms)
    for (int time = 0; time < 2000; ++time) {
      const Region region = region_of(form, glm::vec3(0.0F), {1.5F, 2.5F, 1.0F});
      const glm::vec3 a = places.next(5.0F), b = places.next(5.0F);
      EXPECT_LE(std::abs(distance(region, a) - distance(region, b)), glm::length(a - b) + 1e-4F);
      EXPECT_NEAR(glm::length(outward(region, a)), 1.0F, 1e-4F);
      if (distance(region, a) > 0.0F) {
        EXPECT_GT(distance(region, a + 0.01F * outward(region, a)), 0.0F);
      }
    }
}

TEST(RegionValues, who_may_edit_is_by_role_or_by_name) {
  Region region = region_of(RegionForm::box, glm::vec3(0.0F), glm::vec3(1.0F));
  EXPECT_FALSE(may_edit(region, {Role::admin, "Ann"})) << "nobody may";
  region.editors = RegionEditors::all;
  EXPECT_TRUE(may_edit(region, {}));
  region.editors = RegionEditors::role;
  region.role = Role::builder;
  EXPECT_FALSE(may_edit(region, {Role::carver, "Ann"}));
  EXPECT_TRUE(may_edit(region, {Role::builder, ""}));
  EXPECT_TRUE(may_edit(region, {Role::director, ""})) << "by rank, and not by number";
  region.editors = RegionEditors::persons;
  region.persons = {"Ann", "Bo"};
  EXPECT_TRUE(may_edit(region, {Role::carver, "Bo"}));
  EXPECT_FALSE(may_edit(region, {Role::admin, "bo"}));
  EXPECT_FALSE(may_edit(region, {Role::admin, ""}));
  region.teams = {"red"};
  EXPECT_TRUE(may_edit(region, {Role::carver, "", "red"}));
  EXPECT_FALSE(may_edit(region, {Role::carver, "red", "blue"})) << "a name is no team";
  EXPECT_FALSE(may_edit(region, {Role::carver, "", ""}));
}

TEST(RegionValues, what_no_world_can_take_is_refused) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const Region good = region_of(RegionForm::box, glm::vec3(0.0F), glm::vec3(1.0F));
  EXPECT_TRUE(validate(good).has_value());
  const auto is_refused = [&](auto&& change) {
    Region region = good;
    change(region);
    return !validate(region).has_value();
  };
  EXPECT_TRUE(is_refused([](Region& r) { r.name = ""; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.teams = {""}; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.teams = std::vector<std::string>(9, "red"); }));
  EXPECT_TRUE(is_refused([](Region& r) { r.name = std::string(33, 'x'); }));
  EXPECT_TRUE(is_refused([](Region& r) { r.name = "a\nb"; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.form = static_cast<RegionForm>(9); }));
  EXPECT_TRUE(is_refused([](Region& r) { r.forbids = 16; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.centre_m.x = 5000.0F; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.centre_m.y = nan; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.half_m.y = 0.05F; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.half_m.z = 600.0F; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.half_m.x = nan; }));
  EXPECT_TRUE(is_refused([](Region& r) { r.persons.assign(9, "x"); }));
  EXPECT_TRUE(is_refused([](Region& r) { r.persons = {""}; }));
}

}  // namespace
}  // namespace scree
