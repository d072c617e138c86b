#include "client/render/gl/material_source.h"

#include <array>
#include <cstdio>
#include <string>

#include "client/render/scene/paint_number.h"

namespace scree {
namespace {

std::string constant(const std::string& name, unsigned value) {
  return "const int " + name + " = " + std::to_string(value) + ";\n";
}

/// Nine digits give the same float again.
std::string literal(const std::array<float, 3>& colour) {
  char text[96];
  std::snprintf(text, sizeof(text), "vec3(%.9g, %.9g, %.9g)", static_cast<double>(colour[0]),
                static_cast<double>(colour[1]), static_cast<double>(colour[2]));
  return text;
}

std::string written() {
  std::string text = constant("paint_bits", paint_bits) + constant("paint_in_cuts", paint_in_cuts);
  std::string albedos;
  for (const Material material : all_kinds<Material>) {
    text += constant("material_" + std::string(name_of(material)), paint_number(material));
    albedos += (albedos.empty() ? "" : ", ") + literal(traits_of(material).albedo);
  }
  const std::string type = "vec3[" + std::to_string(kind_count<Material>) + "]";
  text += "const " + type + " material_albedo = " + type + "(" + albedos + ");\n";
  std::array<char, 64> step{};
  std::snprintf(step.data(), step.size(), "const float layer_step_m = %.9g;\n",
                static_cast<double>(layer_step_m));
  return text + step.data() +
         "vec4 paint_colour(int paint) { return paint == 0 ? vec4(0.0) : vec4(material_albedo[paint - 1], "
         "1.0); "
         "}\n";
}

}  // namespace

std::string_view material_source() {
  static const std::string text = written();
  return text;
}

}  // namespace scree
