// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

class QTemporaryFile;

namespace batten {

/// A file for libraries that read or write by name only. It goes with this object; where the system knows files without
/// a place in a folder, also with the program, however that ends.
class ScratchFile {
 public:
  /// @return CannotWrite, with the reason.
  static Result<ScratchFile> create(std::string_view bytes = {});
  ScratchFile(ScratchFile&&) noexcept;
  ScratchFile& operator=(ScratchFile&&) noexcept;
  ~ScratchFile();

  const std::string& path() const { return path_; }
  /// What the file holds now.
  std::string read() const;

 private:
  explicit ScratchFile(std::unique_ptr<QTemporaryFile> file);
  std::unique_ptr<QTemporaryFile> file_;
  std::string path_;
};

}  // namespace batten
