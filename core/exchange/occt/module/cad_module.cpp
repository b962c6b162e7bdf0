// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/module/cad_module.h"

#include <Standard_Failure.hxx>
#include <exception>
#include <new>
#include <type_traits>

#include "core/exchange/occt/module/occt_iges.h"
#include "core/exchange/occt/module/occt_session.h"
#include "core/exchange/occt/module/occt_step_reader.h"
#include "core/exchange/occt/module/occt_step_writer.h"

namespace batten {
namespace {

/// The outcome of `work`. What Open CASCADE throws at a file is told by `work` itself; this is for what nobody expects.
template <class T, class Work>
void putOutcome(Result<T>& outcome, const Work& work) {
  try {
    outcome = work();
  } catch (const std::bad_alloc&) {
    outcome = fail(ErrorCode::OutOfMemory, "There is not enough memory for the file. Export fewer curves at once.");
  } catch (const Standard_Failure& failure) {
    outcome = occtFailed("handle the drawing", failure.GetMessageString());
  } catch (const std::exception& exception) {
    outcome = occtFailed("handle the drawing", exception.what());
  } catch (...) {
    outcome = occtFailed("handle the drawing");
  }
}

}  // namespace
}  // namespace batten

using namespace batten;

// NOLINTBEGIN(readability-identifier-naming): found by these names
extern "C" {

__attribute__((visibility("default"))) void battenWriteIges(const PlainDrawing& drawing, const std::string& title,
                                                            double largest, Result<std::string>& outcome) {
  putOutcome(outcome, [&] { return igesOf(drawing, title, largest); });
}

__attribute__((visibility("default"))) void battenReadIges(const std::string& path, Result<PlainDrawing>& outcome) {
  putOutcome(outcome, [&] { return drawingOfIges(path); });
}

__attribute__((visibility("default"))) void battenWriteStep(const PlainDrawing& drawing, const DrawingFigures& figures,
                                                            const std::string& title, Result<std::string>& outcome) {
  putOutcome(outcome, [&] { return stepOf(drawing, figures, title); });
}

__attribute__((visibility("default"))) void battenReadStep(std::string_view bytes, Result<PlainDrawing>& outcome) {
  putOutcome(outcome, [&] { return drawingOfStep(bytes); });
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
static_assert(std::is_same_v<decltype(&battenWriteIges), WriteIges> &&
              std::is_same_v<decltype(&battenReadIges), ReadIges>);
static_assert(std::is_same_v<decltype(&battenWriteStep), WriteStep> &&
              std::is_same_v<decltype(&battenReadStep), ReadStep>);
