#include "server/app/server_program.h"

int main(int argc, char** argv) {
  return scree::server_program(argc, argv);
}
