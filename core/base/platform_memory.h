// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace batten {

/// What a process takes of the machine, as only the operating system knows (see platform.h).

/// [bytes] Memory that can be taken without swapping: what the machine has free, and no more than the control group of
/// the process (a container, a Slurm job) leaves.
std::optional<std::uint64_t> availableMemoryBytes();

/// [bytes] The most memory that this process has held at any time.
std::optional<std::uint64_t> peakMemoryBytes();

/// [bytes] The memory that a process holds now.
std::optional<std::uint64_t> residentMemoryBytes(std::int64_t processId);

/// Gives memory that was freed back to the system, where the C library would keep it: some milliseconds, for the end of
/// work that took a lot of it.
void returnFreeMemory();

/// [s] Processor time that this process has used so far, all threads together; 0 if unknown.
double processorSeconds();

}  // namespace batten
