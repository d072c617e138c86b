// Prints the SHA-256 of 0, 1, 2 … bytes, for comparison (kernels.mjs): every way in which a text fills its
// last block.
#include <cstdio>
#include <vector>

#include "crypto/sha256.h"

int main() {
  std::vector<uint8_t> bytes;
  for (int i = 0; i <= 200; ++i) {
    std::printf("%s\n", scree::hex_of(scree::sha256(bytes)).c_str());
    bytes.push_back(static_cast<uint8_t>(i * 37));
  }
}
