// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/page_call.h"

#include <QCoreApplication>
#include <QFile>
#include <algorithm>
#include <iostream>
#include <sstream>

#include "app/cli/exit_codes.h"
#include "core/base/json_text.h"
#include "core/base/number_text.h"
#include "core/base/platform.h"
#include "core/base/platform_memory.h"
#include "core/document/report_pages/report_file.h"

namespace batten::cli {
namespace {

/// The last line of what a call wrote to stderr, without the program's name before it.
std::string lastLine(const QByteArray& text) {
  const QByteArray whole = text.trimmed();
  QByteArray line = whole.mid(whole.lastIndexOf('\n') + 1);
  if (line.startsWith("batten-cli: ")) line = line.mid(12);
  return line.toStdString();
}

/// What became of a page whose call has ended by itself, from what it printed.
PageResult resultOfCall(int exitCode, const QByteArray& out, const QByteArray& errors) {
  PageResult result;
  result.exitCode = exitCode;
  result.error = lastLine(errors);
  if (exitCode == kNoCurve) result.status = PageStatus::Empty;
  if (exitCode != kDone) return result;
  auto said = parseJson(out.toStdString());
  if (!said || !said->is_object()) {
    result.error = "What the page printed could not be read.";
    return result;
  }
  for (const char* key : {"scan", "files"}) said->erase(key);  // the line has them from the manifest
  result.status = PageStatus::Done;
  result.error.clear();
  result.figures = std::move(*said);
  return result;
}

double secondsOf(const QElapsedTimer& clock) {
  constexpr double kMsInASecond = 1000.0;  // divided, so that the quotient prints with three digits
  return static_cast<double>(clock.elapsed()) / kMsInASecond;
}

/// What is printed to a stream while this lives.
class Caught {
 public:
  explicit Caught(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(text_.rdbuf())) {}
  ~Caught() { stream_.rdbuf(before_); }
  Caught(const Caught&) = delete;
  Caught& operator=(const Caught&) = delete;
  QByteArray text() const { return QByteArray::fromStdString(text_.str()); }

 private:
  std::ostream& stream_;
  std::ostringstream text_;
  std::streambuf* before_;
};

}  // namespace

bool canBeTracedHere(const BatchPage& page) {
  // Its text needs an application with fonts, and a process has one application only: that of the event loop.
  return std::none_of(page.outputs.begin(), page.outputs.end(),
                      [](const std::string& name) { return reportFormatOf(name) == ReportFormat::Pdf; });
}

PageResult tracedHere(const BatchPage& page, const CallHere& call, const CancelToken& cancel) {
  constexpr int kAllThreads = 0;
  QElapsedTimer clock;
  clock.start();
  const Caught out(std::cout), errors(std::cerr);
  const int exitCode = call(traceWords(page, kAllThreads), cancel);
  PageResult result = resultOfCall(exitCode, out.text(), errors.text());
  result.seconds = secondsOf(clock);
  return result;
}

PageCall::PageCall(const BatchPage& page, int threads, std::optional<double> timeoutSeconds, Ended ended)
    : timeoutSeconds_(timeoutSeconds.value_or(0.0)), ended_(std::move(ended)) {
  words_ = traceWords(page, threads);
  QStringList words;
  for (const std::string& word : words_) words.push_back(QString::fromStdString(word));
  words_.insert(words_.begin(), QFile::encodeName(QCoreApplication::applicationFilePath()).toStdString());
  for (const std::string& word : words_) pointers_.push_back(word.c_str());
  pointers_.push_back(nullptr);
#if defined(Q_OS_UNIX)  // of Qt's own two calls each system has one
  // Qt's words are text, names of files are bytes: the child calls the program itself.
  process_.setChildProcessModifier([pointers = pointers_.data()] {
    becomeDependentChild();
    becomeProgram(pointers);
  });
#elif defined(Q_OS_WIN)
  constexpr unsigned long kOwnProcessGroup = 0x200;  // CREATE_NEW_PROCESS_GROUP: Ctrl+C does not reach the child
  process_.setCreateProcessArgumentsModifier(
      [](QProcess::CreateProcessArguments* arguments) { arguments->flags |= kOwnProcessGroup; });
#endif
  process_.setStandardInputFile(QProcess::nullDevice());
  QObject::connect(&process_, &QProcess::finished, &process_, [this] { finish(); });
  QObject::connect(&process_, &QProcess::errorOccurred, &process_, [this](QProcess::ProcessError error) {
    // Every other error is followed by finished().
    if (error == QProcess::FailedToStart) QTimer::singleShot(0, &process_, [this] { finish(); });
  });
  timer_.setSingleShot(true);
  QObject::connect(&timer_, &QTimer::timeout, &process_, [this] {
    isTooSlow_ = true;
    process_.kill();
  });
  clock_.start();
  process_.start(QCoreApplication::applicationFilePath(), words);
  if (timeoutSeconds) timer_.start(static_cast<int>(1000.0 * *timeoutSeconds));
}

PageCall::~PageCall() {
  process_.disconnect();
  if (process_.state() == QProcess::NotRunning) return;
  process_.kill();
  process_.waitForFinished();
}

std::optional<std::uint64_t> PageCall::memoryBytes() const { return residentMemoryBytes(process_.processId()); }

void PageCall::finish() {
  if (hasEnded_) return;
  hasEnded_ = true;
  timer_.stop();
  ended_(result());
}

PageResult PageCall::result() {
  PageResult result;
  if (process_.error() == QProcess::FailedToStart) {
    result.isUnstarted = true;
    result.error = "Cannot start a subprocess (" + process_.errorString().toStdString() +
                   "), which --page-timeout and a .report.pdf need. Allow more processes, free some memory, or leave "
                   "these out.";
  } else if (isTooSlow_) {
    result.error = "It took longer than " + numberToText(timeoutSeconds_) + " s. Raise --page-timeout.";
  } else if (process_.exitStatus() != QProcess::NormalExit) {
    result.error = "The subprocess was killed or crashed (signal " + std::to_string(process_.exitCode()) + ").";
  } else {
    result = resultOfCall(process_.exitCode(), process_.readAllStandardOutput(), process_.readAllStandardError());
  }
  result.seconds = secondsOf(clock_);
  return result;
}

}  // namespace batten::cli
