// scree-token: makes keys and access tokens, and shows what a token says. Exit status: 0 success, 1 failure
// or a signature that does not hold, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "auth/access_token.h"
#include "auth/duration_text.h"

namespace {

constexpr int exit_failed = 1;
constexpr int exit_usage = 2;

struct Options {
  std::string key;
  std::string role{scree::name_of(scree::Role::viewer)};
  std::string name;
  std::string world;
  std::string team;
  std::string expires;
  std::string token;
};

uint64_t now_s() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now).count());
}

int complain(const scree::Error& error, int code = exit_failed) {
  std::fprintf(stderr, "scree-token: error: %s\n", error.message.c_str());
  return code;
}

int make_key(const Options& options) {
  const std::string public_path = options.key + ".pub";
  const auto written = scree::SigningKey::generate().write(options.key, public_path);
  if (!written) return complain(written.error());
  std::printf("%s signs tokens. Keep it secret; the server does not need it.\n", options.key.c_str());
  std::printf("%s verifies them: scree server --token-key %s\n", public_path.c_str(), public_path.c_str());
  return 0;
}

int make_token(const Options& options) {
  const auto key = scree::SigningKey::read(options.key);
  if (!key) return complain(key.error());
  scree::AccessToken token;
  while (token.id == 0) token.id = scree::random_number();
  token.role = *scree::kind_named<scree::Role>(options.role);
  token.issued_s = now_s();
  if (!options.expires.empty()) {
    const auto seconds = scree::read_duration_s(options.expires);
    if (!seconds) return complain(seconds.error(), exit_usage);
    token.expires_s = token.issued_s + *seconds;
  }
  token.name = options.name;
  token.world = options.world;
  token.team = options.team;
  const auto text = scree::sign(token, *key);
  if (!text) return complain(text.error(), exit_usage);
  std::printf("%s\n", text->c_str());
  return 0;
}

std::string time_text(uint64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm utc{};
  char text[32];
  if (gmtime_r(&time, &utc) == nullptr || std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
    return std::to_string(seconds);
  return text;
}

/// The signature is told as "unchecked" without a key: what the token says may then be anybody's words.
int show(const Options& options) {
  const auto read = scree::read_access_token(options.token);
  if (!read) return complain(read.error());
  std::string signature = "unchecked";
  if (!options.key.empty()) {
    const auto key = scree::VerifyingKey::read(options.key);
    if (!key) return complain(key.error());
    signature = read->is_by(*key) ? "holds" : "does not hold";
  }
  const scree::AccessToken& token = read->token;
  const bool expired = token.expires_s != 0 && token.expires_s <= now_s();
  const nlohmann::ordered_json json{{"id", scree::id_text(token.id)},
                                    {"role", std::string(scree::name_of(token.role))},
                                    {"name", token.name},
                                    {"world", token.world},
                                    {"team", token.team},
                                    {"issued", time_text(token.issued_s)},
                                    {"expires", token.expires_s == 0 ? "never" : time_text(token.expires_s)},
                                    {"expired", expired},
                                    {"signature", signature}};
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  return signature == "does not hold" ? exit_failed : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Makes keys and access tokens for servers, and shows the contents of a token.", "scree-token");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  const CLI::App* key = app.add_subcommand("key", "makes a pair of keys: FILE signs, FILE.pub verifies");
  app.get_subcommand("key")
      ->add_option("FILE", options.key, "a new file, which only you may read")
      ->required();
  CLI::App* made = app.add_subcommand("new", "prints a new token");
  const auto& roles = scree::kind_names<scree::Role>;
  made->add_option("--key", options.key, "the signing key")->required()->envname("SCREE_TOKEN_SIGNING_KEY");
  made->add_option("--role", options.role, "role of its bearer: " + scree::listed(roles))
      ->check(CLI::IsMember(std::vector<std::string>(roles.begin(), roles.end())))
      ->capture_default_str();
  made->add_option("--name", options.name,
                   "the person's name, as others see it; default: the name that the client gives");
  made->add_option("--expires", options.expires,
                   "time until it expires: 30d, 12h, 45m or 90s; default: never");
  made->add_option("--world", options.world,
                   "the only world in which it is valid (the server's --world-name); default: every world");
  made->add_option("--team", options.team, "the person's team, by which regions may let it edit");
  CLI::App* shown = app.add_subcommand("show", "prints the contents of a token as JSON");
  shown->add_option("TOKEN", options.token, "the token")->required();
  shown->add_option("--key", options.key, "a public key that checks the signature");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  if (key->parsed()) return make_key(options);
  return made->parsed() ? make_token(options) : show(options);
}
