#include "sim/levels/ports/rtl_builder.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/standard_streams.h"
#include "sim/machine/rtl/rtl_sources.h"

#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <spawn.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace hopmesh::levels {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// FNV-1a, of everything that a model is made from.
class Fingerprint {
 public:
  void add(const std::string& text) {
    for (unsigned char c : text + '\0') hash_ = (hash_ ^ c) * 0x100000001B3u;
  }
  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

std::string fingerprint(const std::vector<machine::RtlParameter>& parameters) {
  Fingerprint print;
  for (const auto& [name, text] : machine::rtl_sources()) {
    print.add(name);
    print.add(text);
  }
  for (const machine::RtlParameter& p : parameters) print.add(fmt::format("{}={}", p.name, p.value));
  return print.text();
}

/// The folder of PATH that has it; empty where none has.
fs::path found_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string rest = path ? path : "";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    fs::path file = fs::path(rest.substr(0, end)) / name;
    if (access(file.c_str(), X_OK) == 0) return file;
    rest = end == std::string::npos ? "" : rest.substr(end + 1);
  }
  return {};
}

/// Its output goes into `log`. Throws where it fails.
void run_program(const Words& words, const fs::path& log) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int error = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 1;
  if (error == 0)
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  if (error != 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(
        fmt::format("rtl: {} could not make a model; it says why in {}", words[0], log.string()));
}

/// Held until the end of its life: whoever comes second waits.
class FileLock {
 public:
  explicit FileLock(const fs::path& file) : fd_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (fd_ < 0) throw files::WriteError(fmt::format("{}: cannot be written", file.string()));
    while (flock(fd_, LOCK_EX) < 0 && errno == EINTR) {
    }
  }
  ~FileLock() { close(fd_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  const int fd_;
};

fs::path asked_program(const std::string& name, const std::string& package) {
  fs::path found = found_program(name);
  if (found.empty())
    throw input::input_error("", 0, "level rtl", "no program " + name,
                             fmt::format("it, to make a model of this array (apt-get install {})", package));
  return found;
}

/// Where Verilator keeps what every model is compiled with.
fs::path verilator_include(const fs::path& verilator, const fs::path& folder) {
  const fs::path answer = folder / "root.txt";
  run_program({verilator, "--getenv", "VERILATOR_ROOT"}, answer);
  std::string root;
  std::FILE* const file = std::fopen(answer.c_str(), "r");
  for (int c; file != nullptr && (c = std::fgetc(file)) != EOF && c != '\n';) root += static_cast<char>(c);
  if (file != nullptr) std::fclose(file);
  return fs::path(root) / "include";
}

/// A source that includes all of a model: what is compiled at once is optimised at once.
std::string whole_model(const fs::path& made, const fs::path& include) {
  std::string text;
  for (const auto& entry : fs::directory_iterator(made))
    if (entry.path().extension() == ".cpp") text += fmt::format("#include \"{}\"\n", entry.path().string());
  return text + "#include \"hm_model.cpp\"\n" +
         fmt::format("#include \"{}/verilated.cpp\"\n", include.string()) +
         fmt::format("#include \"{}/verilated_threads.cpp\"\n", include.string());
}

/// What makes a model.
struct Makers {
  fs::path verilator = asked_program("verilator", "verilator"), compiler = asked_program("c++", "g++");
};

void build(const Makers& makers, const std::vector<machine::RtlParameter>& parameters, const fs::path& folder,
           const fs::path& library) {
  fs::remove_all(folder);
  fs::create_directories(folder / "made");
  for (const auto& [name, text] : machine::rtl_sources()) files::write_file(folder / name, text);
  Words make{makers.verilator,
             "--cc",
             "-O3",
             "--x-assign",
             "fast",
             "--x-initial",
             "fast",
             "--noassert",
             "-Wno-fatal",
             "--top-module",
             "hm_device",
             "--prefix",
             "Vhm",
             "-Mdir",
             folder / "made",
             "-I" + folder.string(),
             "-y",
             folder,
             folder / "hm_device.v"};
  for (const machine::RtlParameter& p : parameters) make.push_back(fmt::format("-G{}={}", p.name, p.value));
  run_program(make, folder / "verilator.log");
  const fs::path include = verilator_include(makers.verilator, folder);
  files::write_file(folder / "model.cpp", whole_model(folder / "made", include));
  const fs::path part = folder / "model.so";
  run_program({makers.compiler, "-std=c++17", "-O3", "-w", "-shared", "-fPIC", "-I" + folder.string(),
               "-I" + (folder / "made").string(), "-I" + include.string(),
               "-I" + (include / "vltstd").string(), folder / "model.cpp", "-o", part},
              folder / "compiler.log");
  fs::rename(part, library);
  fs::remove_all(folder);
}

} // namespace

fs::path rtl_cache() {
  const auto value = [](const char* name) {
    const char* const text = std::getenv(name);
    return std::string(text ? text : "");
  };
  if (const std::string own = value("HOPMESH_CACHE"); !own.empty()) return own;
  if (const std::string all = value("XDG_CACHE_HOME"); !all.empty()) return fs::path(all) / "hopmesh";
  const std::string home = value("HOME");
  return (home.empty() ? fs::temp_directory_path() : fs::path(home) / ".cache") / "hopmesh";
}

const RtlLibrary* rtl_library(const spec::ArraySpec& array, const machine::RtlRoom& room, RtlBuild when) {
  static std::map<std::string, std::unique_ptr<RtlLibrary>> loaded;
  const auto parameters = machine::rtl_parameters(array, room);
  const std::string key = fingerprint(parameters);
  if (const auto known = loaded.find(key); known != loaded.end()) return known->second.get();
  const fs::path cache = rtl_cache(), library = cache / ("rtl-" + key + ".so");
  if (!fs::exists(library)) {
    if (when == RtlBuild::never) return nullptr;
    const Makers makers;
    fs::create_directories(cache);
    const FileLock lock(cache / ("rtl-" + key + ".lock"));
    if (!fs::exists(library)) {
      input::say(fmt::format("hopmesh: rtl: making a model of \"{}\", once; it is kept in {}\n", array.name,
                             cache.string()));
      build(makers, parameters, cache / ("rtl-" + key), library);
    }
  }
  return (loaded[key] = std::make_unique<RtlLibrary>(library)).get();
}

} // namespace hopmesh::levels
