// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/files/profile_library.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QStandardPaths>

#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/exchange/save_atomically.h"
#include "core/pipeline/recipe/profile_text.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

constexpr std::uint64_t kMostProfileBytes = 1 << 20;  // limit of input
constexpr const char* kEnding = ".profile";           // of the files

QString folderOfProfiles() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/profiles");
}

QString fileOf(const QString& name) { return folderOfProfiles() + QLatin1Char('/') + name + QLatin1String(kEnding); }

bool isName(const QString& name) {
  static const QRegularExpression allowed(QStringLiteral("^[\\p{L}\\p{N}_][\\p{L}\\p{N} ._-]{0,59}$"));
  return allowed.match(name).hasMatch();
}

}  // namespace

QStringList ProfileLibrary::names() const {
  QStringList names;
  for (const QString& file :
       QDir(folderOfProfiles())
           .entryList({QStringLiteral("*") + QLatin1String(kEnding)}, QDir::Files, QDir::Name | QDir::IgnoreCase))
    names << file.chopped(static_cast<qsizetype>(qstrlen(kEnding)));
  return names;
}

Result<std::vector<ProfilePoint>> ProfileLibrary::load(const QString& name) const {
  const auto broken = [&](const std::string& why) {
    return fail(ErrorCode::BadParameter,
                "The profile " + quotedText(name.toStdString()) + " cannot be read: " + why + ".");
  };
  if (!isName(name)) return broken("it has no such name");
  const auto text = readWhole(nativePath(fileOf(name)), kMostProfileBytes);
  if (!text) return broken("its file " + describe(text.error()));
  auto points = profileFromText(*text);
  if (!points) return broken(points.error().message);
  if (points->empty()) return broken("it has no points");
  return std::move(*points);
}

Result<void> ProfileLibrary::save(const QString& name, const std::vector<ProfilePoint>& shape) const {
  if (!isName(name)) {
    return fail(ErrorCode::BadParameter,
                "A profile name has 1 to 60 letters, digits, spaces, dots, hyphens and underscores, and "
                "starts with a letter or digit.");
  }
  if (!QDir().mkpath(folderOfProfiles()))
    return fail(ErrorCode::CannotWrite, "The folder for saved profiles cannot be created.");
  return saveAtomically(nativePath(fileOf(name)), profileToText(shape), Leftovers::OfThisFile);
}

Result<void> ProfileLibrary::remove(const QString& name) const {
  const QString file = fileOf(name);
  if (isName(name) && QFile::exists(file) && !QFile::remove(file))
    return fail(ErrorCode::CannotWrite, "The profile " + quotedText(name.toStdString()) +
                                            " cannot be removed. Check the permissions of its file.");
  return {};
}

}  // namespace batten
