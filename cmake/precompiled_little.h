// For sources that are compiled without optimisation, whose time goes into these (scree_optimise_little,
// ScreeTargets.cmake).
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cmake/precompiled.h"
