// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Functions marked BATTEN_AVX2 are written with the vector instructions of that name, whatever the rest of the program
/// is compiled for. They are called only where hasAvx2() says so, through a table of functions that holds a plain
/// version too. Where BATTEN_HAS_AVX2 is not defined there are none: other processors and compilers, and systems whose
/// stacks may not be aligned enough. No lambda in them: it would not be marked.
#if defined(__GNUC__) && defined(__x86_64__) && defined(__ELF__)
#include <immintrin.h>
#define BATTEN_HAS_AVX2
#define BATTEN_AVX2 __attribute__((target("avx2")))

namespace batten {
/// Whether this processor has AVX2.
inline bool hasAvx2() {
  static const bool kHas = __builtin_cpu_supports("avx2") != 0;
  return kHas;
}
}  // namespace batten
#endif
