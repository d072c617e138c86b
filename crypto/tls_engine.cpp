#include "crypto/tls_engine.h"

#include <openssl/err.h>
#include <openssl/x509v3.h>

#include "crypto/tls_context_impl.h"
#include "shared/base/check.h"

namespace scree {

bool is_tls_greeting(std::span<const uint8_t> first) {
  CHECK(first.size() >= tls_greeting_bytes);
  return first[0] == SSL3_RT_HANDSHAKE && first[1] == SSL3_VERSION_MAJOR && first[2] >= 1 && first[2] <= 3;
}

struct TlsEngine::Impl {
  std::shared_ptr<const TlsServerContext> server;  ///< null on the client's side
  std::shared_ptr<const TlsClientContext> client;
  OwnedSsl ssl;
  BIO* in = nullptr;   ///< owned by ssl
  BIO* out = nullptr;  ///< likewise
  bool established = false;
  uint64_t key_updates = 0;  ///< that arrived
  uint64_t bytes_read = 0;
  std::string refused_fingerprint;  ///< of the certificate that did not verify

  void open(SSL_CTX* context);
  static int verified(int fine, X509_STORE_CTX* store);
  static void count(int sent, int version, int kind, const void* bytes, size_t size, SSL* ssl, void* impl);
  bool updates_too_often() const {
    return key_updates > limits::tls_key_updates_max + bytes_read / limits::tls_bytes_per_key_update;
  }
  Result<void> check_pinned() const;
  std::string words_of_failure() const;
  std::string words_of_verification(long result) const;
};

void TlsEngine::Impl::open(SSL_CTX* context) {
  ssl.reset(SSL_new(context));
  in = BIO_new(BIO_s_mem());
  out = BIO_new(BIO_s_mem());
  CHECK(ssl != nullptr && in != nullptr && out != nullptr);
  BIO_set_mem_eof_return(in, -1);  // an empty buffer is not the end
  SSL_set_bio(ssl.get(), in, out);
  SSL_set_msg_callback(ssl.get(), count);
  SSL_set_msg_callback_arg(ssl.get(), this);
}

/// OpenSSL tells of each message of its own.
void TlsEngine::Impl::count(int sent, int /*version*/, int kind, const void* bytes, size_t size, SSL* /*ssl*/,
                            void* impl) {
  if (sent == 0 && kind == SSL3_RT_HANDSHAKE && size > 0 &&
      *static_cast<const uint8_t*>(bytes) == SSL3_MT_KEY_UPDATE)
    ++static_cast<Impl*>(impl)->key_updates;
}

/// Keeps what an error is to tell: OpenSSL forgets a certificate that did not verify.
int TlsEngine::Impl::verified(int fine, X509_STORE_CTX* store) {
  if (fine == 1) return fine;
  const auto* ssl =
      static_cast<SSL*>(X509_STORE_CTX_get_ex_data(store, SSL_get_ex_data_X509_STORE_CTX_idx()));
  if (const X509* certificate = X509_STORE_CTX_get0_cert(store))
    static_cast<Impl*>(SSL_get_app_data(ssl))->refused_fingerprint = fingerprint_of(*certificate);
  return fine;
}

Result<void> TlsEngine::Impl::check_pinned() const {
  const std::string& wanted = client->impl().fingerprint;
  if (wanted.empty()) return {};
  const OwnedCertificate certificate(SSL_get1_peer_certificate(ssl.get()));
  const std::string found = certificate ? fingerprint_of(*certificate) : "none";
  if (found == wanted) return {};
  return fail("the server's certificate is not the one that is trusted: its SHA-256 fingerprint is " + found);
}

std::string TlsEngine::Impl::words_of_verification(long result) const {
  switch (result) {
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return "the server's certificate is for another host: use the name that it is for (--host)";
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return "the server's certificate has expired";
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return "the server's certificate is not valid yet: do both clocks agree?";
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
      return "the server's certificate is self-signed, or its issuer is unknown here: name the issuer's "
             "certificate (--tls-ca), or trust this one (--tls-fingerprint) if the server's owner confirms "
             "its "
             "SHA-256 fingerprint, " +
             refused_fingerprint;
    default:
      return std::string("the server's certificate is refused: ") + X509_verify_cert_error_string(result);
  }
}

std::string TlsEngine::Impl::words_of_failure() const {
  const unsigned long first = ERR_peek_error();
  const int reason = ERR_GET_LIB(first) == ERR_LIB_SSL ? ERR_GET_REASON(first) : 0;
  const long verified = SSL_get_verify_result(ssl.get());
  const std::string words = pop_openssl_error();
  if (client && reason == SSL_R_CERTIFICATE_VERIFY_FAILED) return words_of_verification(verified);
  if (client && !established &&
      (reason == SSL_R_WRONG_VERSION_NUMBER || reason == SSL_R_PACKET_LENGTH_TOO_LONG))
    return "the server there does not speak TLS (leave out --tls for a Scree server without a certificate; "
           "the connection is then unencrypted)";
  return (established ? "TLS: " : "the TLS handshake failed: ") + words;
}

TlsEngine::TlsEngine(std::shared_ptr<const TlsServerContext> server) : impl_(std::make_unique<Impl>()) {
  CHECK(server != nullptr);
  impl_->open(server->impl().context.get());
  impl_->server = std::move(server);
  SSL_set_accept_state(impl_->ssl.get());
}

TlsEngine::TlsEngine(std::shared_ptr<const TlsClientContext> client, const std::string& host)
    : impl_(std::make_unique<Impl>()) {
  CHECK(client != nullptr && !host.empty());
  impl_->open(client->impl().context.get());
  impl_->client = std::move(client);
  SSL* const ssl = impl_->ssl.get();
  SSL_set_connect_state(ssl);
  SSL_set_app_data(ssl, impl_.get());
  SSL_set_verify(ssl, SSL_get_verify_mode(ssl), Impl::verified);
  X509_VERIFY_PARAM* const verify = SSL_get0_param(ssl);
  if (X509_VERIFY_PARAM_set1_ip_asc(verify, host.c_str()) == 1) return;  // an address has no name to send
  ERR_clear_error();
  CHECK(X509_VERIFY_PARAM_set1_host(verify, host.c_str(), host.size()) == 1);
  SSL_set_tlsext_host_name(ssl, host.c_str());
}

TlsEngine::~TlsEngine() = default;
TlsEngine::TlsEngine(TlsEngine&&) noexcept = default;

void TlsEngine::feed(std::span<const uint8_t> arrived) {
  if (arrived.empty()) return;
  CHECK(BIO_write(impl_->in, arrived.data(), static_cast<int>(arrived.size())) ==
        static_cast<int>(arrived.size()));
}

Result<void> TlsEngine::shake() {
  if (impl_->established) return {};
  ERR_clear_error();
  const int done = SSL_do_handshake(impl_->ssl.get());
  if (done == 1) {
    if (impl_->client) TRY(impl_->check_pinned());
    impl_->established = true;
    return {};
  }
  if (SSL_get_error(impl_->ssl.get(), done) == SSL_ERROR_WANT_READ) return {};
  return fail(impl_->words_of_failure());
}

bool TlsEngine::established() const {
  return impl_->established;
}

Result<TlsEngine::Got> TlsEngine::read(std::span<uint8_t> into) {
  CHECK(impl_->established);
  Got got;
  while (got.bytes < into.size()) {
    ERR_clear_error();
    size_t bytes = 0;
    const int done = SSL_read_ex(impl_->ssl.get(), into.data() + got.bytes, into.size() - got.bytes, &bytes);
    got.bytes += bytes;
    impl_->bytes_read += bytes;
    if (impl_->updates_too_often()) return fail("TLS: more key updates than limits.tls_key_updates_max");
    if (done == 1) continue;
    const int why = SSL_get_error(impl_->ssl.get(), done);
    if (why == SSL_ERROR_WANT_READ) break;
    got.ended = why == SSL_ERROR_ZERO_RETURN;
    if (got.ended || got.bytes > 0) break;  // an error is told when what came before it has been read
    return fail(impl_->words_of_failure());
  }
  return got;
}

Result<void> TlsEngine::write(std::span<const uint8_t> plain) {
  CHECK(impl_->established);
  if (plain.empty()) return {};
  ERR_clear_error();
  size_t written = 0;
  if (SSL_write_ex(impl_->ssl.get(), plain.data(), plain.size(), &written) == 1 && written == plain.size())
    return {};
  return fail(impl_->words_of_failure());
}

void TlsEngine::finish() {
  ERR_clear_error();
  if (impl_->established) SSL_shutdown(impl_->ssl.get());
  ERR_clear_error();
}

size_t TlsEngine::output_bytes() const {
  return BIO_ctrl_pending(impl_->out);
}

void TlsEngine::drain_output(std::vector<uint8_t>& into) {
  into.resize(output_bytes());
  if (into.empty()) return;
  CHECK(BIO_read(impl_->out, into.data(), static_cast<int>(into.size())) == static_cast<int>(into.size()));
}

}  // namespace scree
