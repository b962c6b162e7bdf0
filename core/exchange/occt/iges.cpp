// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/iges.h"

#include <algorithm>
#include <cmath>

#include "core/base/shown_text.h"
#include "core/exchange/model/scratch_file.h"
#include "core/exchange/occt/cad_module_call.h"

namespace batten {
namespace {

double largestCoordinate(const CadDrawing& drawing) {
  double most = 1.0;
  for (const CadEntity& entity : drawing.entities)
    for (int i = 0; i <= 16; ++i) most = std::max(most, pointAt(entity.shape, i / 16.0).cwiseAbs().maxCoeff());
  return std::ceil(most);
}

}  // namespace

Result<std::string> writeIges(const CadDrawing& drawing, const std::string& title) {
  // A line break within a string would end the line of the file.
  return callCadModule<std::string, WriteIges>(kWriteIges, plainDrawing(drawing), shownText(title),
                                               largestCoordinate(drawing));
}

Result<CadDrawing> readIges(std::string_view bytes) {
  // The library reads files only.
  const auto file = ScratchFile::create(bytes);
  if (!file) return fail(file.error());
  return callCadModule<PlainDrawing, ReadIges>(kReadIges, file->path()).map(drawingOf);
}

}  // namespace batten
