#include "run/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "core/error.h"

namespace bench {

namespace {

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<char*> argv{const_cast<char*>("guiding-bench")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error)
    throw pt::WorkError(fmt::format("cannot start a process that logs to {}: {}", log.string(), std::strerror(error)));
  return pid;
}

std::string lastLineOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  return last;
}

std::string describe(int status, const std::filesystem::path& log) {
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  const std::string line = lastLineOf(log);
  return line.empty() ? fmt::format("ended with status {}", WEXITSTATUS(status)) : line;
}

}  // namespace

ChildOutcome runChild(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                      const std::atomic<bool>& stop, double timeoutSeconds) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = start(arguments, log);
  bool interrupted = false, timedOut = false;
  int status = 0;
  while (waitpid(pid, &status, WNOHANG) == 0) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    interrupted = interrupted || stop.load();
    timedOut = timedOut || elapsed.count() > timeoutSeconds;
    if (interrupted || timedOut) kill(pid, SIGKILL);  // results are put in place whole: nothing is left half-written
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ChildOutcome outcome;
  outcome.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (outcome.succeeded) return outcome;
  outcome.interrupted = stop.load();
  outcome.failure = timedOut ? fmt::format("stopped after {:.0f} s", timeoutSeconds) : describe(status, log);
  return outcome;
}

}  // namespace bench
