// Access tokens by themselves: what is signed is read, what is damaged or another's never holds; keys and
// lists in files; and the grants that a server gives for them.
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "auth/access_token.h"
#include "auth/base64url.h"
#include "auth/duration_text.h"
#include "proto/limits.h"
#include "server/doors/access.h"
#include "tests/support/certificates.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

constexpr uint64_t today_s = 1'800'000'000;

AccessToken a_token() {
  return {0xFEDCBA9876543210ULL, Role::carver, today_s - 60, today_s + 60, "Ann", "mine"};
}

TEST(AccessTokens, are_read_as_they_were_signed) {
  const SigningKey key = SigningKey::generate();
  for (const Role role : all_kinds<Role>) {
    AccessToken token = a_token();
    token.role = role;
    const auto text = sign(token, key);
    ASSERT_TRUE(text) << text.error().message;
    const auto read = read_access_token(*text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->token, token);
    EXPECT_TRUE(read->is_by(key.public_key()));
    EXPECT_FALSE(read->is_by(SigningKey::generate().public_key()));
  }
}

TEST(AccessTokens, the_longest_fits_and_a_longer_name_is_refused) {
  const SigningKey key = SigningKey::generate();
  AccessToken token{~0ULL,
                    Role::admin,
                    ~0ULL,
                    ~0ULL,
                    std::string(limits::person_name_bytes_max, 'n'),
                    std::string(limits::world_name_bytes_max, 'w')};
  ASSERT_TRUE(sign(token, key));
  EXPECT_EQ(sign(token, key)->size(), 7U + (1 + 8 + 10 + 10 + 1 + 32 + 1 + 64 + 64) * 4 / 3 + 1);
  EXPECT_LE(sign(token, key)->size(), limits::access_token_bytes_max);
  token.name += 'n';
  EXPECT_TRUE(holds(sign(token, key).error().message, "over the limit of 32"));
  token.name = "two\nlines";
  EXPECT_TRUE(holds(sign(token, key).error().message, "control characters"));
  token.name = "Ann\xE2\x80\xAE";
  EXPECT_TRUE(holds(sign(token, key).error().message, "set its direction"));
  token.name = "Ann\xFF";
  EXPECT_TRUE(holds(sign(token, key).error().message, "is not UTF-8"));
  token.name = "";
  token.id = 0;
  EXPECT_FALSE(sign(token, key));
}

TEST(AccessTokens, no_damaged_one_holds) {
  const SigningKey key = SigningKey::generate();
  const std::string good = *sign(a_token(), key);
  for (size_t length = 0; length < good.size(); ++length) {
    const auto read = read_access_token(good.substr(0, length));
    EXPECT_FALSE(read && read->is_by(key.public_key())) << length;
  }
  for (size_t i = 0; i < good.size(); ++i)
    for (const char c : {'A', 'z', '-', '=', '\n', '\0'}) {
      std::string bad = good;
      bad[i] = c;
      const auto read = read_access_token(bad);
      EXPECT_EQ(read && read->is_by(key.public_key()), bad == good) << i;
    }
  for (const char* more : {"A", "AAAA", " ", "."})
    EXPECT_FALSE(read_access_token(good + more) && read_access_token(good + more)->is_by(key.public_key()));
  EXPECT_TRUE(holds(read_access_token(good + std::string(600, 'A')).error().message, "at most 512"));
}

TEST(AccessTokens, base64url_has_one_text_for_each_value) {
  const std::vector<uint8_t> bytes{0xFB, 0xFF, 0x00, 0x01};
  EXPECT_EQ(to_base64url(bytes), "-_8AAQ");
  EXPECT_EQ(from_base64url("-_8AAQ"), bytes);
  for (const char* wrong : {"-_8AAR", "-_8AAQ==", "-_8AAQAAA", "+/8AAQ", "A"})
    EXPECT_FALSE(from_base64url(wrong)) << wrong;
  EXPECT_TRUE(from_base64url("")->empty());
}

TEST(AccessTokens, keys_are_their_owners_and_are_not_overwritten) {
  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
  struct stat file {};
  ASSERT_EQ(::stat((folder / "key").c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777U, 0600U);
  EXPECT_FALSE(SigningKey::generate().write(folder / "key", folder / "other.pub"));
  EXPECT_FALSE(SigningKey::generate().write(folder / "other", folder / "key.pub"));
  EXPECT_FALSE(std::filesystem::exists(folder / "other")) << "half a pair is none";
  const auto read = SigningKey::read(folder / "key");
  const auto open = VerifyingKey::read(folder / "key.pub");
  ASSERT_TRUE(read && open);
  EXPECT_TRUE(read_access_token(*sign(a_token(), *read))->is_by(*open));
  EXPECT_TRUE(holds(VerifyingKey::read(folder / "key").error().message, "no public Ed25519 key"));
  EXPECT_TRUE(holds(SigningKey::read(folder / "key.pub").error().message, "no private Ed25519 key"));
  EXPECT_TRUE(holds(SigningKey::read(folder / "nothing").error().message, "cannot be read"));
  TestCertificate("DNS:localhost").write(folder / "certificate", folder / "elliptic");
  EXPECT_TRUE(holds(SigningKey::read(folder / "elliptic").error().message, "no private Ed25519 key"));
}

TEST(AccessTokens, a_list_of_revoked_ones_names_the_line_that_is_wrong) {
  const TestFolder folder;
  std::ofstream(folder / "good") << "# lost laptops\n0000000000000005  # Ann\n\nfedcba9876543210\n";
  EXPECT_EQ(read_revoked(folder / "good").value(), (std::vector<uint64_t>{5, 0xFEDCBA9876543210ULL}));
  std::ofstream(folder / "bad") << "0000000000000005\nfive\n";
  EXPECT_TRUE(
      holds(read_revoked(folder / "bad").error().message, "bad, line 2: 'five' is not the id of a token"));
  EXPECT_TRUE(holds(read_revoked(folder / "none").error().message, "cannot be read"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& odd : {folder / "pipe", folder / "", std::string("/dev/zero")})
    EXPECT_TRUE(holds(read_revoked(odd).error().message, "not a file")) << odd;
}

TEST(AccessTokens, lengths_of_time_have_a_unit) {
  EXPECT_EQ(read_duration_s("30d").value(), 30U * 86400U);
  EXPECT_EQ(read_duration_s("12h").value(), 12U * 3600U);
  EXPECT_EQ(read_duration_s("45m").value(), 45U * 60U);
  EXPECT_EQ(read_duration_s("90s").value(), 90U);
  for (const char* wrong :
       {"", "d", "30", "-1d", "0s", "3 d", "1.5h", "9999d", "99999999999999999999d", "30dd"})
    EXPECT_FALSE(read_duration_s(wrong)) << wrong;
}

/// What a server with these files grants.
class Grants : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
    std::ofstream(folder / "revoked") << id_text(13) << "\n";
    config.token_key_path = folder / "key.pub";
    config.token_revoked_path = folder / "revoked";
    config.anonymous = std::nullopt;
    config.world = "mine";
  }
  tl::expected<Grant, Refused> grant(const std::string& token) const {
    const auto access = Access::load(config, "the admin token");
    EXPECT_TRUE(access) << access.error().message;
    return (*access)->grant(token, today_s);
  }
  Refusal refusal(const std::string& token) const { return grant(token).error().reason; }
  std::string signed_by(const SigningKey& by, const std::function<void(AccessToken&)>& change = {}) const {
    AccessToken token = a_token();
    if (change) change(token);
    return *sign(token, by);
  }

  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  AccessConfig config;
};

TEST_F(Grants, are_what_a_good_token_says) {
  const auto granted = grant(signed_by(key));
  ASSERT_TRUE(granted);
  EXPECT_EQ(granted->role, Role::carver);
  EXPECT_EQ(granted->name, "Ann");
  EXPECT_EQ(granted->token_id, a_token().id);
  EXPECT_EQ(granted->team, "");
  EXPECT_EQ(grant(signed_by(key, [](AccessToken& token) { token.team = "red"; }))->team, "red");
  EXPECT_EQ(signed_by(key), signed_by(key, [](AccessToken& token) { token.team = ""; })) << "as before teams";
  const auto anywhere = grant(signed_by(key, [](AccessToken& token) { token.world = ""; }));
  EXPECT_TRUE(anywhere);
  const auto for_ever = grant(signed_by(key, [](AccessToken& token) { token.expires_s = 0; }));
  EXPECT_TRUE(for_ever);
}

TEST_F(Grants, refuse_each_bad_token_for_its_own_reason) {
  EXPECT_EQ(refusal(""), Refusal::token_missing);
  EXPECT_EQ(refusal("guess"), Refusal::token_malformed);
  EXPECT_EQ(refusal(signed_by(key).substr(0, 40)), Refusal::token_malformed);
  EXPECT_EQ(refusal(signed_by(SigningKey::generate())), Refusal::token_foreign);
  EXPECT_EQ(refusal(signed_by(key, [](AccessToken& token) { token.expires_s = today_s; })),
            Refusal::token_expired);
  EXPECT_EQ(refusal(signed_by(key, [](AccessToken& token) { token.id = 13; })), Refusal::token_revoked);
  EXPECT_EQ(refusal(signed_by(key, [](AccessToken& token) { token.world = "yours"; })), Refusal::token_world);
}

TEST_F(Grants, come_with_the_admin_token_and_without_any_too) {
  EXPECT_EQ(grant("the admin token")->role, Role::admin);
  config.anonymous = Role::viewer;
  EXPECT_EQ(grant("")->role, Role::viewer);
  EXPECT_EQ(refusal("guess"), Refusal::token_malformed) << "a token that does not hold is not ignored";
  config.token_key_path = config.token_revoked_path = "";
  EXPECT_EQ(refusal("guess"), Refusal::admin_token_wrong);
  EXPECT_EQ(refusal(signed_by(key)), Refusal::token_foreign);
  EXPECT_EQ((*Access::load(config, ""))->grant("guess", today_s)->role, Role::viewer) << "nobody looks at it";
}

TEST_F(Grants, do_not_outlast_their_token) {
  const auto access = Access::load(config, "");
  const auto granted = (*access)->grant(signed_by(key), today_s);
  EXPECT_TRUE((*access)->still_holds(*granted, today_s + 59));
  EXPECT_EQ((*access)->still_holds(*granted, today_s + 60).error().reason, Refusal::token_expired);
  std::ofstream(folder / "revoked") << id_text(a_token().id) << "\n";
  EXPECT_EQ((*Access::load(config, ""))->still_holds(*granted, today_s).error().reason,
            Refusal::token_revoked);
  EXPECT_TRUE((*access)->still_holds(Grant{Role::viewer}, today_s)) << "who has none loses none";
}

TEST_F(Grants, are_not_given_where_files_or_options_make_no_sense) {
  const auto error = [&](const std::function<void(AccessConfig&)>& change) {
    AccessConfig changed = config;
    change(changed);
    const auto access = Access::load(changed, "");
    return access ? "" : access.error().message;
  };
  EXPECT_EQ(error([](AccessConfig&) {}), "");
  EXPECT_TRUE(holds(error([&](AccessConfig& c) { c.token_key_path = folder / "none"; }),
                    "none: there is no such file"));
  EXPECT_TRUE(
      holds(error([&](AccessConfig& c) { c.token_key_path = folder / "key"; }), "no public Ed25519 key"));
  EXPECT_TRUE(holds(error([](AccessConfig& c) { c.token_key_path = ""; }), "--token-revoked, --token-key"));
  EXPECT_TRUE(holds(error([](AccessConfig& c) { c.token_key_path = c.token_revoked_path = ""; }),
                    "nobody could join"));
  EXPECT_TRUE(holds(error([](AccessConfig& c) { c.tls_required = true; }), "--tls-cert"));
  EXPECT_TRUE(holds(error([](AccessConfig& c) { c.tls_key_path = "key"; }), "come together"));
  EXPECT_TRUE(holds(error([](AccessConfig& c) { c.world = std::string(65, 'w'); }), "at most 64 bytes"));
}

TEST(Roles, each_request_needs_its_own) {
  EXPECT_EQ(role_for(CarveRequest{}), Role::carver);
  EXPECT_EQ(role_for(FillRequest{}), Role::builder);
  EXPECT_EQ(role_for(PaintRequest{}), Role::builder);
  EXPECT_EQ(role_for(SettingsRequest{}), Role::admin);
  EXPECT_EQ(role_for(PushRequest{1, {0.0F, 99e3F, 0.0F}, {}}), Role::carver);
  EXPECT_EQ(role_for(PushRequest{1, {80e3F, 80e3F, 0.0F}, {}}), Role::director)
      << "a carver throws no houses";
}

TEST(Roles, what_is_open_to_everybody_is_said_except_on_this_machine) {
  AccessConfig config;
  for (const char* here : {"127.0.0.1", "127.0.0.2", "::1"})
    EXPECT_TRUE(open_doors(config, here).empty()) << here;
  auto open = open_doors(config, "0.0.0.0");
  ASSERT_EQ(open.size(), 2U);
  EXPECT_TRUE(holds(
      open[0], "anyone who reaches 0.0.0.0 may look, carve, push and break, fill and paint without a token"));
  EXPECT_TRUE(holds(open[1], "--tls-cert"));
  config.anonymous = std::nullopt;
  config.tls_certificate_path = config.tls_key_path = "file";
  open = open_doors(config, "::");
  ASSERT_EQ(open.size(), 1U);
  EXPECT_TRUE(holds(open[0], "--tls-required"));
  config.tls_required = true;
  EXPECT_TRUE(open_doors(config, "::").empty());
}

}  // namespace
}  // namespace scree
