#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# MinGW-w64 reads the Windows side of core/base/platform.h, with all warnings. Nothing is linked, and nothing is run.
set -euo pipefail
cd "$(dirname "$0")/../.."
compiler=$(command -v x86_64-w64-mingw32-g++-posix || command -v x86_64-w64-mingw32-g++ || true)
if [ -z "$compiler" ]; then
  echo "MinGW-w64 (g++-mingw-w64-x86-64-posix) is not installed."
  exit 77
fi
# Of the machine's own headers only expected is wanted, which is one file without a system in it.
headers=$(mktemp -d)
trap 'rm -rf "$headers"' EXIT
ln -s /usr/include/tl "$headers/tl"
"$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wshadow -Wold-style-cast -Werror -I. -isystem "$headers" core/base/platform_windows.cpp
echo "The Windows side of platform.h compiles."
