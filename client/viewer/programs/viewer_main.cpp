#include "client/viewer/viewer_program.h"

int main(int argc, char** argv) {
  return scree::viewer_program(argc, argv);
}
