// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// BATTEN_HOT_LOOP: the loop is also compiled for wider vectors and the right one chosen when the program starts. Only
/// loops whose every element is computed by itself, or which compare and count whole numbers, carry it, so that both
/// give the same bits. Sanitizers run before the choice could be made, hence not there.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BATTEN_HOT_LOOP __attribute__((target_clones("avx2", "default")))
#else
#define BATTEN_HOT_LOOP
#endif

/// BATTEN_PART_OF_LOOP: a function that must become part of the hot loop that calls it, and of its wider vectors.
#if defined(__GNUC__)
#define BATTEN_PART_OF_LOOP inline __attribute__((always_inline))
#else
#define BATTEN_PART_OF_LOOP inline
#endif

/// BATTEN_UNROLL: before a short loop of known length, which is then written out, so that the loop around it can be
/// turned into one of vectors.
#if defined(__GNUC__) && !defined(__clang__)
#define BATTEN_UNROLL _Pragma("GCC unroll 16")
#else
#define BATTEN_UNROLL
#endif
