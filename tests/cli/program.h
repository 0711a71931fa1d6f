#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

/// Runs the built pathtracer program the way people do.
namespace test {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if a signal ended it
  std::string out, err;
};

/// A running program. Its standard streams are collected until it ends.
class Process {
 public:
  struct Limits {
    std::optional<std::size_t> fileBytes;  ///< files cannot grow beyond: as on a full disk
  };

  Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments, const Limits& limits);

  /// Blocks until the program has written `text` to stderr. False if it ended before, or after a minute.
  bool waitForError(const std::string& text);
  void interrupt();  ///< SIGINT
  Outcome wait();

 private:
  pid_t m_pid = -1;
  int m_outPipe = -1, m_errPipe = -1;
  Outcome m_outcome;
};

/// A folder of its own for one test, gone afterwards.
class Workspace {
 public:
  Workspace();
  ~Workspace();

  std::filesystem::path path(const std::string& name) const { return m_folder / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }
  /// Sorted names of all files.
  std::vector<std::string> files() const;

  Process start(const std::vector<std::string>& arguments, const Process::Limits& limits = {}) const;
  Outcome run(const std::vector<std::string>& arguments, const Process::Limits& limits = {}) const;

 private:
  std::filesystem::path m_folder;
};

/// A grey wall before an 8 x 8 pixel camera under a constant sky, as scene.json.
extern const std::string kScene;

/// kScene with a piece of its text replaced.
std::string sceneWith(const std::string& piece, const std::string& replacement);

}  // namespace test
