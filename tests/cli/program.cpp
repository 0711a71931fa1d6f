#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace test {

const std::string kScene = R"({
  "camera": {},
  "film": {"width": 8, "height": 8},
  "sampler": {"spp": 4},
  "materials": {"grey": {"type": "diffuse", "reflectance": 0.5}},
  "shapes": [
    {"type": "rectangle", "material": "grey",
     "transform": [{"scale": [5, 5, 1]}, {"rotate": {"axis": [1, 0, 0], "degrees": 180}}, {"translate": [0, 0, 4]}]}
  ],
  "lights": [{"type": "constant", "radiance": 2}]
}
)";

std::string sceneWith(const std::string& piece, const std::string& replacement) {
  std::string text = kScene;
  const std::size_t at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("the scene holds no '" + piece + "'");
  return text.replace(at, piece.size(), replacement);
}

Process::Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments, const Limits& limits) {
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  std::vector<char*> argv{const_cast<char*>("pathtracer")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  m_pid = fork();
  if (m_pid < 0) throw std::runtime_error("no process");
  if (m_pid == 0) {
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) _exit(126);
    if (limits.fileBytes) {
      const rlimit limit{*limits.fileBytes, *limits.fileBytes};
      setrlimit(RLIMIT_FSIZE, &limit);
      signal(SIGXFSZ, SIG_IGN);  // writing fails with an error instead
    }
    execv(PATHTRACER_PROGRAM, argv.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  m_outPipe = out[0];
  m_errPipe = err[0];
}

namespace {

/// Appends what the pipe has to give; false at its end.
bool readSome(int pipe, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(pipe, buffer, sizeof(buffer));
  if (count > 0) text.append(buffer, std::size_t(count));
  return count > 0;
}

}  // namespace

bool Process::waitForError(const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (m_outcome.err.find(text) == std::string::npos) {
    pollfd ready{m_errPipe, POLLIN, 0};
    if (std::chrono::steady_clock::now() > end) return false;
    if (poll(&ready, 1, 100) > 0 && !readSome(m_errPipe, m_outcome.err)) return false;
  }
  return true;
}

void Process::interrupt() {
  kill(m_pid, SIGINT);
}

Outcome Process::wait() {
  std::thread outReader([this] {
    while (readSome(m_outPipe, m_outcome.out)) {
    }
  });
  while (readSome(m_errPipe, m_outcome.err)) {
  }
  outReader.join();
  close(m_outPipe);
  close(m_errPipe);
  int status = 0;
  waitpid(m_pid, &status, 0);
  m_outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return m_outcome;
}

Workspace::Workspace() {
  std::string name = (std::filesystem::temp_directory_path() / "pathtracer-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  m_folder = name;
}

Workspace::~Workspace() {
  std::error_code ignored;
  std::filesystem::remove_all(m_folder, ignored);
}

void Workspace::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workspace::read(const std::string& name) const {
  std::stringstream text;
  text << std::ifstream(path(name), std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> Workspace::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(m_folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Process Workspace::start(const std::vector<std::string>& arguments, const Process::Limits& limits) const {
  return Process(m_folder, arguments, limits);
}

Outcome Workspace::run(const std::vector<std::string>& arguments, const Process::Limits& limits) const {
  return start(arguments, limits).wait();
}

}  // namespace test
