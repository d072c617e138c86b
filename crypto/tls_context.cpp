#include "crypto/tls_context.h"

#include <cctype>
#include <fstream>
#include <openssl/err.h>

#include "crypto/tls_context_impl.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/regular_file.h"

namespace scree {

namespace {

/// The ciphers of TLS 1.2. Those of 1.3 are all of this kind.
constexpr const char* aead_ciphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

/// Hex digits of a SHA-256.
constexpr size_t fingerprint_digits = 64;

Result<OwnedContext> context_for(const SSL_METHOD* method) {
  ERR_clear_error();
  OwnedContext context(SSL_CTX_new(method));
  const bool made = context != nullptr && SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) == 1 &&
                    SSL_CTX_set_cipher_list(context.get(), aead_ciphers) == 1 &&
                    SSL_CTX_set_num_tickets(context.get(), 0) == 1;
  if (!made) return fail("OpenSSL cannot be set up: " + pop_openssl_error());
  SSL_CTX_set_options(context.get(), SSL_OP_NO_COMPRESSION | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET |
                                         SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_PRIORITIZE_CHACHA);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  // A connection that is idle holds no buffers.
  SSL_CTX_set_mode(context.get(), SSL_MODE_RELEASE_BUFFERS);
  // Else OpenSSL would ask for a key's passphrase on the terminal.
  SSL_CTX_set_default_passwd_cb(context.get(), [](char*, int, int, void*) { return 0; });
  return context;
}

bool can_be_read(const std::string& path) {
  return check_is_small_file(path, limits::pem_bytes_max) && std::ifstream(path).good();
}

/// In the notation of fingerprint_of().
Result<std::string> canonical_fingerprint(const std::string& given) {
  std::string digits;
  for (const char c : given) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ':') continue;
    if (std::isxdigit(byte) == 0) digits.resize(fingerprint_digits + 1);  // refused below
    if (digits.size() > fingerprint_digits) break;
    digits += static_cast<char>(std::toupper(byte));
  }
  if (digits.size() != fingerprint_digits)
    return fail("'" + given +
                "' is not a fingerprint: write the 64 hex digits of a SHA-256, with or without colons");
  std::string text;
  for (size_t i = 0; i < fingerprint_digits; ++i) {
    if (i > 0 && i % 2 == 0) text += ':';
    text += digits[i];
  }
  return text;
}

}  // namespace

TlsServerContext::TlsServerContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TlsServerContext::~TlsServerContext() = default;

Result<std::shared_ptr<const TlsServerContext>> TlsServerContext::load(const std::string& certificate_path,
                                                                       const std::string& key_path) {
  auto context = TRY(context_for(TLS_server_method()));
  SSL_CTX* const tls = context.get();
  const std::string certificate = "the TLS certificate " + certificate_path;
  const std::string key = "the TLS key " + key_path;
  if (!can_be_read(certificate_path)) return fail(certificate + " cannot be read");
  if (!can_be_read(key_path)) return fail(key + " cannot be read");
  if (SSL_CTX_use_certificate_chain_file(tls, certificate_path.c_str()) != 1)
    return fail(certificate + " is not a certificate in PEM form: " + pop_openssl_error());
  if (SSL_CTX_use_PrivateKey_file(tls, key_path.c_str(), SSL_FILETYPE_PEM) != 1) {
    const unsigned long first = ERR_peek_error();
    const int reason = ERR_GET_REASON(first);
    const bool mismatch = ERR_GET_LIB(first) == ERR_LIB_X509 &&
                          (reason == X509_R_KEY_VALUES_MISMATCH || reason == X509_R_KEY_TYPE_MISMATCH);
    const std::string words = pop_openssl_error();
    if (mismatch) return fail(key + " does not belong to " + certificate);
    return fail(key + " is not a private key in PEM form without a passphrase: " + words);
  }
  auto impl = std::make_unique<Impl>();
  impl->context = std::move(context);
  return std::shared_ptr<const TlsServerContext>(new TlsServerContext(std::move(impl)));
}

std::string TlsServerContext::fingerprint() const {
  return fingerprint_of(*SSL_CTX_get0_certificate(impl_->context.get()));
}

bool TlsServerContext::out_of_date() const {
  const X509* certificate = SSL_CTX_get0_certificate(impl_->context.get());
  return X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0 ||
         X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0;
}

TlsClientContext::TlsClientContext(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TlsClientContext::~TlsClientContext() = default;

Result<std::shared_ptr<const TlsClientContext>> TlsClientContext::make(const TlsTrust& trust) {
  auto context = TRY(context_for(TLS_client_method()));
  auto impl = std::make_unique<Impl>();
  SSL_CTX* const tls = context.get();
  if (!trust.fingerprint.empty()) {
    auto fingerprint = canonical_fingerprint(trust.fingerprint);
    TRY(fingerprint);
    impl->fingerprint = std::move(*fingerprint);
  } else {
    SSL_CTX_set_verify(tls, SSL_VERIFY_PEER, nullptr);
    if (trust.ca_path.empty()) {
      SSL_CTX_set_default_verify_paths(tls);
    } else {
      if (!can_be_read(trust.ca_path))
        return fail("the file of certificates " + trust.ca_path + " cannot be read");
      if (SSL_CTX_load_verify_locations(tls, trust.ca_path.c_str(), nullptr) != 1)
        return fail("the file " + trust.ca_path +
                    " holds no certificate in PEM form: " + pop_openssl_error());
      // A certificate in the file is trusted, not only as the end of a chain.
      X509_VERIFY_PARAM_set_flags(SSL_CTX_get0_param(tls), X509_V_FLAG_PARTIAL_CHAIN);
    }
  }
  impl->context = std::move(context);
  return std::shared_ptr<const TlsClientContext>(new TlsClientContext(std::move(impl)));
}

}  // namespace scree
