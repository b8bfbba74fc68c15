#include "tests/campaigns/mutants/hunt.h"

#include "sim/files/output_file.h"
#include "sim/run/children.h"
#include "tests/campaigns/mutants/mutant_child.h"
#include "tests/support/files.h"

#include <algorithm>
#include <csignal>
#include <deque>
#include <memory>
#include <thread>

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;

/// Some mutants of a reader.
struct Batch {
  std::size_t reader;
  std::uint64_t from, to;
};

/// All readers at the first numbers, then at the next ones.
std::deque<Batch> batches_of(std::size_t readers, const Hunt& plan) {
  std::deque<Batch> all;
  const std::uint64_t end = plan.first + plan.mutants;
  for (std::uint64_t from = plan.first; from < end; from += plan.batch)
    for (std::size_t r = 0; r < readers; ++r) all.push_back({r, from, std::min(from + plan.batch, end)});
  return all;
}

std::string first_line_with(const std::string& text, const std::string& word) {
  for (const std::string& line : tests::lines_of(text))
    if (line.find(word) != std::string::npos) return line;
  return "";
}

/// What killed a child, in a line: the sanitizer's, if it said something.
std::string cause_of(const run::ChildEnd& end, const std::string& said) {
  if (end.signal == SIGPROF || end.signal == SIGALRM) return "a hang";
  for (const char* word : {"ERROR: ", "runtime error: ", "WARNING: "})
    if (const std::string line = first_line_with(said, word); !line.empty()) return line;
  return run::describe(end);
}

/// A child at work, and where it is.
class Worker {
 public:
  Worker(const std::vector<Reader>& readers, const Hunt& plan, const fs::path& folder)
      : readers_(readers), plan_(plan), folder_(folder) {}

  bool idle() const { return !child_; }
  std::uint64_t at() const { return child_ ? place_->number.load() : 0; }
  const Batch& batch() const { return batch_; }

  void begin(const Batch& batch) {
    batch_ = batch;
    place_->number = batch.from, place_->read = place_->refused = place_->faults = 0;
    child_ = std::make_unique<run::Child>([this] {
      return read_mutants({readers_[batch_.reader], plan_, folder_, batch_.from, batch_.to}, *place_);
    });
  }

  /// Whether the child has ended; then the batch is done, or the rest of it stands in `left`.
  bool ended(Hunted& hunted, std::deque<Batch>& left) {
    const auto end = child_->ended();
    if (!end) return false;
    child_.reset();
    Tally& tally = hunted.of[batch_.reader];
    tally.read += place_->read, tally.refused += place_->refused, tally.faults += place_->faults;
    if (end->good() || end->exit_code == run::child_stopped) return true;
    tally.faults += 1;
    keep_crash(*end);
    if (place_->number + 1 < batch_.to) left.push_front({batch_.reader, place_->number + 1, batch_.to});
    return true;
  }

 private:
  void keep_crash(const run::ChildEnd& end) const {
    const Reader& reader = readers_[batch_.reader];
    const std::string said = tests::content_of(folder_.string() + ".stderr");
    const Kept kept{plan_.out, reader, place_->number};
    kept.keep(mutant_at(reader, plan_.seed, place_->number), cause_of(end, said) + '\n' + said);
  }

  const std::vector<Reader>& readers_;
  const Hunt& plan_;
  const fs::path folder_;
  Batch batch_{};
  SharedPlace place_;
  std::unique_ptr<run::Child> child_;
};

/// Every mutant below it is done.
std::uint64_t done_up_to(const std::vector<std::unique_ptr<Worker>>& workers, const std::deque<Batch>& left,
                         std::uint64_t end) {
  for (const Batch& batch : left) end = std::min(end, batch.from);
  for (const auto& worker : workers)
    if (!worker->idle()) end = std::min(end, worker->batch().from);
  return end;
}

std::vector<std::string> faults_in(const fs::path& out) {
  std::vector<std::string> lines;
  if (!fs::exists(out)) return lines;
  for (const std::string& name : tests::names_in(out))
    if (fs::exists(out / name / "why"))
      lines.push_back((out / name).string() + ": " +
                      tests::lines_of(tests::content_of(out / name / "why")).at(0));
  return lines;
}

} // namespace

Hunted hunt(const std::vector<Reader>& readers, const Hunt& plan,
            const std::function<void(std::uint64_t)>& progress, const std::atomic<bool>& stop) {
  const tests::Folder scratch;
  Hunted hunted;
  hunted.of.resize(readers.size());
  std::deque<Batch> left = batches_of(readers.size(), plan);
  std::vector<std::unique_ptr<Worker>> workers;
  for (std::size_t k = 0; k < plan.children; ++k)
    workers.push_back(std::make_unique<Worker>(readers, plan, scratch / std::to_string(k)));
  const auto is_busy = [](const auto& worker) { return !worker->idle(); };
  while (!stop && (!left.empty() || std::any_of(workers.begin(), workers.end(), is_busy))) {
    std::uint64_t done = 0;
    for (auto& worker : workers) {
      if (!worker->idle() && !worker->ended(hunted, left)) done += worker->at() - worker->batch().from;
      if (worker->idle() && !left.empty()) worker->begin(left.front()), left.pop_front();
    }
    for (const Tally& tally : hunted.of) done += tally.read + tally.refused + tally.faults;
    progress(done);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  hunted.interrupted = stop;
  hunted.next = done_up_to(workers, left, plan.first + plan.mutants);
  hunted.faults = faults_in(plan.out);
  return hunted;
}

} // namespace hopmesh::campaigns
