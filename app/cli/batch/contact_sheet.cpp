// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/contact_sheet.h"

#include <QBuffer>
#include <QImage>
#include <QString>
#include <QUrl>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "app/cli/batch/drawn_lines.h"
#include "app/cli/batch/page_record.h"
#include "core/base/parallel.h"
#include "core/base/platform.h"
#include "core/exchange/save_atomically.h"
#include "core/image/scan_reader.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide = 320;      // [px] of the longer side
constexpr int kPictureQuality = 75;    // of JPEG, 0..100
constexpr double kLineUnits = 1000.0;  // width of the drawing that holds the lines

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Batten: contact sheet</title><style>
body{font:14px/1.4 Inter,system-ui,sans-serif;margin:16px;background:#f4f5f7;color:#1c1f23}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(240px,1fr));gap:12px;margin-top:10px}
figure{margin:0;padding:8px;background:#fff;border-radius:6px;border-top:4px solid #2c9a4b}
figure.empty{border-color:#c98a00}figure.failed{border-color:#c62b2b}
.picture{display:block;position:relative;background:#e8eaed}
.picture img{display:block;width:100%;height:100%;opacity:.75}
.picture svg{position:absolute;left:0;top:0;width:100%;height:100%;overflow:hidden}
path{fill:none;stroke:#c8102e;stroke-width:1.6;vector-effect:non-scaling-stroke}
#curves:not(:checked)~main svg{display:none}
figcaption{margin-top:6px;overflow-wrap:anywhere}small{color:#5c636b;display:block}
</style></head><body>
)";

QByteArray escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped().toUtf8(); }

/// The address of a file as seen from the sheet's folder.
QByteArray linkTo(const std::string& file, const fs::path& folder) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  const std::string name = (relative.empty() ? whole : relative).generic_string();
  return QUrl::toPercentEncoding(QString::fromStdString(name), "/");
}

/// The scan made small by averaging; the empty image if it cannot be read.
QImage smallPicture(const BatchPage& page) {
  RunContext context;
  context.threads = 1;
  const auto scan = readScan(page.scan, {.page = {page.page, PageChoice{}.pdfDpi}}, context);
  if (!scan) return {};
  const GreyImage& grey = scan->grey;
  const int step =
      std::max(1, static_cast<int>(std::ceil(static_cast<double>(std::max(grey.width, grey.height)) / kPictureSide)));
  QImage picture((grey.width + step - 1) / step, (grey.height + step - 1) / step, QImage::Format_Grayscale8);
  for (int y = 0; y < picture.height(); ++y) {
    uchar* row = picture.scanLine(y);
    for (int x = 0; x < picture.width(); ++x) {
      double sum = 0.0;
      int count = 0;
      for (int v = y * step; v < std::min(grey.height, (y + 1) * step); ++v) {
        for (int u = x * step; u < std::min(grey.width, (x + 1) * step); ++u, ++count) sum += grey.level(u, v);
      }
      row[x] = static_cast<uchar>(std::lround(sum / count));
    }
  }
  return picture;
}

/// What a sheet shows of one page.
struct Card {
  std::string kind = "failed";  ///< "done", "empty" or "failed".
  std::string picture;          ///< File of the small picture; empty: there is none.
  double aspect = 1.0;          ///< Width over height.
  QByteArray figures;
};

/// "1 curve", "2 curves"
QByteArray counted(int count, const char* what) { return QByteArray::number(count) + what + (count == 1 ? "" : "s"); }

QByteArray figuresOf(const PageRecord& record) {
  const auto number = [&](const char* key) {
    const bool isThere = record.figures.is_object() && record.figures.contains(key) && record.figures[key].is_number();
    return isThere ? record.figures[key].get<double>() : 0.0;
  };
  QByteArray text = counted(static_cast<int>(number("curves")), " curve") + " in " +
                    counted(static_cast<int>(number("pieces")), " piece") + "; " +
                    QByteArray::number(record.seconds, 'f', 1) + " s, " +
                    QByteArray::number(1e-6 * number("peak_memory_bytes"), 'f', 0) + " MB";
  if (record.figures.is_object() && record.figures.contains("notes") && record.figures["notes"].is_array()) {
    for (const auto& note : record.figures["notes"]) {
      if (note.is_string()) text += "<br>" + escaped(note.get<std::string>());
    }
  }
  return text;
}

/// @return CannotWrite if the small picture cannot be written.
Result<Card> cardOf(const BatchPage& page, const std::string* error, const fs::path& pictures) {
  Card card;
  const auto record = readRecord(page);
  if (record && record->isEnded && error == nullptr) {
    card.kind = record->isEmpty ? "empty" : "done";
    card.figures = record->isEmpty ? escaped(record->note) : figuresOf(*record);
  } else {
    card.figures = error != nullptr ? escaped(*error) : QByteArray("not reached yet");
  }
  const auto hash = fileHash(page.scan);
  if (!hash) return card;
  card.picture = (pictures / (hash->substr(0, 24) + ".jpg")).string();
  QImage picture(QString::fromStdString(card.picture));
  if (picture.isNull()) {
    picture = smallPicture(page);
    if (picture.isNull()) {
      card.picture.clear();
      return card;
    }
    QBuffer bytes;
    if (!bytes.open(QIODevice::WriteOnly) || !picture.save(&bytes, "JPG", kPictureQuality)) {
      return fail(ErrorCode::CannotWrite,
                  "The small pictures of the contact sheet cannot be made: Qt cannot write JPEG here.");
    }
    const QByteArray& made = bytes.data();
    if (auto saved = saveAtomically(card.picture, {made.data(), static_cast<std::size_t>(made.size())}); !saved) {
      return fail(saved.error());
    }
  }
  card.aspect = static_cast<double>(picture.width()) / picture.height();
  return card;
}

QByteArray overlayOf(const BatchPage& page) {
  for (const std::string& output : page.outputs) {
    const DrawnLines drawn = drawnLines(output);
    if (drawn.lines.empty()) continue;
    const double height = kLineUnits / drawn.aspect;
    QByteArray svg =
        "<svg viewBox=\"0 0 1000 " + QByteArray::number(height, 'f', 1) + "\" preserveAspectRatio=\"none\">";
    for (const auto& line : drawn.lines) {
      svg += "<path d=\"M";
      for (const Vec2& p : line) {
        svg += QByteArray::number(kLineUnits * p.x(), 'f', 1) + " " + QByteArray::number(height * p.y(), 'f', 1) + " ";
      }
      svg += "\"/>";
    }
    return svg + "</svg>";
  }
  return {};
}

QByteArray figureOf(const BatchPage& page, const Card& card, const fs::path& folder) {
  QByteArray html = "<figure class=\"" + QByteArray::fromStdString(card.kind) + "\">";
  const std::string name = fs::path(page.scan).filename().string();
  if (!card.picture.empty()) {
    html += "<a class=\"picture\" style=\"aspect-ratio:" + QByteArray::number(card.aspect, 'f', 4) + "\" href=\"" +
            linkTo(card.kind == "done" ? page.outputs.front() : page.scan, folder) + "\"><img loading=\"lazy\" alt=\"" +
            escaped(name) + "\" src=\"" + linkTo(card.picture, folder) + "\">" +
            (card.kind == "done" ? overlayOf(page) : QByteArray()) + "</a>";
  }
  html += "<figcaption><b>" + escaped(name) + "</b> ";
  if (card.kind == "done") {
    for (const std::string& output : page.outputs) {
      html += "<a href=\"" + linkTo(output, folder) + "\">" + escaped(fs::path(output).extension().string().substr(1)) +
              "</a> ";
    }
  }
  return html + "<small>" + card.figures + "</small></figcaption></figure>\n";
}

}  // namespace

Result<void> writeContactSheet(const std::vector<BatchPage>& pages, const std::map<std::size_t, std::string>& errors,
                               const std::string& file) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code).lexically_normal(), folder = whole.parent_path();
  const fs::path pictures = folder / (whole.stem().string() + "_files");
  fs::create_directories(pictures, code);
  if (code)
    return fail(ErrorCode::CannotWrite, "Cannot make the folder " + pictures.string() + ": " + code.message() + ".");
  std::vector<Result<Card>> cards(pages.size(), Card{});
  {
    const QuietStderr quiet;
    parallelFor(RunContext{}, static_cast<int>(pages.size()), 1, [&](int begin, int) {
      const auto i = static_cast<std::size_t>(begin);
      const auto error = errors.find(i);
      cards[i] = cardOf(pages[i], error == errors.end() ? nullptr : &error->second, pictures);
    });
  }
  QByteArray html = kHead;
  std::map<std::string, int> kinds;
  QByteArray figures;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (!cards[i]) return fail(cards[i].error());
    ++kinds[cards[i]->kind];
    figures += figureOf(pages[i], *cards[i], folder);
  }
  html += "<h1>" + QByteArray::number(static_cast<int>(pages.size())) + " pages</h1><p>" +
          QByteArray::number(kinds["done"]) + " done, " + QByteArray::number(kinds["empty"]) + " without a curve, " +
          QByteArray::number(kinds["failed"]) +
          " failed or not reached</p>\n<input type=\"checkbox\" id=\"curves\" checked>" +
          "<label for=\"curves\">Curves</label>\n<main>\n" + figures + "</main></body></html>\n";
  return saveAtomically(whole, {html.data(), static_cast<std::size_t>(html.size())});
}

}  // namespace batten::cli
