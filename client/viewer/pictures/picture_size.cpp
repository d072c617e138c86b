#include "client/viewer/pictures/picture_size.h"

#include <algorithm>
#include <sstream>

#include "client/render/scene/limits.h"

namespace scree {

Result<PictureSize> parse_size(const std::string& text) {
  std::istringstream in(text);
  PictureSize size;
  char x = 0;
  if (!(in >> size.width >> x >> size.height) || x != 'x' || !in.eof() || size.width < 1 || size.height < 1)
    return fail("'" + text + "' is not a size; write it as 1280x720");
  if (std::max(size.width, size.height) > limits::image_side_max)
    return fail("'" + text + "' is over " + std::to_string(limits::image_side_max) +
                " pixels a side (limits.image_side_max)");
  return size;
}

}  // namespace scree
