// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/save_atomically.h"

#include <QFileDevice>
#include <QSaveFile>
#include <QString>
#include <cerrno>
#include <system_error>

namespace batten {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why, std::string detail = {}) {
  return fail(ErrorCode::CannotWrite, "Cannot write " + path.string() + ": " + why, std::move(detail));
}

/// What stands in the way before anything is written; nullopt if nothing is known to.
std::optional<std::string> obstacle(const fs::path& path) {
  std::error_code code;
  if (path.empty() || path.filename().empty()) return "the file has no name. Add a file name.";
  if (fs::is_directory(path, code)) return "it is a folder. Add a file name.";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::exists(folder, code))
    return "the folder " + folder.string() + " does not exist. Create it or choose another.";
  if (!fs::is_directory(folder, code)) return folder.string() + " is not a folder. Choose another place.";
  if (fs::exists(path, code) && !fs::is_regular_file(path, code))
    return "it is not an ordinary file. Choose another name.";
  return std::nullopt;
}

std::string reason(const QSaveFile& file, int systemError) {
  switch (systemError) {
    case ENOSPC:
    case EDQUOT:
      return "the disk is full. Free some space or choose another place.";
    case EFBIG:
      return "the file would become larger than is allowed here. Choose another place.";
    case EACCES:
    case EPERM:
      return "there is no permission to write there. Choose another place.";
    case EROFS:
      return "the disk is write-protected. Choose another place.";
    case ENAMETOOLONG:
      return "the name is too long. Choose a shorter one.";
    default:
      break;
  }
  if (file.error() == QFileDevice::PermissionsError)
    return "there is no permission to write there. Choose another place.";
  return file.errorString().toStdString() + ". Choose another place.";
}

}  // namespace

Result<void> saveAtomically(const fs::path& path, std::string_view bytes) {
  if (const auto why = obstacle(path)) return cannotWrite(path, *why);
  QSaveFile file(QString::fromStdString(path.string()));
  file.setDirectWriteFallback(false);
  errno = 0;
  if (!file.open(QIODevice::WriteOnly)) return cannotWrite(path, reason(file, errno), file.errorString().toStdString());
  errno = 0;
  const auto size = static_cast<qint64>(bytes.size());
  const bool written = file.write(bytes.data(), size) == size && file.flush();
  const int systemError = errno;
  if (!written) {
    file.cancelWriting();
    return cannotWrite(path, reason(file, systemError), file.errorString().toStdString());
  }
  errno = 0;
  if (!file.commit()) return cannotWrite(path, reason(file, errno), file.errorString().toStdString());
  return {};
}

}  // namespace batten
