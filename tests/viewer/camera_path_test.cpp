// Camera paths, pictures' differences and frame times: what --path, --reference and --timedemo are made of.
#include "client/viewer/pictures/camera_path.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/viewer/base/limits.h"
#include "client/viewer/pictures/frame_times.h"
#include "client/viewer/pictures/picture_difference.h"

namespace scree {
namespace {

constexpr const char* bend = R"({"keys": [
  {"time_s": 10, "camera": [0, 1, 0, 350, 0]},
  {"time_s": 11, "camera": [4, 2, 0, 10, -20]},
  {"time_s": 13, "camera": [4, 2, -9, 80, -20]}]})";

float degrees(float radians) {
  return radians * 57.29578F;
}

TEST(CameraPath, passes_through_its_keys_at_their_times) {
  const Result<CameraPath> path = CameraPath::parse(bend);
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_DOUBLE_EQ(path->duration_s(), 3.0);
  EXPECT_LT(glm::distance(path->at(0.0).eye_m, {0.0F, 1.0F, 0.0F}), 1e-5F);
  EXPECT_LT(glm::distance(path->at(1.0).eye_m, {4.0F, 2.0F, 0.0F}), 1e-5F);
  EXPECT_LT(glm::distance(path->at(3.0).eye_m, {4.0F, 2.0F, -9.0F}), 1e-5F);
  EXPECT_NEAR(degrees(path->at(1.0).pitch), -20.0F, 1e-3F);
  EXPECT_EQ(path->at(-5.0).eye_m, path->at(0.0).eye_m);
  EXPECT_EQ(path->at(99.0).eye_m, path->at(3.0).eye_m);
}

TEST(CameraPath, yaw_goes_the_shorter_way_round) {
  const Result<CameraPath> path = CameraPath::parse(bend);
  ASSERT_TRUE(path);
  const float between = std::remainder(degrees(path->at(0.5).yaw), 360.0F);
  EXPECT_LT(std::abs(between), 10.0F) << "from 350 to 10 degrees by way of 0";
}

TEST(CameraPath, neither_place_nor_speed_jumps) {
  const Result<CameraPath> path = CameraPath::parse(bend);
  ASSERT_TRUE(path);
  constexpr double step_s = 1e-3;
  glm::vec3 before_m_s{0.0F};
  for (int i = 0; i + 1 < 3000; ++i) {
    const double t = i * step_s;
    const glm::vec3 speed_m_s = (path->at(t + step_s).eye_m - path->at(t).eye_m) / static_cast<float>(step_s);
    // The curves' largest acceleration is about 40 m/s²; a kink would be a change by metres a second.
    if (i > 0) {
      EXPECT_LT(glm::distance(speed_m_s, before_m_s), 0.1F) << "at " << t;
    }
    before_m_s = speed_m_s;
  }
}

TEST(CameraPath, one_key_stands_still) {
  const Result<CameraPath> path =
      CameraPath::parse(R"({"keys": [{"time_s": 2, "camera": [1, 2, 3, 0, 0]}]})");
  ASSERT_TRUE(path);
  EXPECT_EQ(path->duration_s(), 0.0);
  EXPECT_EQ(path->at(1.0).eye_m, glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST(CameraPath, what_is_wrong_is_named) {
  const auto refusal = [](const std::string& text) {
    const Result<CameraPath> path = CameraPath::parse(text);
    return path ? "accepted" : path.error().message;
  };
  EXPECT_EQ(refusal("{"), "it is not JSON");
  EXPECT_EQ(refusal("[]"), "it has no list of keys");
  EXPECT_EQ(refusal(R"({"keys": []})"), "it has no list of keys");
  EXPECT_EQ(refusal(R"({"keys": [{}]})"), "key 1: it has no number time_s");
  EXPECT_EQ(refusal(R"({"keys": [{"time_s": 0, "camera": [1, 2, 3]}]})"),
            "key 1: its camera is not [x, y, z, yaw, pitch]");
  EXPECT_NE(refusal(R"({"keys": [{"time_s": 0, "camera": [1e9, 2, 3, 0, 0]}]})").find("outside the world"),
            std::string::npos);
  const std::string still = R"({"time_s": 0, "camera": [0, 0, 0, 0, 0]})";
  EXPECT_EQ(refusal("{\"keys\": [" + still + "," + still + "]}"),
            "key 2: its time is not 0.000500 s or more after the time before it (limits.path_step_min_s)");
  EXPECT_NE(refusal("{\"keys\": [" + still + R"(,{"time_s": 1e6, "camera": [0, 0, 0, 0, 0]}]})")
                .find("path_duration_max_s"),
            std::string::npos);
  std::string many = "{\"keys\": [" + still;
  for (size_t i = 0; i < limits::path_keys_max; ++i) many += ",0";
  EXPECT_NE(refusal(many + "]}").find("path_keys_max"), std::string::npos);
  EXPECT_FALSE(CameraPath::read("/nowhere/path.json"));
}

std::string two_keys(const std::string& first_s, const std::string& second_s) {
  return R"({"keys": [{"time_s": )" + first_s + R"(, "camera": [0, 0, 0, 0, 0]}, {"time_s": )" + second_s +
         R"(, "camera": [9, 9, 9, 0, 0]}]})";
}

TEST(CameraPath, steps_too_short_for_a_speed_are_refused) {
  for (const char* step_s : {"5e-324", "1e-300", "0.00049"}) {
    const Result<CameraPath> path = CameraPath::parse(two_keys("0", step_s));
    ASSERT_FALSE(path) << step_s;
    EXPECT_NE(path.error().message.find("path_step_min_s"), std::string::npos) << path.error().message;
  }
  const Result<CameraPath> shortest = CameraPath::parse(two_keys("0", "0.0005"));
  ASSERT_TRUE(shortest) << shortest.error().message;
  for (const double t : {0.0, 0.0002, 0.0004, 0.0005})
    EXPECT_TRUE(std::isfinite(shortest->at(t).eye_m.x)) << t;
}

TEST(CameraPath, times_far_from_zero_are_counted_from_the_first_key) {
  const Result<CameraPath> path = CameraPath::parse(two_keys("1e17", "100000000000000016"));
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_EQ(path->duration_s(), 16.0);
  EXPECT_NEAR(path->at(8.0).eye_m.x, 4.5F, 1e-5F);
  EXPECT_FALSE(CameraPath::parse(two_keys("-1e300", "1e300")));
}

TEST(CameraPath, deep_nesting_is_refused_whatever_it_is_made_of) {
  constexpr size_t depth = 160000;
  std::string lists = R"({"keys": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
  std::string objects;
  for (size_t i = 0; i < depth; ++i) objects += R"({"keys":)";
  for (const std::string& text : {lists, std::string(depth, '['), objects + "0" + std::string(depth, '}')}) {
    const Result<CameraPath> path = CameraPath::parse(text);
    ASSERT_FALSE(path);
    EXPECT_NE(path.error().message.find("json_depth_max"), std::string::npos) << path.error().message;
  }
  // Brackets in a text nest nothing.
  const std::string noted = R"({"note": "\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[", "keys": [{"time_s": 2,
    "camera": [1, 2, 3, 0, 0]}]})";
  EXPECT_TRUE(CameraPath::parse(noted));
}

Image uniform(int width, int height, uint8_t value) {
  return {width, height, std::vector<uint8_t>(static_cast<size_t>(width * height * 3), value)};
}

TEST(PictureDifference, is_zero_of_equals_and_one_of_black_and_white) {
  EXPECT_EQ(*picture_difference(uniform(4, 3, 77), uniform(4, 3, 77)), 0.0);
  EXPECT_DOUBLE_EQ(*picture_difference(uniform(4, 3, 0), uniform(4, 3, 255)), 1.0);
  EXPECT_FALSE(picture_difference(uniform(4, 3, 0), uniform(3, 4, 0)));
}

TEST(PictureDifference, a_small_hole_counts_more_than_rounding_everywhere) {
  const Image whole = uniform(100, 100, 100);
  Image hole = whole;
  for (size_t i = 0; i < 300; ++i) hole.rgb[i] = 228;  // 1 % of the pixels, by half the range
  EXPECT_NEAR(*picture_difference(whole, hole), 0.05, 0.001);
  EXPECT_LT(*picture_difference(whole, uniform(100, 100, 101)), 0.005);
}

TEST(FrameTimes, json_holds_each_frame_and_their_summary) {
  TimeDemo demo{"a.json", "mesh", "a driver", 640, 360, {}};
  for (int i = 1; i <= 101; ++i)
    demo.frames.push_back({1.0, static_cast<double>(i), static_cast<double>(i) + 1.0});
  const auto json = nlohmann::json::parse(to_json(demo));
  EXPECT_EQ(json["frames"], 101);
  EXPECT_EQ(json["draw_ms"]["median"], 51.0);
  EXPECT_EQ(json["draw_ms"]["p99"], 100.0);
  EXPECT_EQ(json["frame_ms"]["worst"], 102.0);
  EXPECT_EQ(json["update_ms"]["mean"], 1.0);
  EXPECT_EQ(json["each_frame_ms"].size(), 101U);
  EXPECT_EQ(json["method"], "mesh");
}

}  // namespace
}  // namespace scree
