#include "results/machine.h"

#include <fmt/chrono.h>
#include <guiding/version.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace bench {

namespace {

/// The value of the first line "key : value" of a system file.
std::string systemValue(const char* file, const std::string& key) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t:=\"", key.size());
    if (begin != std::string::npos) return line.substr(begin, line.find_last_not_of(" \"") + 1 - begin);
  }
  return "unknown";
}

}  // namespace

nlohmann::ordered_json describeMachine() {
  utsname system{};
  uname(&system);
  const double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
  return {{"processor", systemValue("/proc/cpuinfo", "model name")},
          {"threads", std::thread::hardware_concurrency()},
          {"memoryGB", std::round(bytes / 1e8) / 10},
          {"system", systemValue("/etc/os-release", "PRETTY_NAME")},
          {"kernel", system.release},
          {"compiler", GUIDING_COMPILER},
          {"build", GUIDING_BUILD_TYPE},
          {"version", guiding::kVersionText},
          {"date", fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace bench
