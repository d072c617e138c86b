// Roles and administrators over loopback: each request against each role, sessions that are refused for their
// token, tokens revoked while their session lasts, kicking and banning, and bans that outlive the server.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <thread>

#include "client/connection/connection.h"
#include "server/doors/bans.h"
#include "server/doors/limits.h"
#include "server/net/limits.h"
#include "tests/support/access_fixture.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

using RoleTest = AccessTest;

TEST_F(RoleTest, each_may_do_what_those_before_it_may_and_no_more) {
  start();
  for (const Role role : all_kinds<Role>) {
    const auto client = join(token(role), role);
    commands.drain();
    const Shape shape = sphere({}, 1.0F);
    const ClientMessage requests[] = {CarveMessage{{.shape = shape}, 1}, FillMessage{{shape}, 2},
                                      PaintMessage{{shape, material::ice}, 3},
                                      AdminMessage{4, "", SettingsRequest{{{"dents", "false"}}}}};
    const Role needed[] = {Role::carver, Role::builder, Role::builder, Role::admin};
    size_t allowed = 0;
    for (size_t i = 0; i < std::size(requests); ++i) {
      ASSERT_TRUE(client->send(requests[i]));
      allowed += may_act_as(role, needed[i]) ? 1 : 0;
      if (may_act_as(role, needed[i])) continue;
      const auto reply = client->receive_as<ReplyMessage>();
      ASSERT_TRUE(reply);
      EXPECT_EQ(reply->request, i + 1);
      EXPECT_TRUE(holds(reply->refusal, "takes the role " + std::string(name_of(needed[i]))))
          << reply->refusal;
      EXPECT_TRUE(holds(reply->refusal, "this session is a " + std::string(name_of(role)))) << reply->refusal;
    }
    // An answer follows all requests before it.
    ASSERT_TRUE(client->send(AdminMessage{5, role == Role::admin ? "" : the_admin_token, ListBansRequest{}}));
    ASSERT_TRUE(client->receive_as<AdminListMessage>());
    EXPECT_EQ(commands.drain().size(), allowed) << name_of(role);
  }
}

TEST_F(RoleTest, without_a_token_is_what_the_server_says) {
  for (const std::optional<Role> anonymous :
       {std::optional(Role::viewer), std::optional(Role::carver), std::optional<Role>()}) {
    config.access.anonymous = anonymous;
    start();
    if (anonymous) join("", *anonymous);
    if (!anonymous) {
      EXPECT_TRUE(holds(refusal(hello("")), "requires an access token: ask its operator"));
    }
  }
}

TEST_F(RoleTest, a_server_without_configuration_lets_everybody_build) {
  config = {};
  config.terrain = flat_terrain;
  start();
  join("", Role::builder);
  join("a token that nobody looks at", Role::builder);
}

TEST_F(RoleTest, a_full_server_has_room_for_tokens_and_keeps_those_who_hold_one) {
  config.service.sessions_max = 2;
  start();
  const auto acts = [](RawClient& client) {
    EXPECT_TRUE(client.send(InterestMessage{{1.0F, 2.0F, 3.0F}, 64.0F}));
    EXPECT_TRUE(client.send(AdminMessage{1, "", ListBansRequest{}}));
    EXPECT_TRUE(client.receive_as<ReplyMessage>()) << "it was carried out";
  };
  const auto first = join("", Role::viewer), second = join("", Role::viewer);
  acts(*first);
  acts(*second);
  EXPECT_TRUE(holds(refusal(hello("")), "the server is full"));
  const auto builder = join(token(Role::builder), Role::builder);
  const auto displaced = first->receive_as<RefusalMessage>();
  ASSERT_TRUE(displaced);
  EXPECT_TRUE(holds(displaced->reason, "another client has your place"));
  const auto administrator = join(the_admin_token, Role::admin);
  acts(*second);
  std::this_thread::sleep_for(std::chrono::duration<double>(limits::inert_seconds_max));
  EXPECT_TRUE(holds(refusal(hello("")), "the server is full")) << "nobody without a token displaces them";
  acts(*second);
  const auto carver = join(token(Role::carver, 31), Role::carver);
  EXPECT_TRUE(second->receive_as<RefusalMessage>()) << "those who hold a token go first";
  acts(*carver);
  join(token(Role::carver, 32), Role::carver);
  EXPECT_TRUE(builder->receive_as<RefusalMessage>()) << "it has done nothing since it came";
}

TEST_F(RoleTest, administrators_take_no_place_and_nobody_goes_for_them) {
  config.service.sessions_max = 1;
  start();
  const auto player = join("", Role::viewer);
  const auto plays = [&] {
    EXPECT_TRUE(player->send(AdminMessage{1, "", ListBansRequest{}}));
    return player->receive_as<ReplyMessage>().has_value();
  };
  std::vector<std::unique_ptr<RawClient>> administrators;
  for (size_t i = 0; i < limits::administrators_max; ++i)
    administrators.push_back(join(i % 2 == 0 ? the_admin_token : token(Role::admin), Role::admin));
  EXPECT_TRUE(plays());
  EXPECT_TRUE(holds(refusal(hello(the_admin_token)), "administrators already"));
  EXPECT_TRUE(holds(refusal(hello("")), "the server is full"));
  EXPECT_TRUE(plays());
}

TEST_F(RoleTest, programs_that_administer_go_for_each_other_and_for_administrators) {
  config.service.sessions_max = 1;
  start();
  const auto player = join("", Role::viewer);
  std::vector<std::unique_ptr<RawClient>> visitors;
  HelloMessage visit = hello("");
  visit.administers = true;
  for (size_t i = 0; i < limits::administrators_max + 5; ++i) {
    visitors.push_back(std::make_unique<RawClient>(server->port()));
    ASSERT_TRUE(visitors.back()->send(visit));
    ASSERT_TRUE(visitors.back()->receive_as<WelcomeMessage>()) << i;
  }
  for (size_t i = 0; i < 5; ++i) EXPECT_TRUE(visitors[i]->receive_as<RefusalMessage>()) << i;
  join(the_admin_token, Role::admin);
  EXPECT_TRUE(visitors[5]->receive_as<RefusalMessage>()) << "it came first of those that are left";
  EXPECT_TRUE(player->send(AdminMessage{1, "", ListBansRequest{}}));
  EXPECT_TRUE(player->receive_as<ReplyMessage>());
}

TEST_F(RoleTest, who_administers_alone_sees_and_changes_no_terrain) {
  start();
  commands.drain();
  RawClient client(server->port());
  HelloMessage visit = hello(token(Role::builder));
  visit.administers = true;
  ASSERT_TRUE(client.send(visit));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->interest_radius_m, 0.0F);
  ASSERT_TRUE(client.send(InterestMessage{{}, 64.0F}));
  ASSERT_TRUE(client.send(FillMessage{{sphere({}, 1.0F)}, 9}));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply);
  EXPECT_TRUE(holds(reply->refusal, "administers alone")) << reply->refusal;
  EXPECT_TRUE(commands.drain().empty());
}

TEST_F(RoleTest, guesses_at_the_admin_token_by_hellos_are_slowed_down_and_access_tokens_are_not) {
  start();
  const Within wait(limits::guess_wait_min_s);
  EXPECT_TRUE(holds(refusal(hello("no-admin-token")), "this server does not know the token"));
  const std::string said = refusal(hello(the_admin_token));
  if (wait.over()) GTEST_SKIP() << "the machine stood still: the next guess is looked at";
  EXPECT_TRUE(holds(said, "the server checks the next one in")) << said;
  EXPECT_TRUE(comes_to_refuse(Refusal::token_guesses));
  for (int i = 0; i < 20; ++i)
    EXPECT_TRUE(holds(refusal(hello("no-admin-token")), "as before")) << "which is no guess";
  join(token(Role::builder), Role::builder);
}

TEST_F(RoleTest, a_token_used_twice_holds_for_both_until_it_is_revoked_for_both) {
  config.access.token_revoked_path = folder / "revoked";
  std::ofstream(folder / "revoked") << "";
  start();
  const auto honest = join(token(Role::carver, 22), Role::carver);
  const auto one = join(token(Role::carver, 21), Role::carver);
  const auto other = join(token(Role::carver, 21), Role::carver);
  std::ofstream(folder / "revoked") << id_text(21) << "\n";
  ASSERT_TRUE(server->reload());
  for (const auto& client : {one.get(), other.get()}) {
    const auto refused = client->receive_as<RefusalMessage>();
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->name, "token_revoked");
  }
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(holds(refusal(hello(token(Role::carver, 21))), "was revoked"));
  ASSERT_TRUE(honest->send(FillMessage{{sphere({}, 1.0F)}, 9}));
  EXPECT_TRUE(honest->receive_as<ReplyMessage>()) << "no other notices";
  join(token(Role::carver, 22), Role::carver);
}

TEST_F(RoleTest, a_token_that_does_not_hold_refuses_the_session_by_its_reason) {
  config.access.token_revoked_path = folder / "revoked";
  config.access.world = "mine";
  config.admin_token.clear();  // whatever is no access token would be a guess at it
  std::ofstream(folder / "revoked") << id_text(13) << "\n";
  start();
  const auto named = [&](const std::string& token, Refusal reason, const char* words) {
    EXPECT_TRUE(holds(refusal(hello(token)), words)) << refusal(hello(token));
    EXPECT_TRUE(comes_to_refuse(reason)) << words;
  };
  named("scree1.garbled", Refusal::token_malformed, "the token is damaged");
  named("a-guess-of-something", Refusal::token_malformed, "not an access token");
  named(*sign({7, Role::admin, 0, 0, "", ""}, SigningKey::generate()), Refusal::token_foreign,
        "not signed by this server's key");
  named(token(Role::builder, 7, 1'000'000'000), Refusal::token_expired, "has expired");
  named(token(Role::builder, 13), Refusal::token_revoked, "000000000000000d was revoked");
  named(*sign({7, Role::admin, 0, 0, "", "yours"}, key), Refusal::token_world,
        "for the world 'yours', and this one is 'mine'");
  const std::vector<uint8_t> fields = encode(ClientMessage(hello(std::string(512, 'x'))));
  // One byte more of token (field 6), of hello (field 1) and of message. Lengths of 128 to 16,383 take two
  // bytes.
  const auto varint = [](size_t length) {
    return std::string{static_cast<char>(0x80U | (length & 0x7FU)), static_cast<char>(length >> 7U)};
  };
  const std::string body(fields.begin() + length_prefix_bytes + 3, fields.end());
  const size_t at = body.find("\x32" + varint(512));
  ASSERT_NE(at, std::string::npos);
  std::string with_longer = body.substr(0, at) + "\x32" + varint(513) + 'x' + body.substr(at + 3);
  with_longer = '\x0A' + varint(with_longer.size()) + with_longer;
  std::vector<uint8_t> longer{static_cast<uint8_t>(with_longer.size()),
                              static_cast<uint8_t>(with_longer.size() >> 8U), 0, 0};
  longer.insert(longer.end(), with_longer.begin(), with_longer.end());
  RawClient client(server->port());
  ASSERT_TRUE(client.send_bytes(longer));
  const auto refused = client.receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_TRUE(holds(refused->reason, "token has 513 bytes, over the limit of 512")) << refused->reason;
}

TEST_F(RoleTest, a_token_revoked_while_its_session_lasts_ends_it_and_no_other) {
  config.access.token_revoked_path = folder / "revoked";
  std::ofstream(folder / "revoked") << "";
  start();
  const auto lost = join(token(Role::carver, 21), Role::carver);
  const auto kept = join(token(Role::carver, 22), Role::carver);
  std::ofstream(folder / "revoked") << id_text(21) << "  # lost\n";
  ASSERT_TRUE(server->reload());
  const auto refused = lost->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_TRUE(holds(refused->reason, "was revoked"));
  std::ofstream(folder / "revoked") << "not an id\n";
  EXPECT_TRUE(holds(server->reload().error().message, "line 1"));
  EXPECT_TRUE(holds(refusal(hello(token(Role::carver, 21))), "was revoked"))
      << "the last good list stays in force";
  ASSERT_TRUE(kept->send(FillMessage{{sphere({}, 1.0F)}, 9}));
  EXPECT_TRUE(kept->receive_as<ReplyMessage>());
}

TEST_F(RoleTest, the_name_in_a_token_is_the_one_that_is_listed) {
  start();
  const auto named = join(*sign({9, Role::builder, 0, 0, "Ann", ""}, key), Role::builder);
  const auto free = join("", Role::viewer);
  const auto sessions = list_sessions(admin(the_admin_token));
  ASSERT_TRUE(sessions) << sessions.error().message;
  ASSERT_EQ(sessions->size(), 3U);
  EXPECT_EQ((*sessions)[0].name, "Ann");
  EXPECT_EQ((*sessions)[0].role, Role::builder);
  EXPECT_EQ((*sessions)[0].token_id, 9U);
  EXPECT_EQ((*sessions)[0].address, "127.0.0.1");
  EXPECT_GT((*sessions)[0].sent_bytes, 0U);
  EXPECT_EQ((*sessions)[1].name, "Ben");
  EXPECT_EQ((*sessions)[2].program, "scree-admin");
  EXPECT_EQ((*sessions)[2].role, Role::admin);
  EXPECT_TRUE(holds(sessions_lines(*sessions), "builder  127.0.0.1"));
  EXPECT_TRUE(holds(sessions_json(*sessions), "\"token\": \"0000000000000009\""));
}

TEST_F(RoleTest, only_administrators_administer) {
  start();
  for (const std::string& nobody : {std::string(), token(Role::builder)}) {
    EXPECT_TRUE(holds(list_sessions(admin(nobody)).error().message, "takes the role admin"));
    EXPECT_TRUE(holds(kick_session(admin(nobody), {1, ""}).error().message, "takes the role admin"));
    EXPECT_TRUE(
        holds(ban_address(admin(nobody), {0, "10.0.0.1", 0, ""}).error().message, "takes the role admin"));
  }
  EXPECT_TRUE(list_sessions(admin(token(Role::admin))));
  EXPECT_TRUE(list_sessions(admin(the_admin_token)));
  // The token in the message goes on to work, and a wrong one to end the connection.
  const auto client = join("", Role::viewer);
  ASSERT_TRUE(client->send(AdminMessage{1, the_admin_token, ListSessionsRequest{}}));
  EXPECT_TRUE(client->receive_as<AdminListMessage>());
  ASSERT_TRUE(client->send(AdminMessage{2, "another-admin-token", ListSessionsRequest{}}));
  const auto refused = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, "this server does not know the token");
}

TEST_F(RoleTest, who_is_kicked_is_told_why_and_may_come_again) {
  start();
  const auto client = join("", Role::viewer);
  const auto other = join("", Role::viewer);
  const uint64_t session = list_sessions(admin(the_admin_token))->front().session;
  ASSERT_TRUE(kick_session(admin(the_admin_token), {session, "too loud"}));
  const auto refused = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, "an administrator ended this session: too loud");
  EXPECT_TRUE(comes_to_refuse(Refusal::kicked));
  EXPECT_TRUE(holds(kick_session(admin(the_admin_token), {999, ""}).error().message, "no session 999"));
  join("", Role::viewer);
  ASSERT_TRUE(other->send(FillMessage{{sphere({}, 1.0F)}, 9}));
  EXPECT_TRUE(other->receive_as<ReplyMessage>()) << "no other notices";
}

TEST_F(RoleTest, who_is_banned_stays_out_over_a_restart_until_it_is_lifted) {
  config.access.bans_path = folder / "bans";
  start();
  const auto client = join(token(Role::builder), Role::builder);
  const uint64_t session = list_sessions(admin(the_admin_token))->front().session;
  ASSERT_TRUE(ban_address(admin(the_admin_token), {session, "", 0, "griefing"}));
  const auto refused = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, "this address is banned from the server: griefing");
  EXPECT_TRUE(holds(refusal(hello(token(Role::builder))), "banned"));
  ASSERT_TRUE(ban_address(admin(the_admin_token), {0, "2001:db8:1:2:3:4:5:6", 90, ""}));
  EXPECT_TRUE(
      holds(ban_address(admin(the_admin_token), {0, "nowhere", 0, ""}).error().message, "an IPv4 or IPv6"));
  server->stop();
  start();
  EXPECT_TRUE(holds(refusal(hello("")), "banned from the server: griefing"));
  const auto bans = list_bans(admin(the_admin_token));
  ASSERT_TRUE(bans) << bans.error().message << " (administrators come in all the same)";
  ASSERT_EQ(bans->size(), 2U);
  EXPECT_EQ((*bans)[0], (BanRow{"127.0.0.1", 0, "griefing"}));
  EXPECT_EQ((*bans)[1].address, "2001:db8:1:2::/64");
  EXPECT_GT((*bans)[1].left_s, 89U * 60U - 60U);
  EXPECT_TRUE(holds(bans_lines(*bans), "127.0.0.1, until it is lifted: griefing"));
  ASSERT_TRUE(lift_ban(admin(the_admin_token), {"127.0.0.1"}));
  ASSERT_TRUE(lift_ban(admin(the_admin_token), {"2001:db8:1:2::/64"}));
  EXPECT_TRUE(holds(lift_ban(admin(the_admin_token), {"127.0.0.1"}).error().message, "is not banned"));
  join("", Role::viewer);
  EXPECT_TRUE(list_bans(admin(the_admin_token))->empty());
}

TEST_F(RoleTest, networks_names_and_tokens_are_banned_apart) {
  start();
  const std::string one = token(Role::builder, 0x15), other = token(Role::builder, 0x16);
  const auto client = join(one, Role::builder);
  ASSERT_TRUE(ban_address(admin(the_admin_token), {0, "token:0000000000000015", 0, "griefing"}));
  const auto refused = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, "this token is banned from the server: griefing");
  EXPECT_TRUE(holds(refusal(hello(one)), "this token is banned"));
  join(other, Role::builder);
  for (const auto& [target, words] :
       {std::pair{"127.0.0.0/8", "this address is banned"}, {"name:Ben", "this name is banned"}}) {
    ASSERT_TRUE(ban_address(admin(the_admin_token), {0, target, 0, ""}));
    EXPECT_TRUE(holds(refusal(hello(other)), words));
    ASSERT_TRUE(lift_ban(admin(the_admin_token), {target}));
    join(other, Role::builder);
  }
}

TEST(BanList, keeps_time_and_its_limits) {
  const TestFolder folder;
  auto bans = Bans::open(folder / "bans");
  ASSERT_TRUE(bans);
  ASSERT_TRUE(bans->add(ban_key("10.0.0.1").value(), {100, "two words"}, 50));
  EXPECT_TRUE(bans->find({"10.0.0.1"}, 99));
  EXPECT_FALSE(bans->find({"10.0.0.1"}, 100));
  EXPECT_FALSE(bans->find({"10.0.0.2"}, 99));
  EXPECT_TRUE(bans->find({"::ffff:10.0.0.1"}, 99)) << "the same address, written as IPv6";
  ASSERT_TRUE(bans->add(ban_key("fe80::1:2:3:4").value(), {0, ""}, 50));
  EXPECT_TRUE(bans->find({"fe80::ffff"}, 1'000'000)) << "the same network of 64 bits";
  const auto again = Bans::open(folder / "bans");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->all().size(), 2U);
  EXPECT_EQ(again->find({"10.0.0.1"}, 99)->ban.reason, "two words");
  Bans full = *Bans::open("");
  for (size_t i = 0; i < limits::bans_max; ++i) ASSERT_TRUE(full.add("key" + std::to_string(i), {0, ""}, 50));
  EXPECT_TRUE(holds(full.add("one more", {0, ""}, 50).error().message, "limits.bans_max"));
  EXPECT_TRUE(full.add("key7", {0, "again"}, 50)) << "one that is there may change";
  std::ofstream(folder / "bad") << "10.0.0.1 0 fine\n10.0.0.2 tomorrow\n\x01junk\n";
  const auto with_bad = Bans::open(folder / "bad");
  ASSERT_TRUE(with_bad) << "a bad line keeps no server from its start";
  EXPECT_TRUE(holds(with_bad->fault(), "bad, line 2"));
  EXPECT_TRUE(holds(with_bad->fault(), "and 1 more"));
  EXPECT_TRUE(with_bad->find({"10.0.0.1"}, 99));
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  EXPECT_TRUE(holds(Bans::open(folder / "loop").error().message, "cannot be read")) << "it may hold some";
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& odd : {folder / "pipe", folder / "", std::string("/dev/zero")})
    EXPECT_TRUE(holds(Bans::open(odd).error().message, "not a file"))
        << "it could not take the list: " << odd;
  std::ofstream(folder / "long") << "#";
  std::filesystem::resize_file(folder / "long", limits::bans_bytes_max + 1);
  EXPECT_TRUE(holds(Bans::open(folder / "long").error().message, "KiB")) << "it is not read";
  const auto nowhere = Bans::open(folder / "no/such/folder");
  ASSERT_TRUE(nowhere);
  Bans unkept = *nowhere;
  EXPECT_TRUE(holds(unkept.add("10.0.0.1", {0, ""}, 50).error().message, "cannot be written"));
  EXPECT_TRUE(unkept.find({"10.0.0.1"}, 50)) << "it holds all the same";
}

}  // namespace
}  // namespace scree
