// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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

/// From here on buffers of the size of a page go back to the system as soon as they are freed, and all threads share
/// two heaps, where the C library would keep freed buffers of up to 32 MB in as many heaps as there are threads. For a
/// program that stays open; to be called before the first thread starts.
void keepFewHeaps();

/// Memory for a buffer that may be as large as a page, not initialised, for freeBuffer. The system gives fresh memory
/// piece by piece as it is first written to, which takes longer than the writing: where it can, it is asked for large
/// pieces. @return null: there is not so much.
void* allocateBuffer(std::size_t bytes);
/// Gives back what allocateBuffer gave; null is nothing to give back.
void freeBuffer(void* buffer);

/// [s] Processor time that this process has used so far, all threads together; 0 if unknown.
double processorSeconds();

}  // namespace batten
