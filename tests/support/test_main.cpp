// sc_main must exist and SystemC elaborates once a process: so sc_main runs the tests, one process a test.
#include <gtest/gtest.h>
#include <systemc>

int sc_main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
