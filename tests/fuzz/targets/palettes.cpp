// A palette: the first byte chooses whether the rest is the text of a file or the bytes of the wire.
//
// Holds: what is taken keeps all bounds, and survives its bytes; what is refused has a reason.
#include <vector>

#include "content/palette_text.h"
#include "proto/palette_codec.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

void check_palette(const Result<Palette>& palette) {
  if (!palette) {
    CHECK(!palette.error().message.empty());
    return;
  }
  CHECK(validate(*palette).has_value());
  const std::vector<uint8_t> bytes = encode_palette(*palette);
  const Result<Palette> again = decode_palette(bytes);
  CHECK(again.has_value() && *again == *palette);
  CHECK(encode_palette(*again) == bytes);
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::span<const uint8_t> rest(data + 1, size - 1);
  if (data[0] % 2 == 0)
    scree::check_palette(
        scree::read_palette({reinterpret_cast<const char*>(rest.data()), rest.size()}, "m.toml"));
  else
    scree::check_palette(scree::decode_palette(rest));
  return 0;
}
