// Certificates made when a test needs them, by OpenSSL: an authority, and what it issues. Files are PEM.
#pragma once

#include <ctime>
#include <gtest/gtest.h>
#include <memory>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <string>

#include "tests/support/test_folder.h"

namespace scree {

/// A certificate and its key. Without an issuer it is self-signed.
class TestCertificate {
 public:
  static constexpr long day_s = 24 * 3600;

  /// `for_whom`: as OpenSSL writes alternative names, "IP:127.0.0.1,DNS:localhost". Begins a day ago.
  explicit TestCertificate(const std::string& for_whom, const TestCertificate* issuer = nullptr,
                           long ends_s = day_s)
      : key_(EVP_EC_gen("P-256"), EVP_PKEY_free), certificate_(X509_new(), X509_free) {
    X509* const made = certificate_.get();
    X509_set_version(made, 2);
    static long serial = 1;
    ASN1_INTEGER_set(X509_get_serialNumber(made), serial++);
    X509_gmtime_adj(X509_getm_notBefore(made), -2 * day_s);
    X509_gmtime_adj(X509_getm_notAfter(made), ends_s);
    X509_set_pubkey(made, key_.get());
    X509_NAME_add_entry_by_txt(X509_get_subject_name(made), "CN", MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>(for_whom.c_str()), -1, -1, 0);
    const TestCertificate& by = issuer == nullptr ? *this : *issuer;
    X509_set_issuer_name(made, X509_get_subject_name(by.certificate_.get()));
    extend(NID_subject_alt_name, for_whom, by);
    extend(NID_basic_constraints, "CA:TRUE", by);
    EXPECT_NE(X509_sign(made, by.key_.get(), EVP_sha256()), 0);
  }

  void write(const std::string& certificate_path, const std::string& key_path) const {
    FILE* file = std::fopen(certificate_path.c_str(), "w");
    EXPECT_EQ(PEM_write_X509(file, certificate_.get()), 1);
    std::fclose(file);
    file = std::fopen(key_path.c_str(), "w");
    EXPECT_EQ(PEM_write_PrivateKey(file, key_.get(), nullptr, nullptr, 0, nullptr, nullptr), 1);
    std::fclose(file);
  }

 private:
  void extend(int kind, const std::string& value, const TestCertificate& issuer) {
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer.certificate_.get(), certificate_.get(), nullptr, nullptr, 0);
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
    ASSERT_NE(extension, nullptr) << value;
    X509_add_ext(certificate_.get(), extension, -1);
    X509_EXTENSION_free(extension);
  }

  std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key_;
  std::unique_ptr<X509, decltype(&X509_free)> certificate_;
};

}  // namespace scree
