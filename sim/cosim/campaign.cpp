// A child takes a batch, because SystemC elaborates once a process, and tells of each case before it begins
// it: so the case that kills a child has a name.
#include "sim/cosim/campaign.h"

#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "sim/cosim/random_job.h"
#include "sim/input/line_reader.h"
#include "sim/input/number.h"
#include "sim/run/children.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <list>
#include <memory>
#include <new>
#include <poll.h>
#include <system_error>
#include <unistd.h>

namespace hopmesh::cosim {

namespace {

constexpr std::uint64_t batch_cases = 200;
constexpr unsigned case_seconds = 300; // of a case; whoever takes longer hangs

// SplitMix64: neighbouring seeds and numbers share nothing.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

} // namespace

CampaignCase campaign_case(std::uint64_t seed, std::uint64_t number) {
  Dice dice(mixed(mixed(seed) ^ number));
  const bool large = dice.one_in(64), preset = dice.one_in(4), every_sweep = dice.one_in(4);
  const spec::Topology topology = random_topology(dice, large ? 300 : 60);
  spec::ArraySpec array;
  if (preset) {
    const auto presets = spec::presets();
    array = presets[dice.below(presets.size())];
    array.schedule = dice.mode<spec::Schedule>(spec::schedule_names);
    array.lanes = static_cast<int>(dice.between(1, 6));
    array.packing = dice.one_in(2);
    if (dice.one_in(4)) array.output = spec::Output::binary;
  }
  if (!preset || spec::validate(array, topology.most_taps()))
    array = random_array(dice, topology.most_taps());
  CampaignCase made{random_codes(dice, array, topology), every_sweep};
  fold_at_random(dice, made.job.array);
  vary_stage(dice, made.job);
  return made;
}

CampaignCase campaign_case(std::uint64_t seed, std::uint64_t number,
                           const std::vector<spec::ArraySpec>& arrays) {
  if (arrays.empty()) return campaign_case(seed, number);
  Dice dice(mixed(mixed(seed) ^ number));
  const bool large = dice.one_in(64), every_sweep = dice.one_in(4);
  const spec::ArraySpec& array = arrays[dice.below(arrays.size())];
  for (;;) {
    const spec::Topology topology = random_topology(dice, large ? 300 : 60);
    if (spec::validate_on(array, topology)) continue; // a row too long for its formats
    CampaignCase made{random_codes(dice, array, topology), every_sweep};
    vary_run(dice, made.job);
    return made;
  }
}

namespace {

struct Batch {
  std::uint64_t first, count;
  bool again = false; ///< its first child was ended from outside
};

// ---- in the child ----

void say(int pipe, const std::string& line) {
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t n = write(pipe, line.data() + done, line.size() - done);
    if (n < 0) _exit(1); // nobody listens any more
    done += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void do_batch(const Ways& ways, const CampaignPlan& plan, Batch batch, int pipe) {
  const std::uint64_t seed = plan.seed;
  std::vector<CampaignCase> cases;
  std::vector<MadeAhead> ahead;
  const auto takes_part = [&](std::uint64_t number) {
    return [&ways, seed, number](std::size_t k) {
      return ways[k].one_in == 1 || mixed(mixed(seed + k) ^ number) % ways[k].one_in == 0;
    };
  };
  alarm(case_seconds);
  for (std::uint64_t k = 0; k < batch.count; ++k) {
    say(pipe, fmt::format("c {}\n", batch.first + k));
    cases.push_back(campaign_case(seed, batch.first + k, plan.arrays));
    ahead.push_back(make_ahead(ways, cases.back().job, takes_part(batch.first + k)));
  }
  for (std::uint64_t k = 0; k < batch.count; ++k) {
    const std::uint64_t number = batch.first + k;
    say(pipe, fmt::format("r {}\n", number));
    alarm(case_seconds);
    const Mismatch m = contest(ways, cases[k].job, ahead[k], cases[k].every_sweep, takes_part(number));
    if (!m.text.empty()) say(pipe, fmt::format("m {} {} {}\n", number, m.way, m.text));
  }
  say(pipe, "d\n");
  _exit(0); // no destructors: SystemC would spend a third of the batch's time on its own
}

int run_batch(const Ways& ways, const CampaignPlan& plan, Batch batch, int pipe) {
  std::signal(SIGINT, SIG_IGN); // the parent decides
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGALRM, SIG_DFL);
  try {
    do_batch(ways, plan, batch, pipe);
  } catch (const std::bad_alloc&) {
    throw; // nothing that a level did wrong
  } catch (const std::exception& e) {
    say(pipe, fmt::format("e {}\n", e.what()));
  }
  return run::child_done;
}

// ---- in the parent ----

/// A child at a batch, and what it has said so far.
struct BatchChild {
  BatchChild(const Batch& of, int pipe_end, const std::function<int()>& work)
      : batch(of), pipe(pipe_end), process(work), at(of.first) {}
  ~BatchChild() { close(pipe); }
  BatchChild(const BatchChild&) = delete;
  BatchChild& operator=(const BatchChild&) = delete;

  const Batch batch;
  const int pipe;
  run::Child process;
  std::uint64_t at; ///< the case that it spoke of last
  bool running = false, done = false;
  std::string heard, trouble;
};

class Parent {
 public:
  Parent(const Ways& ways, const CampaignPlan& plan, const std::function<void(std::uint64_t)>& progress,
         const std::atomic<bool>& stop)
      : ways_(ways), plan_(plan), progress_(progress), stop_(stop), workers_(plan.children),
        next_(plan.first) {}

  CampaignResult run() {
    const auto began = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    };
    while (!stop_ && !result_.finding) {
      while (children_.size() < workers_ && next_ - plan_.first < plan_.cases && seconds() < plan_.seconds)
        begin_next_batch();
      if (children_.empty()) break;
      read_children();
    }
    result_.interrupted = stop_ && !result_.finding;
    result_.next = next_;
    for (const BatchChild& child : children_)
      result_.next = std::min(result_.next, child.running ? child.at : child.batch.first);
    result_.cases = result_.finding ? result_.finding->number - plan_.first : result_.next - plan_.first;
    result_.seconds = seconds();
    return result_;
  }

 private:
  // As many at a time as the system has processes for.
  void begin_next_batch() {
    const Batch batch{next_, std::min(batch_cases, plan_.cases - (next_ - plan_.first))};
    try {
      begin(batch);
      next_ += batch.count;
    } catch (const std::system_error&) {
      if (children_.empty()) throw;
      workers_ = children_.size();
    }
  }

  void begin(const Batch& batch) {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe to a child process can be made");
    const std::unique_ptr<int, void (*)(int*)> writer(&ends[1], [](int* end) { close(*end); });
    children_.emplace_back(batch, ends[0], [&] {
      close(ends[0]);
      return run_batch(ways_, plan_, batch, ends[1]);
    });
  }

  void read_children() {
    std::vector<pollfd> polls;
    for (const BatchChild& child : children_) polls.push_back({child.pipe, POLLIN, 0});
    if (poll(polls.data(), polls.size(), 200) <= 0) return;
    auto child = children_.begin();
    for (const pollfd& answer : polls) {
      const auto next = std::next(child);
      if (answer.revents != 0 && !read_from(*child)) end(child);
      child = next;
    }
    report();
  }

  /// False at the end of what a child says.
  bool read_from(BatchChild& child) {
    char block[4096];
    const ssize_t n = read(child.pipe, block, sizeof block);
    if (n < 0) return errno == EINTR;
    child.heard.append(block, static_cast<std::size_t>(n));
    for (std::size_t end; (end = child.heard.find('\n')) != std::string::npos; child.heard.erase(0, end + 1))
      take_line(child, child.heard.substr(0, end));
    return n > 0;
  }

  void take_line(BatchChild& child, const std::string& line) {
    input::Words words(line);
    const std::string_view what = words.next();
    if (what == "d") child.done = true;
    if (what == "e") child.trouble = words.rest();
    if (what == "c" || what == "r") input::parse_number(words.next(), child.at);
    if (what == "r") child.running = true;
    if (what != "m") return;
    Finding finding;
    input::parse_number(words.next(), finding.number);
    input::parse_number(words.next(), finding.way);
    finding.text = words.rest();
    found(finding);
  }

  void found(const Finding& finding) {
    if (!result_.finding || finding.number < result_.finding->number) result_.finding = finding;
  }

  void end(std::list<BatchChild>::iterator child) {
    const run::ChildEnd end = child->process.wait();
    if (end.exit_code == run::child_refused) throw run::Refused(end.message);
    if (!child->done && end.from_outside() && !child->batch.again) {
      const Batch batch{child->batch.first, child->batch.count, true};
      children_.erase(child);
      return begin(batch);
    }
    if (!child->done) {
      const std::string how = end.signal ? run::describe(end) : "ended before its time";
      found({child->at, 0,
             fmt::format("{}: {}", child->running ? "one of the levels" : "while the arrays were made",
                         child->trouble.empty() ? how : child->trouble)});
    }
    done_ += child->batch.count;
    children_.erase(child);
  }

  void report() {
    std::uint64_t done = done_;
    for (const BatchChild& child : children_)
      if (child.running) done += child.at - child.batch.first;
    progress_(done);
  }

  const Ways& ways_;
  const CampaignPlan plan_;
  const std::function<void(std::uint64_t)>& progress_;
  const std::atomic<bool>& stop_;
  std::size_t workers_;
  std::uint64_t next_, done_ = 0;
  std::list<BatchChild> children_;
  CampaignResult result_;
};

} // namespace

CampaignResult run_campaign(const Ways& ways, const CampaignPlan& plan,
                            const std::function<void(std::uint64_t)>& progress,
                            const std::atomic<bool>& stop) {
  return Parent(ways, plan, progress, stop).run();
}

} // namespace hopmesh::cosim
