// OpenSSL's objects with owners, and its errors as words. Internal to crypto/.
#pragma once

#include <memory>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <string>

namespace scree {

template <auto release>
struct Released {
  template <typename T>
  void operator()(T* object) const {
    release(object);
  }
};

using OwnedBio = std::unique_ptr<BIO, Released<BIO_free_all>>;
using OwnedKey = std::unique_ptr<EVP_PKEY, Released<EVP_PKEY_free>>;
using OwnedDigest = std::unique_ptr<EVP_MD_CTX, Released<EVP_MD_CTX_free>>;
using OwnedCertificate = std::unique_ptr<X509, Released<X509_free>>;
using OwnedContext = std::unique_ptr<SSL_CTX, Released<SSL_CTX_free>>;
using OwnedSsl = std::unique_ptr<SSL, Released<SSL_free>>;

/// The first error of this thread since the last call, as OpenSSL words it; forgets all.
std::string pop_openssl_error();

/// SHA-256 of the certificate, as 32 hex numbers with colons between them.
std::string fingerprint_of(const X509& certificate);

}  // namespace scree
