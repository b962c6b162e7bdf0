// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace batten {

/// A function of a part of the program that lies in a file of its own, because what it needs takes long to load: the
/// file is loaded when it is first asked for and stays loaded. `module` is its name without what systems put around it
/// (libNAME.so); it lies in ../lib/batten/modules beside the program's folder, on Windows beside the program. Null if
/// there is no such file or function. May be called from any thread.
void* functionOfModule(const std::string& module, const char* function);

}  // namespace batten
