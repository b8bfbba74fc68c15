// Tests of the program for every row of the table of levels.
#pragma once

#include "sim/levels/level.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hopmesh::tests {

/// What GoogleTest may call a level: letters, digits and underscores.
inline std::string name_of_level(const ::testing::TestParamInfo<std::string>& made) {
  std::string name = made.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// What a line of the program needs beside the level's name: an array that the level has.
inline std::string array_for(const std::string& name) {
  return levels::level_named(name, "").make_ready ? " --array folded --set array.elements=4" : "";
}

} // namespace hopmesh::tests
