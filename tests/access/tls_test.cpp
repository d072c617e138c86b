// TLS over loopback. Sessions over it are sessions like any other, on the port of those without. A client
// refuses what it must not trust, and says why. Files are read again while sessions go on. Old protocols and
// ciphers are refused.
#include <deque>
#include <fstream>
#include <gtest/gtest.h>
#include <openssl/ssl.h>
#include <sys/resource.h>
#include <thread>

#include "client/bot/bot.h"
#include "crypto/tls_engine.h"
#include "proto/codec.h"
#include "server/app/live_server.h"
#include "shared/base/random.h"
#include "tests/support/certificates.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/raw_client.h"
#include "tests/support/raw_server.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

class TlsTest : public ::testing::Test {
 protected:
  void SetUp() override { authority.write(folder / "authority", folder / "authority.key"); }

  void certify(const TestCertificate& certificate) const {
    certificate.write(folder / "certificate", folder / "certificate.key");
  }
  /// A server with the authority's certificate for this machine, or as it was certified before.
  void start(const std::function<void(NetConfig&)>& change = {}) {
    if (!std::filesystem::exists(folder / "certificate")) certify(TestCertificate(here, &authority));
    NetConfig config;
    config.terrain = flat_terrain;
    config.access.tls_certificate_path = folder / "certificate";
    config.access.tls_key_path = folder / "certificate.key";
    if (change) change(config);
    auto listening = NetServer::listen(config, commands, TickDelta());
    ASSERT_TRUE(listening) << listening.error().message;
    server = std::move(*listening);
  }
  ServerEndpoint endpoint(const std::string& host = "127.0.0.1") const {
    ServerEndpoint endpoint{.host = host, .port = server->port(), .tls = true, .trust = {}, .token = {}};
    endpoint.trust.ca_path = folder / "authority";
    return endpoint;
  }
  static std::string trouble(const ServerEndpoint& with) {
    const auto connected = Connection::connect(with, HelloMessage{}, patience);
    return connected ? "" : connected.error().message;
  }
  std::string fingerprint() const {
    return (*TlsServerContext::load(folder / "certificate", folder / "certificate.key"))->fingerprint();
  }

  static constexpr const char* here = "IP:127.0.0.1,DNS:localhost";
  const TestFolder folder;
  const TestCertificate authority{"DNS:authority"};
  CommandQueue commands{64};
  std::unique_ptr<NetServer> server;
};

TEST_F(TlsTest, carries_sessions_whose_hashes_are_equal_beside_plain_ones) {
  certify(TestCertificate(here, &authority));
  LiveConfig config;
  config.world = flat_world();
  config.world.service.requests_per_second = 1000.0;
  config.pacing = Pacing::by_hand;
  config.net.access.tls_certificate_path = folder / "certificate";
  config.net.access.tls_key_path = folder / "certificate.key";
  auto live = LiveServer::start(config);
  ASSERT_TRUE(live) << live.error().message;
  BotConfig how;
  how.port = (*live)->port();
  how.carves = 3;
  how.rate_hz = 0.0;
  how.carver.radius_m = 1.0F;
  how.carver.seeds = 8;
  how.linger = how.check_hash = true;
  how.reconnects_max = 0;
  BotConfig encrypted_how = how;
  encrypted_how.tls = true;
  encrypted_how.trust.ca_path = folder / "authority";
  Bot plain(how), encrypted(encrypted_how);
  ASSERT_TRUE(plain.join());
  ASSERT_TRUE(encrypted.join());
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!(plain.finished() && encrypted.finished()) && std::chrono::steady_clock::now() < end) {
    ASSERT_TRUE((*live)->step_once());
    for (Bot* bot : {&plain, &encrypted}) ASSERT_TRUE(bot->step(1ms)) << bot->report().failure;
  }
  for (const Bot* bot : {&plain, &encrypted}) {
    EXPECT_EQ(bot->report().carves_accepted, 3U);
    EXPECT_TRUE(bot->report().hash.equal);
    EXPECT_EQ(bot->report().seen.mismatches, 0U);
  }
  EXPECT_NE(encrypted.report().hash.client, 0U);
}

TEST_F(TlsTest, is_told_from_plain_bytes_however_they_come) {
  start();
  EXPECT_EQ(trouble(endpoint()), "");
  EXPECT_EQ(trouble(endpoint("localhost")), "");
  EXPECT_EQ(trouble({.port = server->port()}), "");
  RawClient slow(server->port());
  for (const uint8_t byte : encode(ClientMessage(HelloMessage{}))) ASSERT_TRUE(slow.send_bytes({&byte, 1}));
  EXPECT_TRUE(slow.receive_as<WelcomeMessage>());
  for (uint32_t length = 0; length <= 64 * 1024; ++length) {
    const uint8_t first[] = {static_cast<uint8_t>(length), static_cast<uint8_t>(length >> 8U),
                             static_cast<uint8_t>(length >> 16U)};
    ASSERT_FALSE(is_tls_greeting(first)) << length << " is the length of a plain message";
  }
}

TEST_F(TlsTest, a_certificate_for_another_host_is_refused_in_words) {
  certify(TestCertificate("DNS:elsewhere.example,IP:10.1.2.3", &authority));
  start();
  EXPECT_TRUE(holds(trouble(endpoint()), "certificate is for another host")) << trouble(endpoint());
  EXPECT_TRUE(holds(trouble(endpoint("localhost")), "certificate is for another host"));
}

TEST_F(TlsTest, an_expired_certificate_is_refused_in_words) {
  certify(TestCertificate(here, &authority, -TestCertificate::day_s));
  start();
  EXPECT_TRUE(holds(trouble(endpoint()), "certificate has expired")) << trouble(endpoint());
}

TEST_F(TlsTest, a_self_signed_certificate_is_refused_naming_its_fingerprint_which_can_be_trusted) {
  certify(TestCertificate(here));
  start();
  const std::string refused = trouble(endpoint());
  EXPECT_TRUE(holds(refused, "self-signed, or its issuer is unknown")) << refused;
  EXPECT_TRUE(holds(refused, fingerprint())) << refused;
  ServerEndpoint pinned{.host = "127.0.0.1", .port = server->port(), .tls = true, .trust = {}, .token = {}};
  EXPECT_TRUE(holds(trouble(pinned), "self-signed")) << "the system does not know it either";
  pinned.trust.fingerprint = fingerprint();
  EXPECT_EQ(trouble(pinned), "");
  std::erase(pinned.trust.fingerprint, ':');
  for (char& c : pinned.trust.fingerprint) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  EXPECT_EQ(trouble(pinned), "");
  pinned.trust.fingerprint[5] = pinned.trust.fingerprint[5] == '0' ? '1' : '0';
  EXPECT_TRUE(holds(trouble(pinned), "not the one that is trusted")) << trouble(pinned);
  for (const std::string& wrong :
       {std::string("abc"), pinned.trust.fingerprint + "0", std::string(64, 'g')}) {
    pinned.trust.fingerprint = wrong;
    EXPECT_TRUE(holds(trouble(pinned), "is not a fingerprint")) << wrong;
  }
  ServerEndpoint own = endpoint();
  own.trust.ca_path = folder / "certificate";
  EXPECT_EQ(trouble(own), "") << "a file that holds it says that it is trusted";
}

TEST_F(TlsTest, files_that_a_client_cannot_use_are_named) {
  start();
  ServerEndpoint wrong = endpoint();
  wrong.trust.ca_path = folder / "none";
  EXPECT_TRUE(holds(trouble(wrong), "none cannot be read"));
  wrong.trust.ca_path = folder / "authority.key";
  EXPECT_TRUE(holds(trouble(wrong), "holds no certificate"));
}

TEST_F(TlsTest, a_server_that_does_not_speak_it_is_recognised) {
  start([](NetConfig& config) {
    config.access = {};
    config.hello_seconds = 0.5;  // what begins a handshake may look like a length, and the rest never comes
  });
  EXPECT_TRUE(holds(trouble(endpoint()), "does not speak TLS")) << trouble(endpoint());
  RawServer mute;
  std::thread hanging_up([&] {
    mute.accept();
    mute.hang_up();
  });
  ServerEndpoint nobody = endpoint();
  nobody.port = mute.port();
  const std::string ended = trouble(nobody);
  hanging_up.join();
  EXPECT_TRUE(holds(ended, "ended the TLS handshake")) << ended;
}

TEST_F(TlsTest, who_must_come_by_it_is_told_so) {
  start([](NetConfig& config) { config.access.tls_required = true; });
  EXPECT_TRUE(holds(trouble({.port = server->port()}), "accepts only TLS (--tls)"));
  EXPECT_EQ(trouble(endpoint()), "");
  EXPECT_EQ(server->stats().refusals.of(Refusal::tls_required), 1U);
}

TEST_F(TlsTest, half_a_handshake_ends_and_is_counted_and_no_other_notices) {
  start([](NetConfig& config) { config.hello_seconds = 1.0; });  // the witness's handshake takes some
  const auto witness = Connection::connect(endpoint(), HelloMessage{}, patience);
  ASSERT_TRUE(witness);
  RawClient garbage(server->port());
  const std::vector<uint8_t> record{0x16, 0x03, 0x01, 0x00, 0x04, 0xFF, 0xFF, 0xFF, 0xFF};
  ASSERT_TRUE(garbage.send_bytes(record));
  EXPECT_TRUE(garbage.closed_within(10s));
  RawClient silent(server->port());
  ASSERT_TRUE(silent.send_bytes(std::span(record).first(4)));
  EXPECT_TRUE(silent.closed_within(10s)) << "the handshake counts in the time for the hello";
  const auto end = std::chrono::steady_clock::now() + patience;
  while (server->stats().sessions_disconnected + server->stats().sessions_refused < 2 &&
         std::chrono::steady_clock::now() < end)
    wait_a_moment();
  EXPECT_EQ(server->stats().refusals.of(Refusal::tls_failed), 1U);
  EXPECT_EQ(server->stats().refusals.of(Refusal::hello_late), 1U);
  EXPECT_TRUE((*witness)->connected());
}

TEST_F(TlsTest, files_are_read_again_and_kept_when_the_new_ones_are_wrong) {
  start();
  const auto before = Connection::connect(endpoint(), HelloMessage{}, patience);
  ASSERT_TRUE(before);
  certify(TestCertificate("DNS:moved.example", &authority));
  ASSERT_TRUE(server->reload());
  EXPECT_TRUE(holds(trouble(endpoint()), "another host")) << "the new one is in force";
  EXPECT_TRUE((*before)->connected());
  authority.write(folder / "certificate", folder / "authority.key");
  const auto mismatch = server->reload();
  ASSERT_FALSE(mismatch);
  EXPECT_TRUE(holds(mismatch.error().message, "does not belong to the TLS certificate"))
      << mismatch.error().message;
  std::ofstream(folder / "certificate") << "no certificate\n";
  EXPECT_TRUE(holds(server->reload().error().message, "not a certificate in PEM form"));
  std::filesystem::remove(folder / "certificate");
  EXPECT_TRUE(holds(server->reload().error().message, "certificate cannot be read"));
  EXPECT_TRUE(holds(trouble(endpoint()), "another host")) << "the last good one stays in force";
  certify(TestCertificate(here, &authority));
  ASSERT_TRUE(server->reload());
  EXPECT_EQ(trouble(endpoint()), "");
}

TEST_F(TlsTest, a_key_with_a_passphrase_is_refused_and_nobody_is_asked_for_it) {
  start();
  FILE* file = std::fopen((folder / "certificate.key").c_str(), "w");
  EVP_PKEY* key = EVP_EC_gen("P-256");
  EXPECT_EQ(PEM_write_PrivateKey(file, key, EVP_aes_128_cbc(),
                                 reinterpret_cast<const unsigned char*>("secret"), 6, nullptr, nullptr),
            1);
  EVP_PKEY_free(key);
  std::fclose(file);
  EXPECT_TRUE(holds(server->reload().error().message, "without a passphrase"));
}

/// A client by OpenSSL itself against an engine, no sockets between them.
class Handshake {
 public:
  Handshake(std::shared_ptr<const TlsServerContext> server, int protocol_min, int protocol_max,
            const char* ciphers)
      : engine_(std::move(server)), context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_security_level(context_, 0);
    SSL_CTX_set_min_proto_version(context_, protocol_min);
    SSL_CTX_set_max_proto_version(context_, protocol_max);
    EXPECT_EQ(SSL_CTX_set_cipher_list(context_, ciphers), 1);
    ssl_ = SSL_new(context_);
    in_ = BIO_new(BIO_s_mem());
    out_ = BIO_new(BIO_s_mem());
    SSL_set_bio(ssl_, in_, out_);
    SSL_set_connect_state(ssl_);
  }
  ~Handshake() {
    SSL_free(ssl_);
    SSL_CTX_free(context_);
  }
  Handshake(const Handshake&) = delete;
  Handshake& operator=(const Handshake&) = delete;

  /// The cipher that both agree on; empty: none.
  std::string agree() {
    for (int flights = 0; flights < 8; ++flights) {
      SSL_do_handshake(ssl_);
      deliver();
      std::vector<uint8_t> bytes;
      if (!engine_.shake()) return "";
      engine_.drain_output(bytes);
      if (!bytes.empty()) BIO_write(in_, bytes.data(), static_cast<int>(bytes.size()));
    }
    return engine_.established() ? SSL_get_cipher_name(ssl_) : "";
  }

  /// The client changes its keys and asks the engine to do so; whether the engine goes on.
  bool update_keys() {
    EXPECT_EQ(SSL_key_update(ssl_, SSL_KEY_UPDATE_REQUESTED), 1);
    EXPECT_EQ(SSL_do_handshake(ssl_), 1);
    return is_read();
  }
  /// The client says so many bytes; whether the engine goes on.
  bool say(size_t bytes) {
    const std::vector<uint8_t> noise(bytes, 7);
    EXPECT_EQ(SSL_write(ssl_, noise.data(), static_cast<int>(bytes)), static_cast<int>(bytes));
    return is_read();
  }

 private:
  void deliver() {
    std::vector<uint8_t> bytes(BIO_ctrl_pending(out_));
    if (!bytes.empty()) BIO_read(out_, bytes.data(), static_cast<int>(bytes.size()));
    engine_.feed(bytes);
  }
  bool is_read() {
    deliver();
    std::vector<uint8_t> into(tls_record_bytes);
    while (true) {
      const auto got = engine_.read(into);
      if (!got) return false;
      if (got->bytes == 0) return true;
    }
  }

  TlsEngine engine_;
  SSL_CTX* context_;
  SSL* ssl_ = nullptr;
  BIO* in_ = nullptr;
  BIO* out_ = nullptr;
};

TEST_F(TlsTest, a_greeting_that_was_damaged_anywhere_is_refused_or_waited_for) {
  certify(TestCertificate(here, &authority));
  const auto server = *TlsServerContext::load(folder / "certificate", folder / "certificate.key");
  TlsEngine client(*TlsClientContext::make({}), "localhost");
  ASSERT_TRUE(client.shake());
  std::vector<uint8_t> greeting;
  client.drain_output(greeting);
  ASSERT_TRUE(is_tls_greeting(greeting));
  Random random(7);
  for (size_t i = 0; i < greeting.size(); ++i) {
    std::vector<uint8_t> damaged = greeting;
    damaged[i] ^= static_cast<uint8_t>(1 + random.below(255));
    damaged.resize(1 + random.below(static_cast<uint32_t>(damaged.size())));
    TlsEngine engine(server);
    engine.feed(damaged);
    static_cast<void>(engine.shake());
    EXPECT_FALSE(engine.established()) << i;
  }
}

TEST_F(TlsTest, takes_1_3_and_1_2_with_aead_and_forward_secrecy_alone) {
  certify(TestCertificate(here, &authority));
  const auto context = *TlsServerContext::load(folder / "certificate", folder / "certificate.key");
  const auto agreed = [&](int min, int max, const char* ciphers) {
    return Handshake(context, min, max, ciphers).agree();
  };
  EXPECT_TRUE(agreed(TLS1_3_VERSION, TLS1_3_VERSION, "ALL").starts_with("TLS_"));
  EXPECT_EQ(agreed(TLS1_2_VERSION, TLS1_2_VERSION, "ECDHE-ECDSA-AES128-GCM-SHA256"),
            "ECDHE-ECDSA-AES128-GCM-SHA256");
  EXPECT_EQ(agreed(TLS1_2_VERSION, TLS1_2_VERSION, "ECDHE-ECDSA-CHACHA20-POLY1305"),
            "ECDHE-ECDSA-CHACHA20-POLY1305");
  EXPECT_EQ(agreed(TLS1_2_VERSION, TLS1_2_VERSION, "ECDHE-ECDSA-AES128-SHA256"), "") << "CBC";
  EXPECT_EQ(agreed(TLS1_2_VERSION, TLS1_2_VERSION, "ECDHE-ECDSA-AES256-SHA"), "") << "CBC";
  EXPECT_EQ(agreed(TLS1_2_VERSION, TLS1_2_VERSION, "AES128-GCM-SHA256"), "") << "no forward secrecy";
  EXPECT_EQ(agreed(TLS1_1_VERSION, TLS1_1_VERSION, "ALL"), "");
  EXPECT_EQ(agreed(TLS1_VERSION, TLS1_VERSION, "ALL"), "");
}

TEST_F(TlsTest, a_handshake_by_a_slow_link_ends_beside_silent_connections_of_thousands_of_networks) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  start([](NetConfig& config) { config.proxies = *Proxies::parse({"127.0.0.1"}); });
  std::jthread crowd([port = server->port()](const std::stop_token& stop) {
    std::deque<RawClient> silent;
    for (int i = 0; !stop.stop_requested(); ++i) {
      const std::string from = "PROXY TCP4 10.0." + std::to_string(i / 256 % 16) + '.' +
                               std::to_string(i % 256) + " 192.0.2.1 50000 4177\r\n";
      silent.emplace_back(port).send_bytes(std::vector<uint8_t>(from.begin(), from.end()));
      if (silent.size() > 6000) silent.pop_front();
    }
  });
  const auto more_than_fit = [this] { return server->stats().refusals.of(Refusal::outsiders_max) > 0; };
  for (int i = 0; i < 1000 && !more_than_fit(); ++i) std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(more_than_fit()) << "this is no attack";
  ServerEndpoint slow = endpoint();
  slow.link = *read_link("delay=600ms");
  // Chance makes room. Where silent ones are not the first to go, one handshake of ten ends.
  constexpr int tries = 4;
  std::string troubles;
  int ended = 0;
  for (int i = 0; i < tries; ++i) {
    const std::string why = trouble(slow);
    ended += why.empty() ? 1 : 0;
    troubles += why + '\n';
  }
  EXPECT_GE(ended, tries / 2) << troubles;
}

TEST_F(TlsTest, keys_are_changed_as_often_as_bytes_ask_for_it_and_no_oftener) {
  certify(TestCertificate(here, &authority));
  const auto context = *TlsServerContext::load(folder / "certificate", folder / "certificate.key");
  Handshake client(context, TLS1_3_VERSION, TLS1_3_VERSION, "ALL");
  ASSERT_FALSE(client.agree().empty());
  for (uint64_t i = 0; i < limits::tls_key_updates_max; ++i) ASSERT_TRUE(client.update_keys()) << i;
  ASSERT_TRUE(client.say(limits::tls_bytes_per_key_update));
  ASSERT_TRUE(client.update_keys()) << "paid for by bytes";
  EXPECT_FALSE(client.update_keys());
}

}  // namespace
}  // namespace scree
