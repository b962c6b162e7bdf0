// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/platform_memory.h"

#if !defined(_WIN32)

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdlib>
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

/// A hierarchy of control groups: how /proc/self/cgroup names it, where it lies, and its files.
struct GroupHierarchy {
  const char *mark, *root, *limit, *used, *fileCache;
};
// Both versions of control groups.
constexpr GroupHierarchy kHierarchies[] = {
    {"0::", "/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"},
    {":memory:", "/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"}};

/// [bytes] What one group leaves; nullopt if it sets no limit. What it keeps of files counts as free: the kernel gives
/// that up when asked.
std::optional<std::uint64_t> leftInGroup(const GroupHierarchy& kind, const std::string& folder) {
  const auto limit = numberIn(folder + kind.limit), used = numberIn(folder + kind.used);
  if (!limit || !used) return std::nullopt;
  std::uint64_t files = 0;
  std::ifstream figures(folder + "memory.stat");
  std::string key;
  for (std::uint64_t value = 0; figures >> key >> value;) {
    if (key == kind.fileCache) files = value;
  }
  const std::uint64_t held = *used - std::min(*used, files);
  return *limit - std::min(*limit, held);
}

/// What the control group of this process leaves (version 1 or 2), the tightest of its parents among them.
std::optional<std::uint64_t> groupMemory() {
  std::optional<std::uint64_t> least;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    for (const GroupHierarchy& kind : kHierarchies) {
      const auto mark = line.find(kind.mark);
      if (mark == std::string::npos || (mark > 0 && kind.mark[0] != ':')) continue;
      std::string group = line.substr(mark + std::char_traits<char>::length(kind.mark));
      while (!group.empty() && group.front() == '/') {
        if (const auto left = leftInGroup(kind, kind.root + group + (group.back() == '/' ? "" : "/")))
          least = least ? std::min(*least, *left) : left;
        if (group.size() == 1) break;
        const auto slash = group.rfind('/');
        group = slash == 0 ? "/" : group.substr(0, slash);
      }
    }
  }
  return least;
}

}  // namespace

std::optional<std::uint64_t> availableMemoryBytes() {
  const auto machine = machineMemory(), group = groupMemory();
  if (machine && group) return std::min(*machine, *group);
  return machine ? machine : group;
}

std::optional<std::uint64_t> residentMemoryBytes(std::int64_t processId) {
  std::ifstream in("/proc/" + std::to_string(processId) + "/statm");
  std::uint64_t whole = 0, resident = 0;
  if (in >> whole >> resident) return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::nullopt;
}

void returnFreeMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

void keepFewHeaps() {
#if defined(__GLIBC__)
  constexpr int kOwnBlockBytes = 2 << 20, kHeaps = 2;  // blocks that go back to the system when freed
  // Stating it also stops the library from raising it with every large block that is freed.
  mallopt(M_MMAP_THRESHOLD, kOwnBlockBytes);
  mallopt(M_ARENA_MAX, kHeaps);
#endif
}

void* allocateBuffer(std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  // Of a smaller buffer the part of a huge page that is left unused would be too much.
  constexpr std::size_t kHugePage = std::size_t{2} << 20, kLeast = 2 * kHugePage;
  if (bytes >= kLeast) {
    const std::size_t whole = (bytes - 1) / kHugePage * kHugePage + kHugePage;
    void* const buffer = whole < bytes ? nullptr : std::aligned_alloc(kHugePage, whole);
    if (buffer != nullptr)
      madvise(buffer, whole, MADV_HUGEPAGE);  // on request only: where it fails, small pages are as good
    return buffer;
  }
#endif
  return std::malloc(std::max<std::size_t>(1, bytes));
}

void freeBuffer(void* buffer) { std::free(buffer); }

std::optional<std::uint64_t> peakMemoryBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
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

}  // namespace batten

#endif
