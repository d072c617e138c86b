// Names of persons: none is blank, and no two alike are there at once, whatever people say.
#include "server/net/person_names.h"

#include "auth/access_token.h"
#include "crypto/signing_key.h"
#include "proto/limits.h"
#include "proto/person_name.h"
#include "shared/base/text.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

/// Characters without a picture, of all kinds of Unicode.
const std::vector<std::string> unseen = {
    "\u2800", "\u00A0", "\u3000", "\u2003",     "\u202F",   "\u205F",     "\u1680",     "\u200B",
    "\u200D", "\u2060", "\uFEFF", "\u3164",     "\u115F",   "\uFFA0",     "\u00AD",     "\u202E",
    "\u2066", "\u061C", "\t",     "\x7F",       "\xC2\x85", "\u2028",     "\u0301",     "\u20DD",
    "\uFE0F", "\uE000", "\uFFFC", "\U0001D159", "\u034F",   "\U000E0041", "\U000F0000", "\u0378"};

TEST(PersonNames, that_look_empty_are_none) {
  for (const std::string& one : unseen) {
    EXPECT_EQ(visible_name(one), "") << testing::PrintToString(one);
    EXPECT_EQ(visible_name(one + one + " " + one), "") << testing::PrintToString(one);
    for (const std::string& other : unseen)
      EXPECT_EQ(visible_name(one + other), "") << testing::PrintToString(one + other);
  }
  EXPECT_EQ(visible_name(""), "");
  for (const std::string& name : {called(9, ""), std::string("Client 17"), std::string("client\u00A01"),
                                  std::string("CLIENT 2"), std::string("\uFF43lient 3")})
    EXPECT_EQ(visible_name(name), "") << "that is how others without a name are shown: " << name;
}

TEST(PersonNames, that_can_be_seen_stay_without_blanks_around_them) {
  for (const std::string name : {"Ann", "Jos\u00E9", "\u0410\u043D\u043D\u0430", "\u5B89", "\u05D0\u05DF",
                                 "a b", "\u0645\u06CC\u200C\u062E\u0648\u0627", "\U0001F469\u200D\U0001F680",
                                 "\u2764\uFE0F", "e\u0301", "client", "client one", "."})
    EXPECT_EQ(visible_name(name), name);
  EXPECT_EQ(visible_name("  Ann\u2800"), "Ann");
  EXPECT_EQ(visible_name("\u3000Mary \u00A0 Ann\u00A0"), "Mary Ann");
  EXPECT_EQ(visible_name("\u0301Ann"), "Ann")
      << "a mark without a letter would mark what stands before the name";
  EXPECT_EQ(visible_name("\u2800\u200DAnn"), "Ann");
  for (const std::string& one : unseen) {
    const std::string around = visible_name(one + "A" + one + "b" + one);
    EXPECT_FALSE(fault_of_text(around)) << around;
    EXPECT_LE(around.size(), limits::person_name_bytes_max);
    EXPECT_NE(around, "");
  }
}

TEST(PersonNames, are_alike_whatever_cannot_be_told_apart) {
  const std::string key = name_key("Mary Ann");
  for (const char* alike : {"mary ann", "MARY ANN", "MaryAnn", "Mary\u00A0Ann", "\uFF2Dary Ann",
                            "Ma\u200Dry Ann", "Mary Ann\uFE0F", "Mary\u2800Ann"})
    EXPECT_EQ(name_key(alike), key) << alike;
  EXPECT_EQ(name_key("Jose\u0301"), name_key("JOS\u00C9"));
  EXPECT_EQ(name_key("Stra\u00DFe"), name_key("STRASSE"));
  for (const char* other : {"Mary Anne", "Mary", "Mary Ann (2)", "Mary Ann2"})
    EXPECT_NE(name_key(other), key);
  EXPECT_EQ(name_key(""), "");
}

TEST(PersonNames, have_a_number_within_the_limit) {
  EXPECT_EQ(numbered_name("Ann", 2), "Ann (2)");
  std::string longest;
  while (longest.size() + 3 <= limits::person_name_bytes_max) longest += "\u5B89";
  const std::string numbered = numbered_name(longest, 4096);
  EXPECT_LE(numbered.size(), limits::person_name_bytes_max);
  EXPECT_TRUE(numbered.ends_with("\u5B89 (4096)")) << numbered;
  EXPECT_FALSE(fault_of_text(numbered));
}

/// Persons who chat, and may have tokens.
class NamedPersons : public NetServerTest {
 protected:
  void open() {
    ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
    start([&](NetConfig& config) {
      config.access.token_key_path = folder / "key.pub";
      config.service.sessions_max = 64;
    });
  }
  std::unique_ptr<RawClient> person(const std::string& name, const std::string& token = "") {
    auto client = std::make_unique<RawClient>(server->port());
    HelloMessage greeting = hello();
    greeting.name = name;
    greeting.token = token;
    greeting.meets = true;
    EXPECT_TRUE(client->send(greeting));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>()) << name;
    return client;
  }
  std::string token_of(const std::string& name, uint64_t id) const {
    return *sign({id, Role::builder, 0, 0, name, ""}, key);
  }
  /// The name under which others hear the speaker. Who spoke before hears the own line, too.
  std::string heard(RawClient& speaker, RawClient& listener) {
    const std::string line = "it is me, " + std::to_string(++lines_);
    EXPECT_TRUE(speaker.send(SayMessage{line}));
    while (const auto said = listener.receive_as<SaidMessage>())
      if (said->text == line) return said->name;
    return "nothing was heard";
  }

  int lines_ = 0;
  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
};

TEST_F(NamedPersons, who_speaks_is_told_by_the_name) {
  open();
  const auto ann = person("Ann"), mocker = person("ann"), third = person("\uFF21nn"),
             second = person("Ann (2)");
  EXPECT_EQ(heard(*ann, *mocker), "Ann");
  EXPECT_EQ(heard(*mocker, *ann), "ann (2)");
  EXPECT_EQ(heard(*third, *ann), "\uFF21nn (3)");
  EXPECT_EQ(heard(*second, *ann), "Ann (2) (2)");
  const auto blank = person("\u2800"), pretends = person("client 1");
  EXPECT_EQ(heard(*blank, *ann), "");
  EXPECT_EQ(heard(*pretends, *ann), "");
  expect_witness_unmoved();
}

TEST_F(NamedPersons, a_name_that_is_free_again_is_given_again) {
  open();
  auto ann = person("Ann");
  ASSERT_TRUE(ann->send(GoodbyeMessage{}));
  EXPECT_TRUE(ann->closed_within(seconds(10)));
  const auto again = person("Ann"), listener = person("Ben");
  EXPECT_EQ(heard(*again, *listener), "Ann");
}

TEST_F(NamedPersons, whom_a_token_names_has_the_name_and_who_came_under_it_another) {
  open();
  const auto mocker = person("Ann"), listener = person("Ben");
  EXPECT_EQ(heard(*mocker, *listener), "Ann");
  const auto ann = person("", token_of("Ann", 7)), twice = person("", token_of("Ann", 8));
  EXPECT_EQ(heard(*ann, *listener), "Ann");
  EXPECT_EQ(heard(*twice, *listener), "Ann (2)");
  EXPECT_EQ(heard(*mocker, *listener), "Ann (3)");
  std::optional<PersonsMessage> persons;
  for (bool is_told = false; !is_told; is_told = persons->persons.size() == 4) {
    persons = listener->receive_as<PersonsMessage>();
    ASSERT_TRUE(persons);
  }
  std::vector<std::string> names;
  for (const Person& one : persons->persons) names.push_back(one.name);
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"Ann", "Ann (2)", "Ann (3)", "Ben"}));
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
