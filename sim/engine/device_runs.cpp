// What CONTROL does, and how far it has come: the part of the device that keeps time.
#include "rtl_model/spec/cycles.h"
#include "sim/engine/device.h"

namespace hopmesh::engine {

namespace {

const std::atomic<bool> never{false};

} // namespace

// ---- commands ----

// An ABORT is for what is at work when the word comes; START and RESET begin where the transfer ends.
void Device::control(std::uint32_t word, std::uint64_t asked_at) {
  const bool begins = (word & (HM_CONTROL_START | HM_CONTROL_RESET)) != 0;
  const bool aborts = (word & HM_CONTROL_ABORT) != 0;
  if (busy()) {
    if (begins || (aborts && resets(asked_at))) reg(HM_REG_IRQ_STATUS) |= HM_IRQ_REFUSED;
    if (aborts && !resets(asked_at)) abort(asked_at);
    return;
  }
  if (word & HM_CONTROL_RESET) reset();
  if (word & HM_CONTROL_START) start();
}

// The sweep at hand is the last.
void Device::abort(std::uint64_t at) {
  aborted_ = true;
  last_sweep_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(last_sweep_, sweeps_by(at) + 1));
}

// Memories are empty at once, which nobody can see before the RESET has ended.
void Device::reset() {
  reset_registers();
  held_at_reset_ = held_;
  run_cycles_ = largest_sum_ = 0;
  const std::size_t table = map_[spec::Window::MOMENTUM].codes;
  const std::vector<std::uint32_t> zeros(std::max(engine_.topology().weight_words(), table), 0);
  for (std::size_t k = 0; k < spec::window_count; ++k)
    if (spec::is_writable(static_cast<spec::Window>(k)) && map_.window[k].codes > 0)
      write_codes(static_cast<spec::Window>(k), 0, zeros.data(), map_.window[k].codes);
  reg(HM_REG_STATUS) = HM_STATUS_BUSY;
  reset_until_ = now_ + spec::reset_cycles(engine_.array(), engine_.topology());
}

// Limits that are written from now on are for the next run.
void Device::start() {
  reg(HM_REG_STATUS) = HM_STATUS_BUSY;
  running_ = true;
  begun_ = aborted_ = false;
  run_from_ = std::max(now_, reset_until_);
  threshold_ = reg(HM_REG_THRESHOLD);
  max_sweeps_ = reg(HM_REG_MAX_SWEEPS);
  stop_rule_ = {HM_FIELD(reg(HM_REG_STOP), STOP_BY_SUM) != 0,
                static_cast<int>(HM_FIELD(reg(HM_REG_STOP), STOP_SHARE)),
                std::uint64_t{reg(HM_REG_SUM_THRESHOLD_HI)} << 32 | reg(HM_REG_SUM_THRESHOLD_LO)};
  last_sweep_ = std::max(max_sweeps_, 1u);
}

// ---- time ----

/// Sweeps of the run at hand whose check is over in that cycle.
std::uint64_t Device::sweeps_by(std::uint64_t cycle) const {
  const spec::CycleModel& cycles = engine_.cycles();
  const std::uint64_t first = run_from_ + cycles.run(0);
  return cycle < first ? 0 : (cycle - first) / cycles.sweep;
}

// What has happened by now.
void Device::catch_up() {
  if (!busy()) return;
  if (running_)
    run_to(sweeps_by(now_), never);
  else if (!resets(now_))
    reg(HM_REG_STATUS) = 0;
}

void Device::run_to(std::uint64_t sweeps, const std::atomic<bool>& stop) {
  if (sweeps == 0) return;
  if (!begun_) engine_.begin_run(threshold_, max_sweeps_, stop_rule_);
  begun_ = true;
  const auto last = static_cast<std::uint32_t>(std::min<std::uint64_t>(sweeps, last_sweep_));
  const bool over = engine_.advance(stop, last);
  if (over || engine_.result().sweeps == last_sweep_) finish();
}

int Device::wait_for_irq() {
  catch_up();
  if (irq()) return HM_OK;
  if (stop_) return HM_ERROR_STOPPED;
  if (busy() && running_) {
    run_to(last_sweep_, stop_);
    now_ = std::max(now_, run_from_ + engine_.result().cycles);
  } else if (busy()) {
    now_ = std::max(now_, reset_until_);
    catch_up();
  }
  return irq() ? HM_OK : HM_ERROR_STOPPED; // a line that nothing will raise is waited for in vain
}

void Device::finish() {
  const spec::Relaxation& r = engine_.result();
  reg(HM_REG_STATUS) =
      HM_STATUS_DONE | (r.converged ? HM_STATUS_CONVERGED : 0) | (aborted_ ? HM_STATUS_ABORTED : 0);
  reg(HM_REG_SWEEPS) = r.sweeps;
  reg(HM_REG_LARGEST_CHANGE) = r.largest_change;
  run_cycles_ = r.cycles;
  largest_sum_ = r.largest_sum;
  reg(HM_REG_LARGEST_SUM_LO) = static_cast<std::uint32_t>(largest_sum_);
  reg(HM_REG_CYCLES_LO) = static_cast<std::uint32_t>(run_cycles_);
  reg(HM_REG_IRQ_STATUS) |= HM_IRQ_DONE;
  running_ = false;
}

} // namespace hopmesh::engine
