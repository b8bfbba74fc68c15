#include "sim/cosim/shrink.h"

#include "rtl_model/spec/array_keys.h"
#include "rtl_model/spec/array_rules.h"

#include <algorithm>
#include <utility>

namespace hopmesh::cosim {

namespace {

/// Which cells, components and links of a job stay.
struct Kept {
  std::function<bool(std::uint32_t)> cell = [](std::uint32_t) { return true; };
  std::function<bool(int)> component = [](int) { return true; };
  std::function<bool(std::uint32_t, std::uint32_t)> link = [](std::uint32_t, std::uint32_t) { return true; };
};

std::vector<std::uint32_t> sources_of(const spec::Topology& t, std::uint32_t cell) {
  std::vector<std::uint32_t> sources{cell};
  sources.insert(sources.end(), t.link_to.begin() + t.first_link[cell],
                 t.link_to.begin() + t.first_link[cell + 1]);
  return sources;
}

// The job made anew from what is kept; the order of what stays is what it was.
ArrayJob rebuilt(const ArrayJob& job, const Kept& kept) {
  const spec::Topology& t = job.topology;
  const int per_cell = t.neurons_per_cell;
  ArrayJob small{job.array, {}, {}, {}, {}, job.threshold, job.max_sweeps, job.rule, job.momentum};
  std::vector<std::uint32_t> number(t.cells());
  std::uint32_t cells = 0;
  for (std::uint32_t c = 0; c < t.cells(); ++c) number[c] = kept.cell(c) ? cells++ : UINT32_MAX;
  small.topology.neurons_per_cell = 0;
  for (int p = 0; p < per_cell; ++p) small.topology.neurons_per_cell += kept.component(p);
  small.topology.first_link.push_back(0);
  for (std::uint32_t c = 0; c < t.cells(); ++c) {
    if (!kept.cell(c)) continue;
    const auto stays = [&](std::uint32_t s) { return s == c || (kept.cell(s) && kept.link(c, s)); };
    for (std::uint32_t source : sources_of(t, c))
      if (source != c && stays(source)) small.topology.link_to.push_back(number[source]);
    small.topology.first_link.push_back(static_cast<std::uint32_t>(small.topology.link_to.size()));
    for (int p = 0; p < per_cell; ++p) {
      if (!kept.component(p)) continue;
      const std::size_t neuron =
          std::size_t{c} * static_cast<std::size_t>(per_cell) + static_cast<std::size_t>(p);
      small.start.push_back(job.start[neuron]);
      small.bias.push_back(job.bias[neuron]);
      std::size_t at = t.row_offset(c, static_cast<std::size_t>(p));
      for (std::uint32_t source : sources_of(t, c))
        for (int q = 0; q < per_cell; ++q, ++at)
          if (stays(source) && kept.component(q)) small.weight.push_back(job.weight[at]);
    }
  }
  return small;
}

/// Makes the value of a key the plainest; false where it was. Of a format: its rounding, or its overflow.
struct Plain {
  int plainest;
  bool overflow;

  template <typename T> bool change(T& value, T plain) const {
    return !overflow && std::exchange(value, plain) != plain;
  }

  bool operator()(bool* at) const { return change(*at, plainest != 0); }
  bool operator()(int* at) const { return change(*at, plainest); }
  bool operator()(const spec::Choice& choice) const {
    return change(*choice.at, static_cast<std::uint8_t>(plainest));
  }
  bool operator()(const spec::Accumulator& sum) const { return change(*sum.exact, true); }
  bool operator()(spec::NumberFormat* f) const {
    if (overflow) return std::exchange(f->overflow, spec::Overflow::sat) != spec::Overflow::sat;
    return change(f->rounding, spec::Rounding::trn);
  }
  bool operator()(double*) const { return false; }
};

class Shrinker {
 public:
  Shrinker(ArrayJob job, const Differs& differs, std::uint64_t most_trials)
      : job_(std::move(job)), differs_(differs), trials_left_(most_trials) {}

  ArrayJob result() {
    bool smaller = true;
    while (smaller && trials_left_ > 0) {
      smaller = fewer_sweeps();
      smaller |= plainer_rule();
      smaller |= fewer_entries();
      smaller |= fewer_cells();
      smaller |= fewer_components();
      smaller |= fewer_links();
      smaller |= smaller_codes(&ArrayJob::weight);
      smaller |= smaller_codes(&ArrayJob::bias);
      smaller |= smaller_codes(&ArrayJob::start);
      smaller |= smaller_codes(&ArrayJob::momentum);
      smaller |= plainer_array();
    }
    return std::move(job_);
  }

 private:
  bool accept(ArrayJob trial) {
    if (trials_left_ == 0 || spec::validate(trial.array, trial.topology.most_taps())) return false;
    trials_left_ -= 1;
    if (!differs_(trial)) return false;
    job_ = std::move(trial);
    return true;
  }

  template <typename Change> bool try_change(Change change) {
    ArrayJob trial = job_;
    change(trial);
    return accept(std::move(trial));
  }

  bool fewer_sweeps() {
    bool any = false;
    if (job_.threshold > 0) any |= try_change([](ArrayJob& j) { j.threshold = 0; });
    for (std::uint32_t n : {1u, job_.max_sweeps / 2})
      if (n > 0 && n < job_.max_sweeps) any |= try_change([n](ArrayJob& j) { j.max_sweeps = n; });
    while (job_.max_sweeps > 1 && try_change([](ArrayJob& j) { j.max_sweeps -= 1; })) any = true;
    if (job_.max_sweeps == 0) any |= try_change([](ArrayJob& j) { j.max_sweeps = 1; });
    return any;
  }

  bool plainer_rule() {
    bool any = false;
    if (job_.rule.by_sum) any |= try_change([](ArrayJob& j) { j.rule.by_sum = false; });
    if (job_.rule.share > 0) any |= try_change([](ArrayJob& j) { j.rule.share = 0; });
    if (job_.rule.floor > 0) any |= try_change([](ArrayJob& j) { j.rule.floor = 0; });
    while (job_.rule.floor / 2 > 0 && try_change([](ArrayJob& j) { j.rule.floor /= 2; })) any = true;
    return any;
  }

  bool fewer_entries() {
    bool any = false;
    while (job_.momentum.size() > 1 && try_change([](ArrayJob& j) {
             j.array.momentum_entries -= 1;
             j.momentum.pop_back();
           }))
      any = true;
    return any;
  }

  // Halves first, then quarters, down to single ones.
  bool fewer_cells() {
    bool any = false;
    for (std::uint32_t piece = static_cast<std::uint32_t>(job_.topology.cells()) / 2; piece > 0; piece /= 2)
      for (std::uint32_t first = 0; first + piece <= job_.topology.cells() && job_.topology.cells() > piece;)
        if (accept(without_cells(job_, first, piece)))
          any = true;
        else
          first += piece;
    return any;
  }

  bool fewer_components() {
    bool any = false;
    for (int p = 0; p < job_.topology.neurons_per_cell && job_.topology.neurons_per_cell > 1;)
      if (accept(without_component(job_, p)))
        any = true;
      else
        ++p;
    return any;
  }

  bool fewer_links() {
    bool any = false;
    for (std::uint32_t a = 0; a < job_.topology.cells(); ++a)
      for (std::size_t k = job_.topology.first_link[a]; k < job_.topology.first_link[a + 1];)
        if (job_.topology.link_to[k] > a && accept(without_link(job_, a, job_.topology.link_to[k])))
          any = true;
        else
          ++k;
    return any;
  }

  // To zero, many at once, then fewer; what stays is halved as long as it differs.
  bool smaller_codes(std::vector<std::int32_t> ArrayJob::*codes) {
    bool any = false;
    const std::size_t count = (job_.*codes).size();
    for (std::size_t piece = count; piece > 0; piece /= 2)
      for (std::size_t first = 0; first < count; first += piece)
        any |= to_zero(codes, first, std::min(piece, count - first));
    for (std::size_t k = 0; k < count; ++k)
      while ((job_.*codes)[k] / 2 != 0 && try_change([&](ArrayJob& j) { (j.*codes)[k] /= 2; })) any = true;
    return any;
  }

  bool to_zero(std::vector<std::int32_t> ArrayJob::*codes, std::size_t first, std::size_t count) {
    const auto begin = (job_.*codes).begin() + static_cast<std::ptrdiff_t>(first);
    if (std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count), [](std::int32_t c) { return c == 0; }))
      return false;
    return try_change(
        [&](ArrayJob& j) { std::fill_n((j.*codes).begin() + static_cast<std::ptrdiff_t>(first), count, 0); });
  }

  bool plainer_array() {
    bool any = false;
    for (std::size_t row = 0; row < spec::array_keys(job_.array).size(); ++row)
      for (bool overflow : {false, true}) {
        ArrayJob trial = job_;
        const spec::ArrayKey key = spec::array_keys(trial.array)[row];
        if (key.vectors_line == 0 || !std::visit(Plain{key.plainest, overflow}, key.place)) continue;
        trial.momentum.resize(table_entries(trial.array));
        any |= accept(std::move(trial));
      }
    return any;
  }

  ArrayJob job_;
  const Differs& differs_;
  std::uint64_t trials_left_;
};

} // namespace

ArrayJob without_cells(const ArrayJob& job, std::uint32_t first, std::uint32_t count) {
  Kept kept;
  kept.cell = [=](std::uint32_t c) { return c < first || c >= first + count; };
  return rebuilt(job, kept);
}

ArrayJob without_component(const ArrayJob& job, int p) {
  Kept kept;
  kept.component = [p](int q) { return q != p; };
  return rebuilt(job, kept);
}

ArrayJob without_link(const ArrayJob& job, std::uint32_t a, std::uint32_t b) {
  Kept kept;
  kept.link = [=](std::uint32_t c, std::uint32_t d) { return !((c == a && d == b) || (c == b && d == a)); };
  return rebuilt(job, kept);
}

ArrayJob shrink(ArrayJob job, const Differs& differs, std::uint64_t most_trials) {
  return Shrinker(std::move(job), differs, most_trials).result();
}

} // namespace hopmesh::cosim
