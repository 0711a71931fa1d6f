#include "stability/float_traps.h"

#include <fmt/format.h>

#include "core/error.h"

#ifdef GUIDING_TRAPPING_MATH
#include <dlfcn.h>
#include <signal.h>
#include <ucontext.h>
#include <xmmintrin.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#endif

namespace bench {

#ifdef GUIDING_TRAPPING_MATH

namespace {

constexpr unsigned kMasks = 0x1f80, kFlags = 0x003f;     // of MXCSR
constexpr unsigned kTrapped = 0x0080 | 0x0200 | 0x0400;  // invalid, division by zero, overflow
constexpr greg_t kSingleStep = 0x100;                    // of EFLAGS

struct Site {
  std::atomic<std::uintptr_t> address{0};
  std::atomic<int> code{0};
  std::atomic<std::uint64_t> count{0};
};

// A signal handler reaches nothing but what has static storage.
std::array<Site, 4096> sites;
std::atomic<std::uint64_t> withoutRoom{0};

void count(std::uintptr_t address, int code) noexcept {
  for (std::size_t probe = 0, i = address * 0x9e3779b97f4a7c15ull % sites.size(); probe < sites.size();
       ++probe, i = (i + 1) % sites.size()) {
    std::uintptr_t there = 0;
    if (sites[i].address.compare_exchange_strong(there, address)) sites[i].code = code;
    if (there != 0 && there != address) continue;
    ++sites[i].count;
    return;
  }
  ++withoutRoom;
}

/// Lets the instruction pass with the exceptions masked, and has the processor stop behind it.
void onException(int, siginfo_t* info, void* context) noexcept {
  mcontext_t& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
  count(std::uintptr_t(machine.gregs[REG_RIP]), info->si_code);
  machine.fpregs->mxcsr = (machine.fpregs->mxcsr | kMasks) & ~kFlags;
  machine.gregs[REG_EFL] |= kSingleStep;
}

void onStep(int, siginfo_t*, void* context) noexcept {
  mcontext_t& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
  machine.fpregs->mxcsr &= ~(kTrapped | kFlags);
  machine.gregs[REG_EFL] &= ~kSingleStep;
}

void installHandlers() {
  static const bool done = [] {
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = onException;
    sigaction(SIGFPE, &action, nullptr);
    action.sa_sigaction = onStep;
    sigaction(SIGTRAP, &action, nullptr);
    return true;
  }();
  (void)done;
}

std::string kindOf(int code) {
  if (code == FPE_FLTDIV) return "division by zero";
  if (code == FPE_FLTOVF) return "overflow";
  return "invalid";
}

/// What binutils say of an address: functions and lines, the inlined ones first.
std::string placeOf(const char* module, std::uintptr_t offset) {
  std::string text;
  const std::string command = fmt::format("addr2line -Cfipse '{}' {:#x} 2>/dev/null", module, offset);
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char part[512];
    while (std::fgets(part, sizeof part, pipe)) text += part;
    pclose(pipe);
  }
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.empty() || text.starts_with("??") ? fmt::format("{:#x}", offset) : text;
}

}  // namespace

FloatTraps::FloatTraps(bool enable) : m_before(_mm_getcsr()), m_enabled(enable) {
  if (!enable) return;
  installHandlers();
  _mm_setcsr(m_before & ~(kTrapped | kFlags));
}

FloatTraps::~FloatTraps() {
  if (m_enabled) _mm_setcsr(m_before);
}

std::vector<TrappedException> FloatTraps::take() {
  std::vector<TrappedException> all;
  for (Site& site : sites) {
    const std::uint64_t times = site.count.exchange(0);
    if (times == 0) continue;
    TrappedException& found = all.emplace_back();
    found.kind = kindOf(site.code);
    found.count = times;
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(site.address.load()), &info) && info.dli_fname) {
      found.module = std::filesystem::path(info.dli_fname).filename().string();
      found.place = placeOf(info.dli_fname, site.address - reinterpret_cast<std::uintptr_t>(info.dli_fbase));
    }
  }
  if (const std::uint64_t lost = withoutRoom.exchange(0))
    all.push_back({"more exceptions than are told apart", "", "", lost});
  return all;
}

#else

FloatTraps::FloatTraps(bool enable) {
  if (enable)
    throw pt::InputError(
        "--traps needs a build that keeps floating-point exceptions as they are: configure with "
        "-DGUIDING_TRAPPING_MATH=ON (x86-64 Linux)");
}

FloatTraps::~FloatTraps() = default;

std::vector<TrappedException> FloatTraps::take() {
  return {};
}

#endif

namespace {

/// Exceptions that are meant to happen, by what their place contains.
struct Understood {
  const char* kind;
  const char* where;  ///< part of module or place
  const char* reason;
};

constexpr Understood kUnderstood[] = {
    {"", "libembree", "Embree computes with masked lanes and infinite slabs and asks for masked exceptions"},
    {"invalid", "isUsable(guiding::RadianceSample", "records that are no number are told by comparing them"},
    {"invalid", "guiding::FieldSettings::validate", "settings that are no number are told by comparing them"},
    {"invalid", "pt::checkSettings", "settings that are no number are told by comparing them"},
};

}  // namespace

std::optional<std::string> reasonFor(const TrappedException& exception) {
  for (const Understood& known : kUnderstood) {
    const bool isKind = exception.kind.find(known.kind) != std::string::npos;
    if (isKind && (exception.module.find(known.where) != std::string::npos ||
                   exception.place.find(known.where) != std::string::npos))
      return known.reason;
  }
  return std::nullopt;
}

}  // namespace bench
