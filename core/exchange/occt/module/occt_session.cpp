// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/module/occt_session.h"

#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <utility>

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

tl::unexpected<Error> occtFailed(const std::string& what, std::string detail) {
  return fail(ErrorCode::CannotWrite, "Open CASCADE could not " + what + ". Export to DXF.", std::move(detail));
}

}  // namespace batten
