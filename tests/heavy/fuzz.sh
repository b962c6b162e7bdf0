#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The readers under libFuzzer with address and undefined-behaviour sanitizers. Same seed, same inputs. FUZZ_SECONDS (60) is
# the time of each reader. Random parameter sets are a test that packaging/check asan runs a thousand times.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${FUZZ_SECONDS:-60}
if ! command -v clang++ >/dev/null || ! ls /usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a >/dev/null 2>&1; then
  . packaging/packages.sh
  install_missing "${fuzz_packages[@]}"
fi
if ! command -v clang++ >/dev/null; then
  echo "clang with libFuzzer is not installed (Debian: clang libclang-rt-dev)"
  exit 77
fi
export CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
targets=(fuzz_recipe fuzz_curves fuzz_svg fuzz_scan fuzz_import)
cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link -DBATTEN_SANITIZE=address,undefined -DBATTEN_WERROR=OFF -DBATTEN_PCH=ON \
  -DBATTEN_GUI=OFF -DBATTEN_TESTS=OFF -DBATTEN_BENCH=OFF -DBATTEN_FUZZ=ON
cmake --build build/fuzz -j "${BATTEN_JOBS:-2}" --target "${targets[@]}" fuzz_seeds

work=build/fuzz/corpus
rm -rf "$work"
# Leaks are not looked for: Open CASCADE keeps what it has allocated.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
build/fuzz/bin/fuzz_seeds "$work"
for target in "${targets[@]}"; do
  limits=(-max_total_time="$seconds" -timeout=10)
  echo "== $target"
  if ! "build/fuzz/bin/$target" -seed=1 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/$target-" \
    "${limits[@]}" "$work/$target" >"build/fuzz/$target.log" 2>&1; then
    tail -40 "build/fuzz/$target.log"
    echo "$target failed; the input lies in build/fuzz/$target-*"
    exit 1
  fi
  grep -E 'number_of_executed_units|peak_rss_mb' "build/fuzz/$target.log"
done
