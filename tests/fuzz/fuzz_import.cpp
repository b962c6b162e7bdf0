// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a file of curves to be imported; the first byte says of which kind. They are refused with a reason, or
// their curves hold finite numbers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/iges_reader.h"
#include "core/exchange/cad/rhino_reader.h"
#include "core/exchange/cad/step_reader.h"
#include "core/exchange/point_file.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_shapes.h"

namespace {

using namespace batten;

void hold(bool isRight) {
  if (!isRight) std::abort();
}

template <class T>
void refused(const Result<T>& result) {
  hold(!result.error().message.empty());
}

void judge(const Result<CadDrawing>& drawing) {
  if (!drawing) return refused(drawing);
  for (const CadEntity& entity : drawing->entities) {
    const auto curve = curveOf(entity.shape);
    if (!curve) continue;
    for (const Vec2& p : curve->controlPoints()) hold(p.allFinite());
  }
}

template <class Lines>
void judgeLines(const Result<Lines>& lines) {
  if (!lines) return refused(lines);
  for (const ImportedLine& line : lines->lines)
    for (const Vec2& p : line.points) hold(p.allFinite());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'd':
      judge(readDxf(bytes));
      break;
    case 'i':
      judge(parseIges(bytes));
      break;
    case 's':
      judge(parseStep(bytes));
      break;
    case '3':
      judge(readRhino(bytes));
      break;
    case 'g':
      judgeLines(readSvgShapes(bytes));
      break;
    case 'v':
      if (const auto document = readSvg(bytes); !document) refused(document);
      break;
    case 'c':
      judgeLines(readPointTable(bytes));
      break;
    case 'j':
      judgeLines(readPointJson(bytes));
      break;
    default:
      break;
  }
  return 0;
}
