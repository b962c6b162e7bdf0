// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing but a place from which the tests' common headers are compiled once (tests/CMakeLists.txt).
