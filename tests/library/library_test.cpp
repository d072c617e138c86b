// The functions of scree/client.h against a live server, as a program in C calls them.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>

#include "tests/support/library_fixture.h"

namespace scree {
namespace {

class LibraryBodies : public LibraryTest {
 protected:
  /// That the columns have what the rows have, and that a column may be left out.
  void expect_columns(const std::vector<scree_body>& rows) {
    const size_t room = rows.size();
    std::vector<uint32_t> ids(room);
    std::vector<uint8_t> kinds(room);
    std::vector<float> positions(3 * room), rotations(4 * room);
    scree_body_columns columns{.size = sizeof columns,
                               .ids = ids.data(),
                               .kinds = kinds.data(),
                               .positions = positions.data(),
                               .rotations = rotations.data()};
    size_t count = 0;
    EXPECT_EQ(scree_client_body_columns(client, -1.0, &columns, room - 1, &count), SCREE_TOO_SMALL);
    EXPECT_EQ(count, room);
    ASSERT_EQ(scree_client_body_columns(client, -1.0, &columns, room, &count), SCREE_OK);
    for (size_t i = 0; i < room; ++i) {
      EXPECT_EQ(ids[i], rows[i].id);
      EXPECT_EQ(kinds[i], rows[i].kind);
      EXPECT_TRUE(std::equal(rows[i].position, rows[i].position + 3, positions.data() + 3 * i));
      EXPECT_TRUE(std::equal(rows[i].rotation, rows[i].rotation + 4, rotations.data() + 4 * i));
    }
    scree_body_columns ids_alone{.size = sizeof columns,
                                 .ids = ids.data(),
                                 .kinds = nullptr,
                                 .positions = nullptr,
                                 .rotations = nullptr};
    std::fill(ids.begin(), ids.end(), 0);
    ASSERT_EQ(scree_client_body_columns(client, -1.0, &ids_alone, room, &count), SCREE_OK);
    EXPECT_EQ(ids.back(), rows.back().id);
    ids_alone.size = 1;
    EXPECT_EQ(scree_client_body_columns(client, -1.0, &ids_alone, room, &count), SCREE_INVALID);
  }
};

TEST_F(LibraryBodies, a_carve_is_answered_its_pieces_fall_and_merge_and_both_hashes_agree) {
  join();
  EXPECT_EQ(seen[SCREE_EVENT_JOINED], 1);
  EXPECT_EQ(status().connected, 1U);
  EXPECT_NEAR(ground_below(0.0F), 0.0F, 0.01F);
  EXPECT_GE(ask(crater()), 1U << 31U) << "inputs on foot have the numbers below";
  follow_until([&] { return seen[SCREE_EVENT_PIECE_ADDED] > 0 && !refusals.empty(); }, "pieces");
  EXPECT_EQ(refusals, std::vector<std::string>{""});
  EXPECT_GT(seen[SCREE_EVENT_TERRAIN], 0);
  std::vector<scree_body> bodies(1);
  size_t count = 0;
  EXPECT_EQ(scree_client_bodies(client, -1.0, bodies.data(), 0, &count), SCREE_TOO_SMALL);
  EXPECT_EQ(count, status().pieces);
  bodies.resize(count);
  EXPECT_EQ(scree_client_bodies(client, -1.0, bodies.data(), count, &count), SCREE_OK);
  for (const scree_body& body : bodies) EXPECT_LT(std::abs(body.position[0]), 40.0F);
  expect_columns(bodies);
  const auto agrees = [&] {
    const scree_status now = status();
    return now.pieces == 0 && now.server_hash != 0 && now.field_hash == now.server_hash;
  };
  follow_until(agrees, "rest");
  EXPECT_EQ(seen[SCREE_EVENT_PIECE_REMOVED], seen[SCREE_EVENT_PIECE_ADDED]);
  EXPECT_EQ(status().mismatches, 0U);
  EXPECT_GT(std::abs(ground_below(0.0F)), 0.05F) << "a hole or a heap";
}

TEST_F(LibraryTest, a_refusal_has_a_name_and_words_and_a_function_gets_the_reply_in_place_of_an_event) {
  join();
  struct Got {
    int count = 0;
    std::string name, text;
  } got;
  scree_request request = crater();
  request.shape.radius_m = 100.0F;
  const auto hear = [](void* user, const scree_event* reply) {
    auto& heard = *static_cast<Got*>(user);
    ++heard.count;
    heard.name = reply->name;
    heard.text = reply->text;
  };
  ASSERT_EQ(scree_client_request(client, &request, hear, &got, nullptr), SCREE_OK) << scree_error();
  follow_until([&] { return got.count != 0; }, "the reply");
  EXPECT_EQ(got.name, "carve_invalid");
  EXPECT_NE(got.text.find("at most 8 m"), std::string::npos) << got.text;
  EXPECT_EQ(seen[SCREE_EVENT_REPLY], 0);
}

TEST_F(LibraryTest, a_prediction_shows_the_hole_before_the_server_has_answered) {
  join(SCREE_PREDICT);
  const uint64_t before = status().field_hash;
  ask(crater());
  EXPECT_EQ(status().predictions, 1U);
  EXPECT_EQ(status().field_hash, before) << "the copy stays exact";
  auto event = sized<scree_event>();
  ASSERT_EQ(scree_client_poll(client, 0), SCREE_OK);
  bool shown = false;
  while (scree_client_next(client, &event) == SCREE_OK) {
    shown = shown || event.kind == SCREE_EVENT_TERRAIN;
    if (event.kind == SCREE_EVENT_REPLY)
      refusals.emplace_back(event.name);  // on a slow machine it is here already
  }
  EXPECT_TRUE(shown);
  follow_until([&] { return status().predictions == 0 && !refusals.empty(); }, "the answer");
}

TEST_F(LibraryTest, codes_distances_and_casts_tell_of_one_surface) {
  join();
  const int32_t lo[3] = {-2, -6, -2}, hi[3] = {2, 6, 2};
  std::vector<int8_t> codes(size_t{4} * 12 * 4);
  ASSERT_EQ(scree_client_codes(client, lo, hi, codes.data(), codes.size()), SCREE_OK) << scree_error();
  const std::array<float, 6> places{0.0F, 0.5F, 0.0F, 0.0F, -0.5F, 0.0F};
  std::array<float, 2> distances{};
  ASSERT_EQ(scree_client_distances(client, places.data(), 2, distances.data()), SCREE_OK);
  EXPECT_NEAR(distances[0], 0.5F, 0.02F);
  EXPECT_NEAR(distances[1], -0.5F, 0.02F);
  for (int y = -6; y < 6; ++y) {
    const int8_t code = codes.at(static_cast<size_t>((2 * 12 + (y + 6)) * 4 + 2));
    EXPECT_NEAR(code, std::clamp(static_cast<float>(y) * 127.0F / 3.0F, -127.0F, 127.0F), 2.0F) << y;
  }
  EXPECT_EQ(scree_client_codes(client, lo, hi, codes.data(), codes.size() - 1), SCREE_TOO_SMALL);
  const int32_t far[3] = {1 << 21, 0, 0};
  EXPECT_EQ(scree_client_codes(client, lo, far, codes.data(), codes.size()), SCREE_INVALID);
  auto hit = sized<scree_hit>();
  const float place[3] = {1.0F, 0.7F, 0.0F};
  ASSERT_EQ(scree_client_nearest(client, place, 4.0F, SCREE_MASK_ALL, &hit), SCREE_OK) << scree_error();
  EXPECT_NEAR(hit.distance_m, 0.7F, 0.02F);
  uint32_t terrain = 0;
  size_t count = 9;
  ASSERT_EQ(scree_client_overlap(client, place, 1.0F, SCREE_MASK_ALL, &terrain, nullptr, 0, &count),
            SCREE_OK);
  EXPECT_EQ(terrain, 1U);
  EXPECT_EQ(count, 0U);
}

TEST_F(LibraryTest, a_lost_server_is_told_what_waits_gets_an_end_and_the_client_comes_again) {
  join();
  const uint16_t port = server->port();
  ask(crater());
  ASSERT_TRUE(server->stop().has_value());
  server.reset();
  follow_until([&] { return !ends.empty() && !refusals.empty(); }, "the end");
  EXPECT_EQ(ends.front(), 0U) << "another attempt follows";
  EXPECT_EQ(status().connected, 0U);
  EXPECT_EQ(scree_client_say(client, "hello"), SCREE_NOT_CONNECTED);
  start(port);
  follow_until([&] { return seen[SCREE_EVENT_JOINED] == 2; }, "the next welcome");
}

TEST_F(LibraryTest, a_client_that_tries_once_ends_for_good) {
  const uint16_t port = server->port();
  ASSERT_TRUE(server->stop().has_value());
  scree_options options;
  ASSERT_EQ(scree_options_init(&options, sizeof options), SCREE_OK);
  options.port = port;
  options.flags = SCREE_ONCE;
  ASSERT_EQ(scree_client_create(&options, &client), SCREE_OK);
  follow_until([&] { return !ends.empty(); }, "the end");
  EXPECT_EQ(ends.front(), 1U);
  const scree_status now = status();
  EXPECT_EQ(now.tick, 0U);
}

TEST_F(LibraryTest, what_no_call_may_have_is_refused_in_words) {
  scree_options options;
  EXPECT_EQ(scree_options_init(nullptr, sizeof options), SCREE_INVALID);
  EXPECT_EQ(scree_options_init(&options, 3), SCREE_INVALID);
  ASSERT_EQ(scree_options_init(&options, sizeof options), SCREE_OK);
  const auto refused = [&](const std::function<void(scree_options&)>& change, const char* word) {
    scree_options wrong = options;
    change(wrong);
    scree_client* made = nullptr;
    EXPECT_EQ(scree_client_create(&wrong, &made), SCREE_INVALID) << word;
    EXPECT_EQ(made, nullptr);
    EXPECT_NE(std::string(scree_error()).find(word), std::string::npos) << scree_error();
  };
  refused([](scree_options& o) { o.size = 8; }, "release");
  refused([](scree_options& o) { o.size = 0xCDCDCDCDU; }, "release");
  refused([](scree_options& o) { o.host = ""; }, "host");
  refused([](scree_options& o) { o.name = "v\xff"; }, "UTF-8");
  refused([](scree_options& o) { o.eye_m[1] = std::nanf(""); }, "finite");
  refused([](scree_options& o) { o.port = 70000; }, "port");
  refused([](scree_options& o) { o.radius_m = -1.0F; }, "below 0");
  refused([](scree_options& o) { o.fingerprint = "ab"; }, "TLS");
  refused([](scree_options& o) { o.cache_folder = "/tmp"; }, "cache_bytes");
  refused([](scree_options& o) { o.allocator.release = [](void*, void*, size_t) {}; }, "allocator");
  const std::string long_name(200, 'n');
  refused([&](scree_options& o) { o.name = long_name.c_str(); }, "name");
  EXPECT_EQ(scree_client_poll(nullptr, 0), SCREE_INVALID);
  EXPECT_EQ(scree_client_next(nullptr, nullptr), SCREE_INVALID);
  scree_client_destroy(nullptr);
  scree_mesher_destroy(nullptr);

  connect();
  scree_request request = crater();
  EXPECT_EQ(scree_client_request(client, &request, nullptr, nullptr, nullptr), SCREE_NOT_CONNECTED);
  follow_until([&] { return status().loaded != 0; }, "the world around");
  const auto no_request = [&](const std::function<void(scree_request&)>& change) {
    scree_request wrong = crater();
    change(wrong);
    EXPECT_EQ(scree_client_request(client, &wrong, nullptr, nullptr, nullptr), SCREE_INVALID);
  };
  no_request([](scree_request& r) { r.kind = 99; });
  no_request([](scree_request& r) { r.size = 4; });
  no_request([](scree_request& r) { r.shape.kind = 77; });
  no_request([](scree_request& r) { r.shape.radius_m = std::numeric_limits<float>::infinity(); });
  no_request([](scree_request& r) { r.shape.radius_m = -1.0F; });
  no_request([](scree_request& r) { r.pattern = 3; });
  no_request([](scree_request& r) { r.material = 4000; });
  no_request([](scree_request& r) {
    ASSERT_EQ(scree_request_init(&r, sizeof r, SCREE_ADD_BODY), SCREE_OK);
    r.shape.radius_m = 0.5F;
    r.mass_kg = -1.0F;
  });
  EXPECT_NE(std::string(scree_error()).find("mass"), std::string::npos) << scree_error();
  const float nowhere[3] = {std::nanf(""), 0.0F, 0.0F}, down[3] = {0.0F, -1.0F, 0.0F}, nil[3] = {};
  auto hit = sized<scree_hit>();
  EXPECT_EQ(scree_client_cast(client, nowhere, down, 10.0F, 0.0F, SCREE_MASK_ALL, &hit), SCREE_INVALID);
  EXPECT_EQ(scree_client_cast(client, nil, nil, 10.0F, 0.0F, SCREE_MASK_ALL, &hit), SCREE_INVALID);
  EXPECT_EQ(scree_client_follow(client, nowhere, 10.0F), SCREE_INVALID);
  EXPECT_EQ(scree_client_say(client, ""), SCREE_INVALID);
  EXPECT_EQ(scree_client_say(client, "\xff\xfe"), SCREE_INVALID);
  EXPECT_EQ(scree_client_send(client, "", nullptr, 0), SCREE_INVALID);
  uint32_t number = 0;
  EXPECT_EQ(scree_find_pattern("no such", &number), SCREE_NOTHING);
  EXPECT_EQ(scree_find_pattern("radial", &number), SCREE_OK);
  EXPECT_EQ(number, 1U);
}

TEST_F(LibraryTest, a_function_that_gets_a_reply_may_ask_again_but_not_poll_and_may_destroy_the_client) {
  join();
  struct Got {
    scree_client* client;
    scree_result polled = SCREE_OK, taken = SCREE_OK;
    int count = 0;
  } got{client};
  const auto hear = [](void* user, const scree_event*) {
    auto& heard = *static_cast<Got*>(user);
    auto event = sized<scree_event>();
    heard.polled = scree_client_poll(heard.client, 0);
    heard.taken = scree_client_next(heard.client, &event);
    if (++heard.count == 2) return scree_client_destroy(heard.client);
    const scree_request again = crater(6.0F);
    scree_client_request(heard.client, &again, nullptr, nullptr, nullptr);
  };
  for (int i = 0; i < 2; ++i) {
    const scree_request request = crater(static_cast<float>(3 * i));
    ASSERT_EQ(scree_client_request(client, &request, hear, &got, nullptr), SCREE_OK);
  }
  const Within in(60.0);
  auto event = sized<scree_event>();
  while (got.count < 2 && !in.over()) {
    ASSERT_EQ(scree_client_poll(client, 10), SCREE_OK);
    while (got.count < 2 && scree_client_next(client, &event) == SCREE_OK) continue;
  }
  client = nullptr;  // it has ended
  EXPECT_EQ(got.count, 2);
  EXPECT_EQ(got.polled, SCREE_REFUSED);
  EXPECT_EQ(got.taken, SCREE_REFUSED);
}

TEST_F(LibraryTest, what_lies_beyond_what_is_followed_is_not_exact) {
  join();
  auto hit = sized<scree_hit>();
  const float down[3] = {0.0F, -1.0F, 0.0F}, near[3] = {5.0F, 20.0F, 0.0F}, far[3] = {400.0F, 20.0F, 0.0F};
  ASSERT_EQ(scree_client_cast(client, near, down, 100.0F, 0.0F, SCREE_MASK_ALL, &hit), SCREE_OK);
  EXPECT_EQ(hit.exact, 1U);
  ASSERT_EQ(scree_client_cast(client, far, down, 100.0F, 0.0F, SCREE_MASK_ALL, &hit), SCREE_OK);
  EXPECT_EQ(hit.exact, 0U);
}

TEST_F(LibraryTest, a_newer_programs_larger_struct_is_taken_and_its_rest_left_alone) {
  join();
  struct Newer {
    scree_status known;
    uint64_t later = 77;
  } newer{};
  newer.known.size = sizeof newer;
  ASSERT_EQ(scree_client_status(client, &newer.known), SCREE_OK);
  EXPECT_EQ(newer.known.size, sizeof newer);
  EXPECT_EQ(newer.known.connected, 1U);
  EXPECT_EQ(newer.later, 77U);
}

TEST_F(LibraryTest, connects_and_disconnects_leave_no_thread) {
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                         std::filesystem::directory_iterator());
  };
  join();
  scree_client_destroy(std::exchange(client, nullptr));
  const auto before = threads();
  for (int i = 0; i < 50; ++i) {
    connect();
    if (i % 2 == 0) follow_until([&] { return status().connected != 0; }, "a welcome");
    scree_client_destroy(std::exchange(client, nullptr));
  }
  EXPECT_LE(threads(), before);
}

}  // namespace
}  // namespace scree
