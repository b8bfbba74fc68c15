// Keys that no program knows go into test vectors and come back by the table that has them.
#include "sim/cosim/random_job.h"
#include "sim/cosim/vectors.h"
#include "sim/input/input_error.h"
#include "tests/support/files.h"
#include "tests/support/own_array_keys.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace own;

TEST(OwnKeys, areInTestVectors) {
  const Folder folder;
  const std::string file = folder / "v.txt";
  set(7, Colour::blue, narrow);
  cosim::VectorWriter writer(file, with_more);
  writer.add({"one", cosim::random_job(1)}, nullptr);
  writer.commit();
  set(0, Colour::red, {});
  cosim::VectorCase read;
  EXPECT_TRUE(cosim::VectorReader(file, with_more).next(read));
  EXPECT_EQ(depth, 7);
  EXPECT_EQ(colour, Colour::blue);
  EXPECT_EQ(ratio, narrow);
  EXPECT_THROW(cosim::VectorReader(file).next(read), input::InputError) << "a line that nobody knows";
}

} // namespace
} // namespace hopmesh::tests
