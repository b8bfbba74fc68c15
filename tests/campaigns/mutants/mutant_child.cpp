#include "tests/campaigns/mutants/mutant_child.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/utf8.h"
#include "tests/support/files.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <new>
#include <sys/mman.h>
#include <sys/time.h>
#include <typeinfo>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace hopmesh::campaigns {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_sentence = 800; // with the path of a folder of our own

std::uint32_t number_of(const std::string& name) {
  std::uint32_t hash = 2166136261u; // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

/// 0: no limit.
void limit_time(unsigned processor_seconds, unsigned seconds) {
  const itimerval limit{{0, 0}, {static_cast<time_t>(processor_seconds), 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
  alarm(seconds);
}

/// Sends standard output and errors into a file.
void listen_into(const fs::path& file) {
  const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
  dup2(fd, STDOUT_FILENO);
  dup2(fd, STDERR_FILENO);
  close(fd);
}

/// The mutant in its folder, with all that belongs beside it.
void lay_out(const ChildWork& work, const std::string& mutant, bool anew) {
  const Reader& reader = work.reader;
  if (anew) {
    fs::remove_all(work.folder);
    fs::create_directories(work.folder);
    if (!reader.beside.empty()) fs::copy(reader.beside, work.folder, fs::copy_options::recursive);
  }
  fs::remove(work.folder / reader.file);
  tests::write_text(work.folder / reader.file, mutant);
}

/// "" where the mutant was read, or refused as it should be; `refused` says which.
std::string fault_of(const ChildWork& work, bool& refused) {
  refused = false;
  const auto judged = [&](const std::exception& why) {
    refused = true;
    return fault_of_sentence(why.what());
  };
  try {
    work.reader.read(work.folder);
    return "";
  } catch (const input::InputError& why) {
    return judged(why);
  } catch (const files::WriteError& why) {
    return judged(why);
  } catch (const std::bad_alloc&) {
    return "memory asked for without a look at the file's size";
  } catch (const std::exception& why) {
    return std::string("internal error, ") + typeid(why).name() + ": " + why.what();
  }
}

/// Of everything that the mutants of this child lost.
bool leaks() {
#ifdef __SANITIZE_ADDRESS__
  return __lsan_do_recoverable_leak_check() != 0;
#else
  return false;
#endif
}

} // namespace

std::string mutant_at(const Reader& reader, std::uint64_t seed, std::uint64_t number) {
  if (number < reader.seeds.size()) return reader.seeds[number];
  std::seed_seq mixed{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      number_of(reader.name), static_cast<std::uint32_t>(number),
                      static_cast<std::uint32_t>(number >> 32)};
  Random random(mixed);
  std::string bytes = mutant_of(reader.seeds, random);
  if (reader.repair && below(2, random)) reader.repair(bytes);
  return bytes;
}

std::string fault_of_sentence(const std::string& sentence) {
  if (sentence.empty()) return "refused without a word";
  if (sentence.size() > longest_sentence) return "a sentence too long: " + sentence.substr(0, 200);
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == 127; };
  if (std::any_of(sentence.begin(), sentence.end(), is_control)) return "no single line: " + sentence;
  if (!input::is_utf8(sentence)) return "no UTF-8: " + sentence;
  return "";
}

SharedPlace::SharedPlace() {
  void* memory = mmap(nullptr, sizeof(ChildPlace), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  place_ = new (memory) ChildPlace;
}

SharedPlace::~SharedPlace() {
  munmap(place_, sizeof(ChildPlace));
}

void Kept::keep(const std::string& mutant, const std::string& why) const {
  std::string name = reader.name + '-' + std::to_string(number);
  std::replace(name.begin(), name.end(), ' ', '-');
  fs::create_directories(out / name);
  tests::write_text(out / name / fs::path(reader.file).filename(), mutant);
  tests::write_text(out / name / "why", why + '\n');
}

int read_mutants(const ChildWork& work, ChildPlace& place) {
  listen_into(work.folder.string() + ".stderr");
  bool refused = false;
  for (std::uint64_t number = work.from; number < work.to; ++number) {
    place.number = number;
    limit_time(work.plan.processor_seconds, work.plan.seconds);
    const std::string mutant = mutant_at(work.reader, work.plan.seed, number);
    lay_out(work, mutant, number == work.from || work.reader.leaves_traces);
    const std::string fault = fault_of(work, refused);
    if (!fault.empty()) Kept{work.plan.out, work.reader, number}.keep(mutant, fault);
    ++(!fault.empty() ? place.faults : refused ? place.refused : place.read);
  }
  limit_time(0, 0);
  return leaks() ? 1 : 0;
}

} // namespace hopmesh::campaigns
