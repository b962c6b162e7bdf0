// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/platform.h"

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#define BATTEN_POSIX 1
#endif
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

namespace batten {
namespace {

/// The number in a file that holds one; nullopt for "max" and for files that are not there.
std::optional<std::uint64_t> numberIn(const std::string& path) {
  std::ifstream in(path);
  std::uint64_t number = 0;
  if (in >> number) return number;
  return std::nullopt;
}

/// What the machine has free, by the kernel's own estimate.
std::optional<std::uint64_t> machineMemory() {
  std::ifstream in("/proc/meminfo");
  std::string key, rest;
  std::uint64_t kilobytes = 0;
  while (in >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, rest);
  }
  return std::nullopt;
}

/// What the control group leaves (version 2 of the hierarchy), the tightest of its parents among them. What the group
/// keeps of files counts as free: the kernel gives it up when asked.
std::optional<std::uint64_t> groupMemory() {
  std::ifstream in("/proc/self/cgroup");
  std::string line, group;
  while (std::getline(in, line)) {
    if (line.starts_with("0::")) group = line.substr(3);
  }
  if (group.empty() || group.front() != '/') return std::nullopt;
  std::optional<std::uint64_t> least;
  while (true) {
    const std::string folder = "/sys/fs/cgroup" + group + (group.back() == '/' ? "" : "/");
    const auto limit = numberIn(folder + "memory.max"), used = numberIn(folder + "memory.current");
    if (limit && used) {
      std::uint64_t files = 0;
      std::ifstream figures(folder + "memory.stat");
      std::string key;
      for (std::uint64_t value = 0; figures >> key >> value;) {
        if (key == "inactive_file") files = value;
      }
      const std::uint64_t held = *used - std::min(*used, files);
      const std::uint64_t left = *limit - std::min(*limit, held);
      least = least ? std::min(*least, left) : left;
    }
    const auto slash = group.rfind('/');
    if (group.size() <= 1 || slash == std::string::npos) return least;
    group = slash == 0 ? "/" : group.substr(0, slash);
  }
}

}  // namespace

std::optional<std::uint64_t> availableMemoryBytes() {
  const auto machine = machineMemory(), group = groupMemory();
  if (machine && group) return std::min(*machine, *group);
  return machine ? machine : group;
}

std::uint64_t residentMemoryBytes(std::int64_t processId) {
#if defined(BATTEN_POSIX)
  std::ifstream in("/proc/" + std::to_string(processId) + "/statm");
  std::uint64_t whole = 0, resident = 0;
  if (in >> whole >> resident) return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#else
  static_cast<void>(processId);
#endif
  return 0;
}

#if defined(BATTEN_POSIX)

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#if defined(__APPLE__)
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
#endif
}

double processorSeconds() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0.0;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool stderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

void becomeDependentChild() {
  std::signal(SIGINT, SIG_IGN);  // is kept over exec
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

QuietStderr::QuietStderr() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  const int kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept >= 0) {
    kept_ = kept;
    dup2(nowhere, STDERR_FILENO);
  }
  close(nowhere);
#endif
}

QuietStderr::~QuietStderr() {
  if (!kept_) return;
  std::fflush(stderr);
  dup2(*kept_, STDERR_FILENO);
  close(*kept_);
}

#else

std::uint64_t peakMemoryBytes() { return 0; }
double processorSeconds() { return 0.0; }
bool stderrIsTerminal() { return false; }
void becomeDependentChild() {}
QuietStderr::QuietStderr() = default;
QuietStderr::~QuietStderr() = default;

#endif

}  // namespace batten
