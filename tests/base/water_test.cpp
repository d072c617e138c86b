#include "shared/base/water.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(WaterLevel, is_a_height_or_off) {
  EXPECT_EQ(*parse_water("off"), WaterLevel());
  EXPECT_EQ(*parse_water("-2.5"), WaterLevel(-2.5F));
  EXPECT_EQ(*parse_water("0"), WaterLevel(0.0F));
  for (const char* bad : {"", "on", "1 m", "nan", "inf", "513", "-600", "2,5"})
    EXPECT_FALSE(parse_water(bad)) << bad;
}

TEST(WaterLevel, is_read_back_as_it_was_written) {
  for (const char* text : {"off", "-2.50", "0.00", "512.00"})
    EXPECT_EQ(text_of_water(*parse_water(text)), text);
}

TEST(WaterLevel, of_settings_is_none_where_they_say_none_or_nonsense) {
  EXPECT_EQ(water_of({{"reach", "64"}, {"water", "3.25"}}), WaterLevel(3.25F));
  EXPECT_EQ(water_of({{"reach", "64"}}), WaterLevel());
  EXPECT_EQ(water_of({{"water", "much"}}), WaterLevel());
}

}  // namespace
}  // namespace scree
