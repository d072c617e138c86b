// What most tests include, compiled once.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmake/precompiled.h"
