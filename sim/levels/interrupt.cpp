#include "sim/levels/interrupt.h"

#include <csignal>
#include <unistd.h>

namespace hopmesh::levels {

std::atomic<bool> stop_requested{false};

namespace {

void on_signal(int) {
  if (stop_requested.exchange(true)) _exit(130);
}

} // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN); // nohup: goes on without us
}

} // namespace hopmesh::levels
