// A child takes a batch, because SystemC elaborates once a process, and tells of each case before it begins
// it: so the case that kills a child has a name.
#include "sim/cosim/campaign.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/cosim/random_job.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
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
    if (dice.one_in(4)) array.output = spec::Output::binary;
  }
  if (!preset || spec::validate(array, topology.most_taps()))
    array = random_array(dice, topology.most_taps());
  return {random_codes(dice, array, topology), every_sweep};
}

namespace {

struct Batch {
  std::uint64_t first, count;
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

[[noreturn]] void do_batch(const std::vector<Contestant>& contestants, std::uint64_t seed, Batch batch,
                           int pipe) {
  std::vector<CampaignCase> cases;
  std::vector<MadeAhead> ahead;
  const auto takes_part = [&](std::uint64_t number) {
    return [&contestants, seed, number](std::size_t k) {
      return contestants[k].one_in == 1 || mixed(mixed(seed + k) ^ number) % contestants[k].one_in == 0;
    };
  };
  alarm(case_seconds);
  for (std::uint64_t k = 0; k < batch.count; ++k) {
    say(pipe, fmt::format("c {}\n", batch.first + k));
    cases.push_back(campaign_case(seed, batch.first + k));
    ahead.push_back(make_ahead(contestants, cases.back().job, takes_part(batch.first + k)));
  }
  for (std::uint64_t k = 0; k < batch.count; ++k) {
    const std::uint64_t number = batch.first + k;
    say(pipe, fmt::format("r {}\n", number));
    alarm(case_seconds);
    const Mismatch m = contest(contestants, cases[k].job, ahead[k], cases[k].every_sweep, takes_part(number));
    if (!m.text.empty()) say(pipe, fmt::format("m {} {} {}\n", number, m.contestant, m.text));
  }
  say(pipe, "d\n");
  _exit(0); // no destructors: SystemC would spend a third of the batch's time on its own
}

[[noreturn]] void be_child(const std::vector<Contestant>& contestants, std::uint64_t seed, Batch batch,
                           int pipe) {
  std::signal(SIGINT, SIG_IGN); // the parent decides
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGALRM, SIG_DFL);
  try {
    do_batch(contestants, seed, batch, pipe);
  } catch (const std::exception& e) {
    say(pipe, fmt::format("e {}\n", e.what()));
  }
  _exit(0);
}

// ---- in the parent ----

struct Child {
  pid_t pid = -1;
  int pipe = -1;
  Batch batch{};
  std::uint64_t at = 0; ///< the case that it spoke of last
  bool running = false, done = false;
  std::string heard, trouble;
};

class Parent {
 public:
  Parent(const std::vector<Contestant>& contestants, const CampaignPlan& plan,
         const std::function<void(std::uint64_t)>& progress, const std::atomic<bool>& stop)
      : contestants_(contestants), plan_(plan), progress_(progress), stop_(stop), next_(plan.first) {}
  ~Parent() {
    for (Child& child : children_) {
      kill(child.pid, SIGKILL);
      bury(child);
    }
  }

  CampaignResult run() {
    const auto began = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    };
    while (!stop_ && !result_.finding) {
      while (children_.size() < plan_.children && next_ - plan_.first < plan_.cases &&
             seconds() < plan_.seconds)
        begin_batch();
      if (children_.empty()) break;
      listen();
    }
    result_.interrupted = stop_ && !result_.finding;
    result_.next = next_;
    for (const Child& child : children_)
      result_.next = std::min(result_.next, child.running ? child.at : child.batch.first);
    result_.cases = result_.finding ? result_.finding->number - plan_.first : result_.next - plan_.first;
    result_.seconds = seconds();
    return result_;
  }

 private:
  void begin_batch() {
    const Batch batch{next_, std::min(batch_cases, plan_.cases - (next_ - plan_.first))};
    int ends[2];
    std::fflush(nullptr);
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process can be made");
    const pid_t pid = fork();
    if (pid < 0) throw std::runtime_error("no child process can be made");
    if (pid == 0) {
      close(ends[0]);
      be_child(contestants_, plan_.seed, batch, ends[1]);
    }
    close(ends[1]);
    Child child;
    child.pid = pid, child.pipe = ends[0], child.batch = batch, child.at = batch.first;
    children_.push_back(child);
    next_ += batch.count;
  }

  void listen() {
    std::vector<pollfd> polls;
    for (const Child& child : children_) polls.push_back({child.pipe, POLLIN, 0});
    if (poll(polls.data(), polls.size(), 200) <= 0) return;
    for (std::size_t k = polls.size(); k-- > 0;)
      if (polls[k].revents != 0 && !hear(children_[k])) end(k);
    report();
  }

  // What a child said; false at its end.
  bool hear(Child& child) {
    char block[4096];
    const ssize_t n = read(child.pipe, block, sizeof block);
    if (n < 0) return errno == EINTR;
    child.heard.append(block, static_cast<std::size_t>(n));
    for (std::size_t end; (end = child.heard.find('\n')) != std::string::npos; child.heard.erase(0, end + 1))
      understand(child, child.heard.substr(0, end));
    return n > 0;
  }

  void understand(Child& child, const std::string& line) {
    const std::string rest = line.size() > 2 ? line.substr(2) : "";
    if (line[0] == 'd') child.done = true;
    if (line[0] == 'e') child.trouble = rest;
    if (line[0] == 'c') child.at = std::stoull(rest);
    if (line[0] == 'r') child.at = std::stoull(rest), child.running = true;
    if (line[0] != 'm') return;
    std::size_t used = 0, more = 0;
    const std::uint64_t number = std::stoull(rest, &used);
    const std::size_t contestant = std::stoul(rest.substr(used), &more);
    found({number, contestant, rest.substr(used + more + 1)});
  }

  void found(const Finding& finding) {
    if (!result_.finding || finding.number < result_.finding->number) result_.finding = finding;
  }

  void end(std::size_t k) {
    Child& child = children_[k];
    const int status = bury(child);
    if (!child.done) {
      const std::string how = WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                                                  : "ended before its time";
      found({child.at, 0,
             fmt::format("{}: {}", child.running ? "one of the levels" : "while the arrays were made",
                         child.trouble.empty() ? how : child.trouble)});
    }
    done_ += child.batch.count;
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(k));
  }

  static int bury(Child& child) {
    int status = 0;
    while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
    }
    close(child.pipe);
    return status;
  }

  void report() {
    std::uint64_t done = done_;
    for (const Child& child : children_)
      if (child.running) done += child.at - child.batch.first;
    progress_(done);
  }

  const std::vector<Contestant>& contestants_;
  const CampaignPlan plan_;
  const std::function<void(std::uint64_t)>& progress_;
  const std::atomic<bool>& stop_;
  std::uint64_t next_, done_ = 0;
  std::deque<Child> children_;
  CampaignResult result_;
};

} // namespace

CampaignResult run_campaign(const std::vector<Contestant>& contestants, const CampaignPlan& plan,
                            const std::function<void(std::uint64_t)>& progress,
                            const std::atomic<bool>& stop) {
  return Parent(contestants, plan, progress, stop).run();
}

} // namespace hopmesh::cosim
