// Tables of kinds answer for the kinds that they have, and for no other number.
#include "shared/base/kind_table.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

enum class Fruit : uint8_t { apple = 0, pear = 1, plum = 2 };

struct FruitRow {
  std::string_view name;
  bool has_stone;
};

constexpr FruitRow row_of(Fruit fruit) {
  switch (fruit) {
    case Fruit::plum:
      return {.name = "plum", .has_stone = true};
    case Fruit::apple:
      return {.name = "apple", .has_stone = false};
    case Fruit::pear:
      return {.name = "pear", .has_stone = false};
  }
  return {};
}

constexpr bool has_no_stone(Fruit fruit) {
  return !traits_of(fruit).has_stone;
}

TEST(KindTable, has_the_rows_in_the_order_of_their_numbers) {
  static_assert(kind_count<Fruit> == 3);
  EXPECT_EQ(all_kinds<Fruit>, (std::array{Fruit::apple, Fruit::pear, Fruit::plum}));
  EXPECT_EQ(kind_names<Fruit>, (std::array<std::string_view, 3>{"apple", "pear", "plum"}));
  EXPECT_TRUE(traits_of(Fruit::plum).has_stone);
  EXPECT_EQ((kinds_that<Fruit, has_no_stone>), (std::array{Fruit::apple, Fruit::pear}));
}

TEST(KindTable, knows_names_both_ways_and_no_others) {
  for (const Fruit fruit : all_kinds<Fruit>) EXPECT_EQ(kind_named<Fruit>(name_of(fruit)), fruit);
  EXPECT_EQ(kind_named<Fruit>("stone"), std::nullopt);
  EXPECT_EQ(kind_named<Fruit>(""), std::nullopt);
}

TEST(KindTable, refuses_a_number_without_a_row_and_says_what_there_is) {
  for (const Fruit fruit : all_kinds<Fruit>) EXPECT_TRUE(validate_kind(fruit, "fruit"));
  for (const int number : {3, 4, 255}) {
    const auto unknown = static_cast<Fruit>(number);
    EXPECT_FALSE(is_known(unknown));
    const Result<void> refused = validate_kind(unknown, "fruit");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "the fruit is not a known one (apple, pear or plum)");
  }
  EXPECT_DEATH(static_cast<void>(traits_of(static_cast<Fruit>(3))), "is_known");
}

}  // namespace
}  // namespace scree
