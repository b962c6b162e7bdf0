// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/scratch_file.h"

#include <QFile>
#include <QTemporaryFile>

#include "core/base/platform.h"

namespace batten {

ScratchFile::ScratchFile(std::unique_ptr<QTemporaryFile> file) : file_(std::move(file)) {
  // Qt gives the file a name in a folder only when asked for it.
  if (auto name = nameOfOpenFile(file_->handle()))
    path_ = std::move(*name);
  else
    path_ = QFile::encodeName(file_->fileName()).toStdString();
}

ScratchFile::ScratchFile(ScratchFile&&) noexcept = default;
ScratchFile& ScratchFile::operator=(ScratchFile&&) noexcept = default;
ScratchFile::~ScratchFile() = default;

Result<ScratchFile> ScratchFile::create(std::string_view bytes) {
  auto file = std::make_unique<QTemporaryFile>();
  const auto size = static_cast<qint64>(bytes.size());
  if (file->open() && file->write(bytes.data(), size) == size && file->flush()) return ScratchFile(std::move(file));
  return fail(ErrorCode::CannotWrite,
              "A temporary file cannot be written (" + file->errorString().toStdString() +
                  "). Free some space in the folder for temporary files, or choose another folder by TMPDIR.");
}

std::string ScratchFile::read() const {
  file_->seek(0);
  return file_->readAll().toStdString();
}

}  // namespace batten
