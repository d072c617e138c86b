#include "client/bot/bot_program.h"

int main(int argc, char** argv) {
  return scree::bot_program(argc, argv);
}
