// The values that printers.sh looks at in gdb: all of them are known, and `stop_here` sees them all.
#include "shared/field/field.h"
#include "shared/operation/operation.h"

namespace scree {

struct PrintedValues {
  Brick brick;
  Window window;
  Operation carve;
  Operation island;
  const Field& field;
  const Field& layer;
};

[[gnu::noinline]] void stop_here(const PrintedValues& values) {
  asm volatile("" : : "r"(&values) : "memory");
}

void show() {
  Brick brick = air_brick();
  brick.codes[static_cast<size_t>(Brick::index(1, 2, 3))] = -5;
  Window window({{10, 20, 30}, {13, 24, 35}});
  window.at(11, 22, 33) = -7;
  MapField field(TerrainSource{TerrainKind::flat});
  field.set_brick({1, 2, 3}, brick);
  field.set_brick({100, 2, 3}, solid_brick());
  MapField layer(&field);
  layer.set_brick({-4, 0, 0}, brick);
  stop_here({.brick = brick,
             .window = window,
             .carve = CarveOperation{.shape = sphere({1.0F, 2.0F, 3.0F}, 4.5F), .seeds = 17},
             .island = IslandOperation{.box = {{0, 0, 0}, {8, 8, 8}}, .start = {1, 2, -3}, .piece = 9},
             .field = field,
             .layer = layer});
}

}  // namespace scree

int main() {
  scree::show();
}
