// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace batten {

/// What only the operating system knows or does. Beside the files that open, lock and save files safely, no file of
/// core, ui and app calls it by anything but standard C++ and Qt, so that another system is a matter of these. Where a
/// system has no answer, there is none.

/// [bytes] Memory that can be taken without swapping: what the machine has free, and no more than the control group of
/// the process (a container, a Slurm job) leaves.
std::optional<std::uint64_t> availableMemoryBytes();

/// [bytes] The most memory that this process has held at any time; 0 if unknown.
std::uint64_t peakMemoryBytes();

/// [bytes] The memory that a process holds now; 0 if unknown.
std::uint64_t residentMemoryBytes(std::int64_t processId);

/// [s] Processor time that this process has used so far, all threads together; 0 if unknown.
double processorSeconds();

/// Whether a person looks at what goes to stderr.
bool stderrIsTerminal();

/// To be called in a child process before its program starts: Ctrl+C in the terminal is the parent's to hear, and the
/// child does not outlive a parent that is killed. Calls nothing that may not be called after fork().
void becomeDependentChild();

/// While it lives, nothing reaches stderr: image libraries print complaints of their own there, and an error of this
/// program is to be one line. Does nothing in sanitizer builds, whose reports must be seen.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  std::optional<int> kept_;  ///< The real stderr.
};

}  // namespace batten
