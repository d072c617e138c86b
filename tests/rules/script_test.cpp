#include "server/rules/sandbox/script.h"

#include <gtest/gtest.h>
TEST(Script, exists) {}
