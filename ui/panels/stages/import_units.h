// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ui/session/editor_session.h"

class QGridLayout;
class QLabel;

namespace batten {

/// The units of the files that lines were imported from: what each was read in, and a choice of another.
class ImportUnits : public QWidget {
  Q_OBJECT
 public:
  explicit ImportUnits(EditorSession& session, QWidget* parent = nullptr);

 signals:
  void failed(const batten::Error& error);

 private:
  void refresh();
  void build();
  void choose(std::size_t import, const QString& unit);

  EditorSession& session_;
  QWidget* rows_ = nullptr;
  QLabel* note_;
  std::vector<std::pair<std::string, std::string>> shown_;  ///< Source and unit of every import.
};

}  // namespace batten
