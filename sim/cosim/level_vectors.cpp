#include "sim/cosim/level_vectors.h"

#include "sim/cosim/random_job.h"
#include "sim/levels/interrupt.h"
#include "sim/run/progress.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

/// CaseArrays of a level for cases that come in the same order twice: SystemC's are all made before one is
/// used.
class CaseArrays {
 public:
  explicit CaseArrays(const levels::Level& level) : level_(level) {}
  bool ahead() const { return level_.made_ahead; }
  void expect(const ArrayJob& job) { made_.push_back(level_.make_port(job.array, job.topology, {})); }
  const levels::ArrayPort& next(const ArrayJob& job) {
    if (ahead()) return *made_.at(used_++);
    made_.clear();
    expect(job);
    return *made_.back();
  }

 private:
  const levels::Level& level_;
  std::vector<std::unique_ptr<levels::ArrayPort>> made_;
  std::size_t used_ = 0;
};

} // namespace

std::optional<VectorCase> case_of_step(const levels::Prepared& p, std::uint64_t step, std::string& ending) {
  levels::PortRequest request;
  request.remarks = true;
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p, false, request);
  const run::RunResult result = run::simulate_shown(*level.mover, step + 1);
  ending = result.sentence;
  if (result.rows.size() <= step) return std::nullopt;
  return VectorCase{
      fmt::format("{} step {}", p.inputs.scene.name, step),
      loaded_job(level.port->bus(), p.inputs.array, p.mesh->topology(), level.array->start_raw())};
}

VectorCase random_case(std::uint64_t seed) {
  return {fmt::format("random {}", seed), random_job(seed)};
}

bool write_vectors(const std::filesystem::path& path, std::uint64_t cases, const CaseMaker& make,
                   const levels::Level* level) {
  std::optional<CaseArrays> arrays;
  if (level) arrays.emplace(*level);
  for (std::uint64_t k = 0; k < cases && arrays && arrays->ahead(); ++k) arrays->expect(make(k).job);
  files::check_writable(std::filesystem::absolute(path).parent_path(), 1 << 20);
  VectorWriter file(path);
  for (std::uint64_t k = 0; k < cases; ++k) {
    if (levels::stop_requested) return false;
    const VectorCase a_case = make(k);
    file.add(a_case, arrays ? &arrays->next(a_case.job).bus() : nullptr);
  }
  file.commit();
  return true;
}

VectorsJudged judge_vectors(const std::string& file, const levels::Level& level) {
  CaseArrays arrays(level);
  VectorCase a_case;
  if (arrays.ahead())
    for (VectorReader reader(file); reader.next(a_case);) arrays.expect(a_case.job);
  VectorsJudged judged;
  for (VectorReader reader(file); judged.wrong.empty() && reader.next(a_case);) {
    judged.interrupted = levels::stop_requested;
    if (judged.interrupted) return judged;
    judged.wrong = check_answers(file, reader, a_case, arrays.next(a_case.job).bus(), judged.lines);
    judged.cases += 1;
  }
  if (judged.cases == 0) throw input::input_error(file, 0, "", "no case", "case NAME");
  return judged;
}

} // namespace hopmesh::cosim
