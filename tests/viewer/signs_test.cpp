// What a game's signs show: which, when and where; and that nothing is drawn where there is none.
#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/viewer/signs/limits.h"
#include "client/viewer/signs/shown_signs.h"
#include "client/viewer/signs/sign_drawing.h"
#include "client/viewer/signs/sign_painter.h"

namespace scree {
namespace {

constexpr float wide = 16.0F / 9.0F;

/// At the origin; it looks along −z.
const Camera ahead{};

Sign line(const std::string& name, const std::string& text) {
  return {.name = name, .text = text};
}

Sign marker(const std::string& name, glm::vec3 place_m) {
  Sign sign{.name = name, .kind = SignKind::marker, .text = name};
  sign.place_m = place_m;
  return sign;
}

Sign counting(Tick until) {
  Sign sign = line("round", "Round 2");
  sign.until = until;
  sign.counts = true;
  return sign;
}

std::vector<std::string> words_of(const std::vector<Sign>& signs, SignMoment moment = {}) {
  std::vector<std::string> words;
  for (const ShownSign& shown : shown_signs(signs, moment, ahead, wide)) words.push_back(shown.words);
  return words;
}

using Words = std::vector<std::string>;

TEST(ShownSigns, a_countdown_shows_minutes_and_seconds_rounded_up) {
  const Sign sign = counting(9000);
  EXPECT_EQ(time_left(sign, {0.0, 60.0}), "2:30");
  EXPECT_EQ(time_left(sign, {1.0, 60.0}), "2:30");
  EXPECT_EQ(time_left(sign, {60.0, 60.0}), "2:29");
  EXPECT_EQ(time_left(sign, {8641.0, 60.0}), "0:06");
  EXPECT_EQ(time_left(sign, {0.0, 30.0}), "5:00");
  EXPECT_EQ(time_left(line("a", "b"), {}), "");
  EXPECT_EQ(words_of({sign}, {5400.0, 60.0}), Words{"Round 2 1:00"});
  Sign silent = sign;
  silent.text.clear();
  EXPECT_EQ(words_of({silent}, {5400.0, 60.0}), Words{"1:00"});
}

TEST(ShownSigns, a_sign_that_has_ended_is_not_shown) {
  EXPECT_EQ(words_of({counting(600)}, {599.0, 60.0}), Words{"Round 2 0:01"});
  EXPECT_TRUE(words_of({counting(600)}, {600.0, 60.0}).empty());
  EXPECT_TRUE(words_of({counting(600)}, {601.0, 60.0}).empty());
}

TEST(ShownSigns, rows_come_by_name_for_whatever_audience) {
  Sign own = line("b", "second");
  own.to = {.kind = AudienceKind::session, .session = 4};
  EXPECT_EQ(words_of({line("a", "first"), line("c", "third"), own}), (Words{"first", "second", "third"}));
}

TEST(ShownSigns, many_are_cut_to_the_first_rows_and_the_nearest_markers) {
  std::vector<Sign> signs;
  for (int i = 0; i < 30; ++i) signs.push_back(line("l" + std::to_string(10 + i), std::to_string(i)));
  for (int i = 0; i < 60; ++i)
    signs.push_back(marker("m" + std::to_string(10 + i), {0.0F, 0.0F, -1.0F - static_cast<float>(i)}));
  const auto shown = shown_signs(signs, {}, ahead, wide);
  ASSERT_EQ(shown.size(), limits::sign_rows_max + limits::sign_markers_max);
  EXPECT_EQ(shown[limits::sign_rows_max - 1].words, std::to_string(limits::sign_rows_max - 1));
  EXPECT_EQ(shown.back().words, "m10") << "the nearest lies over the others";
  EXPECT_FLOAT_EQ(shown[limits::sign_rows_max].marker->metres, static_cast<float>(limits::sign_markers_max));
}

TEST(ShownSigns, a_marker_lies_at_its_place_and_is_fainter_far_away) {
  const auto middle = place_of_marker({0.0F, 0.0F, -20.0F}, ahead, wide);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->at.x, 0.5F, 1e-5F);
  EXPECT_NEAR(middle->at.y, 0.5F, 1e-5F);
  EXPECT_FALSE(middle->way);
  EXPECT_EQ(middle->opacity, 1.0F);
  const auto upper_right = place_of_marker({4.0F, 4.0F, -20.0F}, ahead, wide);
  EXPECT_GT(upper_right->at.x, 0.55F);
  EXPECT_LT(upper_right->at.y, 0.45F);
  const auto far = place_of_marker({0.0F, 0.0F, -900.0F}, ahead, wide);
  ASSERT_TRUE(far) << "in sight, however far";
  EXPECT_EQ(far->opacity, limits::sign_faintest);
  EXPECT_LT(place_of_marker({0.0F, 0.0F, -120.0F}, ahead, wide)->opacity, 0.9F);
}

TEST(ShownSigns, a_marker_beside_the_picture_is_at_its_edge_and_points_there) {
  for (const glm::vec3 place_m :
       {glm::vec3(50.0F, 0.0F, -1.0F), glm::vec3(50.0F, 0.0F, 20.0F), glm::vec3(-50.0F, 3.0F, 5.0F),
        glm::vec3(0.0F, 90.0F, -5.0F), glm::vec3(1.0F, -60.0F, 3.0F), glm::vec3(0.0F, 0.0F, 30.0F)}) {
    const auto place = place_of_marker(place_m, ahead, wide);
    ASSERT_TRUE(place && place->way);
    EXPECT_NEAR(glm::length(*place->way), 1.0F, 1e-4F);
    EXPECT_GT(place->at.x, 0.0F);
    EXPECT_LT(place->at.x, 1.0F);
    EXPECT_GT(place->at.y, 0.0F);
    EXPECT_LT(place->at.y, 1.0F);
    if (std::abs(place_m.x) > 10.0F) {
      EXPECT_EQ(place->way->x > 0.0F, place_m.x > 0.0F) << "turning that way, one sees it";
      EXPECT_EQ(place->at.x > 0.5F, place_m.x > 0.0F);
    }
  }
  EXPECT_FALSE(place_of_marker({0.0F, 0.0F, 201.0F}, ahead, wide)) << "too far to point at";
}

// ---- drawing

Image grey(int width, int height) {
  return {width, height,
          std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 90)};
}

Image painted(const std::vector<Sign>& signs, int width = 640, int height = 360, SignMoment moment = {}) {
  Image image = grey(width, height);
  SignPainter().paint(image, signs, moment, ahead);
  return image;
}

/// Pixels of about that colour within a part of the picture.
int count_colour(const Image& image, std::array<int, 3> colour, glm::vec2 from, glm::vec2 to) {
  int count = 0;
  for (int y = static_cast<int>(from.y * static_cast<float>(image.height));
       y < static_cast<int>(to.y * static_cast<float>(image.height)); ++y)
    for (int x = static_cast<int>(from.x * static_cast<float>(image.width));
         x < static_cast<int>(to.x * static_cast<float>(image.width)); ++x) {
      const size_t at = 3 * static_cast<size_t>(y * image.width + x);
      bool is = true;
      for (size_t i = 0; i < 3; ++i) is = is && std::abs(image.rgb[at + i] - colour[i]) < 24;
      count += is ? 1 : 0;
    }
  return count;
}

TEST(SignPictures, where_no_sign_is_shown_no_byte_of_the_picture_changes) {
  EXPECT_EQ(painted({}).rgb, grey(640, 360).rgb);
  EXPECT_EQ(painted({counting(600)}, 640, 360, {600.0, 60.0}).rgb, grey(640, 360).rgb);
  EXPECT_EQ(painted({marker("behind", {0.0F, 0.0F, 300.0F})}).rgb, grey(640, 360).rgb);
  EXPECT_EQ(painted({line("empty", "")}).rgb, grey(640, 360).rgb);
}

TEST(SignPictures, a_bar_is_filled_by_its_share) {
  Sign bar{.name = "bar", .kind = SignKind::bar, .text = ""};
  bar.colour = {255, 40, 40};
  const auto red = [&](float share) {
    bar.share = share;
    return count_colour(painted({bar}), {255, 40, 40}, {0.0F, 0.0F}, {1.0F, 0.3F});
  };
  EXPECT_EQ(red(0.0F), 0);
  const int whole = red(1.0F);
  EXPECT_GT(whole, 300);
  EXPECT_NEAR(static_cast<float>(red(0.25F)), 0.25F * static_cast<float>(whole),
              0.03F * static_cast<float>(whole));
}

TEST(SignPictures, rows_lie_at_the_top_and_a_marker_at_its_place) {
  Sign words = line("a", "Round 2");
  words.colour = {60, 255, 60};
  const Image image = painted({words});
  EXPECT_GT(count_colour(image, {60, 255, 60}, {0.3F, 0.0F}, {0.7F, 0.15F}), 20);
  EXPECT_EQ(count_colour(image, {60, 255, 60}, {0.0F, 0.15F}, {1.0F, 1.0F}), 0);
  Sign place = marker("here", {0.0F, 0.0F, -10.0F});
  place.colour = {60, 255, 60};
  EXPECT_GT(count_colour(painted({place}), {60, 255, 60}, {0.45F, 0.45F}, {0.55F, 0.55F}), 30);
}

/// Where the words lie, and the diamonds and arrows.
std::vector<TakenRoom> rooms_of(const std::vector<SignPart>& parts, const LetterSizes& letters) {
  std::vector<TakenRoom> rooms;
  for (const SignPart& part : parts) {
    if (const auto* const words = std::get_if<SignWords>(&part))
      rooms.push_back({words->at, words->at + glm::vec2(letters.width(words->words), letters.height)});
    if (const auto* const triangle = std::get_if<SignTriangle>(&part)) {
      const auto& [a, b, c] = triangle->corners;
      rooms.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    }
  }
  return rooms;
}

TEST(SignDrawing, a_markers_words_and_arrow_lie_beside_rows_and_panels) {
  const LetterSizes letters{[](const std::string& words) { return 7.0F * static_cast<float>(words.size()); },
                            13.0F};
  const glm::vec2 size(1280.0F, 720.0F);
  const TakenRoom tools{{400.0F, 650.0F}, {880.0F, 712.0F}}, figures{{8.0F, 8.0F}, {300.0F, 120.0F}};
  std::vector<ShownSign> rows;
  for (const char* name : {"a", "b", "c"})
    rows.push_back({line(name, "Order: 20 m³ of iron to the gate, please"), "Order: 20 m³ of iron, please"});
  const std::vector<TakenRoom> of_rows = rooms_of(draw_signs(rows, size, letters), letters);
  const auto marked = [&](MarkerPlace place) {
    std::vector<ShownSign> shown = rows;
    shown.push_back({marker("gate", {}), "the gate", place});
    // Markers are drawn first.
    std::vector<TakenRoom> rooms = rooms_of(draw_signs(shown, size, letters, {tools, figures}), letters);
    rooms.resize(rooms.size() - of_rows.size());
    return rooms;
  };
  std::vector<TakenRoom> taken = of_rows;
  taken.insert(taken.end(), {tools, figures});
  const auto expect_beside = [&](const TakenRoom& room, glm::vec2 at) {
    for (const TakenRoom& one : taken)
      EXPECT_FALSE(room.from.x < one.to.x && one.from.x < room.to.x && room.from.y < one.to.y &&
                   one.from.y < room.to.y)
          << at.x << ", " << at.y << ": " << room.from.y << " to " << room.to.y;
    EXPECT_TRUE(room.from.x >= 0.0F && room.to.x <= size.x && room.from.y >= 0.0F && room.to.y <= size.y);
  };
  for (const float x : {0.04F, 0.2F, 0.5F, 0.6F, 0.95F}) {
    // At the edge: all of it.
    for (const auto& [y, way] : {std::pair(0.06F, -1.0F), std::pair(0.94F, 1.0F)})
      for (const TakenRoom& room : marked({.at = {x, y}, .way = glm::vec2(0.0F, way)}))
        expect_beside(room, {x, y});
    // In the picture: a place is where it is, its words beside it.
    for (const float y : {0.02F, 0.12F, 0.5F, 0.88F, 0.97F})
      // Where it lies beneath something, it may have no words.
      for (const TakenRoom& room : marked({.at = {x, y}}))
        if (room.to.x - room.from.x > 50.0F) expect_beside(room, {x, y});
  }
  const auto has_words = [&](glm::vec2 at) {
    return std::ranges::any_of(marked({.at = at}),
                               [](const TakenRoom& room) { return room.to.x - room.from.x > 50.0F; });
  };
  for (const glm::vec2 at : {glm::vec2(0.5F, 0.5F), glm::vec2(0.95F, 0.88F), glm::vec2(0.5F, 0.88F)})
    EXPECT_TRUE(has_words(at)) << at.x << ", " << at.y;
}

TEST(SignPictures, any_words_and_any_size_are_harmless) {
  Sign odd = line("odd", "Türme ↑ 雪 \xF0\x9F\x8F\x94 " + std::string(60, 'x'));
  Sign place = marker("beside", {50.0F, 0.0F, 0.0F});
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(7, 90), std::pair(1920, 1080), std::pair(64, 48)})
    EXPECT_NE(painted({odd, place}, width, height).rgb, grey(width, height).rgb);
}

}  // namespace
}  // namespace scree
