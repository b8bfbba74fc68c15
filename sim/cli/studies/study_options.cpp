#include "sim/cli/studies/study_options.h"

#include "sim/cli/options.h"
#include "sim/input/number.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

study::StudyShare share_of(const StudyOptions& o) {
  study::StudyShare share;
  if (o.share.empty()) return share;
  constexpr std::size_t most = 1'000'000'000;
  const std::string_view text = o.share;
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  share.alone = false;
  if (!input::parse_number(text.substr(0, slash), share.first) ||
      !input::parse_number(text.substr(slash + 1), share.of) || share.first >= share.of || share.of > most)
    throw input::input_error("", 0, "--share", o.share, "K/N with K from 0 to N - 1");
  return share;
}

} // namespace

void add_study(CLI::App& verb, StudyOptions& o) {
  o.verb = verb.get_name();
  verb.add_option("STUDY", o.study, "a study file, or the name of a shipped study")->required();
  verb.add_option("--out", o.out,
                  "results folder (out/NAME of the study); one that is there is gone on with");
  verb.add_option("-j", o.workers, "so many points at a time (as many as processors); changes no result")
      ->check(whole_number(1, 1024));
  verb.add_option("--executor", o.executor, "local, or slurm: a job array of -j tasks by sbatch")
      ->check(one_name_of({"local", "slurm"}))
      ->capture_default_str();
  verb.add_option("--share", o.share, "K/N: only the points K, K + N, ...: several machines, one folder");
}

study::StudyOrder order_of(const StudyOptions& o, const study::Study& study) {
  return {results_folder(o.out, study.name),
          workers_of(o.workers),
          o.executor == "slurm",
          share_of(o),
          o.verb,
          o.study};
}

} // namespace hopmesh::cli
