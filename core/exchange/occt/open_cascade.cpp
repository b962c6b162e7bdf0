// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/open_cascade.h"

#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>

namespace batten {
namespace {

std::mutex& sharedMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

OcctSession::OcctSession() : lock_(sharedMutex()) {
  static const bool isReady = [] {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    IGESControl_Controller::Init();
    STEPControl_Controller::Init();
    Message::DefaultMessenger()->ChangePrinters().Clear();
    return true;
  }();
  static_cast<void>(isReady);
}

KnotRuns knotRuns(const NurbsCurve& curve) {
  KnotRuns runs;
  for (const double knot : curve.knots()) {
    if (runs.knots.empty() || runs.knots.back() != knot) {
      runs.knots.push_back(knot);
      runs.multiplicities.push_back(0);
    }
    ++runs.multiplicities.back();
  }
  return runs;
}

tl::unexpected<Error> occtFailed(const std::string& what, std::string detail) {
  return fail(ErrorCode::CannotWrite, "Open CASCADE could not " + what + ". Export to DXF.", std::move(detail));
}

bool hasOpenCascade() { return true; }

}  // namespace batten
