#include "client/render/gl/material_table.h"

#include <array>
#include <glm/vec3.hpp>

#include "client/render/scene/ground_tint.h"

namespace scree {
namespace {

/// As client/shaders/material.glsl reads it: a column for each row of the palette.
struct Texel {
  float red, green, blue, alpha;
};
constexpr size_t table_columns = 256;
constexpr size_t table_lines = 3;

/// Rubble of the ground's bulk is of the colour of its broken faces (rock.glsl), which is not that of its
/// row.
glm::vec3 colour_of(const MaterialRow& material, const Palette& palette) {
  constexpr glm::vec3 broken(0.51F, 0.30F, 0.165F);
  if (material.rubble && material.rubble->of == palette.ground.bulk)
    return broken * ground_tints(palette).bulk;
  return {material.look.colour[0], material.look.colour[1], material.look.colour[2]};
}

}  // namespace

void MaterialTable::set(const Palette& palette, const MaterialImages& images) {
  std::array<Texel, table_columns * table_lines> texels;
  for (size_t row = 0; row < table_columns; ++row) {
    const MaterialRow& material = palette.row_or_first(static_cast<Material>(row));
    const MaterialLook& look = material.look;
    const glm::vec3 colour = colour_of(material, palette);
    texels[row] = {colour.r, colour.g, colour.b, look.variation};
    texels[table_columns + row] = {look.roughness, static_cast<float>(look.pattern), look.pattern_m,
                                   material.rubble ? 1.0F : 0.0F};
    texels[2 * table_columns + row] = {static_cast<float>(images.layer_of(look.albedo)),
                                       static_cast<float>(images.layer_of(look.normal)), look.image_m, 0.0F};
  }
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, table_columns, table_lines, 0, GL_RGBA, GL_FLOAT, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace scree
