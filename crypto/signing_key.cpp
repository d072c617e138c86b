#include "crypto/signing_key.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <unistd.h>

#include "crypto/openssl.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/regular_file.h"

namespace scree {

struct KeyHandle {
  OwnedKey key;
};

namespace {

constexpr mode_t owner_only = 0600;
constexpr mode_t everybody_reads = 0644;

std::shared_ptr<const KeyHandle> handle_of(EVP_PKEY* key) {
  auto handle = std::make_shared<KeyHandle>();
  handle->key.reset(key);
  return handle;
}

template <typename Read>
Result<std::shared_ptr<const KeyHandle>> read_key(const std::string& path, const char* what,
                                                  const Read& read) {
  if (const auto small = check_is_small_file(path, limits::pem_bytes_max); !small)
    return fail("the key cannot be read: " + small.error().message);
  const OwnedBio file(BIO_new_file(path.c_str(), "r"));
  ERR_clear_error();
  if (!file) return fail("the key " + path + " cannot be read");
  auto handle = handle_of(read(file.get()));
  ERR_clear_error();
  if (!handle->key || EVP_PKEY_get_base_id(handle->key.get()) != EVP_PKEY_ED25519)
    return fail(path + " is no " + what + " Ed25519 key in PEM form (scree token key makes a pair)");
  return handle;
}

Result<void> write_new(const std::string& path, mode_t mode, BIO* content) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(content, &bytes);
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return fail(path + " cannot be made: " + std::strerror(errno));
  const bool written = ::write(file, bytes, static_cast<size_t>(size)) == size;
  const bool closed = ::close(file) == 0;
  if (written && closed) return {};
  return fail(path + " cannot be written: " + std::strerror(errno));
}

}  // namespace

Result<VerifyingKey> VerifyingKey::read(const std::string& path) {
  auto key = read_key(path, "public",
                      [](BIO* file) { return PEM_read_bio_PUBKEY(file, nullptr, nullptr, nullptr); });
  TRY(key);
  return VerifyingKey(std::move(*key));
}

bool VerifyingKey::holds(std::span<const uint8_t> message,
                         std::span<const uint8_t, signature_bytes> signature) const {
  const OwnedDigest digest(EVP_MD_CTX_new());
  CHECK(digest && EVP_DigestVerifyInit(digest.get(), nullptr, nullptr, nullptr, key_->key.get()) == 1);
  const bool holds =
      EVP_DigestVerify(digest.get(), signature.data(), signature.size(), message.data(), message.size()) == 1;
  ERR_clear_error();
  return holds;
}

SigningKey SigningKey::generate() {
  EVP_PKEY* const key = EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519");
  CHECK(key != nullptr);
  return SigningKey(handle_of(key));
}

Result<SigningKey> SigningKey::read(const std::string& path) {
  // No passphrase: OpenSSL would ask for it on the terminal.
  const auto none = [](char*, int, int, void*) { return 0; };
  auto key = read_key(path, "private",
                      [&](BIO* file) { return PEM_read_bio_PrivateKey(file, nullptr, none, nullptr); });
  TRY(key);
  return SigningKey(std::move(*key));
}

Result<void> SigningKey::write(const std::string& path, const std::string& public_path) const {
  const OwnedBio secret(BIO_new(BIO_s_mem()));
  const OwnedBio open(BIO_new(BIO_s_mem()));
  CHECK(PEM_write_bio_PrivateKey(secret.get(), key_->key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1);
  CHECK(PEM_write_bio_PUBKEY(open.get(), key_->key.get()) == 1);
  if (::access(public_path.c_str(), F_OK) == 0) return fail(public_path + " exists already");
  TRY(write_new(path, owner_only, secret.get()));
  return write_new(public_path, everybody_reads, open.get());
}

VerifyingKey SigningKey::public_key() const {
  return VerifyingKey(key_);
}

Signature SigningKey::sign(std::span<const uint8_t> message) const {
  Signature signature{};
  size_t bytes = signature.size();
  const OwnedDigest digest(EVP_MD_CTX_new());
  CHECK(digest && EVP_DigestSignInit(digest.get(), nullptr, nullptr, nullptr, key_->key.get()) == 1);
  CHECK(EVP_DigestSign(digest.get(), signature.data(), &bytes, message.data(), message.size()) == 1);
  CHECK_EQ(bytes, signature.size());
  return signature;
}

uint64_t random_number() {
  uint64_t number = 0;
  CHECK(RAND_bytes(reinterpret_cast<unsigned char*>(&number), sizeof number) == 1);
  return number;
}

}  // namespace scree
