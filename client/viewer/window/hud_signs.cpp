#include <imgui/imgui.h>

#include "client/viewer/signs/sign_drawing.h"
#include "client/viewer/window/hud.h"
#include "shared/base/overloaded.h"

namespace scree {
namespace {

ImU32 packed(SignColour colour) {
  return IM_COL32(colour[0], colour[1], colour[2], colour[3]);
}

ImVec2 place_of(glm::vec2 at) {
  return {at.x, at.y};
}

}  // namespace

void Hud::signs(const std::vector<ShownSign>& shown) {
  if (shown.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const LetterSizes letters{[](const std::string& words) { return ImGui::CalcTextSize(words.c_str()).x; },
                            ImGui::GetFontSize()};
  std::vector<TakenRoom> panels;
  for (const Rectangle& one : panels_.places())
    if (one.size.x > 0.0F) panels.push_back({one.at, one.at + one.size});
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const SignPart& part : draw_signs(shown, {size.x, size.y}, letters, std::move(panels)))
    std::visit(Overloaded{[&](const SignBox& box) {
                            list.AddRectFilled(place_of(box.from), place_of(box.to), packed(box.colour));
                          },
                          [&](const SignTriangle& triangle) {
                            const auto& [a, b, c] = triangle.corners;
                            list.AddTriangleFilled(place_of(a), place_of(b), place_of(c),
                                                   packed(triangle.colour));
                          },
                          [&](const SignWords& text) {
                            list.AddText(place_of(text.at), packed(text.colour), text.words.c_str());
                          }},
               part);
}

}  // namespace scree
